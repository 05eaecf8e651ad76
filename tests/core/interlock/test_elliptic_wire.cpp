#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/geometry/closed_mesh.hpp"
#include "core/interlock/deformation_test.hpp"
#include "core/interlock/element_body.hpp"
#include "core/interlock/element_families.hpp"
#include "core/interlock/elliptic_wire.hpp"

using namespace pliant::interlock;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

/// Of places along the boundary of an ellipse, the largest distance to the union of the discs; and of places along the
/// boundary of that union, how far they are outside the ellipse at most.
std::pair<double, double> sampledErrors(double a, double b, const std::vector<SectionDisc>& discs) {
  double inside = 0, outside = 0;
  constexpr int samples = 20'000;
  for (int i = 0; i < samples; ++i) {
    const double angle = 2 * pi * i / samples, x = a * std::cos(angle), y = b * std::sin(angle);
    double nearest = 1e300;
    for (const auto& [offset, radius] : discs) {
      nearest = std::min(nearest, std::hypot(x - offset, y) - radius);
      const double u = offset + radius * std::cos(angle), v = radius * std::sin(angle);
      outside = std::max(outside, u * u / (a * a) + v * v / (b * b) - 1);
    }
    inside = std::max(inside, nearest);
  }
  return {inside, outside};
}

}  // namespace

class TestEllipticWire : public QObject {
  Q_OBJECT

 private slots:
  /// Discs are inside of the ellipse, and leave no more than is said.
  void sectionOfDiscs_data() {
    QTest::addColumn<double>("aspect");
    for (const double aspect : {1.05, 1.2, 1.5, 2.0, 3.0}) QTest::addRow("%g", aspect) << aspect;
  }
  void sectionOfDiscs() {
    QFETCH(double, aspect);
    const int count = static_cast<int>(ellipticRing(Vector3d::Zero(), Vector3d::UnitZ(), 10, 1, aspect).size());
    for (const int each : {count, 2 * count - 1}) {
      const auto [inside, outside] = sampledErrors(aspect, 1, sectionDiscs(aspect, 1, each));
      // The distance to discs is to the ellipse's nearest place, but measured from the ellipse: of second order here.
      QVERIFY2(std::abs(inside - sectionError(aspect, 1, each)) < 0.1 * inside + 1e-9,
               qPrintable(QString("%1 %2").arg(inside).arg(sectionError(aspect, 1, each))));
      QVERIFY(outside < 1e-12);
    }
    QVERIFY(sectionError(aspect, 1, count) <= largestSectionError);
    if (count > 3) QVERIFY(sectionError(aspect, 1, count - 2) > largestSectionError);
  }

  /// Volume of a ring's body against the torus with an elliptic section, 2π R · π a b.
  void ringBodies() {
    for (const double aspect : {0.6, 1.6}) {
      const ElementShape shape{"ring", ellipticRing(Vector3d::Zero(), Vector3d(1, 2, 2), 5e-3, 0.8e-3, aspect)};
      const auto made = ElementBody(shape).mesh(3e-5);
      const double a = 0.8e-3, b = aspect * a, volume = 2 * pi * 5e-3 * pi * a * b;
      // All around, the section is short by 2 % of its smaller half axis at most, and by chords.
      const double perimeter = 2 * pi * std::sqrt(0.5 * (a * a + b * b));
      const double least = volume - 2 * pi * 5e-3 * perimeter * (0.02 * std::min(a, b) + 3e-5);
      const double found = enclosedVolume(made.mesh);
      QVERIFY2(found > least && found < volume * (1 + 1e-3), qPrintable(QString("%1 %2").arg(found).arg(volume)));
    }
  }

  /// Every material passes its check, and aspect 1 is the wire of old.
  void materials() {
    for (const double aspect : {0.8, 1.25}) {
      Rosette rosette = threefoldDefault, square = squareRosetteDefault;
      ScaleMail scale;
      FourInOne mail;
      RingNet net;
      rosette.aspect = square.aspect = scale.rings.aspect = mail.aspect = net.aspect = aspect;
      for (const UnitCell& cell :
           {threefold(rosette), squareRosette(square), scaleMail(scale), fourInOne(mail), ringNet(net)})
        checkCell(cell);
    }
    QCOMPARE(threefold().shapes[0].pieces.size(), std::size_t(3));
  }

  /// Rings of a net touch inside their planes, where the section is `wire` thick whatever its aspect: they lock where
  /// round ones do. Across, the upright ring lies in the flat one with the other half axis: along z, where it ends.
  void limitsOfANet() {
    for (const double aspect : {0.7, 1.4}) {
      RingNet net;
      net.aspect = aspect;
      const CellSolver solver(ringNet(net));
      const DirectionLimit limit = directionLimit(solver, 0, false);
      QVERIFY(limit.equilibrium.converged());
      QVERIFY2(
          std::abs(limit.strain - (4 * (4 - 0.6) / 12 - 1)) < 2e-5, qPrintable(QString::number(limit.strain, 'g', 9)));
    }
  }

  void badAspect() {
    for (const double aspect : {0.0, -1.0, 0.3, 3.1, std::nan("")})
      QVERIFY_THROWS_EXCEPTION(
          pliant::base::InputError, ellipticRing(Vector3d::Zero(), Vector3d::UnitZ(), 5e-3, 1e-3, aspect));
  }
};

QTEST_GUILESS_MAIN(TestEllipticWire)
#include "test_elliptic_wire.moc"
