#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mechanics/design_parameter.hpp"

namespace pliant::mechanics {

/// An element of one of the model's energies.
struct ElementPlace {
  int energy = 0;
  int element = 0;
  bool operator==(const ElementPlace&) const = default;
};

/// The derivative by a parameter on which nothing but the elastic energy of some coordinates depends.
class ElasticDerivative : public ModelDerivative {
 public:
  using ModelDerivative::ModelDerivative;

  virtual std::span<const int> coordinates() const = 0;
  /// d(∇E)/dp on these coordinates: rows of `x` (a configuration each) x coordinates() [N per unit].
  virtual Matrix coordinateGradient(const Matrix& x) const = 0;

  Matrix gradient(const Matrix& x) const final;
};

/// An energy, with what multiplies the energy of each of its elements apart.
struct FactoredParts {
  std::shared_ptr<const Energy> elements;
  std::vector<double> scales;  ///< all 1 if empty
};
FactoredParts withoutFactors(const std::shared_ptr<const Energy>& energy);

/// The element whose factor of stiffness a parameter is; none of other kinds of parameters.
std::optional<ElementPlace> factoredElement(const DesignParameter& parameter);

struct StiffnessFactorOptions {
  std::string name;            ///< of the parameters, before the element's index
  std::string pointer;         ///< of the list of factors in the scene, before "/INDEX"
  std::vector<double> values;  ///< that the model's elements were made with; all 1 if empty
  double minimum = 0;
  double maximum = 0;
};

/// Design parameters that multiply the stiffness of each element of `Model::energies[energy]`, which must consist of
/// membranes or solids: E = Σ fₑ Eₑ, so that derivatives are exact. Throws base::InputError for other energies.
std::vector<std::shared_ptr<const DesignParameter>> makeStiffnessFactors(const Model& model, int energy,
                                                                         const StiffnessFactorOptions& options);

}  // namespace pliant::mechanics
