#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/interlock/cell_inspection.hpp"
#include "core/interlock/element_families.hpp"

using namespace pliant::interlock;
using Eigen::Vector3d;

namespace {

std::string fault(const UnitCell& cell) { return inspectCell(cell).fault; }

bool accepts(const UnitCell& cell) {
  try {
    checkCell(cell);
    return true;
  } catch (const pliant::base::InputError&) {
    return false;
  }
}

}  // namespace

class TestCellInspection : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void theMaterialsAreSound() {
    const std::vector<std::pair<UnitCell, int>> cells = {{fourInOne(), 4},
                                                         {threefold(), 3},
                                                         {squareRosette(), 2},
                                                         {torusKnot(), 2},
                                                         {scaleMail(), 3},
                                                         {ringNet(), 4},
                                                         {torusKnot(torusCoilDefault), 2}};
    for (const auto& [cell, links] : cells) {
      const CellInspection found = inspectCell(cell, 20);
      QCOMPARE(found.fault, std::string());
      QCOMPARE(found.declaredLinks, links);
      QVERIFY(found.changedLinks.empty());
      QVERIFY(found.nearest && found.nearest->gap > 0 && !found.overlaps());
    }
  }

  /// Flat rings and upright ones cross at right angles at places that are known: the upright ring's wire passes the
  /// middle of the flat ring's at the distance spacing / 2 - 2 rings.
  void gapAndPlaceOfARingNetAreThoseOfItsGeometry() {
    for (const double spacing : {12e-3, 13e-3, 14e-3}) {
      RingNet net;
      net.spacing = spacing;
      const CellInspection found = inspectCell(ringNet(net), 20);
      // Along the line through both centres: the flat ring's wire at R, the upright one's at L/2 - R.
      const double gap = std::abs(0.5 * spacing - net.ring - net.ring) - 2 * net.wire;
      QVERIFY(found.nearest);
      QVERIFY(std::abs(found.nearest->gap - gap) < 1e-9);
      const double middle = 0.25 * spacing;  // of R and L/2 - R
      const Eigen::Vector2d place = found.nearest->place.head<2>().cwiseAbs();
      QVERIFY(std::abs(found.nearest->place.z()) < 1e-6);
      QVERIFY(std::abs(place.maxCoeff() - middle) < 1e-6 ||
              std::abs(place.maxCoeff() - (0.5 * spacing + middle)) < 1e-6);
    }
  }

  void overlapIsNamedWithItsSize() {
    RingNet net;
    net.spacing = 15e-3;  // 2 R - L/2 = 0.5 mm between wires of 1.2 mm in thickness
    const CellInspection found = inspectCell(ringNet(net));
    QVERIFY(found.overlaps());
    QVERIFY(std::abs(found.nearest->gap + 0.7e-3) < 1e-9);
    QVERIFY(std::abs(found.nearest->place.head<2>().cwiseAbs().maxCoeff() - 3.75e-3) < 1e-6);
    QCOMPARE(
        found.fault, std::string("Element 1 and element 2 of the neighbouring cell at (-1, 0) overlap by 0.7 mm."));
    QVERIFY(!accepts(ringNet(net)));
  }

  void linksThatAreLostAreSaid() {
    RingNet net;
    net.spacing = 20e-3;
    const CellInspection found = inspectCell(ringNet(net));
    QCOMPARE(found.changedLinks.size(), std::size_t(4));
    for (const ChangedLink& changed : found.changedLinks) QCOMPARE(changed.found, 0);
    QCOMPARE(found.fault,
             std::string("Element 1 and element 2 of the neighbouring cell at (-1, 0) are not linked, but should be; 3 "
                         "other links have changed as well."));
    TorusKnot knot;
    knot.q = 6;
    QVERIFY(!fault(torusKnot(knot)).empty());
  }

  void otherFaultsAreSaidAndNothingIsThrown() {
    RingNet net;
    net.wire = 0;
    QVERIFY(fault(ringNet(net)).find("radius") != std::string::npos);
    UnitCell flat = ringNet();
    flat.lattice.col(1) = flat.lattice.col(0);
    QVERIFY(fault(flat).find("parallel") != std::string::npos);
  }

  /// As one parameter goes from nothing to twice its value, there is a fault where checkCell refuses, and only there.
  void itFindsFaultWhereTheCheckDoes() {
    int refused = 0;
    for (int i = 1; i <= 40; ++i) {
      FourInOne mail;
      mail.width *= i / 20.0;
      Rosette rosette = threefoldDefault;
      rosette.lean *= i / 20.0;
      RingNet net;
      net.wire *= i / 4.0;
      for (const UnitCell& cell : {fourInOne(mail), threefold(rosette), ringNet(net)}) {
        QCOMPARE(inspectCell(cell).fault.empty(), accepts(cell));
        refused += !accepts(cell);
      }
    }
    QVERIFY(refused > 20 && refused < 110);
  }
};

QTEST_GUILESS_MAIN(TestCellInspection)
#include "test_cell_inspection.moc"
