#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/linking_number.hpp"
#include "tests/core/interlock/link_oracles.hpp"

using namespace pliant::interlock;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// A link with the gap between the two pieces at rest [m], both found by an independent program.
struct VerifiedLink {
  Link link;
  double gap;
};

struct Verified {
  UnitCell cell;
  std::vector<VerifiedLink> links;
  double smallestGap;  ///< of all pieces at rest [m]
};

std::vector<Verified> verifiedMaterials() {
  constexpr double ring = 0.6010753401793552e-3, hexagonal = 0.6523611863129388e-3, scale = 0.9557390808393745e-3;
  constexpr double knot = 0.6920350044544984e-3, coil = 1.0455675429387798e-3, rosette = 1.85e-3, net = 0.8e-3;
  return {
      {fourInOne(),
       {{{0, 0, 1, 0, {-1, -1}, 1}, ring},
        {{0, 0, 1, 0, {-1, 0}, 1}, ring},
        {{0, 0, 1, 0, {0, -1}, -1}, ring},
        {{0, 0, 1, 0, {0, 0}, -1}, ring}},
       0.6e-3},
      {threefold(),
       {{{0, 0, 0, 2, {0, 1}, -1}, hexagonal},
        {{0, 2, 0, 1, {1, -1}, -1}, hexagonal},
        {{0, 0, 0, 1, {1, 0}, -1}, hexagonal}},
       hexagonal},
      {torusKnot(), {{{0, 0, 0, 0, {0, 1}, 1}, knot}, {{0, 0, 0, 0, {1, 0}, 1}, knot}}, knot},
      {torusKnot(torusCoilDefault), {{{0, 0, 0, 0, {0, 1}, 1}, coil}, {{0, 0, 0, 0, {1, 0}, 1}, coil}}, coil},
      {scaleMail(),
       {{{0, 1, 0, 4, {0, 1}, -1}, scale}, {{0, 5, 0, 2, {1, -1}, -1}, scale}, {{0, 0, 0, 3, {1, 0}, -1}, scale}},
       (13.2 - 2 * 5.5 - 2 * 0.8) * 1e-3},  // of the plates; the rings' is larger
      {squareRosette(),
       {{{0, 1, 0, 3, {0, 1}, -1}, rosette}, {{0, 0, 0, 2, {1, 0}, -1}, rosette}},
       1.678320285284181e-3},
      {ringNet(),
       {{{0, 0, 1, 0, {-1, 0}, 1}, net},
        {{0, 0, 1, 0, {0, 0}, -1}, net},
        {{0, 0, 2, 0, {0, -1}, 1}, net},
        {{0, 0, 2, 0, {0, 0}, -1}, net}},
       net},
  };
}

/// The curve of a piece, turned as its element.
ClosedCurve curveOf(const UnitCell& cell, int element, int piece) {
  const InterlockingElement& own = cell.elements[element];
  return std::get<ClosedCurve>(cell.shapes[own.shape].pieces[piece].core).rotated(own.rotation);
}

Matrix3d randomRotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

QString problemOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const pliant::base::InputError& error) {
    return QString::fromStdString(error.problem());
  }
  return {};
}

}  // namespace

class TestUnitCell : public QObject {
  Q_OBJECT

 private slots:
  void torusCurveIsItsFormula() {
    const double a = 4.4, b = 2.2, c = 3.5;
    for (const auto& [p, q] : {std::pair{3, 4}, {1, 4}, {4, 3}, {2, 1}, {1, 1}}) {
      const ClosedCurve curve = ClosedCurve::torusCurve(p, q, a, b, c);
      for (double t = 0; t < 6.3; t += 0.37) {
        const double distance = a + b * std::cos(q * t);
        const Vector3d expected(distance * std::cos(p * t), distance * std::sin(p * t), c * std::sin(q * t));
        QVERIFY((curve.placeAt(t) - expected).norm() < 1e-13);
      }
    }
  }

  void derivativesOfACurve() {
    const ClosedCurve curve = ClosedCurve::torusCurve(3, 4, 4.4, 2.2, 3.5);
    constexpr double h = 1e-4;
    for (double t = 0.1; t < 6.2; t += 0.5) {
      const auto point = curve.at(t);
      QVERIFY(((curve.placeAt(t + h) - curve.placeAt(t - h)) / (2 * h) - point.tangent).norm() < 1e-4);
      QVERIFY(((curve.placeAt(t + h) - 2 * point.place + curve.placeAt(t - h)) / (h * h) - point.second).norm() < 1e-3);
      QVERIFY(point.second.norm() <= curve.secondDerivativeBound());
    }
  }

  /// The curve turns by the same angle between breakpoints, hence so often as its total curvature says.
  void breakpointsOfACircleAreEqual() {
    const auto points = ClosedCurve::circle({1, 2, 3}, {1, 1, 0}, 4).breakpoints(2 * std::numbers::pi / 24);
    QCOMPARE(points.size(), std::size_t(25));
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      QVERIFY(std::abs(points[i + 1] - points[i] - 2 * std::numbers::pi / 24) < 1e-9);
  }

  void linkingNumberIsGaussIntegral() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-6, 6);
    int linked = 0, compared = 0;
    for (int k = 0; k < 60; ++k) {
      const ClosedCurve a = ClosedCurve::torusCurve(3, 4, 4.4, 2.2, 3.5).rotated(randomRotation(random));
      const ClosedCurve b = (k % 2 ? ClosedCurve::torusCurve(2, 3, 4, 1.5, 2)
                                   : ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), 4))
                                .rotated(randomRotation(random));
      const Vector3d offset(coordinate(random), coordinate(random), coordinate(random));
      if (sampledDistance(a, b, offset) < 0.3) continue;  // the integral converges slowly
      const double integral = gaussIntegral(a, b, offset, 700);
      const auto number = linkingNumber(
          sampled(a, Matrix3d::Identity(), offset, 400), sampled(b, Matrix3d::Identity(), Vector3d::Zero(), 400));
      QVERIFY(number);
      QVERIFY2(std::abs(integral - *number) < 1e-3, qPrintable(QString("%1 %2").arg(integral).arg(*number)));
      linked += *number != 0;
      ++compared;
    }
    QVERIFY(linked > 10 && compared - linked > 3);
  }

  void materialsAreAsVerified() {
    for (const auto& [cell, links, smallestGap] : verifiedMaterials()) {
      checkCell(cell);
      const CellContact contact(cell);
      const auto found = LinkFinder(contact).linksAt(restState(cell));
      QVERIFY(found);
      std::vector<Link> expected;
      for (const auto& [link, gap] : links) {
        expected.push_back(canonical(link));
        const Vector3d offset = contact.offsetOf(restState(cell), link.a, link.b, link.shift);
        const ClosedCurve a = curveOf(cell, link.a, link.pieceA), b = curveOf(cell, link.b, link.pieceB);
        const auto radius = [&](int element, int piece) {
          return cell.shapes[cell.elements[element].shape].pieces[piece].radius;
        };
        const double radii = radius(link.a, link.pieceA) + radius(link.b, link.pieceB);
        QVERIFY(std::abs(gaussIntegral(a, b, offset, 400) - link.number) < 1e-6);
        QVERIFY(std::abs(sampledDistance(a, b, offset) - radii - gap) < 1e-9);
      }
      std::sort(expected.begin(), expected.end());
      QVERIFY2(*found == expected, cell.name.c_str());
      const double gap = contact.smallestGap(restState(cell), 5e-3);
      QVERIFY2(std::abs(gap - smallestGap) < 2e-9,
               qPrintable(QString("%1: %2").arg(cell.name.c_str()).arg(gap, 0, 'g', 12)));
    }
  }

  /// Chains of rings from segments have linking numbers as well.
  void closedChainsAreLinked() {
    UnitCell cell = fourInOne();
    Eigen::Matrix3Xd corners(3, 48);
    for (int i = 0; i < 48; ++i)
      corners.col(i) =
          ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), 5e-3).placeAt(i * 2 * std::numbers::pi / 48);
    cell.shapes[0].pieces[0] = closedChain(corners, 0.8e-3);
    checkCell(cell);
    // A polygon lies inside its circle, by at most R (1 - cos(π/48)) = 0.0107 mm.
    const double gap = CellContact(cell).smallestGap(restState(cell), 5e-3);
    QVERIFY(gap > 0.6e-3 - 0.03e-3 && gap < 0.6e-3 + 0.03e-3);
  }

  void supercellsAreTheSameMaterial() {
    for (const auto& [cell, links, gap] : verifiedMaterials())
      for (const auto& [first, second] : {std::pair{2, 1}, {1, 3}, {2, 2}}) {
        const UnitCell larger = supercell(cell, first, second);
        QCOMPARE(larger.elements.size(), first * second * cell.elements.size());
        checkCell(larger);
        QVERIFY(std::abs(CellContact(larger).smallestGap(restState(larger), 5e-3) - gap) < 2e-9);
      }
  }

  void faultsAreSentences_data() {
    QTest::addColumn<int>("fault");
    QTest::addColumn<QString>("part");
    int fault = 0;
    for (const char* part : {"has the radius 0", "parallel or zero", "overlap by", "linked 0 times", "not declared",
                             "chain is open at corner", "surface is open between", "no elements", "not finite",
                             "not a rotation", "no pieces", "no length", "has shape 3", "names element 9"})
      QTest::addRow("%s", part) << fault++ << QString(part);
  }

  void faultsAreSentences() {
    QFETCH(int, fault);
    QFETCH(QString, part);
    UnitCell cell = fourInOne();
    DilatedPiece& piece = cell.shapes[0].pieces[0];
    Eigen::Matrix3Xd corners(3, 4);
    corners << 0, 1e-3, 0, 0, 0, 0, 1e-3, 0, 0, 0, 0, 1e-3;
    switch (fault) {
      case 0: piece.radius = 0; break;
      case 1: cell.lattice.col(1) = 2 * cell.lattice.col(0); break;
      case 2: piece.radius = 1.2e-3; break;
      case 3: cell.elements[1].position.z() = 30e-3; break;
      case 4: cell.links.pop_back(); break;
      case 5: {
        piece = closedChain(corners, 1e-4);
        std::get<SimplexSet>(piece.core).segments.pop_back();
        break;
      }
      case 6: piece = dilatedMesh({corners, {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}}, {}, {}}, 1e-4); break;
      case 7: cell.elements.clear(); break;
      case 8: cell.elements[0].position.x() = std::nan(""); break;
      case 9: cell.elements[0].rotation *= 1.1; break;
      case 10: cell.shapes[0].pieces.clear(); break;
      case 11: piece = wire(ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), 0), 1e-3); break;
      case 12: cell.elements[0].shape = 3; break;
      case 13: cell.links[0].b = 9; break;
    }
    const QString problem = problemOf([&] { checkCell(cell); });
    QVERIFY2(problem.contains(part), qPrintable(problem));
    QVERIFY(!problem.contains('\n') && problem.count(". ") == 0);
  }
};

QTEST_GUILESS_MAIN(TestUnitCell)
#include "test_unit_cell.moc"
