#include <QTest>
#include <cmath>
#include <random>

#include "core/geometry/mesh_generators.hpp"
#include "tests/core/geometry/brute_force_intersections.hpp"
#include "tests/core/mechanics/contact_cloth.hpp"

using namespace pliant;
using namespace pliant::mechanics;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

namespace {

constexpr ContactOptions options{.range = 5e-3, .stiffness = 20};
const Vector3d gravity(0, 0, -9.81);

/// Sheet and bodies as one geometry. Nodes of the sheet have the body 0, those of the i-th other mesh i.
struct Scene {
  ContactGeometry geometry;
  Matrix3Xd x;

  void add(const geometry::SurfaceMesh& mesh, double radius = 0) {
    const int first = geometry.nodeCount(), body = first == 0 ? 0 : geometry.bodies.back() + 1;
    addNodes(mesh.points, body, radius);
    for (auto triangle : mesh.triangles) {
      for (int& node : triangle) node += first;
      geometry.triangles.push_back(triangle);
    }
  }

  void addNodes(const Matrix3Xd& points, int body, double radius) {
    x.conservativeResize(3, x.cols() + points.cols());
    x.rightCols(points.cols()) = points;
    geometry.bodies.resize(x.cols(), body);
    geometry.radii.resize(x.cols(), radius);
  }
};

geometry::SurfaceMesh makeSheet(double length, double width, int cells, int cellsAcross) {
  geometry::SurfaceMesh sheet = geometry::makeGrid(length, width, cells, cellsAcross);
  sheet.points.row(0).array() -= length / 2;
  std::mt19937 random(1);  // else its motion would be symmetric
  std::uniform_real_distribution<double> jitter(-0.1 * length / cells, 0.1 * length / cells);
  for (int i = 0; i < sheet.points.cols(); ++i) sheet.points.col(i) += Vector3d(jitter(random), jitter(random), 0);
  return sheet;
}

/// A sphere of triangles: an octahedron whose faces are cut in n² and moved out.
geometry::SurfaceMesh makeBall(double radius, const Vector3d& centre, int n) {
  geometry::SurfaceMesh soup;
  std::vector<Vector3d> points;
  for (const int sx : {-1, 1})
    for (const int sy : {-1, 1})
      for (const int sz : {-1, 1}) {
        const auto point = [&](int i, int j) -> Vector3d {
          return centre + radius * Vector3d(sx * i, sy * j, sz * (n - i - j)).normalized();
        };
        const auto triangle = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
          const int first = static_cast<int>(points.size());
          points.insert(points.end(), {a, b, c});
          soup.triangles.push_back({first, first + 1, first + 2});
        };
        for (int i = 0; i < n; ++i)
          for (int j = 0; i + j < n; ++j) {
            triangle(point(i, j), point(i + 1, j), point(i, j + 1));
            if (i + j < n - 1) triangle(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
          }
      }
  soup.points.resize(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) soup.points.col(i) = points[i];
  return geometry::weldMesh(soup, 1e-6 * radius);
}

/// How many edges cross triangles, other than those of one body among themselves.
int countCrossings(const Scene& scene, const Matrix3Xd& x) {
  return countIntersectionsByBruteForce(x, scene.geometry.triangles);
}

}  // namespace

class TestContactCloth : public QObject {
  Q_OBJECT

 private slots:
  void fallsOnABall();
  void ballOfTrianglesMovesThrough();
  void foldsOntoItself();
  void withoutContactItWouldIntersect();
};

void TestContactCloth::fallsOnABall() {
  // The ball is one node with a radius; exact: no node may come nearer to its centre than the radius.
  const geometry::SurfaceMesh sheet = makeSheet(0.3, 0.3, 12, 12);
  Scene scene;
  scene.add(sheet);
  Matrix3Xd centre(3, 1);
  centre << 0.01, 0.02, -0.07;
  scene.addNodes(centre, 1, 0.06);
  scene.geometry.points = {static_cast<int>(scene.x.cols()) - 1};
  ClothExample cloth(sheet, scene.x, {scene.geometry, scene.x, options});
  cloth.contact.requireFree(scene.x);
  int checks = 0;
  const auto check = [&] {
    QCOMPARE(countCrossings(scene, cloth.x), 0);
    QVERIFY(cloth.contact.smallestGap(cloth.x) > 0);
    for (const auto& [a, b, c] : sheet.triangles)
      for (double s = 0; s <= 1; s += 0.25)
        for (double t = 0; s + t <= 1; t += 0.25)
          QVERIFY((cloth.x.col(a) * (1 - s - t) + cloth.x.col(b) * s + cloth.x.col(c) * t - centre.col(0)).norm() >
                  0.06);
    ++checks;
  };
  for (int i = 0; i < 30 && !QTest::currentTestFailed(); ++i)
    cloth.step(gravity, Matrix3Xd::Zero(3, cloth.x.cols()), check);
  QVERIFY(checks > 60);
  QVERIFY(cloth.newtonDecrement < 1e-6);
  // It hangs down around the ball: below its centre, which a free fall of 0.3 s has passed by far.
  QVERIFY(cloth.x.row(2).head(169).minCoeff() < -0.1);
  QVERIFY(cloth.x.row(2).head(169).maxCoeff() > -0.011);
}

void TestContactCloth::ballOfTrianglesMovesThrough() {
  // A ball of triangles is pushed through a sheet at rest, half its radius a step.
  const geometry::SurfaceMesh sheet = makeSheet(0.3, 0.3, 8, 8);
  Scene scene;
  scene.add(sheet);
  scene.add(makeBall(0.06, {0.01, 0.02, -0.1}, 3));
  ClothExample cloth(sheet, scene.x, {scene.geometry, scene.x, options});
  cloth.contact.requireFree(scene.x);
  const auto check = [&] {
    QCOMPARE(countCrossings(scene, cloth.x), 0);
    QVERIFY(cloth.contact.smallestGap(cloth.x) > 0);
  };
  Matrix3Xd motion = Matrix3Xd::Zero(3, cloth.x.cols());
  motion.row(2).setConstant(0.03);
  for (int i = 0; i < 5 && !QTest::currentTestFailed(); ++i) cloth.step(Vector3d::Zero(), motion, check);
  QVERIFY(std::abs(cloth.x(2, cloth.x.cols() - 1) - scene.x(2, scene.x.cols() - 1) - 0.15) < 1e-9);  // all the way
  // The ball's top is at 0.11: it has taken the sheet's middle along.
  QVERIFY(cloth.x.row(2).head(81).maxCoeff() > 0.11);
}

void TestContactCloth::foldsOntoItself() {
  // Half a tube of thick cloth on a floor, whose upper half falls on the lower one.
  geometry::SurfaceMesh sheet = makeSheet(0.4, 0.08, 24, 5);
  Scene scene;
  constexpr double radius = 0.5e-3, bend = 0.03;
  Matrix3Xd folded = sheet.points;
  for (int i = 0; i < folded.cols(); ++i) {
    const double s = sheet.points(0, i), half = M_PI * bend / 2;
    folded.col(i) << (std::abs(s) < half ? bend * std::cos(s / bend) : half - std::abs(s)), sheet.points(1, i),
        std::abs(s) < half ? bend * std::sin(s / bend) : std::copysign(bend, s);
  }
  scene.add({folded, sheet.triangles, {}}, radius);
  geometry::SurfaceMesh floor = geometry::makeGrid(1, 1, 1, 1);
  floor.points.row(0).array() -= 0.5;
  floor.points.row(2).setConstant(-bend - 2e-3);
  scene.add(floor);
  ClothExample cloth(sheet, scene.x, {scene.geometry, scene.x, options});
  cloth.contact.requireFree(scene.x);
  const auto check = [&] {
    QCOMPARE(countCrossings(scene, cloth.x), 0);
    QVERIFY(cloth.contact.smallestGap(cloth.x) > 0);
  };
  for (int i = 0; i < 30 && !QTest::currentTestFailed(); ++i)
    cloth.step(gravity, Matrix3Xd::Zero(3, cloth.x.cols()), check);
  int own = 0;
  for (const Contact& contact : cloth.contact.contacts())
    if (*std::max_element(contact.pair.nodes.begin(), contact.pair.nodes.end()) < sheet.points.cols()) ++own;
  QVERIFY2(own > 50, qPrintable(QString::number(own)));
}

void TestContactCloth::withoutContactItWouldIntersect() {
  // The counter of crossings sees them: the example above, with a step that is not cut.
  const geometry::SurfaceMesh sheet = makeSheet(0.3, 0.3, 8, 8);
  Scene scene;
  scene.add(sheet);
  scene.add(makeBall(0.06, {0.01, 0.02, -0.1}, 3));
  QCOMPARE(countCrossings(scene, scene.x), 0);
  scene.x.row(2).tail(scene.x.cols() - 81).array() += 0.05;
  QVERIFY(countCrossings(scene, scene.x) > 10);
}

QTEST_GUILESS_MAIN(TestContactCloth)
#include "test_contact_cloth.moc"
