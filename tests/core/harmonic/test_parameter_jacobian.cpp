#include <QTest>
#include <numeric>

#include "core/harmonic/parameter_jacobian.hpp"
#include "core/mechanics/drive_frequency.hpp"
#include "core/mechanics/family_parameter.hpp"
#include "core/mechanics/joint_parameter.hpp"
#include "core/mechanics/point_mass_parameter.hpp"
#include "core/mechanics/prescribed_motion.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/spring.hpp"
#include "core/mechanics/stiffness_factor.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::ParameterJacobian;

namespace {

constexpr double omega = 3;

/// A triangle of foil with springs, shaken at a corner: `values` are a spring's stiffness, the drive's amplitude and a
/// corner's height.
Model shakenFoil(const std::vector<double>& values) {
  Model model;
  model.dimension = 2;
  model.restPositions.resize(6);
  model.restPositions << 0, 0, 1, values[2], 0.4, 1;
  const mechanics::ShellMaterial foil{.youngModulus = 1e4, .poissonRatio = 0.3, .density = 1, .thickness = 1e-3};
  model.energies.push_back(mechanics::makeMembrane(2, model.restPositions, {{0, 1, 2}}, foil));
  for (const int node : {1, 2})
    for (const Vector& direction : {Vector(Vector::Unit(2, 0)), Vector(Vector::Unit(2, 1))})
      model.energies.push_back(mechanics::makeGroundedSpring(
          2, node, model.restPositions.segment(2 * node, 2), direction, {{values[0], 0, 10}}));
  model.pointMasses = {{"first", {1}, 0.5, 0.1, 3}, {"second", {2}, 0.4, 0.1, 3}};
  model.gravity = -Vector::Unit(2, 1);
  model.drives = {mechanics::makeTranslation({0}, Vector::Unit(2, 0), {{{1, values[1], 0.4}}})};
  model.massDamping = 0.3;
  model.stiffnessDamping = 0.02;
  model.probes = {{"second", 2}};
  model.familyValues = values;
  model.finish();
  return model;
}

/// Parameters of every kind at once: three that are changed together, two masses, a factor, the frequency.
std::shared_ptr<const Model> withEverything() {
  const auto family = std::make_shared<const mechanics::ModelFamily>(shakenFoil);
  auto model = std::make_shared<Model>(shakenFoil({4, 0.1, 0.2}));
  const std::vector<mechanics::FamilyParameter> members{{"stiffness", "/0", base::dimensions::none, 1, 9},
                                                        {"amplitude", "/1", base::dimensions::none, 0.05, 0.2},
                                                        {"height", "/2", base::dimensions::none, -0.4, 0.4}};
  auto factors = mechanics::makeStiffnessFactors(*model, 0, {"factor", "/factors", {}, 0.2, 3});
  for (int i = 0; i < 3; ++i)
    model->parameters.push_back(mechanics::makeFamilyParameter(i, members[static_cast<std::size_t>(i)], family));
  model->parameters.push_back(mechanics::makePointMassParameter(0, "first"));
  model->parameters.push_back(mechanics::makePointMassParameter(1, "second"));
  model->parameters.push_back(factors.front());
  model->parameters.push_back(mechanics::makeDriveFrequency({"frequency", "/studies/0/frequency", omega, 1, 6}));
  return model;
}

HarmonicBalanceProblem problemOf(std::shared_ptr<const Model> model) { return {std::move(model), {3, 32}}; }

double relativeDifference(const Vector& a, const Vector& b) { return (a - b).norm() / b.norm(); }

}  // namespace

/// One direction of many parameters is differentiated otherwise than each of them.
class TestParameterJacobian : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void aDirectionIsTheSumOfItsColumns() {
    const auto model = withEverything();
    const HarmonicBalanceProblem problem = problemOf(model);
    const Vector z = problem.restCoefficients() + 0.05 * Vector::Random(problem.size());
    std::vector<int> all(model->parameters.size());
    std::iota(all.begin(), all.end(), 0);
    const ParameterJacobian jacobian(problem, z, omega, all);
    Vector direction(static_cast<Eigen::Index>(all.size())), values(direction.size());
    direction << 0.7, 0.02, -0.1, 0.2, -0.15, 0.3, 0.4;
    for (Eigen::Index i = 0; i < values.size(); ++i)
      values[i] = model->parameters[static_cast<std::size_t>(i)]->value(*model);

    const Vector along = jacobian.times(direction);
    const auto residualAt = [&](double part) -> Vector {
      auto changed =
          std::make_shared<Model>(mechanics::withParameterValues(*model, model->parameters, values + part * direction));
      const double frequency = mechanics::driveFrequency(*changed).value();
      return problemOf(std::move(changed)).residual(z, frequency);
    };
    // Central differences of order 4.
    constexpr double step = 2e-3;
    const Vector difference =
        (8 * (residualAt(step) - residualAt(-step)) - (residualAt(2 * step) - residualAt(-2 * step))) / (12 * step);
    QVERIFY2(relativeDifference(along, difference) < 1e-9,
             qPrintable(QString::number(relativeDifference(along, difference))));

    const Vector adjoint = Vector::Random(z.size());
    const Vector products = jacobian.transposedTimes(adjoint);  // forms all columns
    QVERIFY(std::abs(products.dot(direction) - adjoint.dot(along)) < 1e-8 * adjoint.norm() * along.norm());
    QVERIFY(relativeDifference(jacobian.times(direction), along) < 1e-8);
    for (Eigen::Index i = 0; i < direction.size(); ++i) {
      const Vector single = ParameterJacobian(problem, z, omega, all).times(Vector::Unit(direction.size(), i));
      QVERIFY(std::abs(products[i] - adjoint.dot(single)) < 1e-8 * adjoint.norm() * single.norm());
    }
  }
};

QTEST_GUILESS_MAIN(TestParameterJacobian)
#include "test_parameter_jacobian.moc"
