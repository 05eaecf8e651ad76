#include <QTest>

#include "core/base/error.hpp"
#include "core/solvers/static_equilibrium.hpp"
#include "tests/core/cloth/cloth_examples.hpp"

using namespace pliant;
using cloth::ClothSimulation;
using cloth::SteppingScheme;

namespace {

void run(ClothSimulation& simulation, int steps) {
  base::ExecutionContext context;
  for (int i = 0; i < steps; ++i) {
    const cloth::StepRecord record = simulation.step(context);
    QVERIFY2(record.termination == base::TerminationType::converged, record.message.c_str());
  }
}

Eigen::Vector3d momentum(const ClothSimulation& simulation) {
  return simulation.state().velocities * cloth::lumpedMasses(*simulation.problem().model);
}

}  // namespace

class TestClothSimulation : public QObject {
  Q_OBJECT

 private slots:
  void freeFallIsExact() {
    const Eigen::Vector3d gravity(0.5, 0, -9.81);
    const auto problem = test::withGravity(test::sheetProblem(3), gravity);
    const double h = 0.02;
    constexpr int steps = 10;
    // Euler's positions lead by g h t / 2 over steps of h, the midpoint rule's do not.
    const std::map<SteppingScheme, double> lead{{SteppingScheme::implicitEuler, h},
                                                {SteppingScheme::stepAndProject, h},
                                                {SteppingScheme::stepAndReflect, h / 2},
                                                {SteppingScheme::secondOrderReflect, 0}};
    for (const auto& [scheme, duration] : lead) {
      ClothSimulation simulation = test::simulate(problem, scheme, h);
      run(simulation, steps);
      const double t = h * steps;
      QVERIFY(std::abs(simulation.state().time - t) < 1e-15);
      const Eigen::Matrix3Xd moved =
          simulation.state().positions - problem.model->restPositions.reshaped(3, problem.sheet.nodeCount);
      QVERIFY((moved.colwise() - 0.5 * t * (t + duration) * gravity).cwiseAbs().maxCoeff() < 1e-12);
      QVERIFY((simulation.state().velocities.colwise() - t * gravity).cwiseAbs().maxCoeff() < 1e-11);
    }
  }

  void hangingSheetReachesTheStaticEquilibrium() {
    // Thick enough to have one equilibrium alone.
    const mechanics::ShellMaterial felt{1800, 0.41, 200, 10e-3};
    const auto problem = test::withModel(test::sheetProblem(5, 0.5, felt), [](mechanics::Model& model) {
      model.gravity = Eigen::Vector3d(0.2, 0.01, -0.1);
      for (int node = 0; node < model.nodeCount(); ++node)
        for (int axis = 0; axis < 3 && model.restPositions[3 * node] == 0; ++axis)
          model.lockedCoordinates[3 * node + axis] = 1;
    });
    ClothSimulation simulation = test::simulate(problem, SteppingScheme::implicitEuler, 100);
    run(simulation, 60);
    const mechanics::ElasticAssembler assembler(problem.model);
    base::ExecutionContext context;
    const auto statics = solvers::solveStaticEquilibrium(
        *problem.model, assembler, problem.model->restPositions, problem.model->externalForce(0), {}, context);
    QVERIFY2(statics.report.converged(), statics.report.message.c_str());
    const mechanics::Vector found = simulation.state().positions.reshaped();
    QVERIFY2((found - statics.positions).lpNorm<Eigen::Infinity>() < 1e-7,
             qPrintable(QString::number((found - statics.positions).lpNorm<Eigen::Infinity>())));
    QVERIFY((found - problem.model->restPositions).lpNorm<Eigen::Infinity>() > 0.01);
  }

  void aFreeClothKeepsItsMomentum() {
    const auto problem = test::sheetProblem(5);
    for (const auto scheme : {SteppingScheme::implicitEuler, SteppingScheme::bdf2, SteppingScheme::stepAndReflect,
                              SteppingScheme::secondOrderReflect}) {
      ClothSimulation simulation = test::simulate(problem, scheme, 0.01);
      simulation.setState(0, simulation.state().positions, test::scattered(problem.sheet.nodeCount, 1));
      const Eigen::Vector3d before = momentum(simulation);
      run(simulation, 20);
      QVERIFY2((momentum(simulation) - before).norm() < 1e-11 * before.norm(),
               qPrintable(QString::number((momentum(simulation) - before).norm() / before.norm())));
    }
  }

  /// ½ ρ c A v² = m g for a flat sheet, whatever the step.
  void aFlatSheetFallsAtItsTerminalVelocity() {
    auto problem = test::withGravity(test::sheetProblem(3), {0, 0, -9.81});
    problem.wind.emplace();
    problem.wind->velocity = {0, 0, 0.25};
    problem.wind->drag = 1.3;
    ClothSimulation simulation = test::simulate(problem, SteppingScheme::implicitEuler, 0.5);
    run(simulation, 12);
    const double weight = 9.81 * cloth::lumpedMasses(*problem.model).sum();
    const double expected = 0.25 - std::sqrt(2 * weight / (1.2 * 1.3 * 0.25));
    QVERIFY2(std::abs(simulation.state().velocities.row(2).mean() - expected) < 1e-9 * std::abs(expected),
             qPrintable(QString::number(simulation.state().velocities.row(2).mean())));
    QVERIFY(std::abs(simulation.state().velocities.row(0).mean()) < 1e-9);
  }

  void pinsFollowTheirPathAndAreReleased() {
    auto problem = test::withGravity(test::sheetProblem(3), {0, 0, -9.81});
    cloth::Pin pin{"corner", {0, 3}, {}, 0.25};
    pin.path = {{0.05, {0, 0, 0}, {0, 0, 0}}, {0.15, {0.2, 0, 0}, {0, 0, 1}}};
    problem.pins = {pin};
    ClothSimulation simulation = test::simulate(problem, SteppingScheme::stepAndReflect, 0.01);
    run(simulation, 10);
    const Eigen::Matrix3Xd rest = problem.model->restPositions.reshaped(3, problem.sheet.nodeCount);
    const Eigen::Vector3d centre = 0.5 * (rest.col(0) + rest.col(3));
    const Eigen::Vector3d arm = rest.col(0) - centre;
    const Eigen::Vector3d turned(
        std::cos(0.5) * arm.x() - std::sin(0.5) * arm.y(), std::sin(0.5) * arm.x() + std::cos(0.5) * arm.y(), 0);
    const Eigen::Vector3d expected = centre + turned + Eigen::Vector3d(0.1, 0, 0);
    QVERIFY((simulation.state().positions.col(0) - expected).norm() < 1e-12);
    run(simulation, 15);
    const Eigen::Vector3d end = simulation.state().positions.col(3);
    QVERIFY((end - cloth::pinnedPositions(problem, pin, 1).col(1)).norm() < 1e-12);
    run(simulation, 5);
    QVERIFY((simulation.state().positions.col(3) - end).norm() > 1e-4);
    // Free now: the whole sheet gains the momentum of its weight, and no more.
    const Eigen::Vector3d before = momentum(simulation);
    run(simulation, 5);
    const double mass = cloth::lumpedMasses(*problem.model).sum();
    QVERIFY((momentum(simulation) - before - Eigen::Vector3d(0, 0, -9.81 * mass * 0.05)).norm() < 1e-10);
  }

  void aDraggedNodeMovesOverTheStep() {
    const auto problem = test::sheetProblem(3);
    ClothSimulation simulation = test::simulate(problem, SteppingScheme::stepAndProject, 0.01);
    const Eigen::Vector3d target(0.1, 0.2, 0.05), first = simulation.state().positions.col(5);
    simulation.setPinTarget(5, target);
    simulation.setPinTarget(9, simulation.state().positions.col(9));
    run(simulation, 1);
    QVERIFY(simulation.state().positions.col(5) == target);
    QVERIFY((simulation.state().velocities.col(5) - (target - first) / 0.01).norm() < 1e-10);
    run(simulation, 1);
    QVERIFY(simulation.state().positions.col(5) == target);
    simulation.releasePinTarget(5);
    run(simulation, 1);
    QVERIFY(simulation.state().positions.col(5) != target);
  }

  void energiesAreThoseOfClosedForms() {
    const auto problem = test::withGravity(test::sheetProblem(4), {0, 0, -10});
    ClothSimulation simulation = test::simulate(problem, SteppingScheme::implicitEuler, 0.01);
    Eigen::Matrix3Xd positions = simulation.state().positions;
    positions.row(0) *= 1.1;
    positions.row(2).array() += 2;
    simulation.setState(0, positions, Eigen::Vector3d(1, 2, 2).replicate(1, positions.cols()));
    const cloth::Energies energies = simulation.energies();
    const double area = 0.25, mass = area * 200 * 0.5e-3, strain = 0.5 * (1.21 - 1);
    QVERIFY(std::abs(energies.kinetic - 4.5 * mass) < 1e-12);
    QVERIFY(std::abs(energies.gravity - 20 * mass) < 1e-12);
    const double membrane = 0.5 * 1800 * 0.5e-3 / (1 - 0.41 * 0.41) * strain * strain * area;
    QVERIFY(std::abs(energies.membrane - membrane) < 1e-12 * membrane);
    QVERIFY(std::abs(energies.bending) < 1e-15);
  }

  void whatCannotBeSteppedIsRefused_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<QString>("said");
    QTest::addRow("consistent masses") << 0 << "lumped";
    QTest::addRow("partly locked") << 1 << "all three coordinates";
    QTest::addRow("massless") << 2 << "no mass";
    QTest::addRow("time step") << 3 << "time step";
    QTest::addRow("pin") << 4 << "names node 99";
  }
  void whatCannotBeSteppedIsRefused() {
    QFETCH(int, kind);
    QFETCH(QString, said);
    auto problem = test::withModel(test::sheetProblem(2), [&](mechanics::Model& model) {
      if (kind == 1) model.lockedCoordinates[4] = 1;
      mechanics::SparseMatrix mass = *model.elementMass;
      if (kind == 0) mass.coeffRef(0, 3) = mass.coeffRef(3, 0) = 1e-6;
      if (kind == 2) mass *= 0.0;
      model.elementMass = std::make_shared<const mechanics::SparseMatrix>(mass);
    });
    if (kind == 4) problem.pins = {{"corner", {99}, {}, {}}};
    try {
      test::simulate(problem, SteppingScheme::implicitEuler, kind == 3 ? 0 : 0.01);
      QFAIL("accepted");
    } catch (const base::InputError& error) {
      QVERIFY2(QString(error.what()).contains(said), error.what());
    }
  }
};

QTEST_GUILESS_MAIN(TestClothSimulation)
#include "test_cloth_simulation.moc"
