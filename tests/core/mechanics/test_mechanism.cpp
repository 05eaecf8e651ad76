#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/mechanism.hpp"
#include "tests/core/mechanics/double_pendulum.hpp"
#include "tests/core/mechanics/shell_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;

namespace {

Model nodesAt(const Matrix& points) {
  Model model;
  model.dimension = static_cast<int>(points.rows());
  model.restPositions = points.reshaped();
  return model;
}

Model barThrough(const Matrix& points) {
  Model model = nodesAt(points);
  std::vector<int> joints(static_cast<std::size_t>(points.cols()));
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = static_cast<int>(i);
  model.energies = makeRigidBar(model.dimension, model.restPositions, joints, 100);
  model.finish();
  return model;
}

/// How many independent motions leave the energy at rest unchanged to second order.
int freeMotions(const Model& model) {
  const Matrix hessian = ElasticAssembler(std::make_shared<const Model>(model)).hessian(model.restPositions);
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(hessian).eigenvalues();
  return static_cast<int>((values.array() < 1e-9 * values.maxCoeff()).count());
}

/// A link of the length 0.5 m from the origin, free to turn, with a mass of 2 kg at its end.
struct Lever {
  static constexpr double length = 0.5, mass = 2, gravity = 9.81;
  Model model;

  Lever() {
    Matrix points(2, 2);
    points << 0, length, 0, 0;
    model = nodesAt(points);
    model.energies = makeRigidBar(2, model.restPositions, {0, 1}, 1e8);
    model.lockedCoordinates = {1, 1, 0, 0};
    model.pointMasses.push_back({"end", {1}, mass, 0, 0});
    model.gravity = Vector{{0, -gravity}};
  }

  double equilibriumAngle() {
    model.finish();
    Vector x = model.restPositions;
    for (const double share : {0.25, 0.5, 0.75, 1.0}) solveStatics(model, share * model.externalForce(0), x);
    return std::atan2(x[3], x[2]);
  }
};

/// The angle between -π/2 and π/2 where a potential is lowest.
template <class Potential>
double lowest(const Potential& potential) {
  double low = -M_PI_2, high = M_PI_2;
  const auto slope = [&](double angle) { return potential(angle + 1e-4) - potential(angle - 1e-4); };
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0 ? high : low) = middle;
  }
  return low;
}

}  // namespace

class TestMechanism : public QObject {
  Q_OBJECT

 private slots:
  void barsAllowRigidMotionsAlone_data();
  void barsAllowRigidMotionsAlone();
  void barMassIsThatOfAUniformRod();
  void attachmentPointsMoveWithTheirLinks();
  void localSpringHoldsALever();
  void torsionSpringHoldsALever();
  void doublePendulumFollowsItsEquation();
  void violationsAreRelative();
  void badInputIsRefused();
};

void TestMechanism::barsAllowRigidMotionsAlone_data() {
  QTest::addColumn<QVector<double>>("points");
  QTest::addColumn<int>("dimension");
  QTest::addColumn<int>("expected");
  QTest::newRow("2D, two joints") << QVector<double>{0, 0, 3, 4} << 2 << 3;
  QTest::newRow("2D, in line") << QVector<double>{0, 0, 1, 1, 3, 3, 2, 2} << 2 << 3;
  QTest::newRow("2D, nearly in line") << QVector<double>{0, 0, 1, 1.001, 3, 3} << 2 << 3;
  QTest::newRow("2D, angular") << QVector<double>{0, 0, 1, 0, 1, 2, -1, 0.5, 4, 1} << 2 << 3;
  QTest::newRow("3D, two joints") << QVector<double>{0, 0, 0, 1, 2, 3} << 3 << 5;
  QTest::newRow("3D, in line") << QVector<double>{0, 0, 0, 1, 2, 3, -1, -2, -3} << 3 << 5;
  QTest::newRow("3D, in a plane") << QVector<double>{0, 0, 1, 1, 0, 1, 0, 1, 1, 2, 2, 1, 0.3, 0.2, 1} << 3 << 6;
  QTest::newRow("3D") << QVector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 0.2, 0.2, 0.2} << 3 << 6;
}

void TestMechanism::barsAllowRigidMotionsAlone() {
  QFETCH(QVector<double>, points);
  QFETCH(int, dimension);
  QFETCH(int, expected);
  const Matrix places = Vector::Map(points.data(), points.size()).reshaped(dimension, points.size() / dimension);
  const Model model = barThrough(places);
  QCOMPARE(freeMotions(model), expected);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2.5, dimension == 2 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(1, -2, 0.5).normalized())
          .toRotationMatrix();
  const Vector moved = (turn.topLeftCorner(dimension, dimension) * places).reshaped();
  QVERIFY(*constraintViolation(model, moved) <= 1e-14);
}

void TestMechanism::barMassIsThatOfAUniformRod() {
  Matrix points(2, 3);
  points << 0, 0.3, 0.5, 0, 0, 0;
  const Vector rest = points.reshaped();
  const double mass = 0.4, length = 0.5, rate = 2;
  Vector velocity = Vector::Zero(6);  // turning about the first joint
  for (int n = 0; n < 3; ++n) velocity[2 * n + 1] = rate * points(0, n);
  for (const MassMatrix kind : {MassMatrix::lumped, MassMatrix::consistent}) {
    std::vector<Eigen::Triplet<double>> entries;
    addBarMass(2, rest, {0, 1, 2}, mass, kind, entries);
    SparseMatrix matrix(6, 6);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Vector along = Eigen::Vector2d(1, 0).replicate(3, 1);
    QVERIFY(std::abs(along.dot(matrix * along) - mass) <= 1e-15);
    const double inertia = velocity.dot(matrix * velocity) / (rate * rate);
    const double expected = kind == MassMatrix::consistent ? mass * length * length / 3
                                                           : mass * (0.6 * 0.5 * 0.09 + 0.4 * 0.5 * (0.09 + 0.25));
    QVERIFY(std::abs(inertia - expected) <= 1e-15);
  }
}

void TestMechanism::attachmentPointsMoveWithTheirLinks() {
  const Vector rest = (Vector(4) << 1, 1, 1, 3).finished();  // points up
  const AttachmentPoint point = attachedToLink(2, rest, 0, 1, 0.5, 0.2);
  QVERIFY((positionOf(point, 2, rest) - Eigen::Vector2d(0.8, 1.5)).norm() <= 1e-15);
  const Vector turned = (Vector(4) << 0, 0, 2, 0).finished();
  QVERIFY((positionOf(point, 2, turned) - Eigen::Vector2d(0.5, 0.2)).norm() <= 1e-15);
}

void TestMechanism::localSpringHoldsALever() {
  const double along = 0.3, across = 0.05, stiffness = 400, restLength = 0.2;
  const Eigen::Vector2d anchor(0.1, 0.4);
  Lever lever;
  lever.model.energies.push_back(makeLocalSpring(2, attachedToLink(2, lever.model.restPositions, 0, 1, along, across),
                                                 fixedPlace(anchor), restLength, {{stiffness}}));
  const auto potential = [&](double angle) {
    const Eigen::Vector2d point = Eigen::Rotation2Dd(angle) * Eigen::Vector2d(along, across);
    const double elongation = (point - anchor).norm() - restLength;
    return Lever::mass * Lever::gravity * Lever::length * std::sin(angle) + 0.5 * stiffness * elongation * elongation;
  };
  const double expected = lowest(potential);
  QVERIFY(std::abs(expected) > 0.1);
  QVERIFY(std::abs(lever.equilibriumAngle() - expected) <= 1e-6);
}

void TestMechanism::torsionSpringHoldsALever() {
  const double stiffness = 12;
  Lever lever;
  Model& model = lever.model;
  model.restPositions = (Vector(6) << 0, 0, Lever::length, 0, -0.2, 0.1).finished();  // the last is the ground
  model.lockedCoordinates = {1, 1, 0, 0, 1, 1};
  model.energies.push_back(makeTorsionSpring(model.restPositions, 2, 0, 1, stiffness));
  const double expected = lowest([&](double angle) {
    return Lever::mass * Lever::gravity * Lever::length * std::sin(angle) + 0.5 * stiffness * angle * angle;
  });
  QVERIFY(std::abs(expected) > 0.1);
  QVERIFY(std::abs(lever.equilibriumAngle() - expected) <= 1e-6);
}

void TestMechanism::doublePendulumFollowsItsEquation() {
  // Let go from a wide swing: the upper link level, the lower one above it.
  const DoublePendulum pendulum{.length = {0.6, 0.4}, .mass = {1.5, 1}, .gravity = 9.81};
  const DoublePendulum::State start(M_PI_2, 2.2, 0, 0);
  const double duration = 1.5;
  DoublePendulum::State exact = start;
  for (int step = 0; step < 15000; ++step) exact = rungeKutta(pendulum, exact, step * 1e-4, 1e-4);
  const Vector expected = pendulum.positions(exact, duration);

  const auto deviation = [&](double stiffness) {
    Model model = pendulum.model(stiffness);
    const ElasticAssembler assembler(std::make_shared<const Model>(model));
    const Vector mass = Matrix(model.massMatrix()).diagonal();
    const std::vector<int>& free = model.dofs.freeCoordinates;
    const auto rate = [&](double, const Vector& state) {
      const Vector x = model.configuration(state.head(4), 0);
      const Vector force = model.externalForce(0) - assembler.gradient(x);
      Vector result(8);
      result << state.tail(4), force(free).cwiseQuotient(mass(free));
      return result;
    };
    Vector state = Vector::Zero(8);
    state.head(4) = pendulum.positions(start, 0).tail(4);
    const double step = 0.1 * std::sqrt(0.4 * 1.0 / stiffness);  // a sixtieth of a link's own vibration
    const int steps = static_cast<int>(std::ceil(duration / step));
    double violation = 0;
    for (int i = 0; i < steps; ++i) {
      state = rungeKutta(rate, state, i * duration / steps, duration / steps);
      violation = std::max(violation, *constraintViolation(model, model.configuration(state.head(4), 0)));
    }
    qInfo("stiffness %.0e N: deviation %.2e m, largest violation %.2e", stiffness,
          (state.head(4) - expected.tail(4)).norm(), violation);
    return std::pair((state.head(4) - expected.tail(4)).norm(), violation);
  };
  const auto [soft, softViolation] = deviation(1e5);
  const auto [stiff, stiffViolation] = deviation(1e6);
  QVERIFY(stiff <= 1e-3);
  QVERIFY(std::abs(std::log10(soft / stiff) - 1) <= 0.15);  // both go with 1 / stiffness
  QVERIFY(std::abs(std::log10(softViolation / stiffViolation) - 1) <= 0.15);
}

void TestMechanism::violationsAreRelative() {
  Matrix points(2, 3);
  points << 0, 4, 2, 0, 0, 0;
  const Model model = barThrough(points);
  Vector x = model.restPositions;
  QCOMPARE(*constraintViolation(model, x), 0.0);
  x[4] += 0.02;  // the middle joint along the bar
  QVERIFY(std::abs(*constraintViolation(model, x) - 0.005) <= 1e-15);
  x = model.restPositions * 1.003;
  QVERIFY(std::abs(*constraintViolation(model, x) - 0.003) <= 1e-15);
  Model springs = nodesAt(points);
  springs.energies.push_back(makeSpring(2, 0, 1, 1, {{1}}));
  springs.finish();
  QVERIFY(!constraintViolation(springs, springs.restPositions));
}

void TestMechanism::badInputIsRefused() {
  const Vector rest = (Vector(9) << 0, 0, 0, 1, 0, 0, 0.5, 1e-3, 0).finished();
  const auto bar = [&](const std::vector<int>& joints, double stiffness) {
    QVERIFY_EXCEPTION_THROWN(makeRigidBar(3, rest, joints, stiffness), base::InputError);
  };
  bar({0}, 1);
  bar({0, 0}, 1);
  bar({0, 3}, 1);
  bar({0, 1}, 0);
  bar({0, 1}, std::nan(""));
  bar({0, 1, 2}, 1);  // neither in line nor clearly off it
  const Vector together = (Vector(4) << 1, 2, 1, 2).finished();
  QVERIFY_EXCEPTION_THROWN(makeRigidBar(2, together, {0, 1}, 1), base::InputError);
  QVERIFY_EXCEPTION_THROWN(attachedToLink(2, together, 0, 1, 0, 0), base::InputError);
  QVERIFY_EXCEPTION_THROWN(attachedToLink(3, rest, 0, 1, 0, 0.1), base::InputError);
  const AttachmentPoint point = attachedToLink(3, rest, 0, 1, 0.2, 0);
  QVERIFY_EXCEPTION_THROWN(makeLocalSpring(3, point, point, 0, {{1}}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeLocalSpring(3, point, attachedToNode(3, 2), -1, {{1}}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeLocalSpring(3, point, attachedToNode(3, 2), 1, {{}}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(makeTorsionSpring(together, 0, 1, 0, 1), base::InputError);
}

QTEST_GUILESS_MAIN(TestMechanism)
#include "test_mechanism.moc"
