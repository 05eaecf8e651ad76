#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/geometry/plate.hpp"
#include "core/geometry/thick_surface.hpp"

using namespace pliant::geometry;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

int genusOf(const SurfaceMesh& mesh) {
  return 1 - (static_cast<int>(mesh.points.cols()) - static_cast<int>(mesh.triangles.size() / 2)) / 2;
}

std::string refusalOf(const PlateOutline& outline) {
  try {
    makePlate(outline, 1, 0.01);
  } catch (const pliant::base::InputError& error) {
    return error.problem();
  }
  return {};
}

}  // namespace

class TestPlate : public QObject {
  Q_OBJECT

  const double thickness_ = 3e-3, width_ = 10e-3, length_ = 80e-3, hole_ = 4e-3;

  PlateOutline link() const {
    const Vector2d a(0.01, 0.02), b = a + length_ * Vector2d(0.6, 0.8);
    return {{{a, b}}, width_, {{a, hole_}, {b, hole_}}};
  }

 private slots:
  /// A link: a rectangle, two half discs, less two holes. Chords err to the inside of the rim and the outside of holes,
  /// by the tolerance at most and with its first power.
  void linkAgainstClosedForm() {
    const double area = length_ * width_ + pi * width_ * width_ / 4 - 2 * pi * hole_ * hole_ / 4;
    const double round = pi * width_ + 2 * pi * hole_;  // what the chords follow
    for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
      const SurfaceMesh mesh = makePlate(link(), thickness_, tolerance);
      checkSolid(mesh);
      QCOMPARE(genusOf(mesh), 2);
      const double missing = area * thickness_ - enclosedVolume(mesh);
      const double rounding = 1e-7 * (2 * length_ + round) * thickness_;
      QVERIFY(missing > -rounding && missing < tolerance * round * thickness_ + rounding);
      QCOMPARE(mesh.points.row(2).minCoeff(), 0.0);
      QCOMPARE(mesh.points.row(2).maxCoeff(), thickness_);
      // All of a hole's corners are outside of it.
      for (const RoundHole& hole : link().holes)
        for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
          QVERIFY((mesh.points.col(i).head<2>() - hole.centre).norm() > 0.5 * hole.diameter - 1e-7);
    }
  }

  /// A rounded triangle: its hull, a strip along its sides, and three sectors that make one disc.
  void hullOfThreeJoints() {
    const Vector2d a(0, 0), b(0.06, 0), c(0, 0.08);
    const SurfaceMesh mesh = makePlate({{{a, b, c}}, width_, {{a, hole_}, {b, hole_}, {c, hole_}}}, thickness_, 1e-6);
    checkSolid(mesh);
    QCOMPARE(genusOf(mesh), 3);
    const double area =
        0.5 * 0.06 * 0.08 + 0.5 * width_ * (0.06 + 0.08 + 0.1) + pi * width_ * width_ / 4 - 3 * pi * hole_ * hole_ / 4;
    QVERIFY(std::abs(enclosedVolume(mesh) - area * thickness_) < 1e-6 * 0.3 * thickness_);
  }

  /// Two capsules that cross at right angles: a cross, whose middle counts once.
  void unionOfHulls() {
    const PlateOutline cross{{{{-0.05, 0}, {0.05, 0}}, {{0, -0.05}, {0, 0.05}}}, width_, {{{0, 0}, hole_}}};
    const SurfaceMesh mesh = makePlate(cross, thickness_, 1e-6);
    checkSolid(mesh);
    QCOMPARE(genusOf(mesh), 1);
    const double area = 2 * (0.1 * width_ + pi * width_ * width_ / 4) - width_ * width_ - pi * hole_ * hole_ / 4;
    QVERIFY(std::abs(enclosedVolume(mesh) - area * thickness_) < 1e-6 * 0.5 * thickness_);
    // Three in a triangle enclose an opening.
    const Vector2d a(0, 0), b(0.06, 0), c(0, 0.08);
    QCOMPARE(genusOf(makePlate({{{a, b}, {b, c}, {c, a}}, width_, {}}, thickness_, 1e-5)), 1);
    // Hulls that nearly agree leave no corners that a file with seven digits would make one.
    const SurfaceMesh near = makePlate({{{a, b}, {a, {0.06, 1e-6}}, {{0.02, 3e-6}, b}}, width_, {}}, thickness_, 2e-5);
    checkSolid(near);
    for (const auto& triangle : near.triangles)
      for (int i = 0; i < 3; ++i)
        QVERIFY((near.points.col(triangle[i]) - near.points.col(triangle[(i + 1) % 3])).norm() > 1e-6);
  }

  /// Joints that are in line, almost in line, or two of them the same.
  void jointsInLine() {
    for (const double off : {0.0, 1e-12, 1e-9, 1e-7, 1e-5}) {
      const PlateOutline outline{{{{0, 0}, {0.03, off}, {0.07, 0}, {0.07, 0}}}, width_, {{{0.03, off}, hole_}}};
      const SurfaceMesh mesh = makePlate(outline, thickness_, 1e-5);
      checkSolid(mesh);
      QCOMPARE(genusOf(mesh), 1);
      const double area = 0.07 * width_ + pi * (width_ * width_ - hole_ * hole_) / 4;
      QVERIFY(std::abs(enclosedVolume(mesh) / thickness_ - area) < 1e-5 * 0.1 + off * 0.07);
    }
  }

  void distances() {
    const PlateOutline a{{{{0, 0}, {0.05, 0}}}, 0.01, {}}, b{{{{0.02, 0.03}, {0.02, 0.08}}}, 0.006, {}};
    QVERIFY(std::abs(distanceBetween(a, b) - (0.03 - 0.005 - 0.003)) < 1e-15);
    const PlateOutline pin{{{{0.06, 0}}}, 0.004, {}}, over{{{{0.02, 0.007}}}, 0.006, {}};
    QVERIFY(std::abs(distanceBetween(a, pin) - 0.003) < 1e-15);
    QCOMPARE(distanceBetween(a, over), 0.0);
  }

  void refusals() {
    PlateOutline wide = link();
    wide.holes[0].diameter = width_;
    QVERIFY(refusalOf(wide).find("reaches its rim") != std::string::npos);
    PlateOutline near = link();
    near.holes.push_back({near.holes[0].centre + Vector2d(0, 3e-3), hole_});
    QVERIFY(refusalOf(near).find("run into each other") != std::string::npos);
    QVERIFY(refusalOf({{{{0, 0}}, {{1, 0}}}, width_, {}}).find("several pieces") != std::string::npos);
    QVERIFY(refusalOf({{{{0, 0}}}, 0, {}}).find("above 0") != std::string::npos);
  }
};

QTEST_GUILESS_MAIN(TestPlate)
#include "test_plate.moc"
