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
};

QTEST_GUILESS_MAIN(TestClothDrape)
#include "test_cloth_drape.moc"
