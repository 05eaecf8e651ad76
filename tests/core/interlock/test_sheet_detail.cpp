#include <Eigen/Geometry>
#include <QTest>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/hexagon_mesh.hpp"
#include "core/geometry/outline_mesh.hpp"
#include "core/interlock/detail_check.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/sheet_detail.hpp"

using namespace pliant;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using interlock::checkDetail;
using interlock::DetailCheck;
using interlock::SheetDetail;
using interlock::SheetDetailer;
using interlock::SheetShape;
using interlock::UnitCell;

namespace {

/// Rolled onto a cylinder of this curvature about y, after a stretch along x.
Vector3d rolled(const Vector3d& point, double curvature, double stretch = 1) {
  const double x = stretch * point.x();
  if (curvature == 0) return {x, point.y(), 0};
  return {std::sin(curvature * x) / curvature, point.y(), -(1 - std::cos(curvature * x)) / curvature};
}

Matrix3Xd rolled(const Matrix3Xd& points, double curvature, double stretch = 1) {
  Matrix3Xd result(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) result.col(i) = rolled(Vector3d(points.col(i)), curvature, stretch);
  return result;
}

std::vector<Matrix3Xd> pathTo(const geometry::SurfaceMesh& sheet, double curvature, double stretch) {
  constexpr int steps = 10;
  std::vector<Matrix3Xd> path;
  for (int i = 0; i <= steps; ++i)
    path.push_back(rolled(sheet.points, curvature * i / steps, 1 + (stretch - 1) * i / steps));
  return path;
}

}  // namespace

class TestSheetDetail : public QObject {
  Q_OBJECT

 private slots:
  void shapeConvergesWithItsSecondOrder();
  void shapeTellsWhichPlacesAreInIt();
  void flatSheetLeavesElementsAtRest();
  void elementsFollowWithoutMeetingOrParting_data();
  void elementsFollowWithoutMeetingOrParting();
  void sheetBeyondAllLimitsIsNotFollowedThroughElements();
  void checkSeesLostLinksAndOverlaps();
  void badInputIsRefused();
};

/// On a cylinder, with an irregular mesh, away from the rim.
void TestSheetDetail::shapeConvergesWithItsSecondOrder() {
  const double curvature = 20, half = 0.05;
  Eigen::Matrix2Xd square(2, 4);
  square << -half, half, half, -half, -half, -half, half, half;
  std::vector<double> places, turns;
  for (const double size : {0.016, 0.008, 0.004}) {
    const SheetShape shape(geometry::meshOutline({square}, size));
    const Matrix3Xd positions = rolled(shape.mesh().points, curvature);
    const auto maps = shape.nodeMaps(positions);
    double place = 0, turn = 0;
    for (double x = -0.02; x <= 0.02; x += 0.0037)
      for (double y = -0.02; y <= 0.02; y += 0.0041) {
        const auto frame = shape.frameAt(*shape.placeOf({x, y}), positions, maps);
        place = std::max(place, (frame.position - rolled(Vector3d(x, y, 0), curvature)).norm());
        const Eigen::Matrix3d exact = Eigen::AngleAxisd(curvature * x, Vector3d::UnitY()).toRotationMatrix();
        turn = std::max(turn, (frame.rotation - exact).norm());
      }
    places.push_back(place);
    turns.push_back(turn);
  }
  qInfo("errors of places %.1e, %.1e, %.1e m, of turns %.1e, %.1e, %.1e", places[0], places[1], places[2], turns[0],
        turns[1], turns[2]);
  // On irregular meshes the nodes' maps are of first order, and places of second.
  QVERIFY(places[2] < places[0] / 12);
  QVERIFY(turns[2] < turns[0] / 3);
  // Flat triangles are off by their sagitta, size² curvature / 8.
  QVERIFY(places[2] < 0.5 * 0.004 * 0.004 * curvature / 8);
}

void TestSheetDetail::shapeTellsWhichPlacesAreInIt() {
  Eigen::Matrix2Xd outer(2, 4), hole(2, 4);
  outer << -1, 1, 1, -1, -1, -1, 1, 1;
  hole = 0.3 * outer;
  const SheetShape shape(geometry::meshOutline({outer, hole}, 0.2));
  for (double x = -1.2; x < 1.2; x += 0.117)
    for (double y = -1.2; y < 1.2; y += 0.093) {
      const double farthest = std::max(std::abs(x), std::abs(y));
      const auto place = shape.placeOf({x, y});
      QCOMPARE(place.has_value(), farthest > 0.3 && farthest < 1);
      if (!place) continue;
      const auto& corners = shape.mesh().triangles[static_cast<std::size_t>(place->triangle)];
      Vector3d sum = Vector3d::Zero();
      for (int i = 0; i < 3; ++i)
        sum += place->shares[i] * shape.mesh().points.col(corners[static_cast<std::size_t>(i)]);
      QVERIFY((sum - Vector3d(x, y, 0)).norm() < 1e-12);
    }
}

void TestSheetDetail::flatSheetLeavesElementsAtRest() {
  const UnitCell cell = interlock::threefold();
  const geometry::SurfaceMesh sheet = geometry::makeDisk(0.04, 4);
  const Vector2d centre(2e-3, -1e-3);
  const SheetDetailer detailer(cell, sheet, 0.4, centre);
  base::ExecutionContext context;
  const SheetDetail detail = detailer.follow({sheet.points}, context);
  QVERIFY2(detail.termination == base::TerminationType::converged, detail.message.c_str());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Vector3d::UnitZ()).toRotationMatrix();
  for (std::size_t i = 0; i < detail.elements.size(); ++i) {
    Vector3d rest = placeOf(cell, restState(cell), detail.elements[i]);
    rest.head<2>() -= centre;
    QVERIFY((detail.state.positions.col(static_cast<Eigen::Index>(i)) - turn * rest).norm() < 1e-9);
    QVERIFY((turn * rest).norm() <= 0.04 + 1e-9);
  }
}

void TestSheetDetail::elementsFollowWithoutMeetingOrParting_data() {
  QTest::addColumn<std::string>("material");
  QTest::addColumn<double>("curvature");
  QTest::addColumn<double>("stretch");
  QTest::newRow("threefold, bent") << std::string("threefold") << 20.0 << 1.0;
  QTest::newRow("threefold, stretched and bent") << std::string("threefold") << 15.0 << 1.06;
  QTest::newRow("threefold, compressed and bent") << std::string("threefold") << 15.0 << 0.8;
  QTest::newRow("chain mail, stretched and bent") << std::string("4-in-1") << 20.0 << 1.08;
  QTest::newRow("scale mail, bent") << std::string("scale mail") << 10.0 << 1.0;
}

void TestSheetDetail::elementsFollowWithoutMeetingOrParting() {
  QFETCH(std::string, material);
  QFETCH(double, curvature);
  QFETCH(double, stretch);
  const UnitCell cell = material == "threefold" ? interlock::threefold()
                        : material == "4-in-1"  ? interlock::fourInOne()
                                                : interlock::scaleMail();
  const geometry::SurfaceMesh sheet = geometry::makeDisk(0.03, 8);
  const SheetDetailer detailer(cell, sheet, 0.3, {0, 0});
  base::ExecutionContext context;
  const SheetDetail detail = detailer.follow(pathTo(sheet, curvature, stretch), context);
  QVERIFY2(detail.termination == base::TerminationType::converged, detail.message.c_str());
  const DetailCheck check = checkDetail(cell, detail.elements, detail.state, 1e-3);
  qInfo("%zu elements, %d steps, %d sweeps, gap %.3g mm, at least %.3g mm, pull %.3g mm", detail.elements.size(),
        detail.steps, detail.sweeps, 1e3 * detail.smallestGap, 1e3 * check.smallestDistance,
        1e3 * detail.pulls.maxCoeff());
  QVERIFY(check.links > static_cast<long>(detail.elements.size()));
  QVERIFY(check.holds());
  QVERIFY(check.smallestDistance <= detail.smallestGap + 1e-12 || detail.smallestGap > 0.2 * cell.smallestRadius());
  QVERIFY(detail.pulls.maxCoeff() < 0.5 * cell.smallestRadius());
}

/// Half as long again is farther than rings reach: elements stay behind, and are linked all the same.
void TestSheetDetail::sheetBeyondAllLimitsIsNotFollowedThroughElements() {
  const UnitCell cell = interlock::threefold();
  const geometry::SurfaceMesh sheet = geometry::makeDisk(0.025, 8);
  interlock::DetailOptions options;
  options.finalSweeps = 10;
  const SheetDetailer detailer(cell, sheet, 0, {0, 0}, options);
  base::ExecutionContext context;
  const SheetDetail detail = detailer.follow(pathTo(sheet, 0, 1.4), context);
  QVERIFY(checkDetail(cell, detail.elements, detail.state, 1e-3).holds());
  QVERIFY(detail.reached < 1 || detail.pulls.maxCoeff() > cell.smallestRadius());
}

void TestSheetDetail::checkSeesLostLinksAndOverlaps() {
  const UnitCell cell = interlock::fourInOne();
  const geometry::SurfaceMesh sheet = geometry::makeDisk(0.03, 4);
  const SheetDetailer detailer(cell, sheet, 0, {0, 0});
  base::ExecutionContext context;
  const SheetDetail rest = detailer.follow({sheet.points}, context);
  QVERIFY(checkDetail(cell, rest.elements, rest.state, 1e-3).holds());
  // The gap between the surfaces of two rings, by a search over both circles.
  const DetailCheck before = checkDetail(cell, rest.elements, rest.state, 1e-2);
  QVERIFY(std::abs(before.smallestDistance - clearance(cell, restState(cell))) < 1e-6);
  interlock::CellState away = rest.state;
  away.positions.col(0) += Vector3d(0, 0, 0.05);
  const DetailCheck lost = checkDetail(cell, rest.elements, away, 1e-3);
  QVERIFY(lost.lostLinks >= 1 && lost.newLinks == 0 && !lost.holds());
  interlock::CellState pushed = rest.state;
  pushed.positions.col(0) += Vector3d(0, 0, before.smallestDistance + 2.5e-3);
  QVERIFY(!checkDetail(cell, rest.elements, pushed, 1e-3).holds());
}

void TestSheetDetail::badInputIsRefused() {
  const geometry::SurfaceMesh sheet = geometry::makeDisk(0.04, 4);
  QVERIFY_THROWS_EXCEPTION(
      base::InputError, SheetDetailer(interlock::threefold(), geometry::makeDisk(1e-4, 2), 0, {5e-3, 0}));
  const SheetDetailer detailer(interlock::threefold(), sheet, 0, {0, 0});
  base::ExecutionContext context;
  QVERIFY_THROWS_EXCEPTION(base::InputError, detailer.follow({}, context));
  QVERIFY_THROWS_EXCEPTION(base::InputError, detailer.follow({Matrix3Xd::Zero(3, 2)}, context));
}

QTEST_APPLESS_MAIN(TestSheetDetail)
#include "test_sheet_detail.moc"
