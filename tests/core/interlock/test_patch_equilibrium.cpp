#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/patch_search.hpp"
#include "tests/core/interlock/link_oracles.hpp"

using namespace pliant;
using namespace pliant::interlock;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double ring = 5e-3, wireRadius = 0.8e-3, pi = std::numbers::pi;

ElementShape ringShape() {
  return {"ring", {wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), ring), wireRadius)}};
}

/// Rings in a row along a direction (a unit vector), each turned by 90 degrees about it against the one before.
UnitCell chain(int count, const Vector3d& direction) {
  UnitCell cell;
  cell.shapes = {ringShape()};
  const Matrix3d along = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), direction).toRotationMatrix();
  for (int i = 0; i < count; ++i) {
    const Matrix3d turn = Eigen::AngleAxisd(i % 2 * pi / 2, Vector3d::UnitX()).toRotationMatrix();
    cell.elements.push_back({0, i * 6e-3 * direction, along * turn});
  }
  cell.links = LinkFinder(CellContact(cell)).linksAt(restState(cell)).value();
  return cell;
}

PatchOutline circle(double radius) {
  PatchOutline outline;
  outline.radius = radius;
  return outline;
}

/// Sum of the forces of contact on each element, and of their moments about its origin.
void contactForces(const CellEquilibrium& rest, Eigen::Matrix3Xd& forces, Eigen::Matrix3Xd& moments) {
  forces.setZero(3, rest.state.positions.cols());
  moments = forces;
  for (const CellContactForce& contact : rest.contacts)
    for (const auto& [element, sign] : {std::pair{contact.pair.a, 1.0}, std::pair{contact.pair.b, -1.0}}) {
      const Vector3d force = sign * contact.force * contact.normal;
      forces.col(element) += force;
      moments.col(element) += Vector3d(contact.place - rest.state.positions.col(element)).cross(force);
    }
}

/// Objective and derivatives by the unknowns at a state, on the way of PatchSearch.
class SearchProbe : public PatchSearch {
 public:
  using PatchSearch::PatchSearch;
  static constexpr double range = 0.7e-3, weight = 2;

  double energy(const CellState& state) const {
    return contact_.energy(state, contact_.nearParts(state, range), {weight, range}) + objective(state);
  }
  double linearizeHere() {
    pairs_ = contact_.nearParts(state_, range);
    double gap = 0;
    return linearize({weight, range}, gap);
  }
  CellState stepped(const VectorXd& step, const VectorXd& borderStep, double by) const {
    return advanced(state_, velocityOf(step, borderStep), by);
  }
  PatchSystem& system() { return system_; }
  /// qᵀ H q.
  double quadratic(const VectorXd& step, const VectorXd& borderStep) {
    double sum = borderStep.dot(system_.corner * borderStep) + 2 * step.dot(system_.border * borderStep);
    for (int i = 0; i < step.size() / 6; ++i)
      sum += step.segment<6>(6 * i).dot(system_.diagonal(i) * step.segment<6>(6 * i));
    system_.visitPairs([&](int a, int b, const PatchSystem::Matrix6& block) {
      sum += 2 * step.segment<6>(6 * a).dot(block * step.segment<6>(6 * b));
    });
    return sum;
  }
};

/// Along random lines through the state: slope and curvature of the objective by central differences.
void compareWithDifferences(SearchProbe& probe, int elements, int border, bool onParaboloid, double size) {
  const double energy = probe.linearizeHere();
  QVERIFY(std::isfinite(energy) && energy != 0);
  std::mt19937 random(3);
  const auto uniform = [&] { return 2 * (random() / 4294967296.0) - 1; };
  for (int line = 0; line < 12; ++line) {
    VectorXd step(6 * elements), borderStep(border);
    for (double& value : step) value = uniform();
    for (double& value : borderStep) value = uniform();
    if (onParaboloid)
      for (int i = 0; i < elements; ++i) step[6 * i + 2] = 0;
    const double h = size;
    const auto at = [&](double by) { return probe.energy(probe.stepped(step, borderStep, by)); };
    const double slope = probe.system().gradient.dot(step) + probe.system().borderGradient.dot(borderStep);
    // Fourth order.
    const double p1 = at(h), m1 = at(-h), p2 = at(2 * h), m2 = at(-2 * h), mid = at(0);
    const double difference = (8 * (p1 - m1) - (p2 - m2)) / (12 * h);
    QVERIFY2(std::abs(slope - difference) < 1e-6 * (std::abs(slope) + probe.system().gradient.norm()),
             qPrintable(QString("%1 against %2").arg(slope).arg(difference)));
    const double curvature = probe.quadratic(step, borderStep);
    const double second = (16 * (p1 + m1) - (p2 + m2) - 30 * mid) / (12 * h * h);
    QVERIFY2(std::abs(curvature - second) < 1e-4 * (std::abs(curvature) + std::abs(second)),
             qPrintable(QString("%1 against %2").arg(curvature).arg(second)));
  }
}

}  // namespace

class TestPatchEquilibrium : public QObject {
  Q_OBJECT

 private slots:
  /// Hexagonal disks have 7, 19, 37, 61 elements, and as many links as the triangular lattice has edges.
  void patchesHaveTheElementsOfTheirOutline() {
    const double spacing = threefoldDefault.spacing;
    for (const auto& [shells, elements, links] :
         {std::array{1, 7, 12}, std::array{2, 19, 42}, std::array{3, 37, 90}, std::array{4, 61, 156}}) {
      const UnitCell patch = cutPatch(threefold(), circle(shells * spacing));
      QCOMPARE(static_cast<int>(patch.elements.size()), elements);
      QCOMPARE(static_cast<int>(patch.links.size()), links);
      QVERIFY(!patch.isPeriodic());
      QVERIFY(LinkFinder(CellContact(patch)).linksAt(restState(patch)) == patch.links);
    }
    PatchOutline square;
    square.kind = PatchOutline::Kind::rectangle;
    square.size = {40e-3, 40e-3};
    square.centre = {5.5e-3, 5.5e-3};
    const UnitCell patch = cutPatch(torusKnot(), square);
    QCOMPARE(static_cast<int>(patch.elements.size()), 16);
    QCOMPARE(static_cast<int>(patch.links.size()), 24);
    Vector3d mean = Vector3d::Zero();
    for (const InterlockingElement& element : patch.elements) mean += element.position;
    QVERIFY(mean.norm() < 1e-12);
    const Eigen::MatrixXi distances = linkDistances(patch);
    QCOMPARE(distances(0, 15), 6);  // opposite corners of the square
  }

  void massesAreExact() {
    const BodyMass torus = bodyMass(ringShape());
    QVERIFY(std::abs(torus.volume / (2 * pi * pi * ring * wireRadius * wireRadius) - 1) < 1e-12);
    const double r = 1e-3, h = 4e-3;
    const BodyMass rod = bodyMass({"rod", {capsule(Vector3d(1e-3, 0, 0), Vector3d(1e-3, 0, h), r)}});
    QVERIFY(std::abs(rod.volume / (pi * r * r * h + 4.0 / 3 * pi * r * r * r) - 1) < 1e-12);
    QVERIFY((rod.centre - Vector3d(1e-3, 0, 0.5 * h)).norm() < 1e-12);
    // A square plate: the volume near a square of side s is 2 r s² + 2 π r² s + 4/3 π r³ (Steiner).
    const double s = 5e-3;
    Eigen::Matrix3Xd corners(3, 4);
    corners << 0, s, s, 0, 0, 0, s, s, 0, 0, 0, 0;
    const BodyMass plate = bodyMass({"plate", {roundedPolygon(corners, r)}});
    QVERIFY(std::abs(plate.volume / (2 * r * s * s + 2 * pi * r * r * s + 4.0 / 3 * pi * r * r * r) - 1) < 1e-12);
    QVERIFY((plate.centre - Vector3d(0.5 * s, 0.5 * s, 0)).norm() < 1e-12);
  }

  void derivativesUnderLoads() {
    const UnitCell patch = cutPatch(scaleMail(), circle(scaleMail().lattice.col(0).norm()));
    const PatchSolver solver(patch);
    PatchLoads loads;
    loads.forces = weightsOf(patch, 1e9, {0.3, 0.1, -9.81});
    const CellState state = solver.perturbed(restState(patch), 0.3, 5);
    SearchProbe probe(solver, state, loads, nullptr);
    compareWithDifferences(probe, static_cast<int>(patch.elements.size()), 0, false, 1e-8);
  }

  void derivativesOnAParaboloid() {
    const UnitCell patch = cutPatch(scaleMail(), circle(scaleMail().lattice.col(0).norm()));
    const PatchSolver solver(patch);
    StrainDrive bend;  // somewhere inside, so that nothing vanishes
    bend.load = Vector3d(1, 0.4, -0.3);
    bend.farthest = 15;
    CellState state = solver.bend(solver.perturbed(restState(patch), 0.2, 5), bend).state;
    QVERIFY(std::abs(bend.load.dot(state.strain) - 15) < 1e-6);
    StrainDrive drive;
    drive.load = Vector3d(0.7, -0.2, 0.5);
    drive.spring = 0.01;
    drive.target = Vector3d(30, 1, 2);
    SearchProbe probe(solver, state, drive, nullptr);
    compareWithDifferences(probe, static_cast<int>(patch.elements.size()), 3, true, 1e-8);
  }

  /// Held at one end, from straight down or from the side, each link carries what is below it, and the chain is as long
  /// as its rings allow.
  void hangingChain() {
    constexpr int count = 6;
    constexpr double density = 8000;
    const double weight = 2 * pi * pi * ring * wireRadius * wireRadius * density * 9.81;
    for (const Vector3d& direction : {Vector3d(0, 0, -1), Vector3d(0.8, 0, -0.6)}) {
      const UnitCell patch = chain(count, direction);
      EquilibriumOptions options;
      options.finalGap = 1e-5;
      const PatchSolver solver(patch, options);
      PatchLoads loads;
      loads.forces = weightsOf(patch, density, {0, 0, -9.81});
      loads.clamped = {0};
      const CellState start = restState(patch);
      const CellEquilibrium rest = solver.solve(start, loads);
      QVERIFY2(rest.converged() && rest.kind == RestKind::locked, rest.message.c_str());
      QVERIFY(rest.state.positions.col(0) == start.positions.col(0));  // clamped
      QVERIFY(rest.meanGap <= 1e-5 * wireRadius * 1.01);

      // Newton's decrement ends below the barrier's weight, count * weight * gap at most: so much force may be left
      // over in the softest motion, a pendulum's, of stiffness count * weight / length.
      const double exact = 2 * (ring - wireRadius);
      const double balance = count * weight * std::sqrt(options.finalGap * wireRadius / exact);
      Eigen::Matrix3Xd forces, moments;
      contactForces(rest, forces, moments);
      for (int i = 1; i < count; ++i) {
        QVERIFY2((forces.col(i) - Vector3d(0, 0, weight)).norm() < balance, qPrintable(QString::number(i)));
        QVERIFY(moments.col(i).norm() < balance * ring);
        // What ring i - 1 carries of ring i and all below.
        Vector3d carried = Vector3d::Zero();
        for (const CellContactForce& contact : rest.contacts)
          if (contact.pair.a == i - 1 && contact.pair.b == i) carried -= contact.force * contact.normal;
        QVERIFY((carried - Vector3d(0, 0, (count - i) * weight)).norm() < (count - i) * balance);
      }
      // Below the first, whose hole the second hangs in at whatever angle it is held, rings hang straight.
      for (int i = 2; i < count; ++i) {
        const Vector3d link = rest.state.positions.col(i) - rest.state.positions.col(i - 1);
        QVERIFY2(link.norm() < exact && link.norm() > exact * (1 - 1e-5),
                 qPrintable(QString::number(link.norm() / exact, 'g', 9)));
        QVERIFY(link.head<2>().norm() < 2e-3 * exact);
      }
    }
  }

  /// A force on the last ring of a chain pulls it straight, or presses two rings together.
  void pointLoads() {
    const double exact = 2 * (ring - wireRadius);
    for (const int count : {2, 4}) {
      const UnitCell patch = chain(count, Vector3d::UnitX());
      const PatchSolver solver(patch);
      PatchLoads loads;
      loads.clamped = {0};
      loads.forces = {{count - 1, Vector3d(0.5, 0, 0)}};
      const CellEquilibrium rest = solver.solve(solver.perturbed(restState(patch), 0.01, 1), loads);
      QVERIFY2(rest.converged(), rest.message.c_str());
      const double length = (rest.state.positions.col(count - 1) - rest.state.positions.col(0)).norm();
      QVERIFY2(length < (count - 1) * exact && length > (count - 1) * (exact - 1.2e-4 * wireRadius),
               qPrintable(QString::number(length / exact, 'g', 9)));
    }
  }

  /// Pulled at random, far beyond what holds, nothing overlaps and no linking number changes.
  void randomLoadsPassNothing() {
    const UnitCell patch = cutPatch(fourInOne(), circle(10e-3));
    EquilibriumOptions options;
    options.finalGap = 1e-2;
    options.maximumIterations = 150;
    const PatchSolver solver(patch, options);
    std::mt19937 random(11);
    const auto uniform = [&] { return 2 * (random() / 4294967296.0) - 1; };
    const int count = static_cast<int>(patch.elements.size());
    for (int trial = 0; trial < 6; ++trial) {
      PatchLoads loads;
      loads.clamped = {trial % count};
      for (int i = 0; i < count; ++i) loads.forces.push_back({i, 10 * Vector3d(uniform(), uniform(), uniform()), {}});
      for (PointLoad& load : loads.forces) load.arm = ring * Vector3d(uniform(), uniform(), uniform());
      const CellEquilibrium rest = solver.solve(restState(patch), loads);
      QVERIFY2(rest.termination != base::TerminationType::failed, rest.message.c_str());
      QVERIFY(solver.contact().smallestGap(rest.state, wireRadius) > 0);
      QVERIFY(LinkFinder(solver.contact()).linksAt(rest.state) == patch.links);
    }
  }

  void badInput() {
    const auto sentenceOf = [](auto&& action) {
      try {
        action();
      } catch (const base::InputError& error) {
        return QString(error.what());
      }
      return QString();
    };
    QVERIFY(sentenceOf([] { cutPatch(threefold(), circle(0)); }).contains("above 0"));
    QVERIFY(sentenceOf([] { cutPatch(threefold(), circle(1e-3)); }).contains("1 elements, but needs two"));
    QVERIFY(sentenceOf([] { cutPatch(threefold(), circle(10)); }).contains("more than 4000"));
    const UnitCell patch = chain(3, Vector3d::UnitX());
    const PatchSolver solver(patch);
    PatchLoads loads;
    loads.clamped = {3};
    QVERIFY(sentenceOf([&] { solver.solve(restState(patch), loads); }).contains("element 3"));
    // Two rings of ring net, and nothing between them.
    PatchOutline strip;
    strip.kind = PatchOutline::Kind::rectangle;
    strip.size = {30e-3, 1e-3};
    strip.centre = {0, 6e-3};
    QVERIFY(sentenceOf([&] { cutPatch(ringNet(), strip); }).contains("not linked with the others"));
    base::ExecutionContext context;
    context.requestCancel();
    loads.clamped = {0};
    QVERIFY(solver.solve(restState(patch), loads, &context).termination == base::TerminationType::cancelled);
  }
};

QTEST_GUILESS_MAIN(TestPatchEquilibrium)
#include "test_patch_equilibrium.moc"
