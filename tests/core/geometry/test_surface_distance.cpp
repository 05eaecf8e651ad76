#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <limits>
#include <random>

#include "core/base/error.hpp"
#include "core/geometry/surface_distance.hpp"

using namespace pliant;
using geometry::SurfaceDistance;
using geometry::SurfaceMesh;

namespace {

/// A closed surface with hollows and sharp ridges around the origin: cells of a sphere of latitudes and longitudes with
/// random radii.
SurfaceMesh ruggedSurface(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.6, 1.4);
  std::vector<Eigen::Vector3d> points = {{0, 0, radius(random)}};
  for (int i = 1; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double polar = M_PI * i / rows, azimuth = 2 * M_PI * j / columns;
      points.push_back(radius(random) * Eigen::Vector3d(std::sin(polar) * std::cos(azimuth),
                                                        std::sin(polar) * std::sin(azimuth), std::cos(polar)));
    }
  points.emplace_back(0, 0, -radius(random));
  SurfaceMesh mesh;
  const auto last = static_cast<int>(points.size()) - 1;
  const auto at = [&](int i, int j) { return i == 0 ? 0 : i == rows ? last : 1 + (i - 1) * columns + j % columns; };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      if (i < rows - 1) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.points.resize(3, last + 1);
  for (int i = 0; i <= last; ++i) mesh.points.col(i) = points[i];
  return mesh;
}

/// Independent of the code under test: by projection onto the plane and the three sides.
double distanceToTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c) {
  const auto toSide = [&p](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const double along = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    return (p - from - along * (to - from)).norm();
  };
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  const Eigen::Vector3d foot = p - (p - a).dot(normal) * normal;
  const bool inside = (b - a).cross(foot - a).dot(normal) >= 0 && (c - b).cross(foot - b).dot(normal) >= 0 &&
                      (a - c).cross(foot - c).dot(normal) >= 0;
  return inside ? std::abs((p - a).dot(normal)) : std::min({toSide(a, b), toSide(b, c), toSide(c, a)});
}

/// By the solid angle that the surface covers, 4π inside and 0 outside (Van Oosterom & Strackee 1983).
bool isInside(const SurfaceMesh& mesh, const Eigen::Vector3d& p) {
  double angle = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d a = mesh.points.col(i) - p, b = mesh.points.col(j) - p, c = mesh.points.col(k) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle > 2 * M_PI;
}

}  // namespace

class TestSurfaceDistance : public QObject {
  Q_OBJECT

 private slots:
  void distanceIsThatOfBruteForce();
  void sideIsRightNextToEdgesAndVertices();
  void derivativesAreThoseOfTheDistance();
  void cubeHasItsDistances();
  void openSurfaceIsRefused();
};

/// 1e5 points around a rugged surface.
void TestSurfaceDistance::distanceIsThatOfBruteForce() {
  const SurfaceMesh mesh = ruggedSurface(8, 12, 1);
  const SurfaceDistance surface(mesh);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-1.6, 1.6);
  for (int i = 0; i < 100000; ++i) {
    const Eigen::Vector3d p = Eigen::Vector3d::NullaryExpr([&] { return coordinate(random); });
    const SurfaceDistance::Closest found = surface.closest(p);
    double expected = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles)
      expected = std::min(expected, distanceToTriangle(p, mesh.points.col(a), mesh.points.col(b), mesh.points.col(c)));
    if (std::abs(std::abs(found.distance) - expected) > 1e-13 || (found.distance < 0) != isInside(mesh, p) ||
        std::abs((p - found.point).norm() - expected) > 1e-13)
      QFAIL(qPrintable(QString("point %1: %2 instead of %3").arg(i).arg(found.distance).arg(expected)));
  }
}

void TestSurfaceDistance::sideIsRightNextToEdgesAndVertices() {
  const SurfaceMesh mesh = ruggedSurface(8, 12, 3);
  const SurfaceDistance surface(mesh);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0, 1), step(-1, 1);
  std::array<int, 3> features{};
  for (int i = 0; i < 100000; ++i) {
    const auto& corners = mesh.triangles[i % mesh.triangles.size()];
    const double s = i % 2 ? share(random) : 0;  // beside a point of an edge, or beside a vertex
    Eigen::Vector3d p = (1 - s) * mesh.points.col(corners[0]) + s * mesh.points.col(corners[1]);
    p += 1e-4 * Eigen::Vector3d::NullaryExpr([&] { return step(random); });
    const SurfaceDistance::Closest found = surface.closest(p);
    ++features[static_cast<std::size_t>(found.feature)];
    if ((found.distance < 0) != isInside(mesh, p)) QFAIL(qPrintable(QString("point %1").arg(i)));
  }
  for (const int count : features) QVERIFY(count > 1000);
}

void TestSurfaceDistance::derivativesAreThoseOfTheDistance() {
  const SurfaceDistance surface(ruggedSurface(6, 8, 5));
  std::mt19937 random(6);
  std::uniform_real_distribution<double> coordinate(-1.6, 1.6);
  const double h = 1e-5;
  std::array<int, 3> checked{};
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = Eigen::Vector3d::NullaryExpr([&] { return coordinate(random); });
    const SurfaceDistance::Closest at = surface.closest(p);
    if (std::abs(at.distance) < 0.05) continue;
    Eigen::Vector3d gradient;
    Eigen::Matrix3d hessian;
    bool same = true;  // by one feature on all sides
    for (int k = 0; k < 3; ++k) {
      const SurfaceDistance::Closest after = surface.closest(p + h * Eigen::Vector3d::Unit(k));
      const SurfaceDistance::Closest before = surface.closest(p - h * Eigen::Vector3d::Unit(k));
      same = same && after.feature == at.feature && before.feature == at.feature && after.triangle == at.triangle &&
             before.triangle == at.triangle;
      gradient[k] = (after.distance - before.distance) / (2 * h);
      hessian.col(k) = (after.gradient - before.gradient) / (2 * h);
    }
    if (!same) continue;
    ++checked[static_cast<std::size_t>(at.feature)];
    QVERIFY((gradient - at.gradient).norm() < 1e-8);
    QVERIFY((hessian - at.hessian).norm() < 1e-6);
  }
  for (const int count : checked) QVERIFY(count > 20);
}

void TestSurfaceDistance::cubeHasItsDistances() {
  SurfaceMesh cube;
  cube.points.resize(3, 8);
  for (int i = 0; i < 8; ++i) cube.points.col(i) << i % 2, i / 2 % 2, i / 4;
  cube.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const SurfaceDistance surface(cube);
  QCOMPARE(surface.closest({0.5, 0.5, 0.25}).distance, -0.25);
  QCOMPARE(surface.closest({0.5, 0.25, 3}).distance, 2.0);
  QCOMPARE(surface.closest({2, 0.5, 2}).distance, std::sqrt(2.0));
  QCOMPARE(surface.closest({-1, -1, -1}).distance, std::sqrt(3.0));
  QCOMPARE(surface.closest({1, 0.5, 0.5}).distance, 0.0);
}

void TestSurfaceDistance::openSurfaceIsRefused() {
  SurfaceMesh mesh = ruggedSurface(4, 5, 7);
  mesh.triangles.pop_back();
  QVERIFY_THROWS_EXCEPTION(base::InputError, SurfaceDistance{mesh});
}

QTEST_APPLESS_MAIN(TestSurfaceDistance)
#include "test_surface_distance.moc"
