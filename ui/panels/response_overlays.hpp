#pragma once

#include <QString>
#include <string>
#include <vector>

#include "ui/document/document.hpp"
#include "ui/jobs/motion_session.hpp"
#include "ui/plots/response_plot.hpp"

namespace pliant::panels {

/// The probe at a node; -1 if there is none.
int probeOf(const mechanics::Model& model, int node);

/// What other studies than `shown` have found of a probe's amplitude: curves of linear analysis, single motions of time
/// integration, other response curves. Empty if `node` is no probe.
std::vector<plots::ResponseOverlay> studyOverlays(const document::Document& document, const std::string& shown,
                                                  int node, jobs::AmplitudeMeasure measure);

/// Reads measurements: a table of comma-separated values whose header names two columns with their units, such as
/// `frequency [Hz],amplitude [mm]`; further columns are left alone. Throws base::InputError.
plots::ResponseOverlay readMeasurements(const QString& file);

}  // namespace pliant::panels
