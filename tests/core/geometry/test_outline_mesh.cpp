#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/error.hpp"
#include "core/geometry/outline_mesh.hpp"

using namespace pliant;
using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

Matrix2Xd rectangle(double width, double height) {
  return 0.5 * (Matrix2Xd(2, 4) << -width, width, width, -width, -height, -height, height, height).finished();
}

double smallestAngle(const geometry::SurfaceMesh& mesh) {
  double smallest = std::numbers::pi;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d a = mesh.points.col(triangle[i]), b = mesh.points.col(triangle[(i + 1) % 3]),
                     c = mesh.points.col(triangle[(i + 2) % 3]);
      smallest = std::min(smallest, std::acos((b - a).normalized().dot((c - a).normalized())));
    }
  return smallest;
}

}  // namespace

class TestOutlineMesh : public QObject {
  Q_OBJECT

 private slots:
  void trianglesFillTheOutline() {
    const std::vector<Matrix2Xd> polygons = {rectangle(0.3, 0.2), rectangle(0.05, 0.03)};
    const double size = 0.01;
    const geometry::SurfaceMesh mesh = geometry::meshOutline(polygons, size);
    geometry::checkMesh(mesh);
    double area = 0, longest = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vector3d ab = mesh.points.col(b) - mesh.points.col(a), ac = mesh.points.col(c) - mesh.points.col(a);
      const double own = 0.5 * ab.cross(ac).z();
      QVERIFY(own > 0);
      area += own;
      longest = std::max({longest, ab.norm(), ac.norm(), (ab - ac).norm()});
    }
    QVERIFY(std::abs(area - (0.3 * 0.2 - 0.05 * 0.03)) < 1e-12);
    QVERIFY(longest <= size * (1 + 1e-9));
    QVERIFY(smallestAngle(mesh) > 20 * std::numbers::pi / 180);
    // A plane piece with one hole: points - edges + triangles = 0.
    const auto edges = static_cast<long>(geometry::meshEdges(mesh.triangles).size());
    QCOMPARE(mesh.points.cols() - edges + static_cast<long>(mesh.triangles.size()), 0L);
  }

  void orderOfCornersDoesNotMatter() {
    const Matrix2Xd forth = rectangle(0.3, 0.2), back = forth.rowwise().reverse();
    QCOMPARE(geometry::polygonArea(forth), -geometry::polygonArea(back));
    const geometry::SurfaceMesh mesh = geometry::meshOutline({back}, 0.05);
    for (const auto& [a, b, c] : mesh.triangles)
      QVERIFY(Vector3d(mesh.points.col(b) - mesh.points.col(a))
                  .cross(Vector3d(mesh.points.col(c) - mesh.points.col(a)))
                  .z() > 0);
  }

  void outlinesThatEncloseNothingAreRefused_data() {
    QTest::addColumn<int>("kind");
    for (const char* name : {"none", "two corners", "crosses itself", "hole outside", "hole across", "no size", "tiny"})
      QTest::newRow(name) << static_cast<int>(std::string(name).size());
  }
  void outlinesThatEncloseNothingAreRefused() {
    const std::string kind = QTest::currentDataTag();
    std::vector<Matrix2Xd> polygons = {rectangle(1, 1)};
    double size = 0.1;
    if (kind == "none") polygons.clear();
    if (kind == "two corners") polygons = {rectangle(1, 1).leftCols<2>()};
    if (kind == "crosses itself") polygons[0] << 0, 1, 0, 1.5, 0, 1, 1, 0;
    if (kind == "hole outside") polygons.push_back(rectangle(0.2, 0.2).colwise() + Vector2d(2, 0));
    if (kind == "hole across") polygons.push_back(rectangle(0.2, 0.2).colwise() + Vector2d(0.5, 0));
    if (kind == "no size") size = 0;
    if (kind == "tiny") size = 1e-5;
    QVERIFY_THROWS_EXCEPTION(base::InputError, geometry::meshOutline(polygons, size));
  }
};

QTEST_APPLESS_MAIN(TestOutlineMesh)
#include "test_outline_mesh.moc"
