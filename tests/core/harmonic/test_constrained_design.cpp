#include <QTest>

#include "core/harmonic/constrained_design.hpp"
#include "core/harmonic/design_gradient.hpp"
#include "core/mechanics/registry.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::ConstrainedDesignResult;
using harmonic::DesignConstraint;
using harmonic::HarmonicBalanceProblem;
using harmonic::PeriodicMotion;

namespace {

constexpr double alpha = 0.1, force = 0.1, omega = 1.2;

/// m x'' + α m x' + x = F cos ωt along x of one node that rests at 0.
std::shared_ptr<Model> oscillator(double mass) {
  auto model = std::make_shared<Model>(*duffing(alpha / 2, 0, force));
  model->pointMasses[0] = {"mass", {0}, mass, 0.2, 3};
  return model;
}

double amplitudeOf(double mass) { return force / std::hypot(1 - mass * omega * omega, alpha * mass * omega); }

/// The mass above that of the resonance at which the amplitude is `wanted`.
double heavyMassOf(double wanted) {
  double low = 1 / (omega * omega + alpha * alpha), high = 3;
  while (high - low > 1e-14) (amplitudeOf(0.5 * (low + high)) > wanted ? low : high) = 0.5 * (low + high);
  return low;
}

/// The largest swing that the constraints allow.
ConstrainedDesignResult design(double mass, const std::vector<DesignConstraint>& constraints,
                               const std::function<void(base::ExecutionContext&, int)>& onIterate = {}) {
  harmonic::InverseDesignOptions options;
  options.omega = omega;
  options.parameters = {0};
  options.motion.tolerance = 1e-12;
  options.optimizer.gradientTolerance = 1e-7;
  base::ExecutionContext context;
  return harmonic::designWithConstraints(HarmonicBalanceProblem(oscillator(mass), {3, 32}),
                                         *harmonic::makeAmplitudeObjective({{0}, {}, {}}), constraints, options,
                                         context, [&](const harmonic::DesignIterate& design) {
                                           if (onIterate) onIterate(context, design.iteration);
                                         });
}

DesignConstraint massAtMost(double most) {
  DesignConstraint constraint{"mass", harmonic::makeTotalMass()};
  constraint.upper = constraint.scale = most;
  return constraint;
}

/// No nearer to a wall on the right than `least`.
DesignConstraint wall(double place, double least, double sharpness = 1e5) {
  harmonic::ClearanceGoal goal{{0}, harmonic::Plane{vector2(place, 0), vector2(-3, 0)}, sharpness};
  DesignConstraint constraint{"wall", harmonic::makeClearance(goal)};
  constraint.lower = least;
  constraint.scale = 0.1;
  return constraint;
}

PeriodicMotion solve(HarmonicBalanceProblem& problem, const Vector& start = {}) {
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = options.stepTolerance = 1e-13;
  PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, 3, options, context, start);
  if (!motion.report.converged()) qFatal("there is no motion");
  return motion;
}

}  // namespace

class TestConstrainedDesign : public QObject {
  Q_OBJECT

 private slots:
  void gradientAgreesWithDifferencesOfWholeSolves_data();
  void gradientAgreesWithDifferencesOfWholeSolves();
  void smoothValuesBoundTheExtremes();
  void strainOfAStretchedTriangle();
  void strainByTheRestShape();
  void keepsToAMass();
  void keepsAwayFromAWall();
  void reachesFeasibleDesignsFromOthers();
  void leavesConstraintsThatDoNotMatterAlone();
  void saysThatNoDesignKeepsThem();
  void keepsTheBestWhenCancelled();
};

void TestConstrainedDesign::gradientAgreesWithDifferencesOfWholeSolves_data() {
  QTest::addColumn<int>("constraintKind");
  QTest::addColumn<int>("parameterKind");
  for (std::size_t c = 0; c < harmonic::constraintKinds().size(); ++c)
    for (std::size_t p = 0; p < mechanics::parameterKinds().size(); ++p)
      QTest::addRow(
          "%s by %s", harmonic::constraintKinds()[c].name.c_str(), mechanics::parameterKinds()[p].name.c_str())
          << static_cast<int>(c) << static_cast<int>(p);
}

void TestConstrainedDesign::gradientAgreesWithDifferencesOfWholeSolves() {
  QFETCH(int, constraintKind);
  QFETCH(int, parameterKind);
  for (unsigned seed = 0; seed < 3; ++seed) {
    std::mt19937 random(seed);
    const Model model = mechanics::parameterKinds()[static_cast<std::size_t>(parameterKind)].drivenExample(random);
    const auto problemOf = [](Model made) {
      return HarmonicBalanceProblem(std::make_shared<const Model>(std::move(made)), {5, 32});
    };
    HarmonicBalanceProblem problem = problemOf(model);
    const auto quantity =
        harmonic::constraintKinds()[static_cast<std::size_t>(constraintKind)].example(problem, random);
    const PeriodicMotion motion = solve(problem);
    const harmonic::DesignGradient gradient = harmonic::designGradient(problem, motion, *quantity, {0});
    const auto valueAt = [&](double change) {
      const auto& parameter = *model.parameters[0];
      HarmonicBalanceProblem changed = problemOf(parameter.withValue(model, parameter.value(model) + change));
      return quantity->evaluate(changed, solve(changed, motion.z).z).value;
    };
    QCOMPARE(gradient.value, valueAt(0));
    const double step = 1e-3;
    const double difference =
        (8 * (valueAt(step) - valueAt(-step)) - (valueAt(2 * step) - valueAt(-2 * step))) / (12 * step);
    // Values round to about 1e-15, so differences of those that hardly depend on the parameter to 1e-11.
    const double error = std::abs(gradient.gradient[0] - difference);
    QVERIFY2(
        error < 1e-6 * std::abs(difference) + 1e-11,
        qPrintable(QString("%1, differences %2").arg(gradient.gradient[0], 0, 'g', 10).arg(difference, 0, 'g', 10)));
  }
}

/// By no more than the logarithm of their number over the sharpness, and from the right side.
void TestConstrainedDesign::smoothValuesBoundTheExtremes() {
  std::mt19937 random(3);
  HarmonicBalanceProblem problem(
      std::make_shared<const Model>(mechanics::parameterKinds()[0].drivenExample(random)), {5, 32});
  const PeriodicMotion motion = solve(problem);
  for (const double sharpness : {50.0, 5e3, 5e5}) {
    const double room = std::log(512.0) / sharpness;
    const auto strain = harmonic::makeLargestStrain({{{0, 1, 2}}, {}, sharpness});
    const double above = strain->evaluate(problem, motion.z).value - strain->exactValue(problem, motion.z);
    const auto clearance = harmonic::makeClearance({{1}, harmonic::OtherNode{0}, sharpness});
    const double below = clearance->exactValue(problem, motion.z) - clearance->evaluate(problem, motion.z).value;
    // What lies between instants, of a swing of less than 1.
    const double missed = std::pow(5 * std::numbers::pi / 128, 2) / 2;
    QVERIFY(above > -missed && above < room);
    QVERIFY(below > -missed && below < room);
    if (sharpness == 50) QVERIFY(above > 0 && below > 0);
  }
}

/// A right triangle whose corner is pulled out along x by 0.2 sin τ: the stretch is that of [1 + u, 0; 0, 1].
void TestConstrainedDesign::strainOfAStretchedTriangle() {
  auto model = std::make_shared<Model>();
  model->dimension = 2;
  model->restPositions = (Vector(6) << 0, 0, 1, 0, 0, 1).finished();
  model->gravity = vector2(0, 0);
  model->lockedCoordinates = {1, 1, 0, 1, 1, 1};
  model->energies = {mechanics::makeGroundedSpring(2, 1, vector2(1, 0), vector2(1, 0), {{1}})};
  addPointMass(*model, "corner", {1}, 1);
  model->finish();
  HarmonicBalanceProblem problem(model, {1, 64});
  const auto strain = harmonic::makeLargestStrain({{{0, 1, 2}}, {}, 1e7});
  Vector z(3);
  z << 1, 0.2, 0;
  QVERIFY(std::abs(strain->exactValue(problem, z) - 0.2) < 1e-12);
  QVERIFY(std::abs(strain->evaluate(problem, z).value - 0.2) < 1e-6);
  // Sheared by s, C = [1, s; s, 1 + s²] has the eigenvalue 1 + s²/2 + s √(1 + s²/4).
  auto sheared = std::make_shared<Model>(*model);
  sheared->lockedCoordinates = {1, 1, 1, 1, 0, 1};
  sheared->finish();
  HarmonicBalanceProblem shear(sheared, {1, 64});
  z << 0, 0.3, 0;
  const double expected = std::sqrt(1 + 0.045 + 0.3 * std::sqrt(1 + 0.0225)) - 1;
  QVERIFY(std::abs(strain->exactValue(shear, z) - expected) < 1e-12);
}

/// A triangle whose rest width is a parameter and whose motion is not: strain (1 + u) / w - 1.
void TestConstrainedDesign::strainByTheRestShape() {
  class WidthParameter final : public mechanics::DesignParameter {
   public:
    std::string name() const override { return "width"; }
    base::Dimension dimension() const override { return base::dimensions::length; }
    std::string pointer() const override { return "/geometry/0/points/1/0"; }
    double value(const Model& model) const override { return model.restPositions[2]; }
    double minimum(const Model&) const override { return 0.5; }
    double maximum(const Model&) const override { return 2; }
    Model withValue(const Model& model, double value) const override {
      Model changed = model;
      changed.restPositions[2] = value;
      return changed;
    }
    std::unique_ptr<mechanics::ModelDerivative> derivative(const Model& model) const override {
      return std::make_unique<mechanics::ModelDerivative>(model);
    }
  };
  auto model = std::make_shared<Model>();
  model->dimension = 2;
  model->restPositions = (Vector(6) << 0, 0, 1.1, 0, 0, 1).finished();
  model->gravity = vector2(0, 0);
  model->lockedCoordinates = {1, 1, 0, 1, 1, 1};
  model->energies = {mechanics::makeGroundedSpring(2, 1, vector2(1, 0), vector2(1, 0), {{1}})};
  addPointMass(*model, "corner", {1}, 1);
  model->parameters = {std::make_shared<WidthParameter>()};
  model->finish();
  const HarmonicBalanceProblem problem(model, {1, 64});
  Vector z(3);
  z << 1.2, 0.2, 0;
  const auto at = harmonic::makeLargestStrain({{{0, 1, 2}}, {}, 1e7})->evaluate(problem, z);
  QVERIFY(std::abs(at.byParameters[0] + 1.4 / (1.1 * 1.1)) < 1e-6);
}

void TestConstrainedDesign::keepsToAMass() {
  const double budget = 0.5;  // below that of the resonance, 0.69
  const ConstrainedDesignResult result = design(0.3, {massAtMost(budget)});
  QVERIFY2(result.design.report.converged(), result.design.report.message.c_str());
  const auto& last = result.design.history.back();
  QVERIFY(std::abs(last.values[0] - budget) < 1e-5 && last.values[0] <= budget * (1 + 1e-6));
  QVERIFY(std::abs(last.amplitudes[0].pathLength - 4 * amplitudeOf(budget)) < 1e-4);
  QVERIFY(result.optimality.stationarity < 1e-6 && result.optimality.violation <= 1e-6);
  // The multiplier is what the objective would gain per kilogram.
  const double step = 1e-5, gain = 4 * (amplitudeOf(budget + step) - amplitudeOf(budget - step)) / (2 * step);
  QVERIFY2(std::abs(result.optimality.multipliers[0] / gain - 1) < 1e-3,
           qPrintable(QString("%1, expected %2").arg(result.optimality.multipliers[0]).arg(gain)));
  QVERIFY(std::abs(result.states.back()[0].exactValue - last.values[0]) < 1e-12);
  QCOMPARE(result.states.size(), result.design.history.size());
}

/// The swing may be 0.3, from a heavier mass than that of the resonance.
void TestConstrainedDesign::keepsAwayFromAWall() {
  const ConstrainedDesignResult result = design(2, {wall(0.5, 0.2)});
  QVERIFY2(result.design.report.converged(), result.design.report.message.c_str());
  const auto& last = result.design.history.back();
  const double allowed = std::log(512.0) / 1e5;                         // of the smooth minimum
  const double missed = 0.3 * std::pow(std::numbers::pi / 512, 2) / 2;  // between instants
  QVERIFY(last.amplitudes[0].maximumDisplacement < 0.3 + missed + 1e-6);
  QVERIFY(last.amplitudes[0].maximumDisplacement > 0.3 - allowed - 1e-6);
  QVERIFY(std::abs(last.values[0] - heavyMassOf(0.3)) < 1e-3);
  QVERIFY(std::abs(result.states.back()[0].exactValue - (0.5 - last.amplitudes[0].maximumDisplacement)) < missed);
}

void TestConstrainedDesign::reachesFeasibleDesignsFromOthers() {
  const ConstrainedDesignResult result = design(2, {massAtMost(0.5)});
  QVERIFY2(result.design.report.converged(), result.design.report.message.c_str());
  QCOMPARE(result.states.front()[0].exactValue, 2.0);
  QVERIFY(std::abs(result.design.history.back().values[0] - 0.5) < 1e-5);
}

void TestConstrainedDesign::leavesConstraintsThatDoNotMatterAlone() {
  const ConstrainedDesignResult result = design(2, {massAtMost(2.5), wall(9, 0.1)});
  QVERIFY2(result.design.report.converged(), result.design.report.message.c_str());
  QVERIFY(std::abs(result.design.history.back().values[0] - 1 / (omega * omega + alpha * alpha)) < 1e-5);
  QCOMPARE(result.optimality.multipliers[0], 0.0);
  QCOMPARE(result.optimality.multipliers[1], 0.0);
}

void TestConstrainedDesign::saysThatNoDesignKeepsThem() {
  const ConstrainedDesignResult result = design(2, {massAtMost(0.1)});
  QVERIFY(!result.design.report.converged());
  QVERIFY(!result.design.report.message.empty());
  QVERIFY(std::abs(result.design.history.back().values[0] - 0.2) < 0.02);  // the lightest there is
  QVERIFY(result.optimality.violation > 0.9);
}

void TestConstrainedDesign::keepsTheBestWhenCancelled() {
  const ConstrainedDesignResult result =
      design(0.3, {massAtMost(0.5)}, [](base::ExecutionContext& context, int iteration) {
        if (iteration == 3) context.requestCancel();
      });
  QVERIFY(result.design.report.termination == base::TerminationType::cancelled);
  const auto& history = result.design.history;
  for (std::size_t i = 0; i < history.size(); ++i)
    if (result.states[i][0].value <= 0.5) QVERIFY(history.back().objective <= history[i].objective);
  QVERIFY(result.states.back()[0].value <= 0.5 * (1 + 1e-6));
  QVERIFY(history.back().objective < history.front().objective);
}

QTEST_GUILESS_MAIN(TestConstrainedDesign)
#include "test_constrained_design.moc"
