#pragma once

#include <QStringList>
#include <functional>

#include "core/scene/parts_request.hpp"
#include "ui/jobs/motion_session.hpp"

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

/// Work for any thread: writes the bodies of a scene as scene::exportParts does and returns its lines, none once
/// cancelled. Throws base::InputError.
using PartsExport = std::function<QStringList(base::ExecutionContext&)>;

/// Of what is on show: the scene as it is now, with the shape of this moment; links know all of its motion.
PartsExport partsExport(const QString& file, const document::Document& document, const jobs::MotionSession& session,
                        viewport::Viewport& viewport, const scene::PartsRequest& request);

}  // namespace pliant::shell
