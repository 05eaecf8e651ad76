#include <QTest>
#include <cmath>
#include <numbers>

#include "core/interlock/sphere_mesh.hpp"
#include "ui/render/boundary_geometry.hpp"
#include "ui/render/polar_scale.hpp"

namespace pliant::render {

namespace {

const Eigen::Vector3d axes(3, 2, 1), middle(0.4, -0.3, 0.2);

struct Ellipsoid {
  Points points;
  TriangleList triangles;
  Ellipsoid() {
    const interlock::SphereMesh sphere = interlock::icosphere(4);
    points.resize(3, static_cast<Eigen::Index>(sphere.directions.size()));
    for (std::size_t i = 0; i < sphere.directions.size(); ++i)
      points.col(static_cast<Eigen::Index>(i)) = middle + axes.cwiseProduct(sphere.directions[i]);
    triangles = sphere.triangles;
  }
};

double areaOf(const Eigen::Matrix2Xd& outline) {
  double sum = 0;
  for (Eigen::Index i = 0; i < outline.cols(); ++i) {
    const Eigen::Vector2d a = outline.col(i), b = outline.col((i + 1) % outline.cols());
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

}  // namespace

/// Shadows, slices and rays, compared with those of an ellipsoid.
class TestBoundaryGeometry : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void shadowsAreEllipses() {
    const Ellipsoid body;
    for (int axis = 0; axis < 3; ++axis) {
      const int first = (axis + 1) % 3, second = (axis + 2) % 3;
      const Eigen::Matrix2Xd outline = shadowOutline(body.points, body.triangles, axis);
      QCOMPARE(outline.cols(), 360);
      for (const auto& point : outline.colwise()) {
        const double x = (point.x() - middle[first]) / axes[first], y = (point.y() - middle[second]) / axes[second];
        QVERIFY(std::abs(std::hypot(x, y) - 1) < 4e-3);  // triangles lie within
        QVERIFY(std::hypot(x, y) < 1 + 1e-12);
      }
      const double area = std::numbers::pi * axes[first] * axes[second];
      QVERIFY(std::abs(areaOf(outline) - area) < 6e-3 * area);
    }
    QCOMPARE(shadowOutline(body.points, {}, 0).cols(), 0);
  }

  void slicesAreEllipses() {
    const Ellipsoid body;
    for (int axis = 0; axis < 3; ++axis)
      for (const double part : {-0.7, 0.1, 0.6}) {
        const auto curves = sliceCurves(body.points, body.triangles, axis, middle[axis] + part * axes[axis]);
        QCOMPARE(curves.size(), std::size_t(1));
        QVERIFY(curves[0].closed);
        for (const auto& point : curves[0].points.colwise()) {
          QVERIFY(std::abs(point[axis] - middle[axis] - part * axes[axis]) < 1e-12);
          QVERIFY(std::abs((point - middle).cwiseQuotient(axes).norm() - 1) < 6e-3);
        }
      }
    QVERIFY(sliceCurves(body.points, body.triangles, 2, middle.z() + 1.01).empty());
    // Through points of the mesh: each once.
    const auto through = sliceCurves(body.points, body.triangles, 2, body.points(2, 100));
    QCOMPARE(through.size(), std::size_t(1));
    QVERIFY(through[0].closed);
    // A surface with a rim gives curves with ends.
    const TriangleList half(body.triangles.begin(), body.triangles.begin() + 40);
    for (const SliceCurve& curve : sliceCurves(body.points, half, 2, body.points(2, half[3][0]) + 1e-3))
      QVERIFY(!curve.closed);
  }

  void raysMeetTheNearSide() {
    const Ellipsoid body;
    const auto hit = firstHit(body.points, body.triangles, middle + Eigen::Vector3d(10, 0.01, 0.02), {-2, 0, 0});
    QVERIFY(hit.has_value());
    QVERIFY(std::abs(hit->distance - 3.5) < 5e-3);  // 10 - 3, in steps of 2
    const auto& [a, b, c] = body.triangles[static_cast<std::size_t>(hit->triangle)];
    const Eigen::Vector3d place = hit->weights[0] * body.points.col(a) + hit->weights[1] * body.points.col(b) +
                                  hit->weights[2] * body.points.col(c);
    QVERIFY((place - middle - Eigen::Vector3d(10 - 2 * hit->distance, 0.01, 0.02)).norm() < 1e-12);
    QVERIFY(!firstHit(body.points, body.triangles, middle + Eigen::Vector3d(10, 0, 0), {2, 0, 0}));
    QVERIFY(!firstHit(body.points, body.triangles, middle + Eigen::Vector3d(10, 2.1, 0), {-2, 0, 0}));
  }

  void scalesAreRound() {
    PolarScale scale;
    scale.fit(0.02, 0.95);
    QCOMPARE(scale.inner(), 0.0);
    QCOMPARE(scale.outer(), 1.0);
    QVERIFY(scale.rings() == (std::vector<double>{0.2, 0.4, 0.6000000000000001, 0.8, 1.0}));
    QCOMPARE(scale.decimals(), 1);
    scale.fit(-26.3, 9.4);
    QCOMPARE(scale.outer(), 10.0);
    QVERIFY(scale.inner() < -26.3);
    QVERIFY(std::any_of(scale.rings().begin(), scale.rings().end(), [&](double ring) { return scale.isZero(ring); }));
    QCOMPARE(scale.fraction(10), 1.0);
    QVERIFY(scale.fraction(-26.3) > 0.1 && scale.fraction(-26.3) < 0.15);
    QVERIFY(std::abs((scale.fraction(5) - scale.fraction(0)) - (scale.fraction(0) - scale.fraction(-5))) < 1e-12);
    scale.fit(-3, -1);  // curvatures of one sign
    QCOMPARE(scale.outer(), 0.0);
    QVERIFY(scale.fraction(-1) < 1);
  }
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestBoundaryGeometry)
#include "test_boundary_geometry.moc"
