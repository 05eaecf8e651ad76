#pragma once

#include "core/scene/study.hpp"

namespace pliant::scene {

/// Factory of the study "calibration", whose options stand in calibration_specs.cpp. Throws base::InputError for a
/// parameter that the scene does not have, a table that cannot be read, or too many harmonics.
std::unique_ptr<Study> makeCalibrationStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options);

}  // namespace pliant::scene
