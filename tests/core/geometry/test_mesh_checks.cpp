#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <limits>
#include <random>

#include "core/base/error.hpp"
#include "core/geometry/mesh_generators.hpp"
#include "core/geometry/surface_mesh.hpp"

using namespace pliant;
using geometry::SurfaceMesh;

namespace {

/// The sentence with which checkMesh refuses the mesh; empty if it does not.
std::string refusal(const SurfaceMesh& mesh) {
  try {
    geometry::checkMesh(mesh);
  } catch (const base::InputError& error) {
    return error.problem();
  }
  return {};
}

bool contains(const std::string& sentence, const std::string& part) { return sentence.find(part) != std::string::npos; }

/// Each triangle with three points of its own, as in an STL file.
SurfaceMesh takenApart(const SurfaceMesh& mesh) {
  SurfaceMesh soup;
  soup.points.resize(3, static_cast<Eigen::Index>(3 * mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    const int first = static_cast<int>(3 * soup.triangles.size());
    for (int i = 0; i < 3; ++i) soup.points.col(first + i) = mesh.points.col(triangle[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

Eigen::Vector3d normal(const SurfaceMesh& mesh, const std::array<int, 3>& t) {
  return (mesh.points.col(t[1]) - mesh.points.col(t[0])).cross(mesh.points.col(t[2]) - mesh.points.col(t[0]));
}

}  // namespace

class TestMeshChecks : public QObject {
  Q_OBJECT

 private slots:
  void goodMeshPasses();
  void badMeshesAreRefusedByName();
  void oneSidedSurfaceIsRefused();
  void weldingJoinsASoup();
  void weldingKeepsGroups();
  void weldingOrients();
  void weldingRefusesCollapsedTriangles();
  void edgesKnowTheirTriangles();
};

void TestMeshChecks::goodMeshPasses() { QCOMPARE(refusal(geometry::makeGrid(1, 1, 3, 3)), std::string()); }

void TestMeshChecks::badMeshesAreRefusedByName() {
  const SurfaceMesh good = geometry::makeGrid(1, 1, 2, 2);
  SurfaceMesh mesh = good;
  mesh.triangles.clear();
  QCOMPARE(refusal(mesh), std::string("the mesh has no triangles"));

  mesh = good;
  mesh.points(1, 5) = std::numeric_limits<double>::quiet_NaN();
  QVERIFY(contains(refusal(mesh), "point 5"));
  mesh.points(1, 5) = std::numeric_limits<double>::infinity();
  QVERIFY(contains(refusal(mesh), "point 5"));

  for (const int index : {-1, 9}) {
    mesh = good;
    mesh.triangles[3][1] = index;
    QVERIFY(contains(refusal(mesh), "triangle 3 names point " + std::to_string(index)));
  }

  mesh = good;
  mesh.groups["tip"] = {9};
  QVERIFY(contains(refusal(mesh), "group 'tip'"));

  mesh = good;
  mesh.triangles[6][2] = mesh.triangles[6][0];
  QVERIFY(contains(refusal(mesh), "triangle 6 has no area"));

  mesh = good;  // three points on a line
  mesh.triangles.push_back({mesh.groups["start"][0], mesh.groups["start"][1], mesh.groups["start"][2]});
  QVERIFY(contains(refusal(mesh), "triangle 8 has no area"));

  mesh = good;  // the same triangle, turned over
  mesh.triangles.push_back({mesh.triangles[2][1], mesh.triangles[2][0], mesh.triangles[2][2]});
  QVERIFY(contains(refusal(mesh), "triangle 8 has the same corners as triangle 2"));

  mesh = good;  // a fin on an inner edge
  mesh.points.conservativeResize(3, 10);
  mesh.points.col(9) = Eigen::Vector3d(0.5, 0, 1);
  for (const auto& edge : geometry::meshEdges(good.triangles))
    if (edge.triangles[1] >= 0) {
      mesh.triangles.push_back({edge.nodes[0], edge.nodes[1], 9});
      break;
    }
  QVERIFY(contains(refusal(mesh), "triangle 8 is the third on the edge"));
}

void TestMeshChecks::oneSidedSurfaceIsRefused() {
  constexpr int cells = 12;
  SurfaceMesh band;  // Möbius
  band.points.resize(3, 2 * cells);
  for (int i = 0; i < cells; ++i)
    for (int side = 0; side < 2; ++side) {
      const double angle = 2 * M_PI * i / cells, offset = (side - 0.5) * 0.4;
      const double radius = 1 + offset * std::cos(angle / 2);
      band.points.col(2 * i + side) << radius * std::cos(angle), radius * std::sin(angle), offset * std::sin(angle / 2);
    }
  for (int i = 0; i < cells; ++i) {
    const int a = 2 * i, b = a + 1, c = i + 1 < cells ? a + 2 : 1, d = i + 1 < cells ? a + 3 : 0;
    band.triangles.insert(band.triangles.end(), {{a, c, b}, {b, c, d}});
  }
  QVERIFY(contains(refusal(band), "one-sided"));
  band.triangles.pop_back();  // cut open, it can be oriented
  QCOMPARE(refusal(band), std::string());
}

void TestMeshChecks::weldingJoinsASoup() {
  const SurfaceMesh fork = geometry::makeFork({0.13, 0.14, 0.02, 0.04, 13, 14, 2});
  SurfaceMesh soup = takenApart(fork);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-1e-7, 1e-7);
  for (double& coordinate : soup.points.reshaped()) coordinate += jitter(random);
  const SurfaceMesh welded = geometry::weldMesh(soup, 1e-6);
  QCOMPARE(welded.points.cols(), fork.points.cols());
  QCOMPARE(welded.triangles.size(), fork.triangles.size());
  QCOMPARE(geometry::meshEdges(welded.triangles).size(), geometry::meshEdges(fork.triangles).size());
  for (std::size_t t = 0; t < fork.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      QVERIFY((welded.points.col(welded.triangles[t][i]) - fork.points.col(fork.triangles[t][i])).norm() <= 1.3e-6);
  QCOMPARE(geometry::weldMesh(takenApart(fork), 0).points.cols(), fork.points.cols());
}

void TestMeshChecks::weldingKeepsGroups() {
  SurfaceMesh soup = takenApart(geometry::makeGrid(1, 1, 2, 2));
  for (int n = 0; n < soup.points.cols(); ++n)
    if (soup.points(0, n) == 0) soup.groups["start"].push_back(n);
  const SurfaceMesh welded = geometry::weldMesh(soup, 1e-9);
  QCOMPARE(welded.groups.at("start").size(), std::size_t(3));
  for (const int node : welded.groups.at("start")) QCOMPARE(welded.points(0, node), 0.0);
}

void TestMeshChecks::weldingOrients() {
  SurfaceMesh mesh = geometry::makeGrid(1, 1, 5, 4);
  std::mt19937 random(3);
  for (std::size_t t = 1; t < mesh.triangles.size(); ++t)
    if (random() % 2) std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const SurfaceMesh welded = geometry::weldMesh(mesh, 1e-9);
  for (const auto& triangle : welded.triangles) QVERIFY(normal(welded, triangle).z() > 0);
}

void TestMeshChecks::weldingRefusesCollapsedTriangles() {
  const SurfaceMesh mesh = geometry::makeGrid(1, 1, 10, 10);
  QVERIFY_EXCEPTION_THROWN(geometry::weldMesh(mesh, 0.11), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::weldMesh(mesh, -1), base::InputError);
  QVERIFY_EXCEPTION_THROWN(geometry::weldMesh(mesh, std::nan("")), base::InputError);
}

void TestMeshChecks::edgesKnowTheirTriangles() {
  const auto edges = geometry::meshEdges({{0, 1, 2}, {2, 1, 3}});
  QCOMPARE(edges.size(), std::size_t(5));
  for (const auto& edge : edges) {
    QVERIFY(edge.nodes[0] < edge.nodes[1]);
    const bool inner = edge.nodes == std::array{1, 2};
    QCOMPARE(edge.triangles[1] >= 0, inner);
    if (inner) QVERIFY((edge.triangles == std::array{0, 1}));
  }
}

QTEST_GUILESS_MAIN(TestMeshChecks)
#include "test_mesh_checks.moc"
