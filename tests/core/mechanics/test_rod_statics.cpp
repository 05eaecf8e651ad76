#include <Eigen/Eigenvalues>
#include <QTest>

#include "tests/core/mechanics/rod_examples.hpp"
#include "tests/core/mechanics/shell_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;
using Eigen::Vector3d;

namespace {

/// An inextensible cantilever of length 1 and bending stiffness 1 along x with a load along y at its tip, which keeps
/// its direction: θ'' = -load cos θ, θ(0) = 0, θ'(1) = 0. By shooting with Runge and Kutta's method.
class Elastica {
 public:
  explicit Elastica(double load) : load_(load) {
    double low = 0, high = load;  // of the curvature at the clamp, which the moment load * (lever <= 1) bounds
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (solve(middle, 1)[3] < 0 ? low : high) = middle;
    }
    curvature_ = (low + high) / 2;
  }

  Eigen::Vector2d position(double s) const { return solve(curvature_, s).head<2>(); }

 private:
  /// x, y, θ, θ' at s.
  Eigen::Vector4d solve(double curvature, double s) const {
    const auto rate = [&](const Eigen::Vector4d& v) -> Eigen::Vector4d {
      return {std::cos(v[2]), std::sin(v[2]), v[3], -load_ * std::cos(v[2])};
    };
    constexpr int steps = 1000;
    Eigen::Vector4d v(0, 0, 0, curvature);
    const double h = s / steps;
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector4d a = rate(v), b = rate(v + h / 2 * a), c = rate(v + h / 2 * b), d = rate(v + h * c);
      v += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return v;
  }

  double load_;
  double curvature_ = 0;
};

/// Displacements under small forces.
Vector linearResponse(const RodModel& rod, const Vector& force) {
  const Eigen::SimplicialLDLT<SparseMatrix> factors(rod.assembler().hessian(rod.model.restPositions));
  Vector result = Vector::Zero(force.size());
  const Vector onFree = force(rod.model.dofs.freeCoordinates), moved = factors.solve(onFree);
  result(rod.model.dofs.freeCoordinates) = moved;
  return result;
}

/// A stem of height 2 along z from the clamped origin and arms along x at its top, one of length 1.5 (its tip is
/// the last node) and, if wanted, one of length 1 (its tip is the node before the last).
struct Frame {
  static constexpr double stemHeight = 2, armLength = 1.5, bending = 0.3, torsion = 0.2;
  RodModel rod;
  int tip, otherTip;

  Frame(int count, bool hasOther) : rod(make(count, hasOther)), tip(rod.model.nodeCount() - 1), otherTip(tip - 1) {}

  static RodModel make(int count, bool hasOther) {
    std::vector<Vector3d> points;
    std::vector<RodSegment> segments;
    const RodSegment like = unitSegment(0, 1, bending, torsion, 1e6);
    const auto branch = [&](std::vector<int> nodes, const Vector3d& direction) {
      for (int i = 1; i < count; ++i) {
        nodes.push_back(static_cast<int>(points.size()));
        points.push_back(points[static_cast<std::size_t>(nodes[0])] + i * direction / count);
      }
      return nodes;
    };
    points.push_back(Vector3d::Zero());
    std::vector<int> stem = branch({0}, {0, 0, stemHeight});
    const int top = static_cast<int>(points.size());
    points.emplace_back(0, 0, stemHeight);
    stem.push_back(top);
    std::vector<int> other = branch({top}, {-1, 0, 0}), arm = branch({top}, {armLength, 0, 0});
    if (hasOther) {
      other.push_back(static_cast<int>(points.size()));
      points.emplace_back(-1, 0, stemHeight);
    }
    arm.push_back(static_cast<int>(points.size()));
    points.emplace_back(armLength, 0, stemHeight);
    addChain(segments, stem, like);
    addChain(segments, arm, like);
    if (hasOther) addChain(segments, other, like);
    Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t n = 0; n < points.size(); ++n) matrix.col(static_cast<Eigen::Index>(n)) = points[n];
    RodModel rod(matrix, segments, {0});
    rod.clamp(0);
    // Without the other arm its nodes belong to no rod.
    for (int n = 0; n < rod.model.nodeCount(); ++n) {
      bool isUsed = false;
      for (const RodSegment& s : segments) isUsed = isUsed || s.nodes[0] == n || s.nodes[1] == n;
      for (int axis = 0; axis < 3 && !isUsed; ++axis) rod.model.lockedCoordinates[3 * n + axis] = 1;
    }
    rod.model.finish();
    return rod;
  }

  Vector response(const Vector3d& forceAtTip) const {
    Vector force = Vector::Zero(rod.model.coordinateCount());
    force.segment<3>(3 * tip) = forceAtTip;
    return linearResponse(rod, force);
  }
};

}  // namespace

/// Bending and twist in equilibrium, against closed forms.
class TestRodStatics : public QObject {
  Q_OBJECT

 private slots:
  void elastica_data();
  void elastica();
  void directorsOfARectangle();
  void frameOfTwoOrThreeRods_data();
  void frameOfTwoOrThreeRods();
  void michellsRing();
};

void TestRodStatics::elastica_data() {
  QTest::addColumn<double>("load");
  for (const double load : {0.5, 3.0, 10.0}) QTest::addRow("P L²/EI = %g", load) << load;
}

void TestRodStatics::elastica() {
  QFETCH(double, load);
  const Elastica exact(load);
  const Eigen::Vector2d tip = exact.position(1);
  double errors[3];
  for (int level = 0; level < 3; ++level) {
    const int count = 20 << level;
    const RodModel rod = cantilever(1, count, unitSegment(0, 1, 1, 0.8, 1e8));
    Vector force = Vector::Zero(rod.model.coordinateCount()), x = rod.model.restPositions;
    force[3 * count + 1] = load;
    for (int n = 0; n <= count; ++n) x.segment<2>(3 * n) = exact.position(static_cast<double>(n) / count);
    solveStatics(rod.model, force, x);
    QVERIFY((force - rod.assembler().gradient(x))(rod.model.dofs.freeCoordinates).norm() <= 1e-5 * load);
    errors[level] = (x.segment<2>(3 * count) - tip).norm();
    QVERIFY(std::abs(x[3 * count + 2]) <= 1e-9);
  }
  qInfo("tip at (%.6f, %.6f); errors with 20, 40, 80 segments: %.2e %.2e %.2e", tip[0], tip[1], errors[0], errors[1],
        errors[2]);
  QVERIFY(errors[2] <= 1e-3);
  for (int level = 0; level < 2; ++level) {
    const double order = std::log2(errors[level] / errors[level + 1]);
    QVERIFY(order > 1.9 && order < 2.1);
  }
}

void TestRodStatics::directorsOfARectangle() {
  constexpr int count = 40;
  RodSegment like = unitSegment(0, 1, 1, 1, 1);
  like.section = rectangularSection(0.02, 0.01);
  like.director = {0.3, 3, 4};  // director 1 is (0, 3, 4)/5
  const RodModel rod = cantilever(1, count, like);
  for (const bool isAlongWidth : {false, true}) {
    const Vector3d direction = isAlongWidth ? Vector3d(0, 0.6, 0.8) : Vector3d(0, -0.8, 0.6);
    Vector force = Vector::Zero(rod.model.coordinateCount());
    force.segment<3>(3 * count) = direction;
    const Vector moved = linearResponse(rod, force);
    // A load along the width (director 1) bends about director 2.
    const double inertia = isAlongWidth ? 0.01 * std::pow(0.02, 3) / 12 : 0.02 * std::pow(0.01, 3) / 12;
    const double expected = 1 / (3 * inertia);
    QVERIFY((moved.segment<3>(3 * count) - expected * direction).norm() <= 1e-3 * expected);
  }
}

void TestRodStatics::frameOfTwoOrThreeRods_data() {
  QTest::addColumn<bool>("hasOther");
  QTest::newRow("L: two rods at a right angle") << false;
  QTest::newRow("T: three rods") << true;
}

void TestRodStatics::frameOfTwoOrThreeRods() {
  QFETCH(bool, hasOther);
  constexpr double a = Frame::armLength, h = Frame::stemHeight, b = Frame::bending, t = Frame::torsion;
  // Across: the arm bends, the stem twists and bends. Along the stem: the arm bends, the stem bends under its moment.
  const double across = a * a * a / (3 * b) + a * a * h / t + h * h * h / (3 * b);
  const double along = a * a * a / (3 * b) + a * a * h / b;
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const Frame frame(10 << level, hasOther);
    const Vector sideways = frame.response({0, 1, 0}), down = frame.response({0, 0, -1});
    const double errorAcross = sideways[3 * frame.tip + 1] - across, errorAlong = -down[3 * frame.tip + 2] - along;
    error[level] = std::hypot(errorAcross, errorAlong);
    QVERIFY(error[level] <= 0.01 * across);
    if (!hasOther) continue;
    // The other arm, of length 1, turns along with the joint and does not bend.
    QVERIFY(std::abs(sideways[3 * frame.otherTip + 1] - (h * h * h / (3 * b) - a * h / t)) <= 0.01 * across);
    QVERIFY(std::abs(down[3 * frame.otherTip + 2] - a * h / b) <= 0.01 * along);
  }
  const double order = std::log2(error[0] / error[1]);
  QVERIFY(order > 1.9 && order < 2.1);
}

/// A straight rod bent to a ring and twisted is stable up to a twist of √3 EI/GJ turns (Michell 1889), where it leaves
/// its plane in two waves. All segments are alike: what is stiff against two waves is an 8 x 8 matrix.
void TestRodStatics::michellsRing() {
  constexpr double bending = 1, torsion = 0.75, exact = 1.7320508075688772 * bending / torsion;
  const auto smallestStiffness = [&](int count, double turns) {
    const double radius = 1;
    const RodModel rod = ring(radius, count, [&](const Vector3d& tangent) {
      RodSegment segment = unitSegment(0, 1, bending, torsion, 1e4);
      segment.prestrain = -Vector3d::UnitZ() / radius + turns / radius * tangent;
      return segment;
    });
    const int coordinates = rod.model.coordinateCount();
    Matrix waves = Matrix::Zero(coordinates, 8);
    for (int n = 0; n < count; ++n) {
      const double angle = 2 * M_PI * n / count, between = angle + M_PI / count;
      for (int phase = 0; phase < 2; ++phase) {
        const double wave = std::cos(2 * angle - phase * M_PI / 2);
        waves.block<3, 1>(3 * n, phase) = wave * Vector3d(std::cos(angle), std::sin(angle), 0);
        waves.block<3, 1>(3 * n, 2 + phase) = wave * Vector3d(-std::sin(angle), std::cos(angle), 0);
        waves(3 * n + 2, 4 + phase) = wave;
        waves(rod.network[0].twistCoordinate(n), 6 + phase) = std::cos(2 * between - phase * M_PI / 2);
      }
    }
    const Matrix stiffness = waves.transpose() * (rod.assembler().hessian(rod.model.restPositions) * waves);
    return stiffness.selfadjointView<Eigen::Lower>().eigenvalues()[0];
  };
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int count = 40 << level;
    double stable = 0.5 * exact, unstable = 1.5 * exact;
    QVERIFY(smallestStiffness(count, stable) > 0 && smallestStiffness(count, unstable) < 0);
    for (int i = 0; i < 40; ++i) {
      const double middle = (stable + unstable) / 2;
      (smallestStiffness(count, middle) > 0 ? stable : unstable) = middle;
    }
    error[level] = std::abs(stable - exact);
    qInfo("%d segments: %.5f turns, exact %.5f", count, stable, exact);
    QVERIFY(error[level] <= 0.01 * exact);
  }
  const double order = std::log2(error[0] / error[1]);
  QVERIFY(order > 1.9 && order < 2.1);
}

QTEST_GUILESS_MAIN(TestRodStatics)
#include "test_rod_statics.moc"
