#include <Eigen/Geometry>
#include <QTest>
#include <cmath>
#include <random>

#include "core/base/error.hpp"
#include "core/mechanics/elastic_assembler.hpp"
#include "core/mechanics/strain_limits.hpp"
#include "tests/core/mechanics/shell_examples.hpp"
#include "tests/core/mechanics/strain_set_examples.hpp"

using namespace pliant;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mechanics::LimitedTriangle;
using mechanics::SheetStrains;
using mechanics::Vector;

namespace {

/// A hexagon of equilateral triangles, `rings` around the middle, with the given circumradius.
geometry::SurfaceMesh hexagon(int rings, double radius) {
  const double h = radius / rings;
  std::map<std::pair<int, int>, int> nodes;
  std::vector<Vector3d> points;
  for (int i = -rings; i <= rings; ++i)
    for (int j = -rings; j <= rings; ++j)
      if (std::abs(i + j) <= rings) {
        nodes[{i, j}] = static_cast<int>(points.size());
        points.emplace_back(h * (i + 0.5 * j), h * std::sqrt(0.75) * j, 0);
      }
  geometry::SurfaceMesh mesh;
  for (const auto& [place, node] : nodes) {
    const auto& [i, j] = place;
    const auto right = nodes.find({i + 1, j}), up = nodes.find({i, j + 1}), down = nodes.find({i + 1, j - 1});
    if (right != nodes.end() && up != nodes.end()) mesh.triangles.push_back({node, right->second, up->second});
    if (right != nodes.end() && down != nodes.end()) mesh.triangles.push_back({node, down->second, right->second});
  }
  mesh.points.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) mesh.points.col(static_cast<Eigen::Index>(i)) = points[i];
  return mesh;
}

std::vector<LimitedTriangle> sheetOf(const geometry::SurfaceMesh& mesh, double materialAngle = 0) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(-materialAngle).toRotationMatrix();
  std::vector<LimitedTriangle> sheet;
  for (const auto& nodes : mesh.triangles) {
    LimitedTriangle& triangle = sheet.emplace_back();
    triangle.nodes = nodes;
    for (int i = 0; i < 3; ++i) triangle.rest.col(i) = turn * mesh.points.col(nodes[i]).head<2>();
  }
  return sheet;
}

/// Largest error of the curvature over the triangles whose neighbours have all their neighbours.
double curvatureError(const geometry::SurfaceMesh& mesh, const SheetStrains& strains, double reach,
                      const std::function<Vector3d(const Vector2d&)>& exact) {
  double error = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Vector2d middle = Vector2d::Zero();
    for (const int node : mesh.triangles[t]) middle += mesh.points.col(node).head<2>() / 3;
    if (middle.norm() < reach)
      error = std::max(error, (strains.curvature.col(static_cast<Eigen::Index>(t)) - exact(middle)).norm());
  }
  return error;
}

}  // namespace

class TestStrainLimits : public QObject {
  Q_OBJECT

 private slots:
  void homogeneousStretchHasItsGreenStrain();
  void curvatureOfCylindersIsOfSecondOrder();
  void curvatureOfParaboloidsIsOfSecondOrder();
  void curvatureConvergesOnIrregularMeshes();
  void curvatureOfALatticeIsThatOfGingold();
  void rigidMotionsChangeNoStrain();
  void barrierIsInfiniteOutside();
  void penaltyIsTheThesis();
  void trianglesWithoutAreaAreRefused();
};

void TestStrainLimits::homogeneousStretchHasItsGreenStrain() {
  const geometry::SurfaceMesh mesh = mechanics::irregularGrid(0.3, 0.2, 5, 4);
  Eigen::Matrix<double, 3, 2> map;
  map << 1.1, 0.2, -0.1, 0.8, 0.3, 0.1;
  const Vector x = (map * mesh.points.topRows<2>()).reshaped();
  const double angle = 0.7;  // of the material's axes
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Eigen::Matrix2d green = 0.5 * turn.transpose() * (map.transpose() * map - Eigen::Matrix2d::Identity()) * turn;
  const Vector3d inMaterial(0.5 * green.trace(), 0.5 * (green(0, 0) - green(1, 1)), green(0, 1));
  const SheetStrains strains = mechanics::sheetStrains(sheetOf(mesh, angle), x);
  for (Eigen::Index t = 0; t < strains.stretch.cols(); ++t) {
    QVERIFY((strains.stretch.col(t) - inMaterial).norm() < 1e-13);
    QVERIFY(strains.curvature.col(t).norm() < 1e-9);
  }
}

/// Rolled up around axes of all directions without stretch: the exact curvature is 1/R across the axis. Orders are
/// those of the largest error.
void TestStrainLimits::curvatureOfCylindersIsOfSecondOrder() {
  const double radius = 0.2;
  for (const double axis : {0.0, 0.3, M_PI / 2}) {
    std::vector<double> errors;
    for (const int rings : {4, 8, 16, 32}) {
      const geometry::SurfaceMesh mesh = hexagon(rings, 0.1);
      const Vector2d across(-std::sin(axis), std::cos(axis)), along(std::cos(axis), std::sin(axis));
      Vector x(mesh.points.size());
      for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
        const Vector2d rest = mesh.points.col(i).head<2>();
        const double angle = rest.dot(across) / radius;
        const Vector2d plane = rest.dot(along) * along + radius * std::sin(angle) * across;
        x.segment<3>(3 * i) << plane, radius * (1 - std::cos(angle));
      }
      const Vector3d exact(0.5 / radius, -0.5 / radius * std::cos(2 * axis), -0.5 / radius * std::sin(2 * axis));
      errors.push_back(curvatureError(
          mesh, mechanics::sheetStrains(sheetOf(mesh), x), 0.05, [&](const Vector2d&) { return exact; }));
    }
    const double order = std::log2(errors[2] / errors[3]);
    qInfo("axis %.2f: errors %.1e, %.1e, %.1e, %.1e /m, order %.2f", axis, errors[0], errors[1], errors[2], errors[3],
          order);
    QVERIFY(order > 1.9 || errors[3] < 1e-10);  // exact where edges are parallel to the axis
    QVERIFY(errors[3] * radius < 1e-3);
  }
}

/// z = ½ (m r² + a (x² - y²) + 2 b x y) is nearly isometric to the plane where it is flat: on patches that shrink with
/// the mesh the curvature at the middle is (m, a, b), to second order in their slope.
void TestStrainLimits::curvatureOfParaboloidsIsOfSecondOrder() {
  const Vector3d exact(3, 2, -1);
  std::vector<double> errors;
  for (const double size : {0.08, 0.04, 0.02, 0.01}) {
    const geometry::SurfaceMesh mesh = hexagon(4, size);
    Vector x = mesh.points.reshaped();
    for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
      const double u = x[3 * i], v = x[3 * i + 1];
      x[3 * i + 2] = 0.5 * exact.dot(Vector3d(u * u + v * v, u * u - v * v, 2 * u * v));
    }
    errors.push_back(curvatureError(
        mesh, mechanics::sheetStrains(sheetOf(mesh), x), 0.4 * size, [&](const Vector2d&) { return exact; }));
  }
  const double order = std::log2(errors[2] / errors[3]);
  qInfo("errors %.1e, %.1e, %.1e, %.1e /m, order %.2f", errors[0], errors[1], errors[2], errors[3], order);
  QVERIFY(order > 1.9);
  QVERIFY(errors[3] < 1e-2);
}

/// Cylinders on grids whose points are moved at random, for which the four-triangle formula is off by a third.
void TestStrainLimits::curvatureConvergesOnIrregularMeshes() {
  const double radius = 0.2, axis = 0.4;
  const Vector2d across(-std::sin(axis), std::cos(axis)), along(std::cos(axis), std::sin(axis));
  const Vector3d exact(0.5 / radius, -0.5 / radius * std::cos(2 * axis), -0.5 / radius * std::sin(2 * axis));
  std::vector<double> errors;
  for (const int cells : {8, 16, 32, 64}) {
    geometry::SurfaceMesh mesh = mechanics::irregularGrid(0.2, 0.2, cells, cells);
    mesh.points.row(0).array() -= 0.1;
    Vector x(mesh.points.size());
    for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
      const Vector2d rest = mesh.points.col(i).head<2>();
      const double angle = rest.dot(across) / radius;
      const Vector2d plane = rest.dot(along) * along + radius * std::sin(angle) * across;
      x.segment<3>(3 * i) << plane, radius * (1 - std::cos(angle));
    }
    const SheetStrains strains = mechanics::sheetStrains(sheetOf(mesh), x);
    double squares = 0;
    int count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Vector2d middle = Vector2d::Zero();
      for (const int node : mesh.triangles[t]) middle += mesh.points.col(node).head<2>() / 3;
      if (middle.norm() > 0.06) continue;
      squares += (radius * (strains.curvature.col(static_cast<Eigen::Index>(t)) - exact)).squaredNorm();
      ++count;
    }
    errors.push_back(std::sqrt(squares / count));
  }
  const double order = std::log2(errors[2] / errors[3]);
  qInfo("relative errors %.1e, %.1e, %.1e, %.1e, order %.2f", errors[0], errors[1], errors[2], errors[3], order);
  QVERIFY(order > 0.9);
  QVERIFY(errors[3] < 0.02);
}

/// A triangle whose neighbours are bent by one angle each: the formula of the thesis.
void TestStrainLimits::curvatureOfALatticeIsThatOfGingold() {
  geometry::SurfaceMesh mesh = hexagon(2, 0.1);
  const Eigen::Matrix2d shear = (Eigen::Matrix2d() << 1, 0.3, 0, 0.8).finished();
  mesh.points.topRows<2>() = (shear * mesh.points.topRows<2>()).eval();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> height(-0.01, 0.01);
  Vector x = mesh.points.reshaped();
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) x[3 * i + 2] = height(random);
  const SheetStrains strains = mechanics::sheetStrains(sheetOf(mesh), x);
  std::vector<Vector3d> normals;
  for (const auto& [a, b, c] : mesh.triangles)
    normals.push_back(
        (x.segment<3>(3 * b) - x.segment<3>(3 * a)).cross(x.segment<3>(3 * c) - x.segment<3>(3 * a)).normalized());
  int checked = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
    int neighbours = 0;
    for (const geometry::MeshEdge& edge : geometry::meshEdges(mesh.triangles)) {
      const auto [s, other] = edge.triangles;
      if (other < 0 || (s != static_cast<int>(t) && other != static_cast<int>(t))) continue;
      ++neighbours;
      const int beside = s == static_cast<int>(t) ? other : s;
      Vector3d middle = Vector3d::Zero();
      for (const int node : mesh.triangles[t]) middle += mesh.points.col(node) / 3;
      const Vector3d from = mesh.points.col(edge.nodes[0]), to = mesh.points.col(edge.nodes[1]);
      Vector2d outward((to - from).y(), -(to - from).x());
      if (outward.dot((middle - from).head<2>()) > 0) outward = -outward;
      Vector3d apex = Vector3d::Zero();
      for (const int node : mesh.triangles[beside])
        if (node != edge.nodes[0] && node != edge.nodes[1]) apex = x.segment<3>(3 * node);
      const double up = (apex - x.segment<3>(3 * edge.nodes[0])).dot(normals[t]);
      const double angle = std::copysign(std::acos(std::clamp(normals[t].dot(normals[beside]), -1.0, 1.0)), up);
      const auto& [a, b, c] = mesh.triangles[t];
      const Vector2d u = (mesh.points.col(b) - mesh.points.col(a)).head<2>(),
                     v = (mesh.points.col(c) - mesh.points.col(a)).head<2>();
      const double area = 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
      curvature += angle / (2 * area * (to - from).norm()) * outward * outward.transpose();
    }
    if (neighbours < 3) continue;
    ++checked;
    const Vector3d expected(0.5 * curvature.trace(), 0.5 * (curvature(0, 0) - curvature(1, 1)), curvature(0, 1));
    QVERIFY((strains.curvature.col(static_cast<Eigen::Index>(t)) - expected).norm() < 1e-9 * expected.norm());
  }
  QVERIFY(checked > 5);
}

void TestStrainLimits::rigidMotionsChangeNoStrain() {
  const geometry::SurfaceMesh mesh = hexagon(3, 0.1);
  const std::vector<LimitedTriangle> sheet = sheetOf(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-0.01, 0.01);
  const Vector x = mesh.points.reshaped() + Vector::NullaryExpr(mesh.points.size(), [&] { return step(random); });
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.5, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Matrix3Xd moved = (turn * x.reshaped(3, mesh.points.cols())).colwise() + Vector3d(0.1, -0.3, 0.2);
  const SheetStrains before = mechanics::sheetStrains(sheet, x),
                     after = mechanics::sheetStrains(sheet, moved.reshaped());
  QVERIFY((before.stretch - after.stretch).cwiseAbs().maxCoeff() < 1e-13);
  QVERIFY((before.curvature - after.curvature).cwiseAbs().maxCoeff() < 1e-13 * before.curvature.cwiseAbs().maxCoeff());
}

void TestStrainLimits::barrierIsInfiniteOutside() {
  const geometry::SurfaceMesh mesh = hexagon(2, 0.1);
  std::vector<LimitedTriangle> sheet = sheetOf(mesh);
  for (LimitedTriangle& triangle : sheet) triangle.stretch = mechanics::strainSet([](const Vector3d&) { return 0.1; });
  mechanics::Model model = mechanics::modelOf(mesh, 3);
  model.energies.push_back(mechanics::makeStretchLimit(sheet, {mechanics::StrainLimitFunction::Kind::barrier, 2}));
  model.finish();
  const mechanics::ElasticAssembler assembler(std::make_shared<const mechanics::Model>(model));
  // All of it by s in both directions: Green strain s + s²/2 in the mean.
  const auto stretched = [&](double s) -> Vector { return (1 + s) * model.restPositions; };
  const double area = 6 * std::sqrt(3.0) / 4 * 0.1 * 0.1, strain = 0.05 + 0.05 * 0.05 / 2;
  QVERIFY(std::abs(assembler.value(stretched(0.05)) + 2 * area * std::log(1 - strain * strain / 0.01)) < 1e-9);
  QVERIFY(std::isinf(assembler.value(stretched(0.11))));
}

void TestStrainLimits::penaltyIsTheThesis() {
  const geometry::SurfaceMesh mesh = hexagon(2, 0.1);
  std::vector<LimitedTriangle> sheet = sheetOf(mesh);
  const auto set = mechanics::strainSet([](const Vector3d&) { return 0.1; });
  for (LimitedTriangle& triangle : sheet) triangle.stretch = set;
  mechanics::Model model = mechanics::modelOf(mesh, 3);
  model.energies.push_back(mechanics::makeStretchLimit(sheet, {mechanics::StrainLimitFunction::Kind::penalty, 2}));
  model.finish();
  const mechanics::ElasticAssembler assembler(std::make_shared<const mechanics::Model>(model));
  const double area = 6 * std::sqrt(3.0) / 4 * 0.1 * 0.1, strain = 0.2 + 0.2 * 0.2 / 2;
  const double distance = (strain - 0.1) / set->size();
  QCOMPARE(assembler.value(model.restPositions), 0.0);
  QVERIFY(std::abs(assembler.value(1.2 * model.restPositions) / (2 * area * distance * distance * distance) - 1) <
          1e-10);
}

void TestStrainLimits::trianglesWithoutAreaAreRefused() {
  LimitedTriangle triangle;
  triangle.nodes = {0, 1, 2};
  triangle.rest << 0, 1, 2, 0, 1, 2;
  triangle.stretch = mechanics::strainSet([](const Vector3d&) { return 0.1; });
  QVERIFY_THROWS_EXCEPTION(base::InputError, mechanics::makeStretchLimit({triangle}, {}));
}

QTEST_APPLESS_MAIN(TestStrainLimits)
#include "test_strain_limits.moc"
