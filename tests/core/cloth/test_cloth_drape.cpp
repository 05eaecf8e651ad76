#include <Eigen/LU>
#include <QTest>

#include "core/base/error.hpp"
#include "core/cloth/cloth_drape.hpp"
#include "core/geometry/triangle_intersection.hpp"
#include "core/solvers/cone_certificate.hpp"
#include "tests/core/cloth/cloth_examples.hpp"

using namespace pliant;

class TestClothDrape : public QObject {
  Q_OBJECT

 private slots:
  /// The end of a drape without limits is where Newton's method for the elastic forces alone stays.
  void withoutLimitsTheForcesBalance() {
    const auto problem = test::withModel(test::sheetProblem(6), [](mechanics::Model& model) {
      model.gravity = Eigen::Vector3d(0, 0, -1);
      for (int node = 0; node < model.nodeCount(); ++node)
        for (int axis = 0; axis < 3 && model.restPositions[3 * node] == 0; ++axis)
          model.lockedCoordinates[3 * node + axis] = 1;
    });
    cloth::DrapeOptions options;
    options.limitMethod = "none";
    options.tolerance = 1e-8;
    cloth::ClothDrape drape(std::make_shared<const cloth::ClothProblem>(problem), options);
    base::ExecutionContext context;
    int steps = 0;
    while (!drape.converged() && steps < 300) {
      const cloth::DrapeRecord record = drape.step(context);
      QVERIFY2(record.step.termination == base::TerminationType::converged, record.step.message.c_str());
      ++steps;
    }
    QVERIFY2(drape.converged(), qPrintable(QString::number(steps)));
    const mechanics::ElasticAssembler assembler(problem.model);
    const mechanics::Vector force = problem.model->externalForce(0);
    const mechanics::Vector left = force - assembler.gradient(drape.positions().reshaped());
    const auto& free = problem.model->dofs.freeCoordinates;
    QVERIFY(left(free).norm() <= 1e-8 * force(free).norm());
    QVERIFY(drape.positions().row(2).minCoeff() < -0.2);
  }

  /// With limits the forces balance as well, those of the limits being the multipliers'; and they pull inwards alone.
  void withLimitsTheForcesBalance() {
    const auto problem =
        test::withLimit(test::hungByCorners(test::withGravity(test::sheetProblem(10), {0, 0, -9.81})), 1.01);
    cloth::DrapeOptions options;
    options.tolerance = 1e-3;
    cloth::ClothDrape drape(std::make_shared<const cloth::ClothProblem>(problem), options);
    base::ExecutionContext context;
    int steps = 0;
    cloth::DrapeRecord record;
    while (!drape.converged() && steps < 3000) {
      record = drape.step(context);
      QVERIFY2(record.step.termination == base::TerminationType::converged, record.step.message.c_str());
      ++steps;
    }
    QVERIFY2(drape.converged(), qPrintable(QString::number(record.residual)));
    QVERIFY(cloth::stretchRatios(problem.sheet, drape.positions()).maxCoeff() < 1 + 1e-7);
    // R from the multipliers: Σ (F Λ) g / h² over the triangles, in the metric that the limit makes unit.
    Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, drape.positions().cols());
    const Eigen::Matrix3Xd& multipliers = record.step.projection->multipliers;
    const double h = record.timeStep;
    for (std::size_t t = 0; t < problem.sheet.triangles.size(); ++t) {
      const cloth::SheetTriangle& triangle = problem.sheet.triangles[t];
      const auto entries = multipliers.col(static_cast<Eigen::Index>(t));
      const Eigen::Matrix2d multiplier{{entries[0], entries[2]}, {entries[2], entries[1]}};
      QVERIFY(multiplier.trace() >= 0 && multiplier.determinant() > -1e-12 * multiplier.squaredNorm());
      const Eigen::Matrix<double, 3, 2> f = cloth::deformationGradient(triangle, drape.positions());
      for (std::size_t corner = 0; corner < 3; ++corner)
        forces.col(triangle.nodes[corner]) += f * multiplier * triangle.gradients[corner] / (h * h);
    }
    const mechanics::ElasticAssembler assembler(problem.model);
    const mechanics::Vector weight = problem.model->externalForce(0);
    const mechanics::Vector left =
        assembler.gradient(drape.positions().reshaped()) - weight + mechanics::Vector(forces.reshaped());
    const auto& free = problem.model->dofs.freeCoordinates;
    QVERIFY2(left(free).norm() < 1.5e-3 * weight(free).norm(),
             qPrintable(QString::number(left(free).norm() / weight(free).norm())));
    QVERIFY(mechanics::Vector(forces.reshaped())(free).norm() > 0.5 * weight(free).norm());
  }

  /// Newton's method and splitting share nothing but the limits, and end in the same place.
  void bothMethodsFindTheSameEquilibrium() {
    const auto problem = std::make_shared<const cloth::ClothProblem>(
        test::withLimit(test::hungByCorners(test::withGravity(test::sheetProblem(6), {0, 0, -9.81})), 1.02));
    cloth::DrapeOptions options;
    options.tolerance = 1e-4;
    cloth::ClothDrape newton(problem, options);
    cloth::ClothDrape split(problem, options, [&](const cloth::SheetCones& cones) {
      return cloth::makeStrainLimiter("cone", cones.constraints, options.projection);
    });
    base::ExecutionContext context;
    for (cloth::ClothDrape* drape : {&newton, &split}) {
      int steps = 0;
      while (!drape->converged() && steps < 3000) {
        const cloth::DrapeRecord record = drape->step(context);
        QVERIFY2(record.step.termination == base::TerminationType::converged, record.step.message.c_str());
        ++steps;
      }
      QVERIFY2(drape->converged(), qPrintable(QString::number(steps)));
    }
    const double distance = (newton.positions() - split.positions()).colwise().norm().maxCoeff();
    QVERIFY2(distance < 1e-3 * 0.5, qPrintable(QString::number(distance)));
    QVERIFY((newton.limitForces() - split.limitForces()).norm() < 1e-2 * split.limitForces().norm());
  }

  /// A sheet held by two corners comes to rest on a ball: nowhere inside it, not through itself, within its limits, and
  /// with all forces, those of contact among them, in balance.
  void itRestsOnABall() {
    auto problem = test::withLimit(test::hungByCorners(test::withGravity(test::sheetProblem(6), {0, 0, -9.81})), 1.02);
    const double radius = 0.15;
    cloth::Body ball;
    ball.name = "ball";
    ball.points = Eigen::Vector3d(0.12, 0.01, -0.2);
    ball.radius = radius;
    problem.bodies = {ball};
    problem.contactDistance = 5e-3;
    problem.selfContact = true;
    cloth::DrapeOptions options;
    options.tolerance = 1e-2;
    cloth::ClothDrape drape(std::make_shared<const cloth::ClothProblem>(problem), options);
    base::ExecutionContext context;
    std::vector<std::array<int, 3>> triangles;
    for (const cloth::SheetTriangle& triangle : problem.sheet.triangles) triangles.push_back(triangle.nodes);
    int steps = 0;
    cloth::DrapeRecord record;
    while (!drape.converged() && steps < 300) {
      record = drape.step(context);
      ++steps;
      for (Eigen::Index node = 0; node < drape.positions().cols(); ++node)
        QVERIFY((drape.positions().col(node) - ball.points.col(0)).norm() > radius);
      if (steps % 20 == 0) QVERIFY(geometry::findIntersections(drape.positions(), triangles).empty());
      QVERIFY(cloth::stretchRatios(problem.sheet, drape.positions()).maxCoeff() <= 1);
    }
    QVERIFY2(drape.converged(), qPrintable(QString("%1 after %2").arg(record.residual).arg(steps)));
    QVERIFY(record.step.smallestGap < problem.contactDistance);
    // R is what the multipliers and the contact barrier say, each computed for itself.
    const auto contact = cloth::makeContactBarrier(problem);
    contact->update(cloth::withBodies(problem, drape.positions(), 0));
    Eigen::Matrix3Xd forces = solvers::limitForces(
        cloth::sheetCones(problem.sheet, cloth::ProjectionNorm::mass).constraints, *record.step.projection);
    forces /= record.timeStep * record.timeStep;
    Eigen::Matrix3Xd push = Eigen::Matrix3Xd::Zero(3, forces.cols());
    contact->addGradient(push);
    forces += push;
    const auto& locked = problem.model->lockedCoordinates;
    for (Eigen::Index node = 0; node < forces.cols(); ++node)
      if (locked[static_cast<std::size_t>(3 * node)]) forces.col(node).setZero();
    const double weight = 9.81 * problem.sheet.masses.sum();
    QVERIFY2((forces - drape.limitForces()).norm() < 1e-3 * weight,
             qPrintable(QString::number((forces - drape.limitForces()).norm() / weight)));
    QVERIFY(push.norm() > 0.05 * weight);  // the ball bears a part
  }

  void contactRefusesWhatItCannotKeep() {
    auto problem = test::withLimit(test::withGravity(test::sheetProblem(2), {0, 0, -9.81}), 1.02);
    problem.selfContact = true;
    cloth::DrapeOptions options;
    options.limitMethod = "gauss_seidel";
    QVERIFY_THROWS_EXCEPTION(
        base::InputError, cloth::ClothDrape(std::make_shared<const cloth::ClothProblem>(problem), options));
    cloth::SteppingOptions stepping;
    stepping.norm = cloth::ProjectionNorm::identity;
    QVERIFY_THROWS_EXCEPTION(
        base::InputError, cloth::ClothSimulation(std::make_shared<const cloth::ClothProblem>(problem), stepping));
  }
};

QTEST_GUILESS_MAIN(TestClothDrape)
#include "test_cloth_drape.moc"
