#include "core/mechanics/driven_examples.hpp"

#include "core/mechanics/family_parameter.hpp"
#include "core/mechanics/point_mass_parameter.hpp"
#include "core/mechanics/prescribed_motion.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/spring.hpp"
#include "core/mechanics/stiffness_factor.hpp"

namespace pliant::mechanics {

namespace {

Vector vectorOf(double x, double y) {
  Vector vector(2);
  vector << x, y;
  return vector;
}

/// Everything depends on `value`.
Model shakenNodes(double value) {
  Model model;
  model.dimension = 2;
  model.restPositions.resize(6);
  model.restPositions << 0, 0, 1 + 0.1 * value, 0, 2, 0.3;
  const auto rest = [&](int node) { return Vector(model.restPositions.segment(2 * node, 2)); };
  const Vector x = vectorOf(1, 0), y = vectorOf(0, 1);
  model.energies.push_back(makeSpring(2, 0, 1, 0.9 + 0.02 * value, {{8 * std::exp(0.1 * value), 0, 5}}));
  model.energies.push_back(makeSpring(2, 1, 2, 1, {{6, 0, 5 * value}}));
  for (const int node : {1, 2})
    for (const Vector& direction : {x, y})
      model.energies.push_back(makeGroundedSpring(2, node, rest(node), direction, {{4, 0, 10}}));
  const ShellMaterial sheet{.youngModulus = 1e4 * (1 + 0.1 * value),
                            .poissonRatio = 0.3,
                            .density = 1,
                            .thickness = 1e-3 * (1 + 0.1 * value)};
  model.energies.push_back(makeMembrane(2, model.restPositions, {{0, 1, 2}}, sheet));
  model.pointMasses = {{"first", {1}, 0.5 + 0.1 * value * value, 0.1, 3}, {"second", {2}, 0.4, 0.1, 3}};
  model.gravity = vectorOf(0.3, -1);
  model.forces = {{"load", {2}, y, {{{1, 0.4 + 0.1 * value, 0.2}}}}};
  model.drives = {makeTranslation({0}, vectorOf(0.8, 0.6), {{{1, 0.1 * (1 + 0.2 * value), value}}})};
  model.massDamping = 0.3 + 0.05 * value;
  model.stiffnessDamping = 0.02 * (1 + value);
  model.probes = {{"second", 2}, {"shaken", 0}};
  model.familyValues = {value};
  model.finish();
  return model;
}

double anyValue(std::mt19937& random) { return std::uniform_real_distribution<double>(0.5, 1.5)(random); }

}  // namespace

Model drivenPointMassExample(std::mt19937& random) {
  Model model = shakenNodes(anyValue(random));
  model.parameters = {makePointMassParameter(0, "first"), makePointMassParameter(1, "second")};
  return model;
}

Model drivenFamilyExample(std::mt19937& random) {
  const auto family =
      std::make_shared<const ModelFamily>([](const std::vector<double>& values) { return shakenNodes(values.at(0)); });
  Model model = shakenNodes(anyValue(random));
  model.parameters = {makeFamilyParameter(0, {"value", "/value", base::dimensions::none, 0.2, 2}, family)};
  return model;
}

Model drivenStiffnessFactorExample(std::mt19937& random) {
  Model model = shakenNodes(1);
  StiffnessFactorOptions options{"factor", "/factors", {anyValue(random)}, 0.2, 3};
  const ShellMaterial material{.youngModulus = 1e4, .poissonRatio = 0.3, .density = 1, .thickness = 1e-3};
  model.energies.back() = makeMembrane(2, model.restPositions, {{0, 1, 2}}, material, {options.values, {}});
  model.parameters = makeStiffnessFactors(model, static_cast<int>(model.energies.size()) - 1, options);
  return model;
}

}  // namespace pliant::mechanics
