#include <Eigen/Geometry>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/geometry/mesh_generators.hpp"

using namespace pliant;
using geometry::SurfaceMesh;

namespace {

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.points.col(b) - mesh.points.col(a)).cross(mesh.points.col(c) - mesh.points.col(a)).z();
  return sum;
}

double smallestAngle(const SurfaceMesh& mesh) {
  double smallest = M_PI;
  for (const auto& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d p = mesh.points.col(triangle[i]);
      const Eigen::Vector3d u = mesh.points.col(triangle[(i + 1) % 3]) - p,
                            v = mesh.points.col(triangle[(i + 2) % 3]) - p;
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
  return smallest;
}

double closestPoints(const SurfaceMesh& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      smallest = std::min(smallest, (mesh.points.col(i) - mesh.points.col(j)).norm());
  return smallest;
}

/// V - E + F, 1 for a disc.
int eulerCharacteristic(const SurfaceMesh& mesh) {
  return static_cast<int>(mesh.points.cols()) - static_cast<int>(geometry::meshEdges(mesh.triangles).size()) +
         static_cast<int>(mesh.triangles.size());
}

}  // namespace

class TestMeshGenerators : public QObject {
  Q_OBJECT

 private slots:
  void gridFillsTheRectangle();
  void stripNamesItsEnds();
  void forkHasTheThesisSize();
  void forksOfOtherShapes_data();
  void forksOfOtherShapes();
  void forkIsSymmetric();
  void badSizesAreRefused();
};

void TestMeshGenerators::gridFillsTheRectangle() {
  const SurfaceMesh mesh = geometry::makeGrid(0.4, 0.3, 4, 3);
  geometry::checkMesh(mesh);
  QCOMPARE(mesh.points.cols(), 20);
  QCOMPARE(mesh.triangles.size(), std::size_t(24));
  QCOMPARE(eulerCharacteristic(mesh), 1);
  QVERIFY(std::abs(area(mesh) - 0.12) <= 1e-15);
  QVERIFY(mesh.points.row(2).isZero(0));
  for (const int node : mesh.groups.at("start")) QCOMPARE(mesh.points(0, node), 0.0);
  for (const int node : mesh.groups.at("end")) QCOMPARE(mesh.points(0, node), 0.4);
  for (const int node : mesh.groups.at("left")) QCOMPARE(mesh.points(1, node), 0.15);
  for (const int node : mesh.groups.at("right")) QCOMPARE(mesh.points(1, node), -0.15);
  QCOMPARE(mesh.groups.at("start").size(), std::size_t(4));
  QCOMPARE(mesh.groups.at("left").size(), std::size_t(5));
}

void TestMeshGenerators::stripNamesItsEnds() {
  const SurfaceMesh mesh = geometry::makeStrip(1, 0.1, 10, 1);
  geometry::checkMesh(mesh);
  QCOMPARE(mesh.triangles.size(), std::size_t(20));
  QCOMPARE(mesh.groups.size(), std::size_t(2));
  QCOMPARE(mesh.groups.at("end").size(), std::size_t(2));
}

void TestMeshGenerators::forkHasTheThesisSize() {
  const SurfaceMesh mesh = geometry::makeFork({.handleLength = 0.13,
                                               .prongLength = 0.14,
                                               .width = 0.02,
                                               .spacing = 0.04,
                                               .handleCells = 13,
                                               .prongCells = 14,
                                               .widthCells = 2});
  geometry::checkMesh(mesh);
  QCOMPARE(mesh.triangles.size(), std::size_t(188));
  QCOMPARE(mesh.points.cols(), 144);
  QVERIFY(smallestAngle(mesh) > 44 * M_PI / 180);
}

void TestMeshGenerators::forksOfOtherShapes_data() {
  QTest::addColumn<double>("spacing");
  QTest::addColumn<int>("widthCells");
  for (const int widthCells : {1, 2, 3, 4})
    for (const double spacing : {0.04, 0.043, 0.05, 0.0771, 0.2})
      QTest::addRow("spacing %g, %d cells wide", spacing, widthCells) << spacing << widthCells;
}

void TestMeshGenerators::forksOfOtherShapes() {
  QFETCH(double, spacing);
  QFETCH(int, widthCells);
  const double width = 0.02, handle = 0.1, prong = 0.12;
  const SurfaceMesh mesh =
      geometry::makeFork({handle, prong, width, spacing, 5 * widthCells, 6 * widthCells, widthCells});
  geometry::checkMesh(mesh);
  QCOMPARE(eulerCharacteristic(mesh), 1);
  const double expected = width * (handle + 2 * prong + spacing + width);
  QVERIFY(std::abs(area(mesh) - expected) <= 1e-12 * expected);
  QVERIFY(closestPoints(mesh) > 0.4 * width / widthCells);
  QVERIFY(smallestAngle(mesh) > 20 * M_PI / 180);
  QCOMPARE(mesh.groups.size(), std::size_t(3));
  for (const char* tip : {"left_tip", "right_tip"}) {
    QCOMPARE(mesh.groups.at(tip).size(), std::size_t(widthCells + 1));
    double middle = 0;
    for (const int node : mesh.groups.at(tip)) {
      QVERIFY(std::abs(mesh.points(0, node) - (handle + width + prong)) <= 1e-15);
      middle += mesh.points(1, node) / (widthCells + 1);
    }
    QVERIFY(std::abs(middle - (tip[0] == 'l' ? 0.5 : -0.5) * spacing) <= 1e-15);
  }
  QCOMPARE(mesh.groups.at("base").size(), std::size_t(widthCells + 1));
  for (const int node : mesh.groups.at("base")) QCOMPARE(mesh.points(0, node), 0.0);
}

void TestMeshGenerators::forkIsSymmetric() {
  const SurfaceMesh mesh = geometry::makeFork({0.13, 0.14, 0.02, 0.045, 13, 14, 2});
  const auto find = [&](const Eigen::Vector3d& place) {
    for (int n = 0; n < mesh.points.cols(); ++n)
      if ((mesh.points.col(n) - place).norm() <= 1e-12) return n;
    return -1;
  };
  std::vector<std::array<int, 3>> triangles, mirrored;
  for (auto triangle : mesh.triangles) {
    std::array<int, 3> image;
    for (int i = 0; i < 3; ++i) image[i] = find(mesh.points.col(triangle[i]).cwiseProduct(Eigen::Vector3d(1, -1, 1)));
    std::sort(triangle.begin(), triangle.end());
    std::sort(image.begin(), image.end());
    triangles.push_back(triangle);
    mirrored.push_back(image);
  }
  std::sort(triangles.begin(), triangles.end());
  std::sort(mirrored.begin(), mirrored.end());
  QVERIFY(triangles == mirrored);
}

void TestMeshGenerators::badSizesAreRefused() {
  QVERIFY_EXCEPTION_THROWN(geometry::makeGrid(-1, 1, 2, 2), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::makeGrid(1, std::nan(""), 2, 2), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::makeGrid(1, 1, 0, 2), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::makeGrid(1, 1, 2000000000, 2000000000), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::makeStrip(1, 0, 1, 1), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::makeFork({0.1, 0.1, 0.02, 0.02, 4, 4, 2}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::makeFork({0.1, 0.1, 0.02, 1e300, 4, 4, 2}), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::makeFork({0.1, 0.1, 0.02, 0.04, 4, -4, 2}), base::InputError);
}

QTEST_GUILESS_MAIN(TestMeshGenerators)
#include "test_mesh_generators.moc"
