#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/mechanics/design_parameter.hpp"

namespace pliant::mechanics {

/// The frequency of the drive as a design parameter. It belongs to motions, not to the model: the equation of motion is
/// The frequency of the drive as a design parameter. It belongs to motions, not to the model: a model that has the
/// parameter says by its value at which frequency its motions are sought, and its derivative is ModelDerivative's
/// `driveFrequency` alone.
struct DriveFrequencyOptions {
  std::string name;
  std::string pointer;
  double value = 0;  ///< ω [rad/s]
  double minimum = 0;
  double maximum = 0;
};
/// Throws base::InputError for a value that is not above 0.
std::shared_ptr<const DesignParameter> makeDriveFrequency(DriveFrequencyOptions options);

bool isDriveFrequency(const DesignParameter& parameter);

/// The frequency of the first such parameter that the model has [rad/s].
std::optional<double> driveFrequency(const Model& model);

/// The model without the drive frequencies that `isKept` says no to, by their pointers.
std::shared_ptr<const Model> withoutDriveFrequencies(std::shared_ptr<const Model> model,
                                                     const std::function<bool(const std::string& pointer)>& isKept);

}  // namespace pliant::mechanics
