#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/geometry/tet_mesh.hpp"

using namespace pliant;
using geometry::Block;
using geometry::TetMesh;

namespace {

/// A bar with a crossbar on top: 2 x 1 x 3 cells and 4 x 1 x 1 cells of the size 1 x 2 x 0.5.
const std::vector<Block> letterT = {{"stem", {1, 0, 0}, {3, 2, 1.5}}, {"bar", {0, 0, 1.5}, {4, 2, 2}}};
const Eigen::Vector3d cell(1, 2, 0.5);

double enclosedVolume(const TetMesh& mesh) {
  double sum = 0;  // divergence theorem
  for (const auto& [a, b, c] : geometry::boundaryTriangles(mesh.tetrahedra))
    sum += mesh.points.col(a).dot(mesh.points.col(b).cross(mesh.points.col(c))) / 6;
  return sum;
}

TetMesh oneTetrahedron() {
  TetMesh mesh;
  mesh.points = Eigen::Matrix3Xd::Zero(3, 4);
  mesh.points.rightCols(3).setIdentity();
  mesh.tetrahedra = {{0, 1, 2, 3}};
  return mesh;
}

std::string sentenceOf(const TetMesh& mesh) {
  try {
    geometry::checkTetMesh(mesh);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

class TestTetMesh : public QObject {
  Q_OBJECT

 private slots:
  void blocksFillTheirBoxes();
  void blocksAreSymmetric();
  void groupsNameSides();
  void badBlocksAreRefused();
  void wrongOrientationIsRepaired();
  void badMeshesAreNamed();
};

void TestTetMesh::blocksFillTheirBoxes() {
  const TetMesh mesh = geometry::makeBlocks(letterT, cell);
  geometry::checkTetMesh(mesh);
  QCOMPARE(mesh.tetrahedra.size(), 5u * (6 + 4));
  QCOMPARE(mesh.points.cols(), 2 * (3 * 4 + 5 * 2 - 3));  // the stem's top is the bar's underside
  QVERIFY(std::abs(geometry::volumeOf(mesh) - 10) <= 1e-14 * 10);
  QVERIFY(std::abs(enclosedVolume(mesh) - 10) <= 1e-13 * 10);
  // Conforming: the boundary is closed, every edge between two triangles that agree about the outside.
  geometry::SurfaceMesh surface;
  surface.points = mesh.points;
  surface.triangles = geometry::boundaryTriangles(mesh.tetrahedra);
  geometry::checkMesh(surface);
  for (const auto& edge : geometry::meshEdges(surface.triangles)) QVERIFY(edge.triangles[1] >= 0);
  double area = 0;
  for (const auto& [a, b, c] : surface.triangles)
    area += 0.5 *
            (surface.points.col(b) - surface.points.col(a)).cross(surface.points.col(c) - surface.points.col(a)).norm();
  QVERIFY(std::abs(area - (2 * (3 + 2) + 2 * (2 + 2 * 1.5 + 2 + 2 * 0.5 + 4))) <= 1e-12);
}

void TestTetMesh::blocksAreSymmetric() {
  const TetMesh mesh = geometry::makeBlocks({{"", {-2, -2, -2}, {2, 2, 2}}}, {1, 1, 1});
  // Each tetrahedron's mirror image in x = 0 is one of the mesh.
  std::set<std::set<int>> all;
  for (const auto& t : mesh.tetrahedra) all.insert({t.begin(), t.end()});
  std::vector<int> image(static_cast<std::size_t>(mesh.points.cols()));
  for (Eigen::Index n = 0; n < mesh.points.cols(); ++n) {
    Eigen::Index best = 0;
    (mesh.points.colwise() - Eigen::Vector3d(-mesh.points(0, n), mesh.points(1, n), mesh.points(2, n)))
        .colwise()
        .squaredNorm()
        .minCoeff(&best);
    image[static_cast<std::size_t>(n)] = static_cast<int>(best);
  }
  for (const auto& t : all) {
    std::set<int> mirrored;
    for (const int node : t) mirrored.insert(image[static_cast<std::size_t>(node)]);
    QVERIFY(all.contains(mirrored));
  }
}

void TestTetMesh::groupsNameSides() {
  const TetMesh mesh = geometry::makeBlocks(letterT, cell);
  QCOMPARE(mesh.groups.at("stem").size(), 3u * 2 * 4);
  QCOMPARE(mesh.groups.at("bar").size(), 5u * 2 * 2);
  QCOMPARE(mesh.groups.at("stem.z_min").size(), 6u);
  for (const int node : mesh.groups.at("stem.z_min")) QCOMPARE(mesh.points(2, node), 0.0);
  for (const int node : mesh.groups.at("bar.x_max")) QCOMPARE(mesh.points(0, node), 4.0);
  for (const int node : mesh.groups.at("bar.y_min")) QCOMPARE(mesh.points(1, node), 0.0);
}

void TestTetMesh::badBlocksAreRefused() {
  const auto refused = [](const std::vector<Block>& blocks, const Eigen::Vector3d& size) {
    QVERIFY_EXCEPTION_THROWN(geometry::makeBlocks(blocks, size), base::InputError);
  };
  refused({}, cell);
  refused({{"", {0, 0, 0}, {1, 2, 0.6}}}, cell);                                // no whole number of cells
  refused({{"", {0, 0, 0}, {1, 2, 0}}}, cell);                                  // flat
  refused({{"", {0, 0, 0}, {1, 2, -0.5}}}, cell);                               // turned over
  refused({{"", {0, 0, 0}, {1, 2, 1}}, {"", {0.5, 0, 1}, {1.5, 2, 2}}}, cell);  // off the lattice
  refused({{"a", {0, 0, 0}, {1, 2, 1}}, {"a", {1, 0, 0}, {2, 2, 1}}}, cell);    // a name twice
  refused({{"", {0, 0, 0}, {1, 2, 1}}}, {1, 0, 1});
  refused({{"", {0, 0, 0}, {1, 2, std::nan("")}}}, cell);
  refused({{"", {0, 0, 0}, {1000, 1000, 1000}}}, {1, 1, 1});  // too many
}

void TestTetMesh::wrongOrientationIsRepaired() {
  TetMesh mesh = geometry::makeBlocks(letterT, cell);
  std::swap(mesh.tetrahedra[7][0], mesh.tetrahedra[7][2]);
  QVERIFY(geometry::volumeOf(mesh) < 9.999);
  mesh.tetrahedra = geometry::orientTetrahedra(mesh);
  QVERIFY(std::abs(geometry::volumeOf(mesh) - 10) <= 1e-13);
}

void TestTetMesh::badMeshesAreNamed() {
  QVERIFY(sentenceOf(oneTetrahedron()).empty());
  QVERIFY(sentenceOf({}).find("no tetrahedra") != std::string::npos);
  TetMesh mesh = oneTetrahedron();
  mesh.points(1, 2) = std::numeric_limits<double>::quiet_NaN();
  QVERIFY(sentenceOf(mesh).find("point 2") != std::string::npos);
  mesh = oneTetrahedron();
  mesh.points.col(3) = mesh.points.col(1) + mesh.points.col(2);
  QVERIFY(sentenceOf(mesh).find("tetrahedron 0 has no volume") != std::string::npos);
  mesh = oneTetrahedron();
  mesh.tetrahedra[0][3] = 4;
  QVERIFY(sentenceOf(mesh).find("tetrahedron 0 names point 4") != std::string::npos);
  mesh = oneTetrahedron();
  mesh.tetrahedra.push_back({1, 0, 3, 2});
  QVERIFY(sentenceOf(mesh).find("tetrahedron 1 has the same corners") != std::string::npos);
  mesh = oneTetrahedron();
  mesh.points.conservativeResize(3, 6);
  mesh.points.rightCols(2) << 1, 2, 1, 1, 1, 3;
  mesh.tetrahedra.push_back({1, 2, 3, 4});
  QVERIFY(sentenceOf(mesh).empty());
  mesh.tetrahedra.push_back({1, 2, 3, 5});
  QVERIFY(sentenceOf(mesh).find("tetrahedron 2 shares a face") != std::string::npos);
}

QTEST_GUILESS_MAIN(TestTetMesh)
#include "test_tet_mesh.moc"
