#include <Eigen/LU>
#include <QTest>
#include <complex>

#include "core/harmonic/linear_response.hpp"
#include "core/harmonic/periodic_motion.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using Complex = std::complex<double>;

namespace {

constexpr int nodes = 5;
constexpr double stiffness[nodes] = {90, 40, 70, 55, 30};  // between i and i + 1; the last to the ground
constexpr double pointMass[nodes] = {0.3, 0.2, 0.5, 0.1, 0.4};
constexpr double barMass = 0.6;  // of each spring, if they are heavy
constexpr double massDamping = 0.4;
constexpr double stiffnessDamping = 0.01;

/// A chain on a line: the first node is moved, the third is pushed, the last is held by a spring.
std::shared_ptr<const Model> chain(bool consistent) {
  auto model = std::make_shared<Model>();
  model->dimension = 1;
  model->restPositions = Vector::LinSpaced(nodes, 0, nodes - 1);
  model->gravity = Vector::Zero(1);
  model->lockedCoordinates.assign(nodes, 0);
  for (int i = 0; i + 1 < nodes; ++i)
    model->energies.push_back(mechanics::makeSpring(1, i, i + 1, 1, {{stiffness[i]}}));
  model->energies.push_back(mechanics::makeGroundedSpring(
      1, nodes - 1, Vector::Constant(1, nodes - 1), Vector::Ones(1), {{stiffness[nodes - 1]}}));
  for (int i = 0; i < nodes; ++i) addPointMass(*model, "mass", {i}, pointMass[i]);
  if (consistent) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i + 1 < nodes; ++i)
      for (int a : {0, 1})
        for (int b : {0, 1}) entries.emplace_back(i + a, i + b, barMass / (a == b ? 3 : 6));
    auto mass = std::make_shared<SparseMatrix>(nodes, nodes);
    mass->setFromTriplets(entries.begin(), entries.end());
    model->elementMass = mass;
  }
  model->massDamping = massDamping;
  model->stiffnessDamping = stiffnessDamping;
  model->drives = {mechanics::makeTranslation({0}, Vector::Ones(1), {{{1, 0.05, 0.3}, {2, 0.02, -1}}})};
  model->forces = {{"push", {2}, Vector::Ones(1), {{{1, 2.0, 1.1}, {3, 0.7, 0.2}, {0, 0.9, 0}}}}};
  model->finish();
  return model;
}

/// The amplitude a of the motion a exp(i order τ) of all nodes, from the stiffness and mass matrices written down here.
Eigen::VectorXcd closedForm(bool consistent, double omega, int order, Complex base, Complex push) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(nodes, nodes);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(nodes, nodes);
  for (int i = 0; i < nodes; ++i) m(i, i) += pointMass[i];
  for (int i = 0; i + 1 < nodes; ++i) {
    k(i, i) += stiffness[i];
    k(i + 1, i + 1) += stiffness[i];
    k(i, i + 1) -= stiffness[i];
    k(i + 1, i) -= stiffness[i];
    if (!consistent) continue;
    m(i, i) += barMass / 3;
    m(i + 1, i + 1) += barMass / 3;
    m(i, i + 1) += barMass / 6;
    m(i + 1, i) += barMass / 6;
  }
  k(nodes - 1, nodes - 1) += stiffness[nodes - 1];
  const Complex rate(0, order * omega);
  const Eigen::MatrixXcd dynamic = rate * rate * m + rate * (massDamping * m + stiffnessDamping * k) + k;
  Eigen::VectorXcd force = Eigen::VectorXcd::Zero(nodes - 1);
  force[1] = push;
  force -= dynamic.block(1, 0, nodes - 1, 1) * base;
  Eigen::VectorXcd motion(nodes);
  motion << base, dynamic.bottomRightCorner(nodes - 1, nodes - 1).lu().solve(force);
  return motion;
}

}  // namespace

/// Coefficients of the chain's free nodes against the closed form.
void compareWithClosedForm(const Vector& coefficients, bool consistent, double omega) {
  const Eigen::Map<const Matrix> z(coefficients.data(), 7, nodes - 1);
  const Complex base[] = {0, std::polar(0.05, 0.3), std::polar(0.02, -1.0), 0};
  const Complex push[] = {0.9, std::polar(2.0, 1.1), 0, std::polar(0.7, 0.2)};
  for (int order = 0; order <= 3; ++order) {
    const Eigen::VectorXcd expected = closedForm(consistent, omega, order, base[order], push[order]);
    for (int i = 1; i < nodes; ++i) {
      // a exp(iτ) stands for Re: cosine coefficient Re a, sine coefficient -Im a.
      const Complex found =
          order == 0 ? Complex(z(0, i - 1) - i, 0) : Complex(z(2 * order, i - 1), -z(2 * order - 1, i - 1));
      QVERIFY(std::abs(found - expected[i]) <= 1e-11 * expected.norm() + 1e-14);
    }
  }
}

/// A mass on a spring, pushed.
std::shared_ptr<const Model> oscillator(double stiffness, double mass, double damping, double force) {
  auto model = std::make_shared<Model>();
  model->dimension = 1;
  model->restPositions = Vector::Zero(1);
  model->energies = {mechanics::makeGroundedSpring(1, 0, Vector::Zero(1), Vector::Ones(1), {{stiffness}})};
  addPointMass(*model, "mass", {0}, mass);
  model->massDamping = damping / mass;
  model->forces = {{"push", {0}, Vector::Ones(1), cosine(force)}};
  model->probes = {{"mass", 0}};
  model->finish();
  return model;
}

std::shared_ptr<Model> turnedFoil(double angle) {
  const StripOptions options{8, 1, 1e8, 5e-4, mechanics::MassMatrix::lumped, 0, true};
  const geometry::SurfaceMesh mesh = stripMesh(options);
  auto model = strip(options, mesh);
  model->massDamping = 1;
  model->drives = {
      mechanics::makeRotation(clampedNodes(mesh, 0.026), vector3(0, 0, 0), Eigen::Vector3d::UnitY(), sine(angle))};
  const int last = static_cast<int>(mesh.points.cols()) - 1;
  model->probes = {{"tip", last}};
  model->parts = {{"foil", 0, last + 1, mesh.triangles, {}, {}, {}, {}}};
  model->finish();
  return model;
}

/// Harmonic balance of a linear system is exact: it is compared with the complex frequency response. So is the response
/// of the linearised model.
class TestLinearResponse : public QObject {
  Q_OBJECT

 private slots:
  void chainAgreesWithClosedForm_data();
  void chainAgreesWithClosedForm();
  void peakIsThatOfAnOscillator();
  void smallSwingsAreLinear();
  void largeTurnsStretchTheLinearModel();
};

void TestLinearResponse::chainAgreesWithClosedForm_data() {
  QTest::addColumn<bool>("consistent");
  QTest::addColumn<double>("omega");
  for (const bool consistent : {false, true})
    for (const double omega : {0.7, 4.0, 11.0, 60.0})
      QTest::addRow("%s mass at %g rad/s", consistent ? "consistent" : "lumped", omega) << consistent << omega;
}

void TestLinearResponse::chainAgreesWithClosedForm() {
  QFETCH(bool, consistent);
  QFETCH(double, omega);
  harmonic::HarmonicBalanceProblem problem(chain(consistent), {3, 16});
  base::ExecutionContext context;
  harmonic::PeriodicMotionOptions options;
  options.tolerance = 1e-13;
  const harmonic::PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, options, context);
  QVERIFY(motion.report.converged());
  QVERIFY(motion.report.iterations.size() <= 3);  // one Newton step, and at most one more against rounding
  compareWithClosedForm(motion.z, consistent, omega);

  harmonic::LinearResponse linear(problem, harmonic::linearizeAtEquilibrium(problem, context));
  QCOMPARE(linear.drivenHarmonics(), (std::vector<int>{1, 2, 3}));
  compareWithClosedForm(linear.solve(omega), consistent, omega);
  QVERIFY(linear.residual() < 1e-12);
}

/// The displacement of a mass on a spring is largest at ω₀ √(1 - 2 ζ²), P/(2 ζ k √(1 - ζ²)).
void TestLinearResponse::peakIsThatOfAnOscillator() {
  const double stiffness = 20, mass = 0.5, damping = 0.3, force = 0.7;
  const double natural = std::sqrt(stiffness / mass), ratio = damping / (2 * std::sqrt(stiffness * mass));
  const harmonic::HarmonicBalanceProblem problem(oscillator(stiffness, mass, damping, force), {1, 16});
  base::ExecutionContext context;
  for (const bool downwards : {false, true}) {
    harmonic::LinearResponseOptions options{3, 10, 20, 1e-7};
    if (downwards) std::swap(options.from, options.to);
    const harmonic::FrequencyResponse curve = harmonic::traceLinearResponse(problem, options, context);
    QVERIFY(curve.report.converged());
    QCOMPARE(curve.points.front().omega, options.from);
    QCOMPARE(curve.points.back().omega, options.to);
    int peaks = 0;
    for (const harmonic::ResponsePoint& point : curve.points) {
      const double u = point.omega / natural;
      const double height = force / stiffness / std::hypot(1 - u * u, 2 * ratio * u);
      QVERIFY(std::abs(point.amplitudes[0].maximumDisplacement - height) < 1e-10 * height);
      QVERIFY(std::abs(point.amplitudes[0].pathLength - 4 * height) < 1e-9 * height);
      if (point.kind != harmonic::PointKind::peak) continue;
      ++peaks;
      QVERIFY(std::abs(point.omega - natural * std::sqrt(1 - 2 * ratio * ratio)) < 3e-7 * natural);
    }
    QCOMPARE(peaks, 1);
  }
}

/// A shell under its weight, hardly turned: harmonic balance and the linear response differ by the swing alone.
void TestLinearResponse::smallSwingsAreLinear() {
  auto model = turnedFoil(1e-5);
  model->gravity = vector3(0, 0, -9.81);
  harmonic::HarmonicBalanceProblem problem(model, {2, 16});
  base::ExecutionContext context;
  harmonic::LinearResponse linear(problem, harmonic::linearizeAtEquilibrium(problem, context));
  for (const double omega : {30.0, 60.0, 200.0}) {
    const harmonic::PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, omega, {}, context);
    QVERIFY(motion.report.converged());
    const double swing = problem.oscillation(motion.z).norm();
    const double error = (problem.oscillation(linear.solve(omega)) - problem.oscillation(motion.z)).norm();
    QVERIFY2(error < 1e-3 * swing, qPrintable(QString("%1 %2").arg(error).arg(swing)));
  }
}

/// Slowly turned by α, a foil hardly stretches; the linear model shears it by sin α across, to √(1 + sin² α) of its
/// length.
void TestLinearResponse::largeTurnsStretchTheLinearModel() {
  const double angle = 0.5;
  harmonic::HarmonicBalanceProblem problem(turnedFoil(angle), {9, 64});
  base::ExecutionContext context;
  harmonic::LinearResponse linear(problem, harmonic::linearizeAtEquilibrium(problem, context));
  const double strain = harmonic::largestStrain(problem, linear.solve(0.1));
  const double expected = std::hypot(1, std::sin(angle)) - 1;
  QVERIFY2(std::abs(strain - expected) < 1e-3 * expected, qPrintable(QString("%1 %2").arg(strain).arg(expected)));
  const harmonic::PeriodicMotion motion = harmonic::solvePeriodicMotion(problem, 0.1, {}, context);
  QVERIFY2(motion.report.converged(), motion.report.message.c_str());
  QVERIFY(harmonic::largestStrain(problem, motion.z) < 1e-3 * expected);
}

QTEST_GUILESS_MAIN(TestLinearResponse)
#include "test_linear_response.moc"
