#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/mechanics/design_parameter.hpp"

namespace pliant::mechanics {

/// Models that differ in some parameters alone, with the same nodes, coordinates, energies and freedoms. Called with
/// `Model::familyValues`; all other parameters have their first value. Throws base::InputError where there is no model.
using ModelFamily = std::function<Model(const std::vector<double>& values)>;

struct FamilyParameter {
  std::string name;
  std::string pointer;
  base::Dimension dimension;
  double minimum = 0;
  double maximum = 0;
};

/// A parameter on which anything in the model may depend: material, thickness, rest shape, attachment, drive. Entry
/// `index` of Model::familyValues. Derivatives are differences of order 4 between four models of the family whose
/// values are a few thousandths of the range apart: relative errors of about 1e-10, wherever the model is smooth.
std::shared_ptr<const DesignParameter> makeFamilyParameter(int index, FamilyParameter parameter,
                                                           std::shared_ptr<const ModelFamily> family);

/// How a number that the model alone decides changes with a parameter of any kind: differences of order 4 as well, in
/// steps of `relativeStep` times the value (or a tenth of the range, whichever is larger).
double derivativeOf(const std::function<double(const Model&)>& number, const DesignParameter& parameter,
                    const Model& model, double relativeStep);

/// The derivatives along `direction` in the space of parameters of any kind, an entry each. Differences as above, so
/// that a direction costs no more than one parameter.
std::unique_ptr<ModelDerivative> derivativeAlong(const Model& model,
                                                 const std::vector<std::shared_ptr<const DesignParameter>>& parameters,
                                                 const Vector& direction);

}  // namespace pliant::mechanics
