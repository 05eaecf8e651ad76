#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/interlock/boundary_sensitivity.hpp"
#include "core/scene/cell_parameters.hpp"

using namespace pliant;
using namespace pliant::interlock;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

struct DesignedCell {
  std::vector<scene::CellParameter> parameters;
  CellFunction build;
  VectorXd values;
  std::vector<CellRate> rates;

  explicit DesignedCell(const std::string& type, const std::vector<std::string>& names) {
    const scene::Scene scene = scene::Scene::parse(
        R"({"schema_version": 1, "interlocking_cells": [{"name": "m", "type": ")" + type + "\"}]}", "/nowhere", "test");
    for (const scene::CellParameter& each : scene::cellParameters(scene, 0))
      if (std::find(names.begin(), names.end(), each.name) != names.end()) parameters.push_back(each);
    build = scene::cellFunction(scene, 0, parameters);
    values = scene::valuesOf(parameters);
    for (const auto& rate : scene::cellRates(build, parameters, values)) rates.push_back(rate.value());
  }
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

class TestBoundarySensitivity : public QObject {
  Q_OBJECT

 private slots:
  /// Limits of a changed cell, solved from the middle along the same rays, against those predicted: an error of second
  /// order where the same contacts hold.
  void errorIsOfSecondOrder_data() {
    QTest::addColumn<QString>("type");
    QTest::addColumn<QStringList>("names");
    QTest::addColumn<double>("change");
    QTest::newRow("threefold") << "threefold" << QStringList{"ring_radius", "wire_radius", "distance", "lean"} << 0.01;
    QTest::newRow("ring net") << "ring_net" << QStringList{"ring_radius", "wire_radius", "spacing"} << 0.01;
  }

  void errorIsOfSecondOrder() {
    QFETCH(QString, type);
    QFETCH(QStringList, names);
    QFETCH(double, change);
    std::vector<std::string> list;
    for (const QString& name : names) list.push_back(name.toStdString());
    const DesignedCell cell(type.toStdString(), list);
    const CellSolver solver(cell.build(cell.values));
    BoundaryOptions options;
    options.subdivisions = 1;
    options.testStarShape = false;
    base::ExecutionContext context;
    const StrainSpaceBoundary boundary = computeBoundary(solver, options, context);
    QVERIFY(boundary.isClosed());
    const BoundarySensitivity sensitivity = boundarySensitivity(solver, boundary, cell.rates, context);
    QVERIFY(sensitivity.termination == base::TerminationType::converged);
    // Limits on a symmetry of the cell may be where contacts change.
    QVERIFY2(sensitivity.count(LimitSensitivity::Kind::smooth) >= 38,
             qPrintable(QString::number(sensitivity.count(LimitSensitivity::Kind::smooth))));

    // Numbers change by 1, -2, 3, ... times a share of theirs, so that nothing cancels.
    VectorXd direction(cell.values.size());
    for (Index i = 0; i < direction.size(); ++i)
      direction[i] = (i % 2 ? -0.5 : 1) * cell.values[i] / static_cast<double>(i + 1);
    std::vector<double> steps, errors, moves;
    for (double step = change; step > 0.2 * change; step *= 0.5) {
      const VectorXd move = step * direction;
      const StrainSpaceBoundary predicted = predictedBoundary(boundary, sensitivity, move);
      const CellSolver changed(cell.build(cell.values + move));
      std::vector<double> error, moved;
      for (std::size_t i = 0; i < boundary.states.size(); ++i) {
        if (sensitivity.kinds[i] != LimitSensitivity::Kind::smooth) continue;
        const StrainDrive drive = rayDrive(boundary.mesh.directions[i]);
        const CellEquilibrium rest = changed.solve(boundary.middleState, drive);
        if (!rest.converged() || rest.kind != RestKind::locked) continue;
        // Under the barrier of the limit that is predicted from, on both sides.
        const LimitSensitivity before = limitSensitivity(solver, boundary.states[i].cell, drive, {});
        const double after = limitSensitivity(changed, rest.state, drive, {}, &before.barrier).value;
        const double grown = sensitivity.slopes.row(static_cast<Index>(i)).dot(move);
        error.push_back(std::abs(after - before.value - grown));
        moved.push_back(std::abs(after - before.value));
        QVERIFY(std::abs(predicted.states[i].distance - boundary.states[i].distance - grown) < 1e-15);
      }
      QVERIFY(error.size() > 30);
      steps.push_back(step);
      errors.push_back(median(error));
      moves.push_back(median(moved));
      std::cout << "  change " << step << ": limits move by " << moves.back() << ", predicted to " << errors.back()
                << " (median of " << error.size() << ")" << std::endl;
    }
    const double slope = std::log(errors.front() / errors.back()) / std::log(steps.front() / steps.back());
    std::cout << "  slope " << slope << std::endl;
    QVERIFY2(std::abs(slope - 2) < 0.3, qPrintable(QString::number(slope)));
    QVERIFY(errors.back() < 0.05 * moves.back());
  }

  /// A slider asks for all limits at once.
  void predictionIsQuick() {
    StrainSpaceBoundary boundary;
    boundary.mesh = icosphere(3);
    boundary.states.resize(boundary.mesh.directions.size());
    CellState state;
    state.positions.setZero(3, 2);
    state.rotations.assign(2, Eigen::Matrix3d::Identity());
    for (BoundaryState& each : boundary.states) each.distance = 0.1, each.cell = state;
    BoundarySensitivity sensitivity;
    sensitivity.slopes.setConstant(static_cast<Index>(boundary.states.size()), 6, -1.0);
    QElapsedTimer timer;
    timer.start();
    const int repeats = 20;
    for (int i = 0; i < repeats; ++i) {
      const auto predicted = predictedBoundary(boundary, sensitivity, VectorXd::Constant(6, 0.01));
      QVERIFY(std::abs(predicted.states[17].distance - 0.04) < 1e-15);
      // Never beyond the middle.
      QCOMPARE(predictedBoundary(boundary, sensitivity, VectorXd::Constant(6, 1)).states[3].distance, 0.0);
    }
    std::cout << "  a prediction of 642 limits takes " << timer.nsecsElapsed() * 1e-6 / (2 * repeats) << " ms"
              << std::endl;
  }
};

QTEST_GUILESS_MAIN(TestBoundarySensitivity)
#include "test_boundary_sensitivity.moc"
