#include <Eigen/LU>
#include <QtTest>

#include "core/cloth/cloth_drape.hpp"
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
};

QTEST_GUILESS_MAIN(TestClothDrape)
#include "test_cloth_drape.moc"
