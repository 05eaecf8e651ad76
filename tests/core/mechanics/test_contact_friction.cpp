#include <QTest>
#include <cmath>
#include <random>

#include "core/base/error.hpp"
#include "core/mechanics/contact_friction.hpp"
#include "tests/core/mechanics/contact_examples.hpp"

using namespace pliant;
using namespace pliant::mechanics;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

constexpr double coefficient = 0.4, creep = 1e-2;

/// The slope of the barrier's energy at a gap, by hand [N].
double pushAt(double gap) {
  const double range = options.range;
  return options.stiffness * (2 * (range - gap) * std::log(range / gap) + std::pow(gap - range, 2) / gap);
}

/// Two tetrahedra, a tip and an edge of one above a face and an edge of the other, and a body's triangle below a corner
/// of that.
struct Touching {
  ContactGeometry geometry;
  Matrix3Xd x{3, 11};
};

Touching touchingBodies() {
  Touching example;
  example.geometry.triangles = {
      {0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}, {4, 5, 6}, {4, 5, 7}, {5, 6, 7}, {4, 6, 7}, {8, 9, 10}};
  example.geometry.radii.assign(11, 0);
  example.geometry.bodies.assign(8, 0);
  example.geometry.bodies.resize(11, 1);
  example.x << 0, 1, 0.1, 0.3, 0.35, -0.3, 0.9, 0.4, -1, 2, 0.3,  //
      0, 0.1, 1, 0.3, 0.3, 0.3, 0.9, -0.4, -1, -1, 2,             //
      0, 0.03, 0, -1, 0.06, 0.05, 0.8, 0.9, -1.05, -1.06, -1.04;
  return example;
}

Matrix3Xd randomMotion(Eigen::Index nodes, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-size, size);
  return Matrix3Xd::NullaryExpr(3, nodes, [&] { return coordinate(random); });
}

Matrix3Xd gradientAt(const ContactFriction& friction, const Matrix3Xd& x) {
  Matrix3Xd gradient = Matrix3Xd::Zero(3, x.cols());
  friction.addGradient(x, gradient);
  return gradient;
}

}  // namespace

class TestContactFriction : public QObject {
  Q_OBJECT

 private slots:
  void forceIsThatOfCoulomb();
  void contactsThatHoldCreep();
  void derivativesAreThoseOfDifferences();
  void forcesBalanceAndTakeEnergy();
  void commonMotionIsFree();
  void badNumbersAreRefused();
};

void TestContactFriction::forceIsThatOfCoulomb() {
  ContactBarrier barrier(triangleAndPoint(1), triangleAndPointAt({0.25, 0.25, 1}), options);
  const double gap = 0.03;
  const Matrix3Xd before = triangleAndPointAt({0.25, 0.25, gap});
  ContactFriction friction(barrier, before, before, {coefficient, creep});
  const Vector3d slide(0.03, 0.04, 0.5);  // the height is none of friction's
  const Matrix3Xd after = triangleAndPointAt(before.col(3) + slide);
  const Vector3d onTriangle = -gradientAt(friction, after).leftCols(3).rowwise().sum();
  const double largest = coefficient * pushAt(gap);
  QVERIFY((onTriangle - largest * Vector3d(0.6, 0.8, 0)).norm() < 1e-12 * largest);
  QVERIFY(std::abs(friction.dissipated(after) - largest * 0.05) < 1e-12 * largest);
  QCOMPARE(friction.slidingShare(after), 1.0);
  QVERIFY(gradientAt(friction, after).col(3).isZero(0));  // of a body
}

void TestContactFriction::contactsThatHoldCreep() {
  ContactBarrier barrier(triangleAndPoint(1), triangleAndPointAt({0.25, 0.25, 1}), options);
  const Matrix3Xd before = triangleAndPointAt({0.25, 0.25, 0.05});
  ContactFriction friction(barrier, before, before, {coefficient, creep});
  const double share = 0.3, largest = coefficient * pushAt(0.05);
  const Matrix3Xd after = triangleAndPointAt(before.col(3) + Vector3d(0, share * creep, 0));
  const double force = gradientAt(friction, after).leftCols(3).rowwise().sum().norm();
  QVERIFY(std::abs(force - largest * (2 * share - share * share)) < 1e-12 * largest);
  QCOMPARE(friction.slidingShare(after), 0.0);
}

void TestContactFriction::derivativesAreThoseOfDifferences() {
  const Touching example = touchingBodies();
  ContactBarrier barrier(example.geometry, example.x, options);
  ContactFriction friction(barrier, example.x + randomMotion(11, 0.6 * creep, 1), example.x, {coefficient, creep});
  QVERIFY(friction.contactCount() >= 3);
  for (const double size : {0.4 * creep, 10 * creep}) {
    const Matrix3Xd x = example.x + randomMotion(11, size, 2);
    const double step = 1e-6;
    const Matrix3Xd gradient = gradientAt(friction, x);
    std::vector<ContactBlock> blocks;
    friction.addHessian(x, blocks);
    MatrixXd hessian = MatrixXd::Zero(33, 33);
    for (const ContactBlock& block : blocks) {
      hessian.block<3, 3>(3 * block.row, 3 * block.column) += block.entry;
      if (block.row != block.column) hessian.block<3, 3>(3 * block.column, 3 * block.row) += block.entry.transpose();
    }
    const double largest = gradient.cwiseAbs().maxCoeff(), stiffest = hessian.cwiseAbs().maxCoeff();
    QVERIFY(largest > 0);
    for (int node = 0; node < 8; ++node)
      for (int i = 0; i < 3; ++i) {
        Matrix3Xd up = x, down = x;
        up(i, node) += step;
        down(i, node) -= step;
        const double slope = (friction.value(up) - friction.value(down)) / (2 * step);
        QVERIFY(std::abs(slope - gradient(i, node)) < 1e-6 * largest);
        const Eigen::VectorXd column =
            ((gradientAt(friction, up) - gradientAt(friction, down)) / (2 * step)).reshaped();
        QVERIFY((column - hessian.col(3 * node + i)).cwiseAbs().maxCoeff() < 1e-5 * stiffest);
      }
  }
}

void TestContactFriction::forcesBalanceAndTakeEnergy() {
  Touching example = touchingBodies();
  example.geometry.bodies.assign(11, 0);
  ContactBarrier barrier(example.geometry, example.x, options);
  ContactFriction friction(barrier, example.x, example.x, {coefficient, creep});
  QCOMPARE(friction.value(example.x), 0.0);
  for (unsigned seed = 1; seed < 20; ++seed) {
    const Matrix3Xd motion = randomMotion(11, creep * seed / 5, seed), x = example.x + motion;
    const Matrix3Xd gradient = gradientAt(friction, x);
    const double largest = gradient.cwiseAbs().maxCoeff();
    QVERIFY(gradient.rowwise().sum().norm() < 1e-13 * largest);
    const double work = gradient.cwiseProduct(motion).sum();
    QVERIFY(work > 0);
    QVERIFY(std::abs(work - friction.dissipated(x)) < 1e-12 * work);
    QVERIFY(friction.value(x) > 0 && friction.value(x) <= work);
  }
}

void TestContactFriction::commonMotionIsFree() {
  const Touching example = touchingBodies();
  ContactBarrier barrier(example.geometry, example.x, options);
  ContactFriction friction(barrier, example.x, example.x, {coefficient, creep});
  const Matrix3Xd x = example.x.colwise() + Vector3d(0.2, -0.1, 0.3);
  QVERIFY(gradientAt(friction, x).cwiseAbs().maxCoeff() < 1e-12);
}

void TestContactFriction::badNumbersAreRefused() {
  ContactBarrier barrier(triangleAndPoint(1), triangleAndPointAt({0.25, 0.25, 1}), options);
  const Matrix3Xd x = triangleAndPointAt({0.25, 0.25, 0.05});
  QVERIFY_THROWS_EXCEPTION(base::InputError, ContactFriction(barrier, x, x, {-0.1, creep}));
  QVERIFY_THROWS_EXCEPTION(base::InputError, ContactFriction(barrier, x, x, {0.1, 0}));
}

QTEST_APPLESS_MAIN(TestContactFriction)
#include "test_contact_friction.moc"
