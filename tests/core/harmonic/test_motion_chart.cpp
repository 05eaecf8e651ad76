#include <QTest>

#include "core/harmonic/amplitude.hpp"
#include "core/harmonic/motion_chart.hpp"
#include "core/mechanics/mechanism.hpp"
#include "tests/core/harmonic/example_models.hpp"

using namespace pliant;
using namespace pliant::test;
using harmonic::HarmonicBalanceProblem;
using harmonic::MotionChart;

namespace {

constexpr double omega = 2;

MotionChart chart(const char* key, const HarmonicBalanceProblem& problem, const Vector& z, int node = 0) {
  for (const auto& kind : harmonic::motionChartKinds())
    if (kind.key == key) return kind.make(problem, z, omega, node);
  throw std::invalid_argument(key);
}

/// x = 1 + 0.3 sin τ + 0.4 cos τ - 0.2 sin 3τ of a single oscillator.
struct Oscillation {
  HarmonicBalanceProblem problem{duffing(0.02, 0.5, 0.1), {3, 16}};
  Vector z{{1, 0.3, 0.4, 0, 0, -0.2, 0}};
  double displacement(double t) const {
    return 0.3 * std::sin(omega * t) + 0.4 * std::cos(omega * t) - 0.2 * std::sin(3 * omega * t);
  }
  double velocity(double t) const {
    return omega * (0.3 * std::cos(omega * t) - 0.4 * std::sin(omega * t) - 0.6 * std::cos(3 * omega * t));
  }
};

}  // namespace

/// Charts of motions that are known in closed form.
class TestMotionChart : public QObject {
  Q_OBJECT

 private slots:
  void harmonicContentIsTheAmplitudeOfEachHarmonic() {
    const Oscillation o;
    const MotionChart content = chart("harmonics", o.problem, o.z);
    QCOMPARE(content.series.size(), std::size_t(1));  // nothing along the locked y
    QVERIFY((content.series[0].x - vector3(1, 2, 3)).norm() == 0);
    QVERIFY((content.series[0].y - vector3(0.5, 0, 0.2)).norm() < 1e-14);
  }

  void displacementAndVelocityAreOverTime() {
    const Oscillation o;
    const MotionChart moved = chart("displacement", o.problem, o.z), fast = chart("velocity", o.problem, o.z);
    const auto& series = moved.series.at(0);
    QCOMPARE(series.x[0], 0.0);
    QVERIFY(std::abs(series.x[series.x.size() - 1] - 2 * std::numbers::pi / omega) < 1e-14);
    for (Eigen::Index i = 0; i < series.x.size(); ++i) {
      QVERIFY(std::abs(series.y[i] - o.displacement(series.x[i])) < 1e-13);
      QVERIFY(std::abs(fast.series.at(0).y[i] - o.velocity(series.x[i])) < 1e-12);
    }
  }

  void thePhasePlaneHasVelocityOverDisplacement() {
    const Oscillation o;
    const MotionChart plane = chart("phase_plane", o.problem, o.z), fast = chart("velocity", o.problem, o.z),
                      moved = chart("displacement", o.problem, o.z);
    QVERIFY(plane.style == MotionChart::Style::closedLine);
    QCOMPARE(plane.series.at(0).x, moved.series.at(0).y);
    QCOMPARE(plane.series.at(0).y, fast.series.at(0).y);
  }

  void strainOfAGrowingMeshIsItsGrowth() {
    const geometry::SurfaceMesh mesh = stripMesh({});
    const auto model = strip({}, mesh);
    model->parts = {{"strip", 0, model->nodeCount(), mesh.triangles, {}, {}, {}, {}}};
    model->finish();
    const HarmonicBalanceProblem problem(model, {1, 8});
    // x = (1 + 0.1 cos τ) rest
    Matrix z = Matrix::Zero(3, model->coordinateCount());
    z.row(0) = model->restPositions.transpose();
    z.row(2) = 0.1 * model->restPositions.transpose();
    const MotionChart strain = chart("strain", problem, z.reshaped());
    const auto& series = strain.series.at(0);
    for (Eigen::Index i = 0; i < series.x.size(); ++i)
      QVERIFY(std::abs(series.y[i] - 0.1 * std::cos(omega * series.x[i])) < 1e-12);
    QVERIFY(!chart("violation", problem, z.reshaped()).note.empty());
    const Oscillation o;
    QVERIFY(!chart("strain", o.problem, o.z).note.empty());
  }

  void strainOfATetrahedronIsItsGrowth() {
    auto model = std::make_shared<Model>();
    model->restPositions = Vector{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}};
    model->parts = {{"tetrahedron", 0, 4, {}, {{0, 1, 2, 3}}, {}, {}, {}}};
    addPointMass(*model, "corners", {0, 1, 2, 3}, 1);
    model->finish();
    const HarmonicBalanceProblem problem(model, {1, 8});
    Matrix z = Matrix::Zero(3, model->coordinateCount());  // x = (1 + 0.1 cos τ) rest
    z.row(0) = model->restPositions.transpose();
    z.row(2) = 0.1 * model->restPositions.transpose();
    const MotionChart strain = chart("strain", problem, z.reshaped());
    const auto& series = strain.series.at(0);
    for (Eigen::Index i = 0; i < series.x.size(); ++i)
      QVERIFY(std::abs(series.y[i] - 0.1 * std::cos(omega * series.x[i])) < 1e-12);
    QVERIFY(std::abs(harmonic::largestStrain(problem, z.reshaped()) - 0.1) < 1e-12);
  }

  void violationIsTheChangeOfALink() {
    auto model = std::make_shared<Model>();
    model->dimension = 2;
    model->restPositions = Eigen::Vector4d(0, 0, 2, 0);
    model->lockedCoordinates = {1, 1, 0, 1};
    model->energies = mechanics::makeRigidBar(2, model->restPositions, {0, 1});
    addPointMass(*model, "end", {1}, 1);
    model->finish();
    const HarmonicBalanceProblem problem(model, {1, 8});
    const MotionChart violation = chart("violation", problem, vector3(2, 0, 0.02));  // x = 2 + 0.02 cos τ
    const auto& series = violation.series.at(0);
    for (Eigen::Index i = 0; i < series.x.size(); ++i)
      QVERIFY(std::abs(series.y[i] - std::abs(0.01 * std::cos(omega * series.x[i]))) < 1e-12);
  }
};

QTEST_GUILESS_MAIN(TestMotionChart)
#include "test_motion_chart.moc"
