#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/harmonic/curve_sensitivity.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// Of a response curve, by all parameters of the model.
struct PeakSensitivities {
  /// One for each point that is a peak, in their order; none where it cannot be told.
  std::vector<std::optional<harmonic::PeakSensitivity>> peaks;
};

/// Of all peaks that `result` has; of fewer if cancelled.
std::shared_ptr<const PeakSensitivities> computePeakSensitivities(const HarmonicResult& result,
                                                                  base::ExecutionContext& context);

/// Adds "sensitivities" to the entries of summary.json's "peaks".
void addPeakSensitivities(const HarmonicResult& result, Json& peaks);

/// peak_sensitivity.csv: a row a peak and parameter; and what is read from it. Throws base::InputError for a table of
/// other peaks or parameters.
std::string peakSensitivityTable(const HarmonicResult& result);
std::shared_ptr<const PeakSensitivities> readPeakSensitivities(const HarmonicResult& result, const std::string& table);

/// sensitivity.csv of a single motion: a row a parameter.
std::string sensitivityTable(const HarmonicResult& result);

}  // namespace pliant::scene
