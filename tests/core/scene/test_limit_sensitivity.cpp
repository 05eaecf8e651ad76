#include <QTest>
#include <iostream>

#include "core/interlock/contact_terms.hpp"
#include "core/interlock/deformation_test.hpp"
#include "core/interlock/limit_sensitivity.hpp"
#include "core/interlock/parameter_terms.hpp"
#include "core/scene/cell_parameters.hpp"
#include "core/scene/interlock_specs.hpp"

using namespace pliant;
using namespace pliant::interlock;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

scene::Scene sceneOf(const std::string& entry) {
  return scene::Scene::parse(
      R"({"schema_version": 1, "interlocking_cells": [)" + entry + "]}", "/nowhere", "test.json");
}

/// Every family of the registry whose numbers all have defaults.
std::vector<std::string> families() {
  std::vector<std::string> list;
  for (const base::ParameterSpec& spec : scene::interlockingCellSpecs())
    if (spec.key != "composed") list.push_back(R"({"name": "material", "type": ")" + spec.key + R"("})");
  return list;
}

/// A ring, an ellipse, and a body of points, rods and a plate, near each other; two of its rods are parallel.
const std::string mixedCell = R"({"name": "mixed", "type": "composed", "lattice": [["30 mm", 0], [0, "30 mm"]],
  "shapes": [
    {"name": "ring", "pieces": [{"type": "circle", "ring_radius": "4 mm", "radius": "0.6 mm", "normal": [0.2, 0.1, 1]}]},
    {"name": "body", "pieces": [
      {"type": "simplices", "radius": "0.5 mm",
       "corners": [["-2 mm", 0, "1 mm"], ["3 mm", "0.5 mm", "1.5 mm"], ["0.5 mm", "4 mm", "2 mm"], [0, "-2 mm", 0],
                   ["1 mm", "-3 mm", "4 mm"], ["-3 mm", "1 mm", "-2 mm"]],
       "triangles": [[0, 1, 2]], "segments": [[3, 4]], "points": [5]}]},
    {"name": "rods", "pieces": [
      {"type": "simplices", "radius": "0.4 mm", "corners": [["-4 mm", 0, 0], ["4 mm", 0, 0], [0, "3 mm", "1 mm"]],
       "segments": [[0, 1], [1, 2]]},
      {"type": "ellipse", "first": ["5 mm", 0, 0], "second": [0, "3 mm", "1 mm"], "radius": "0.3 mm"}]}],
  "elements": [
    {"shape": "ring"},
    {"shape": "body", "position": ["1 mm", "1 mm", "4 mm"], "rotation": {"axis": [1, 2, 3], "angle": "20 deg"}},
    {"shape": "rods", "position": [0, "1 mm", "-3 mm"]},
    {"shape": "rods", "position": ["0.3 mm", "1 mm", "9.5 mm"], "rotation": {"axis": [0, 0, 1], "angle": "0.5 deg"}},
    {"shape": "rods", "position": ["0.2 mm", "2 mm", "11.5 mm"]}],
  "links": []})";

/// A family's cell with the rates of all its numbers that have one.
struct RatedCell {
  std::vector<scene::CellParameter> parameters;
  CellFunction build;
  VectorXd values;
  std::vector<CellRate> rates;
  std::vector<Index> columns;  ///< of the numbers that have a rate
  std::vector<std::string> without;

  explicit RatedCell(const std::string& entry) {
    const scene::Scene scene = sceneOf(entry);
    parameters = scene::cellParameters(scene, 0);
    build = scene::cellFunction(scene, 0, parameters);
    values = scene::valuesOf(parameters);
    const auto all = scene::cellRates(build, parameters, values);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i]) {
        without.push_back(parameters[i].name);
        continue;
      }
      rates.push_back(*all[i]);
      columns.push_back(static_cast<Index>(i));
    }
  }

  /// The number's scale: its own value, where it is not 0.
  double scale(std::size_t rate) const { return 100 * parameters[static_cast<std::size_t>(columns[rate])].step; }
  UnitCell with(std::size_t rate, double change) const {
    VectorXd changed = values;
    changed[columns[rate]] += change;
    return build(changed);
  }
};

/// Central differences of sixth order.
template <typename Function>
auto derivative(Function&& f, double h) {
  return ((45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h)).eval();
}

void agreesWithSolves(const RatedCell& cell, const StrainDrive& drive, double finalGap, double tolerance) {
  EquilibriumOptions options;
  options.finalGap = finalGap;
  const auto solved = [&](const UnitCell& other) {
    const CellSolver solver(other, options);
    return solver.solve(solver.perturbed(restState(other), 0.01, 1), drive).state;
  };
  const CellSolver solver(cell.build(cell.values), options);
  const LimitSensitivity here = limitSensitivity(solver, solved(solver.contact().cell()), drive, cell.rates);
  QVERIFY(here.kind == LimitSensitivity::Kind::smooth);
  double largest = 0;
  for (std::size_t k = 0; k < cell.rates.size(); ++k)
    largest = std::max(largest, std::abs(here.slopes[static_cast<Index>(k)]) * cell.scale(k));
  double worst = 0;
  for (std::size_t k = 0; k < cell.rates.size(); ++k) {
    const auto valueAt = [&](double change) {
      const CellSolver other(cell.with(k, change), options);
      return limitSensitivity(other, solved(other.contact().cell()), drive, {}, &here.barrier).value;
    };
    const double h = 1e-5 * cell.scale(k);  // a change of contacts is blended over about the gap
    const double slope = (8 * (valueAt(h) - valueAt(-h)) - (valueAt(2 * h) - valueAt(-2 * h))) / (12 * h);
    const double error = std::abs(slope - here.slopes[static_cast<Index>(k)]) * cell.scale(k) / largest;
    worst = std::max(worst, error);
    QVERIFY2(
        error < tolerance,
        qPrintable(QString("%1: %2, but %3 by differences")
                       .arg(QString::fromStdString(cell.parameters[static_cast<std::size_t>(cell.columns[k])].name))
                       .arg(here.slopes[static_cast<Index>(k)], 0, 'g', 12)
                       .arg(slope, 0, 'g', 12)));
    // The forces alone tell the same as gaps vanish.
    const double ofForces = std::abs(here.envelope[static_cast<Index>(k)] - here.slopes[static_cast<Index>(k)]);
    QVERIFY(ofForces * cell.scale(k) / largest < 30 * finalGap);
  }
  std::cout << "  gap " << finalGap << ": limit " << here.value << ", largest difference " << worst
            << " of the largest derivative" << std::endl;
}

}  // namespace

class TestLimitSensitivity : public QObject {
  Q_OBJECT

 private slots:
  /// Curves, corners and radii are sines and products of the numbers.
  void ratesOfGeometryAreExact() {
    const RatedCell cell(R"({"name": "m", "type": "four_in_one"})");
    const auto rateOfNumber = [&](const std::string& name) -> const CellRate& {
      for (std::size_t k = 0; k < cell.rates.size(); ++k)
        if (cell.parameters[static_cast<std::size_t>(cell.columns[k])].name == name) return cell.rates[k];
      return cell.rates.front();
    };
    const CellContact contact(cell.build(cell.values));
    const ClosedCurve& circle = contact.partsOf(0).curves()[0];
    const PartsRate& ofRing = rateOfNumber("ring_radius").shapes[0];
    for (double t = 0; t < 6; t += 0.7)
      QVERIFY((ofRing.curves[0].placeAt(t) - circle.placeAt(t) / 5e-3).norm() < 1e-12);
    QVERIFY(ofRing.radii.cwiseAbs().maxCoeff() < 1e-12 && ofRing.begins.cwiseAbs().maxCoeff() * 5e-3 < 1e-9);
    const CellRate& ofWire = rateOfNumber("wire_radius");
    QVERIFY((ofWire.shapes[0].radii.array() - 1).abs().maxCoeff() < 1e-12 && std::abs(ofWire.radius - 1) < 1e-12);
    const CellRate& ofTilt = rateOfNumber("tilt");
    QVERIFY((ofTilt.turns.col(0) + Vector3d::UnitX()).norm() < 1e-11);
    QVERIFY((ofTilt.turns.col(1) - Vector3d::UnitX()).norm() < 1e-11);
    const CellRate& ofWidth = rateOfNumber("width");
    QVERIFY((ofWidth.lattice - (Eigen::Matrix2d() << 1, 0, 0, 0).finished()).norm() < 1e-12);
    QVERIFY((ofWidth.positions.col(1) - Vector3d(0.5, 0, 0)).norm() < 1e-12);
    // A round wire is one circle, an elliptic one a bundle: nothing leads from one to the other.
    QCOMPARE(cell.without, std::vector<std::string>{"aspect"});
  }

  /// Every pair of parts within a wide barrier, arcs against arcs, points, rods and plates, these against each other,
  /// parallel edges, and ends of arcs; by all numbers, against differences of the energy and its gradient.
  void termsOfContact_data() {
    QTest::addColumn<QString>("entry");
    for (const std::string& entry : families()) QTest::newRow(entry.c_str()) << QString::fromStdString(entry);
    QTest::newRow("elliptic") << R"({"name": "m", "type": "threefold", "aspect": 1.2})";
    QTest::newRow("mixed") << QString::fromStdString(mixedCell);
  }

  void termsOfContact() {
    QFETCH(QString, entry);
    const RatedCell cell(entry.toStdString());
    const CellContact contact(cell.build(cell.values));
    // Not at rest, where symmetric cells have places that are nearest at once.
    CellState state = CellSolver(contact.cell()).perturbed(restState(contact.cell()), 0.1, 7);
    state.strain = {1e-3, 2e-3, -3e-3};
    const double range = contact.cell().smallestRadius() * (entry.contains("mixed") ? 5 : 4);
    for (const int split : {1, 2}) {
      const CellContact::Barrier barrier{0.7, range, split};
      const auto pairs = contact.nearParts(state, range);
      QVERIFY(std::isfinite(contact.energy(state, pairs, barrier)));
      const ParameterTerms terms = parameterTerms(contact, state, pairs, barrier, cell.rates);
      double scale = 0;
      for (std::size_t k = 0; k < cell.rates.size(); ++k)
        scale = std::max(scale, terms.ofGradient.col(static_cast<Index>(k)).norm() * cell.scale(k));
      QVERIFY(scale > 0);
      for (std::size_t k = 0; k < cell.rates.size(); ++k) {
        const auto both = [&](double change) -> VectorXd {
          const CellContact other(cell.with(k, change));
          VectorXd gradient;
          const double energy = other.energy(state, other.nearParts(state, range), barrier, &gradient);
          return (VectorXd(gradient.size() + 1) << gradient, energy).finished();
        };
        const VectorXd slopes = derivative(both, 1e-5 * cell.scale(k));
        const double ofEnergy = slopes[slopes.size() - 1];
        const auto column = static_cast<Index>(k);
        const std::string name = cell.parameters[static_cast<std::size_t>(cell.columns[k])].name;
        const double error = (slopes.head(slopes.size() - 1) - terms.ofGradient.col(column)).norm() * cell.scale(k);
        QVERIFY2(error < 1e-6 * scale, qPrintable(QString::fromStdString(name) + QString(": %1").arg(error / scale)));
        QVERIFY2(std::abs(ofEnergy - terms.ofEnergy[column]) <
                     1e-7 * std::max(std::abs(ofEnergy), terms.ofEnergy.cwiseAbs().maxCoeff()),
                 qPrintable(QString::fromStdString(name)));
      }
    }
  }

  void gapsAtRest() {
    for (const std::string& entry : families()) {
      const RatedCell cell(entry);
      const UnitCell unit = cell.build(cell.values);
      const CellContact contact(unit);
      PartPair pair{};
      const double reach = 10 * unit.smallestRadius();
      contact.smallestGap(restState(unit), reach, &pair);
      const VectorXd slopes = gapRateAtRest(contact, pair, cell.rates);
      for (std::size_t k = 0; k < cell.rates.size(); ++k) {
        const auto gap = [&](double change) {
          const UnitCell other = cell.with(k, change);
          Eigen::Matrix<double, 1, 1> result;
          CellContact(other).visitContacts(restState(other), {pair}, {1, 1}, false, false,
                                           [&](const PartPair&, const ContactTerms& terms) { result[0] = terms.gap; });
          return result;
        };
        const double slope = derivative(gap, 1e-4 * cell.scale(k))[0];
        const double error = std::abs(slope - slopes[static_cast<Index>(k)]) * cell.scale(k);
        QVERIFY2(
            error < 1e-9 * reach,
            qPrintable(QString("%1 of %2: %3, but %4")
                           .arg(QString::fromStdString(cell.parameters[static_cast<std::size_t>(cell.columns[k])].name),
                                QString::fromStdString(entry))
                           .arg(slopes[static_cast<Index>(k)])
                           .arg(slope)));
      }
    }
  }

  void limitsOfFamilies_data() {
    QTest::addColumn<QString>("entry");
    for (const std::string& entry : families()) QTest::newRow(entry.c_str()) << QString::fromStdString(entry);
    QTest::newRow("elliptic") << R"({"name": "m", "type": "threefold", "aspect": 1.2})";
  }

  /// From rest to the limit anew with each number changed.
  void limitsOfFamilies() {
    QFETCH(QString, entry);
    agreesWithSolves(RatedCell(entry.toStdString()), uniaxialDrive(0.4, false, Lateral::free), 1e-4, 1e-5);
  }

  void limitsOfOtherDrivesAndGaps() {
    const RatedCell cell(R"({"name": "m", "type": "threefold"})");
    for (const double gap : {1e-2, 1e-5}) agreesWithSolves(cell, uniaxialDrive(0.2, false, Lateral::free), gap, 1e-5);
    agreesWithSolves(cell, uniaxialDrive(0.2, false, Lateral::held), 1e-4, 1e-5);
    agreesWithSolves(cell, uniaxialDrive(0.2, true, Lateral::principal), 1e-4, 1e-5);
    agreesWithSolves(cell, rayDrive(Vector3d(0.3, -0.5, 0.4)), 1e-4, 1e-5);
  }

  /// F e · spacing = 4 (R - r) along the first axis of a ring net: dL/dp in closed form, to the gap.
  void closedFormOfRingNet() {
    const RatedCell cell(R"({"name": "m", "type": "ring_net"})");
    EquilibriumOptions options;
    options.finalGap = 1e-6;
    const CellSolver solver(cell.build(cell.values), options);
    const StrainDrive drive = uniaxialDrive(0, false, Lateral::principal);
    const auto rest = solver.solve(solver.perturbed(restState(solver.contact().cell()), 0.01, 1), drive);
    const LimitSensitivity own = limitSensitivity(solver, rest.state, drive, cell.rates);
    const double R = 4e-3, r = 0.6e-3, L = 12e-3;
    const VectorXd exact = (VectorXd(3) << 4 / L, -4 / L, -4 * (R - r) / (L * L)).finished();
    QVERIFY2((own.slopes - exact).norm() < 1e-6 * exact.norm(),
             qPrintable(QString::number((own.slopes - exact).norm() / exact.norm())));
  }
};

QTEST_GUILESS_MAIN(TestLimitSensitivity)
#include "test_limit_sensitivity.moc"
