#include <QTest>

#include "core/base/error.hpp"
#include "core/harmonic/calibration_residuals.hpp"
#include "core/mechanics/registry.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::CalibrationOptions;
using harmonic::CalibrationResult;
using harmonic::HarmonicBalanceProblem;
using harmonic::MeasuredMotion;
using harmonic::MeasuredValue;

namespace {

constexpr double omega = 1.2;

/// α of the mass-proportional damping as a design parameter.
class DampingParameter final : public mechanics::DesignParameter {
 public:
  std::string name() const override { return "damping"; }
  base::Dimension dimension() const override { return base::dimensions::rate; }
  std::string pointer() const override { return "/damping/mass_proportional"; }
  double value(const Model& model) const override { return model.massDamping; }
  double minimum(const Model&) const override { return 0.01; }
  double maximum(const Model&) const override { return 1; }
  Model withValue(const Model& model, double value) const override {
    Model changed = model;
    changed.massDamping = value;
    return changed;
  }
  std::unique_ptr<mechanics::ModelDerivative> derivative(const Model& model) const override {
    class ByDamping final : public mechanics::ModelDerivative {
     public:
      using ModelDerivative::ModelDerivative;
      double massDamping() const override { return 1; }
    };
    return std::make_unique<ByDamping>(model);
  }
};

/// m x'' + α m x' + x + γ x³ = F cos ωt with m and α to be found.
std::shared_ptr<Model> oscillator(double mass, double damping, double cubic) {
  auto model = std::make_shared<Model>(*duffing(damping / 2, cubic, 0.1));
  model->pointMasses[0] = {"mass", {0}, mass, 0.2, 3};
  model->parameters.push_back(std::make_shared<DampingParameter>());
  return model;
}

HarmonicBalanceProblem problemOf(const std::shared_ptr<const Model>& model) { return {model, {3, 16}}; }

Vector motionOf(const std::shared_ptr<const Model>& model, double frequency = omega) {
  HarmonicBalanceProblem problem = problemOf(model);
  base::ExecutionContext context;
  const auto motion = harmonic::solvePeriodicMotion(problem, frequency, {}, context);
  if (!motion.report.converged()) qFatal("no motion");
  return motion.z;
}

/// The motion of the mass as somebody sees it who starts a clock `offset` after the drive's, with errors.
MeasuredMotion measure(const std::shared_ptr<const Model>& model, double deviation, std::mt19937& random,
                       double offset = 0.7, double frequency = omega) {
  const Vector z = motionOf(model, frequency);
  const math::HarmonicBasis basis(3, 16);
  std::normal_distribution<double> error(0, 1);
  MeasuredMotion measured;
  measured.omega = frequency;
  measured.times = Vector::LinSpaced(60, 0, 13);
  Vector values(measured.times.size());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] = basis.valuesAt(frequency * (measured.times[i] + offset)).dot(z.head(7)) + deviation * error(random);
  measured.coordinates = {{0, 0, values}};
  return measured;
}

CalibrationResult calibrate(const std::shared_ptr<const Model>& model, std::vector<MeasuredMotion> measured,
                            std::vector<int> parameters) {
  CalibrationOptions options;
  options.parameters = std::move(parameters);
  base::ExecutionContext context;
  return harmonic::calibrate(problemOf(model), std::move(measured), options, context);
}

/// The k for which a binomial variable is at most k with less than `probability`, and with more than 1 - it.
std::pair<int, int> binomialRange(int count, double success, double probability) {
  double sum = 0;
  int low = -1, high = count;
  for (int k = 0; k <= count; ++k) {
    sum += std::exp(std::lgamma(count + 1) - std::lgamma(k + 1) - std::lgamma(count - k + 1) + k * std::log(success) +
                    (count - k) * std::log1p(-success));
    if (sum < probability) low = k;
    if (sum > 1 - probability) {
      high = k;
      break;
    }
  }
  return {low, high};
}

}  // namespace

class TestCalibration : public QObject {
  Q_OBJECT

 private slots:
  void findsTheBestPhase();
  void jacobianAgainstWholeSolves_data();
  void jacobianAgainstWholeSolves();
  void recoversParameters_data();
  void recoversParameters();
  void intervalsHoldTheTruthAsOftenAsTheySay();
  void saysWhatCannotBeToldApart();
  void staysWithinBounds();
  void seesThatTheModelIsWrong();
  void measuresFromRestAndFromUnknownPlaces();
  void refusesTooFewValues();
  void refusesDisplacementsFromWhatMoves();
};

/// Against a fine search by brute force, with missing values and unknown places.
void TestCalibration::findsTheBestPhase() {
  std::mt19937 random(4);
  std::normal_distribution<double> entry;
  for (int trial = 0; trial < 20; ++trial) {
    MeasuredMotion measured;
    measured.omega = 2;
    measured.times = Vector::NullaryExpr(15, [&] { return entry(random); });
    if (trial % 2) measured.meaning = MeasuredValue::swing;
    for (int axis = 0; axis < 2; ++axis) {
      measured.coordinates.push_back({0, axis, Vector::NullaryExpr(15, [&] { return entry(random); })});
      measured.coordinates.back().values[3 + axis] = std::numeric_limits<double>::quiet_NaN();
    }
    const Matrix coefficients = Matrix::NullaryExpr(7, 2, [&] { return entry(random); });
    const auto fit = harmonic::MotionComparison(measured, 3).compare(coefficients);
    QCOMPARE(fit.residuals.size(), Eigen::Index(28));
    const math::HarmonicBasis basis(3, 7);
    double least = 1e300;
    for (int i = 0; i < 20000; ++i) {
      const double phase = 2 * std::numbers::pi * i / 20000;
      double sum = 0;
      for (int axis = 0; axis < 2; ++axis) {
        std::vector<double> residuals;
        for (int k = 0; k < 15; ++k)
          if (k != 3 + axis)
            residuals.push_back(basis.valuesAt(2 * measured.times[k] + phase).dot(coefficients.col(axis)) -
                                measured.coordinates[static_cast<std::size_t>(axis)].values[k]);
        double mean = 0;
        if (trial % 2)
          for (const double r : residuals) mean += r / 14;
        for (const double r : residuals) sum += (r - mean) * (r - mean);
      }
      least = std::min(least, sum);
    }
    const double found = fit.residuals.squaredNorm();
    QVERIFY(found <= least && found > (1 - 1e-4) * least);
  }
}

void TestCalibration::jacobianAgainstWholeSolves_data() {
  QTest::addColumn<int>("kind");
  QTest::addColumn<int>("meaning");
  QTest::addColumn<bool>("phaseKnown");
  const std::vector<std::string> meanings{"position", "displacement", "swing"};
  for (std::size_t i = 0; i < mechanics::parameterKinds().size(); ++i)
    for (int meaning = 0; meaning < 3; ++meaning)
      for (const bool known : {true, false})
        QTest::newRow((mechanics::parameterKinds()[i].name + ", " + meanings[static_cast<std::size_t>(meaning)] +
                       (known ? ", known" : ", unknown") + " phase")
                          .c_str())
            << static_cast<int>(i) << meaning << known;
}

/// Every kind of parameter, two driving frequencies, three nodes, of which one is driven. Where nothing else is unknown
/// the Jacobian is that of the residuals; else the gradient of Σ r² is.
void TestCalibration::jacobianAgainstWholeSolves() {
  QFETCH(int, kind);
  QFETCH(int, meaning);
  QFETCH(bool, phaseKnown);
  std::mt19937 random(21);
  auto model =
      std::make_shared<Model>(mechanics::parameterKinds()[static_cast<std::size_t>(kind)].drivenExample(random));
  model->parameters.resize(1);
  std::normal_distribution<double> entry;
  std::vector<MeasuredMotion> measured(2);
  for (std::size_t i = 0; i < 2; ++i) {
    measured[i].omega = i == 0 ? 3 : 2.6;
    measured[i].times = Vector::LinSpaced(11, 0, 2);
    measured[i].meaning = static_cast<MeasuredValue>(meaning);
    if (phaseKnown) measured[i].timeOffset = 0.1;
    for (int node = 0; node < 3; ++node)
      measured[i].coordinates.push_back(
          {node, node % model->dimension, Vector::NullaryExpr(11, [&] { return 0.1 * entry(random); })});
  }
  harmonic::PeriodicMotionOptions motion;
  motion.tolerance = 1e-13;
  motion.stepTolerance = 1e-14;
  base::ExecutionContext context;
  harmonic::CalibrationResiduals function(HarmonicBalanceProblem(model, {5, 32}), measured, motion, context);
  QVERIFY(function.begin().converged());
  const Vector start = function.anyBranch().firstVariables();
  Vector residuals;
  Matrix jacobian;
  QVERIFY(function.evaluate(start, residuals, &jacobian));
  const double step = 1e-4;
  const auto at = [&](double change) {
    Vector found;
    if (!function.evaluate(start + Vector::Constant(1, change * step), found, nullptr)) qFatal("no residuals");
    return found;
  };
  const Vector one = at(1), minusOne = at(-1), two = at(2), minusTwo = at(-2);
  const auto slope = [&](const auto& value) {
    return (8 * (value(one) - value(minusOne)) - (value(two) - value(minusTwo))) / (12 * step);
  };
  if (phaseKnown && meaning < 2) {
    const Vector difference = (8 * (one - minusOne) - (two - minusTwo)) / (12 * step);
    QVERIFY(difference.norm() > 1e-6);
    QVERIFY((jacobian.col(0) - difference).norm() < 1e-6 * difference.norm());
  }
  const double gradient = 2 * jacobian.col(0).dot(residuals);
  const double expected = slope([](const Vector& r) { return r.squaredNorm(); });
  QVERIFY2(std::abs(gradient - expected) < 1e-6 * jacobian.norm() * residuals.norm(),
           qPrintable(QString("%1, expected %2").arg(gradient).arg(expected)));
}

void TestCalibration::recoversParameters_data() {
  QTest::addColumn<double>("deviation");
  QTest::newRow("exact") << 0.0;
  QTest::newRow("noisy") << 0.01;
}

/// Mass and damping of a hardening oscillator from two motions whose clocks are not known.
void TestCalibration::recoversParameters() {
  QFETCH(double, deviation);
  std::mt19937 random(6);
  const auto truth = oscillator(1.3, 0.2, 0.5);
  const CalibrationResult result =
      calibrate(oscillator(0.9, 0.5, 0.5),
                {measure(truth, deviation, random, 0.7), measure(truth, deviation, random, 2, 1)}, {0, 1});
  QVERIFY2(result.report.converged(), result.report.message.c_str());
  const Vector& values = result.history.back().values;
  if (deviation == 0) {
    QVERIFY((values - Eigen::Vector2d(1.3, 0.2)).norm() < 1e-6);
    QVERIFY(std::abs(result.motions[0].timeOffset - 0.7) < 1e-5);
    QVERIFY(std::abs(result.motions[1].timeOffset - 2) < 1e-5);
    return;
  }
  QVERIFY(std::abs(values[0] - 1.3) < result.uncertainty.halfWidths[0]);
  QVERIFY(std::abs(values[1] - 0.2) < result.uncertainty.halfWidths[1]);
  QCOMPARE(result.uncertainty.degreesOfFreedom, 2 * 60 - 4);
  // s has a standard deviation of σ / √(2 · 116): five of them.
  QVERIFY(std::abs(result.uncertainty.residualDeviation / deviation - 1) < 5 / std::sqrt(232));
  QVERIFY(result.uncertainty.halfWidths[0] < 0.1 * 1.3 && result.uncertainty.halfWidths[1] < 0.2);
}

/// The share of intervals that hold the true values is that of the level, as far as 400 trials can tell: the bounds are
/// passed by chance in one of a million runs.
void TestCalibration::intervalsHoldTheTruthAsOftenAsTheySay() {
  constexpr int trials = 400;
  const auto truth = oscillator(1.3, 0.2, 0.5);
  std::mt19937 random(17);
  std::array<int, 2> held{};
  for (int trial = 0; trial < trials; ++trial) {
    const CalibrationResult result =
        calibrate(truth, {measure(truth, 0.005, random, 0.7), measure(truth, 0.005, random, 2, 1)}, {0, 1});
    QVERIFY2(result.report.converged(), result.report.message.c_str());
    const Vector& values = result.history.back().values;
    held[0] += std::abs(values[0] - 1.3) < result.uncertainty.halfWidths[0];
    held[1] += std::abs(values[1] - 0.2) < result.uncertainty.halfWidths[1];
  }
  const auto [low, high] = binomialRange(trials, 0.95, 5e-7);
  qInfo("%d and %d of %d intervals hold the truth; from %d to %d would do", held[0], held[1], trials, low + 1, high);
  for (const int count : held) QVERIFY(count > low && count <= high);
}

/// Of a linear oscillator with mass and damping unknown one motion without a clock tells its amplitude alone.
void TestCalibration::saysWhatCannotBeToldApart() {
  std::mt19937 random(9);
  const auto truth = oscillator(1.3, 0.2, 0);
  const CalibrationResult result = calibrate(oscillator(1.2, 0.25, 0), {measure(truth, 0.01, random)}, {0, 1});
  const auto& uncertainty = result.uncertainty;
  QCOMPARE(uncertainty.undetermined.cols(), Eigen::Index(1));
  QVERIFY(std::isnan(uncertainty.standardErrors[0]) && std::isnan(uncertainty.standardErrors[1]));
  // Along the combination (1 - m ω²)² + (α m ω)² stays the same.
  const Vector at = result.history.back().values, change = uncertainty.undetermined.col(0);
  const double byMass = -2 * omega * omega * (1 - at[0] * omega * omega) + 2 * at[0] * std::pow(at[1] * omega, 2);
  const double byDamping = 2 * at[1] * std::pow(at[0] * omega, 2);
  QVERIFY(std::abs(change[0] * byMass + change[1] * byDamping) < 1e-5 * std::abs(change[0] * byMass));
  // With the drive's clock both are found.
  std::mt19937 again(9);
  MeasuredMotion clocked = measure(truth, 0.01, again);
  clocked.timeOffset = 0.7;
  const CalibrationResult both = calibrate(oscillator(1.2, 0.25, 0), {clocked}, {0, 1});
  QCOMPARE(both.uncertainty.undetermined.cols(), Eigen::Index(0));
  QVERIFY((both.history.back().values - Eigen::Vector2d(1.3, 0.2)).norm() < 0.05);
}

void TestCalibration::staysWithinBounds() {
  std::mt19937 random(9);
  auto model = oscillator(1, 0.2, 0.5);
  model->pointMasses[0].maximum = 1.1;
  const CalibrationResult result = calibrate(model, {measure(oscillator(1.3, 0.2, 0.5), 0.001, random)}, {0, 1});
  QVERIFY2(result.report.converged(), result.report.message.c_str());
  QCOMPARE(result.history.back().values[0], 1.1);
  QCOMPARE(result.atBound[0], 1);
  QVERIFY(std::isnan(result.uncertainty.standardErrors[0]) && result.uncertainty.standardErrors[1] > 0);
}

/// What a model without the cubic force leaves is the third harmonic, whose successive samples correlate by the cosine
/// of the phase between them, 0.70; those of noise do not.
void TestCalibration::seesThatTheModelIsWrong() {
  std::mt19937 random(9);
  const auto truth = oscillator(1.3, 0.2, 0.5);
  MeasuredMotion measured = measure(truth, 1e-6, random);
  measured.timeOffset = 0.7;
  QVERIFY(std::abs(calibrate(truth, {measured}, {0, 1}).motions[0].serialCorrelation) < 0.3);
  QVERIFY(calibrate(oscillator(1.3, 0.2, 0), {measured}, {0, 1}).motions[0].serialCorrelation > 0.6);
}

/// A node that rests at x = 2, seen by a camera whose frame nobody knows.
void TestCalibration::measuresFromRestAndFromUnknownPlaces() {
  std::mt19937 random(9);
  const auto truth = oscillator(1.3, 0.2, 0.5);
  MeasuredMotion measured = measure(truth, 0, random);
  const auto elsewhere = std::make_shared<Model>(*oscillator(0.9, 0.5, 0.5));
  elsewhere->restPositions[0] = 2;
  elsewhere->energies = {mechanics::makeGroundedSpring(2, 0, vector2(2, 0), vector2(1, 0), {{1, 0, 0.5}})};
  measured.timeOffset = 0.7;
  measured.meaning = MeasuredValue::displacement;
  QVERIFY((calibrate(elsewhere, {measured}, {0, 1}).history.back().values - Eigen::Vector2d(1.3, 0.2)).norm() < 1e-6);
  measured.meaning = MeasuredValue::swing;
  measured.coordinates[0].values.array() += 7.3;
  const CalibrationResult swing = calibrate(elsewhere, {measured}, {0, 1});
  QVERIFY((swing.history.back().values - Eigen::Vector2d(1.3, 0.2)).norm() < 1e-6);
  QCOMPARE(swing.uncertainty.degreesOfFreedom, 60 - 3);
}

void TestCalibration::refusesTooFewValues() {
  std::mt19937 random(9);
  MeasuredMotion measured = measure(oscillator(1.3, 0.2, 0.5), 0, random);
  measured.times.conservativeResize(3);
  measured.coordinates[0].values.conservativeResize(3);
  QVERIFY_THROWS_EXCEPTION(base::InputError, calibrate(oscillator(1.3, 0.2, 0.5), {measured}, {0, 1}));
}

void TestCalibration::refusesDisplacementsFromWhatMoves() {
  class PlaceParameter final : public mechanics::DesignParameter {
   public:
    std::string name() const override { return "place"; }
    base::Dimension dimension() const override { return base::dimensions::length; }
    std::string pointer() const override { return "/geometry/0/points/0/0"; }
    double value(const Model& model) const override { return model.restPositions[0]; }
    double minimum(const Model&) const override { return -1; }
    double maximum(const Model&) const override { return 1; }
    Model withValue(const Model& model, double value) const override {
      Model changed = model;
      changed.restPositions[0] = value;
      return changed;
    }
    std::unique_ptr<mechanics::ModelDerivative> derivative(const Model& model) const override {
      return std::make_unique<mechanics::ModelDerivative>(model);
    }
  };
  std::mt19937 random(9);
  auto model = oscillator(1.3, 0.2, 0.5);
  MeasuredMotion measured = measure(model, 0, random);
  measured.meaning = MeasuredValue::displacement;
  model->parameters.push_back(std::make_shared<PlaceParameter>());
  QVERIFY_THROWS_EXCEPTION(base::InputError, calibrate(model, {measured}, {2}));
}

QTEST_GUILESS_MAIN(TestCalibration)
#include "test_calibration.moc"
