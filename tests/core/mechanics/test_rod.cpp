#include <Eigen/Eigenvalues>
#include <QTest>
#include <random>

#include "core/base/error.hpp"
#include "tests/core/mechanics/rod_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

/// A helix about z of `turns` turns with a flat section that keeps facing the axis.
RodModel helix(int segmentCount, double turns) {
  Eigen::Matrix3Xd points(3, segmentCount + 1);
  std::vector<RodSegment> segments;
  for (int n = 0; n <= segmentCount; ++n) {
    const double angle = 2 * M_PI * turns * n / segmentCount;
    points.col(n) << std::cos(angle), std::sin(angle), 0.2 * angle;
  }
  for (int n = 0; n < segmentCount; ++n) {
    RodSegment segment;
    segment.nodes = {n, n + 1};
    segment.material = {.youngModulus = 3, .shearModulus = 1, .density = 2};
    segment.section = rectangularSection(0.2, 0.05);
    segment.director = points.col(n);
    segments.push_back(segment);
  }
  return RodModel(points, segments, {0, segmentCount});
}

Vector randomMove(const Vector& rest, double size) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> step(-size, size);
  return rest + Vector::NullaryExpr(rest.size(), [&] { return step(random); });
}

/// The configuration turned by `turn`: where the twist of each segment and the rotation of each frame are what they
/// have to be for the sections to turn along.
Vector turned(const RodModel& rod, const Vector& x, const Quaterniond& turn) {
  const RodNetwork& network = rod.network[0];
  const Vector& rest = rod.model.restPositions;
  Vector result = x;
  for (int n = 0; n < rod.model.nodeCount(); ++n) result.segment<3>(3 * n) = turn * Vector3d(x.segment<3>(3 * n));
  for (int i = 0; i < static_cast<int>(network.segments().size()); ++i) {
    const auto along = [&](const Vector& at) -> Vector3d {
      const auto& nodes = network.segments()[i].nodes;
      return (at.segment<3>(3 * nodes[1]) - at.segment<3>(3 * nodes[0])).normalized();
    };
    const Vector3d tangent = along(rest);
    double& twist = result[network.twistCoordinate(i)];
    const Quaterniond section =
        turn * Quaterniond::FromTwoVectors(tangent, along(x)) * AngleAxisd(twist / network.twistLength(i), tangent);
    const Quaterniond left = Quaterniond::FromTwoVectors(tangent, along(result)).conjugate() * section;
    twist = 2 * std::atan2(left.vec().dot(tangent), left.w()) * network.twistLength(i);
  }
  for (const auto& [node, coordinate] : network.frameCoordinates()) {
    const double length = 4 * network.frameLength(node);
    const Vector3d s = x.segment<3>(coordinate) / length;
    const Quaterniond old((1 - s.squaredNorm()) / (1 + s.squaredNorm()), 2 * s[0] / (1 + s.squaredNorm()),
                          2 * s[1] / (1 + s.squaredNorm()), 2 * s[2] / (1 + s.squaredNorm()));
    const Quaterniond now = turn * old;
    result.segment<3>(coordinate) = length * now.vec() / (1 + now.w());
  }
  return result;
}

}  // namespace

class TestRod : public QObject {
  Q_OBJECT

 private slots:
  void restShapeHasNoForce();
  void turningChangesNothing();
  void directionOfSegmentsDoesNotMatter();
  void pureTwist();
  void sections();
  void massOfRods();
  void reversedEdgesAreFinite();
  void badInputIsRefused();
};

void TestRod::restShapeHasNoForce() {
  const RodModel rod = helix(40, 1.5);
  const ElasticAssembler assembler = rod.assembler();
  const double scale = assembler.gradient(randomMove(rod.model.restPositions, 0.01)).norm();
  QVERIFY(assembler.gradient(rod.model.restPositions).norm() <= 1e-13 * scale);
  QVERIFY(assembler.value(rod.model.restPositions) <= 1e-26);
  // Only the six rigid motions are free of stiffness.
  const Vector stiffness =
      Matrix(assembler.hessian(rod.model.restPositions)).selfadjointView<Eigen::Lower>().eigenvalues();
  QVERIFY(std::abs(stiffness[5]) <= 1e-12 * stiffness.tail(1)[0]);
  QVERIFY(stiffness[6] >= 1e-9 * stiffness.tail(1)[0]);
}

void TestRod::turningChangesNothing() {
  const RodModel rod = helix(12, 0.8);
  const ElasticAssembler assembler = rod.assembler();
  const Vector x = randomMove(rod.model.restPositions, 0.05);
  const double energy = assembler.value(x);
  const Vector gradient = assembler.gradient(x);
  for (const double angle : {-2.5, -0.4, 0.3, 1.5}) {
    const Quaterniond turn(AngleAxisd(angle, Vector3d(1, -2, 0.5).normalized()));
    const Vector moved = turned(rod, x, turn);
    QVERIFY(std::abs(assembler.value(moved) - energy) <= 1e-12 * energy);
    const Vector force = assembler.gradient(moved);
    // Those of positions mix with those of twists, which do not stay the same; along a common twist they do.
    for (int i = 0; i < 12; ++i) {
      const int twist = rod.network[0].twistCoordinate(i);
      QVERIFY(std::abs(force[twist] - gradient[twist]) <= 1e-11 * gradient.norm());
    }
    Vector3d sum = Vector3d::Zero();
    for (int n = 0; n < rod.model.nodeCount(); ++n) sum += force.segment<3>(3 * n);
    QVERIFY(sum.norm() <= 1e-12 * gradient.norm());
  }
}

void TestRod::directionOfSegmentsDoesNotMatter() {
  RodModel rod = helix(10, 0.6);
  std::vector<RodSegment> segments = rod.network[0].segments();
  for (std::size_t i = 0; i < segments.size(); i += 2) std::swap(segments[i].nodes[0], segments[i].nodes[1]);
  const RodModel other(rod.model.restPositions.head(33).reshaped(3, 11), segments, {0, 10});
  const Vector x = randomMove(rod.model.restPositions, 0.05);
  Vector mirrored = x;
  for (int i = 0; i < 10; i += 2) mirrored[rod.network[0].twistCoordinate(i)] *= -1;
  const double energy = rod.assembler().value(x);
  QVERIFY(std::abs(other.assembler().value(mirrored) - energy) <= 1e-13 * energy);
}

void TestRod::pureTwist() {
  const double length = 2, torsion = 0.7, angle = 1.5;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int count = 20 << level;
    const RodModel rod = cantilever(length, count, unitSegment(0, 1, 1e-3, torsion, 1));
    Vector x = rod.model.restPositions;
    const RodNetwork& network = rod.network[0];
    for (int i = 0; i < count; ++i) x[network.twistCoordinate(i)] = angle * (i + 0.5) / count * network.twistLength(i);
    const Vector gradient = rod.assembler().gradient(x);
    const int last = network.twistCoordinate(count - 1);
    error[level] = std::abs(gradient[last] * network.twistLength(count - 1) - torsion * angle / length);
    QVERIFY(error[level] <= 1e-3 * torsion * angle / length);
    // The torque passes through (but where the half segment at the clamp has a smaller angle to err by), and nothing
    // bends.
    for (const int free : rod.model.dofs.freeCoordinates)
      if (free != last && free != network.twistCoordinate(0)) QVERIFY(std::abs(gradient[free]) <= 1e-12);
  }
  QVERIFY(error[1] > 0.24 * error[0] && error[1] < 0.26 * error[0]);
}

void TestRod::sections() {
  const RodSection circle = circularSection(0.1);
  QVERIFY(std::abs(circle.area - M_PI * 0.01) <= 1e-16);
  QVERIFY(std::abs(circle.bendingInertia1 - M_PI * 1e-4 / 4) <= 1e-18);
  QVERIFY(std::abs(circle.torsionConstant - M_PI * 1e-4 / 2) <= 1e-18);
  const RodSection tube = tubularSection(0.1, 0.08), core = circularSection(0.08);
  QVERIFY(std::abs(tube.area - (circle.area - core.area)) <= 1e-16);
  QVERIFY(std::abs(tube.bendingInertia2 - (circle.bendingInertia2 - core.bendingInertia2)) <= 1e-18);
  // Timoshenko & Goodier, Theory of Elasticity, table of k₁ (k = J / a b³): 0.1406 for a square, 0.229 for 2 : 1.
  QVERIFY(std::abs(rectangularSection(0.1, 0.1).torsionConstant / 1e-4 - 0.1406) <= 5e-5);
  QVERIFY(std::abs(rectangularSection(0.1, 0.2).torsionConstant / 2e-4 - 0.229) <= 5e-4);
  QVERIFY(std::abs(rectangularSection(1000, 1).torsionConstant / 1000 - 1.0 / 3) <= 1e-3);
  QVERIFY(std::abs(rectangularSection(0.2, 0.1).bendingInertia1 - 0.2e-3 / 12) <= 1e-18);
}

void TestRod::massOfRods() {
  const RodModel rod = helix(30, 1);
  const RodNetwork& network = rod.network[0];
  double length = 0;
  for (int n = 0; n < 30; ++n)
    length += (rod.model.restPositions.segment<3>(3 * n + 3) - rod.model.restPositions.segment<3>(3 * n)).norm();
  const RodSection section = rectangularSection(0.2, 0.05);
  for (const MassMatrix kind : {MassMatrix::lumped, MassMatrix::consistent}) {
    std::vector<Eigen::Triplet<double>> entries;
    network.addMass(kind, entries);
    SparseMatrix mass(rod.model.coordinateCount(), rod.model.coordinateCount());
    mass.setFromTriplets(entries.begin(), entries.end());
    Vector along = Vector::Zero(mass.rows()), spin = along;
    for (int n = 0; n <= 30; ++n) along[3 * n + 1] = 1;
    QVERIFY(std::abs(along.dot(mass * along) - 2 * section.area * length) <= 1e-13);
    // All sections turn by 1 rad/s about the rod: ½ the inertia ∫ ρ I_p is the kinetic energy.
    for (int i = 0; i < 30; ++i) spin[network.twistCoordinate(i)] = network.twistLength(i);
    for (const auto& [node, coordinate] : network.frameCoordinates()) spin[coordinate] = network.frameLength(node);
    QVERIFY(std::abs(spin.dot(mass * spin) - 2 * section.polarInertia * length) <= 1e-13);
  }
}

void TestRod::reversedEdgesAreFinite() {
  const RodModel rod = cantilever(4, 4, unitSegment(0, 1, 0.3, 0.2, 1));
  const ElasticAssembler assembler = rod.assembler();
  Vector x = rod.model.restPositions;
  const auto isFinite = [&] {
    const Matrix rows = x.transpose().replicate(8, 1);
    Matrix gradient, hessian;
    assembler.evaluate(rows, gradient, &hessian);
    return std::isfinite(assembler.value(x)) && assembler.gradient(x).allFinite() &&
           Matrix(assembler.hessian(x)).allFinite() && gradient.allFinite() && hessian.allFinite();
  };
  x[3 * 3] = 1;  // the third edge has turned back onto the second
  QVERIFY(isFinite());
  QVERIFY(std::abs(largestTurn(rod.model, x).value() - M_PI) <= 1e-12);
  x[3 * 3] = 2;  // it has no length left
  QVERIFY(isFinite());
  x = rod.model.restPositions;
  x[rod.network[0].twistCoordinate(2)] = 2 * M_PI * rod.network[0].twistLength(2);  // a whole turn at one node
  QVERIFY(isFinite());
}

void TestRod::badInputIsRefused() {
  const Vector rest = (Vector(9) << 0, 0, 0, 1, 0, 0, 2, 0, 0).finished();
  const RodSegment good = unitSegment(0, 1, 0.1, 0.1, 1);
  const auto refused = [&](const std::function<void(RodSegment&)>& change, std::vector<int> frames = {}) {
    RodSegment segment = good;
    change(segment);
    try {
      RodNetwork(rest, {segment}, frames, 9);
    } catch (const base::InputError&) {
      return true;
    }
    return false;
  };
  QVERIFY(!refused([](RodSegment&) {}));
  QVERIFY(refused([](RodSegment& s) { s.nodes = {1, 1}; }));
  QVERIFY(refused([](RodSegment& s) { s.nodes = {1, 3}; }));
  QVERIFY(refused([](RodSegment& s) { s.material.youngModulus = 0; }));
  QVERIFY(refused([](RodSegment& s) { s.material.density = std::nan(""); }));
  QVERIFY(refused([](RodSegment& s) { s.section.torsionConstant = -1; }));
  QVERIFY(refused([](RodSegment&) {}, {2}));
  QVERIFY(refused([](RodSegment& s) { s.section.bendingInertia1 = 0.2; }));
  QVERIFY(refused([](RodSegment& s) {
    s.section.bendingInertia1 = 0.2;
    s.director = {3, 0, 0};
  }));
  QVERIFY(!refused([](RodSegment& s) {
    s.section.bendingInertia1 = 0.2;
    s.director = {3, 1, 0};
  }));
  QVERIFY_EXCEPTION_THROWN(RodNetwork(rest, {}, {}, 9), base::InputError);
  QVERIFY_EXCEPTION_THROWN(circularSection(0), base::InputError);
  QVERIFY_EXCEPTION_THROWN(tubularSection(1, 1), base::InputError);
  QVERIFY_EXCEPTION_THROWN(rectangularSection(1, -1), base::InputError);
}

QTEST_GUILESS_MAIN(TestRod)
#include "test_rod.moc"
