#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>
#include <random>

#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/friction_step.hpp"
#include "core/interlock/linking_number.hpp"
#include "core/interlock/patch_equilibrium.hpp"

using namespace pliant;
using namespace pliant::interlock;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

geometry::SurfaceMesh boxMesh(const Vector3d& half) {
  geometry::SurfaceMesh mesh;
  mesh.points.resize(3, 8);
  for (int i = 0; i < 8; ++i)
    mesh.points.col(i) = half.cwiseProduct(Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A block on a long table, both of plates with round rims or both meshes, with a small gap between them.
UnitCell blockOnTable(bool meshes) {
  UnitCell patch;
  const double radius = 0.5e-3;
  const auto plate = [&](double length, double width) {
    Eigen::Matrix3Xd corners(3, 4);
    corners << -length, length, length, -length, -width, -width, width, width, 0, 0, 0, 0;
    return roundedPolygon(corners, radius);
  };
  if (meshes)
    patch.shapes = {{"table", {dilatedMesh(boxMesh({100e-3, 5e-3, radius}), 0)}},
                    {"block", {dilatedMesh(boxMesh({2e-3, 2e-3, radius}), 0)}}};
  else
    patch.shapes = {{"table", {plate(100e-3, 5e-3)}}, {"block", {plate(2e-3, 2e-3)}}};
  patch.elements = {
      {0, Vector3d::Zero(), Matrix3d::Identity()}, {1, Vector3d(0.3e-3, 0.2e-3, 2.02 * radius), Matrix3d::Identity()}};
  return patch;
}

}  // namespace

class TestFriction : public QObject {
  Q_OBJECT

 private slots:
  /// First and second differences of friction and drag, with contacts that creep, some that slide, and in images.
  void finiteDifferences() {
    for (const double creep : {1e-3, 1e-5}) {
      const UnitCell cell = fourInOne();
      const CellContact contact(cell);
      const CellState before = restState(cell);
      std::vector<CellContactForce> contacts;
      contact.energy(before, contact.nearParts(before, 2e-3), {1, 2e-3}, nullptr, nullptr, nullptr, &contacts);
      QVERIFY(contacts.size() > 8);
      const FrictionStep step(contact, before, before, contacts, {0.4, creep, 3e5, 0.01});
      QCOMPARE(step.energy(before), 0.0);
      std::mt19937 random(4);
      std::normal_distribution<double> normal;
      const auto randomVelocity = [&] {
        VectorXd velocity(contact.coordinateCount());
        for (Eigen::Index i = 0; i < velocity.size(); ++i) velocity[i] = normal(random) * (i % 6 < 3 ? 1 : 200);
        velocity.tail<3>() = 100 * Vector3d(normal(random), normal(random), normal(random));
        return velocity;
      };
      const CellState state = moved(before, randomVelocity(), 2e-4);
      VectorXd gradient = VectorXd::Zero(contact.coordinateCount());
      MatrixXd hessian = MatrixXd::Zero(gradient.size(), gradient.size());
      step.addDerivatives(state, gradient, hessian);
      QVERIFY((hessian - hessian.transpose()).norm() < 1e-12 * hessian.norm());
      for (int trial = 0; trial < 10; ++trial) {
        const VectorXd velocity = randomVelocity();
        const double h = 1e-8;
        VectorXd ahead = VectorXd::Zero(gradient.size()), behind = ahead;
        MatrixXd unused = hessian;
        const CellState next = moved(state, velocity, h), last = moved(state, velocity, -h);
        step.addDerivatives(next, ahead, unused);
        step.addDerivatives(last, behind, unused);
        const double slope = (step.energy(next) - step.energy(last)) / (2 * h);
        QVERIFY(std::abs(slope - gradient.dot(velocity)) < 1e-6 * gradient.cwiseProduct(velocity).norm());
        // Along multiples of one velocity the slope is gradient · velocity at every point.
        const double second = (ahead - behind).dot(velocity) / (2 * h), expected = velocity.dot(hessian * velocity);
        QVERIFY2(std::abs(second - expected) < 1e-5 * std::abs(expected),
                 qPrintable(QString("%1 %2").arg(second).arg(expected)));
      }
    }
  }

  /// A block on a table that is inclined holds if the tangent of its angle is below the coefficient, and slides for
  /// ever if it is above: whichever the surfaces are made of.
  void blockOnIncline() {
    constexpr double coefficient = 0.3;
    for (const bool meshes : {false, true})
      for (const double over : {0.5, 0.98, 1.02}) {
        const UnitCell patch = blockOnTable(meshes);
        EquilibriumOptions options;
        options.friction = coefficient;
        const PatchSolver solver(patch, options);
        const double angle = std::atan(over * coefficient), weight = 0.01;
        PatchLoads loads;
        loads.clamped = {0};
        loads.forces = {{1, weight * Vector3d(std::sin(angle), 0, -std::cos(angle)), Vector3d::Zero()}};
        const CellEquilibrium rest = solver.solve(restState(patch), loads);
        const double slid = rest.state.positions(0, 1) - patch.elements[1].position.x();
        if (over > 1) {
          QVERIFY(!rest.converged());
          QVERIFY2(rest.message.find("slide") != std::string::npos, rest.message.c_str());
          QVERIFY(slid > 0.5 * solver.radius());
          continue;
        }
        QVERIFY2(rest.converged(), rest.message.c_str());
        QVERIFY2(slid < 0.2 * solver.radius(), qPrintable(QString::number(slid)));
        double normal = 0;
        for (const CellContactForce& contact : rest.contacts) normal -= contact.force * contact.normal.z();
        // Newton's decrement is below 1e-4 of the barrier's weight, forces are in balance to the root of that.
        QVERIFY2(std::abs(normal / (weight * std::cos(angle)) - 1) < 1e-2, qPrintable(QString::number(normal)));
      }
  }

  /// A flat ring and its image pull at an upright one that hangs beside the middle: it slides there until the normal of
  /// its contacts is the angle of friction off the pull, or stays where it is if it is less already.
  void ringsSlideUntilFrictionHolds() {
    const double ring = 5e-3, wireRadius = 0.5e-3;
    UnitCell cell;
    cell.lattice = Eigen::Vector2d(14e-3, 0.1).asDiagonal();
    cell.shapes = {{"ring", {wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), ring), wireRadius)}}};
    const Matrix3d upright = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()).toRotationMatrix();
    for (const double coefficient : {0.1, 0.3}) {
      EquilibriumOptions options;
      options.friction = coefficient;
      for (const double start : {2.6e-3, 0.2e-3}) {
        cell.elements = {{0, Vector3d::Zero(), Matrix3d::Identity()}, {0, Vector3d(7e-3, start, 0), upright}};
        const CellSolver solver(cell, options);
        QCOMPARE(solver.links().size(), std::size_t{2});
        const CellEquilibrium rest = solver.solve(restState(cell), uniaxialDrive(0, false, Lateral::held));
        QVERIFY2(rest.converged(), rest.message.c_str());
        QCOMPARE(rest.kind, RestKind::locked);
        double most = 0, tangent = 0;
        for (const CellContactForce& contact : rest.contacts)
          if (contact.force > most) most = contact.force, tangent = std::abs(contact.normal.y() / contact.normal.x());
        const double before = start / std::sqrt((ring - wireRadius) * (ring - wireRadius) - start * start);
        qInfo("coefficient %.2f, from %.4f: %.4f", coefficient, before, tangent);
        QVERIFY(before > coefficient ? std::abs(tangent - coefficient) < 0.03 * coefficient
                                     : std::abs(tangent - before) < 0.1 * before);
      }
    }
  }

  /// With hardly any friction the limit is that without; with much it is less.
  void limitsWithFriction() {
    const UnitCell cell = fourInOne();
    const double without = directionLimit(CellSolver(cell), 0.4, false).strain;
    for (const double coefficient : {1e-5, 0.3}) {
      EquilibriumOptions options;
      options.friction = coefficient;
      const auto limit = directionLimit(CellSolver(cell, options), 0.4, false);
      QVERIFY2(limit.equilibrium.converged(), limit.equilibrium.message.c_str());
      qInfo("coefficient %g: %.6f, without %.6f", coefficient, limit.strain, without);
      if (coefficient < 1e-4) QVERIFY(std::abs(limit.strain - without) < 2e-4);
      if (coefficient > 0.1) QVERIFY(limit.strain < without - 1e-3);
    }
  }
};

QTEST_GUILESS_MAIN(TestFriction)
#include "test_friction.moc"
