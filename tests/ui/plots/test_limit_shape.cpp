#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/cloth/limit_envelope.hpp"
#include "ui/plots/limit_shape.hpp"
#include "ui/plots/measured_limit.hpp"
#include "ui/plots/polar_axis.hpp"

using namespace pliant;
using cloth::stretchAt;
using plots::LimitKind;
using plots::LimitShape;
using plots::LimitSymmetry;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

cloth::LimitCurve curve(std::initializer_list<cloth::DirectionLimit> degreesAndStretches) {
  std::vector<cloth::DirectionLimit> points;
  for (const auto& [angle, stretch] : degreesAndStretches) points.push_back({angle * degree, stretch});
  return cloth::LimitCurve(points);
}

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

}  // namespace

/// The polar editor's model: handles, symmetry, what is refused.
class TestLimitShape : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void everyKindComesBackAsItWas_data() {
    QTest::addColumn<int>("kind");
    for (int kind = 0; kind < 3; ++kind) QTest::addRow("kind %d", kind) << kind;
  }

  void everyKindComesBackAsItWas() {
    QFETCH(int, kind);
    const cloth::StretchLimit limits[] = {cloth::IsotropicLimit{1.07}, cloth::OrthotropicLimit{1.2, 1.05, 0.3},
                                          curve({{0, 1.1}, {50, 1.2}, {120, 1.05}})};
    const LimitShape shape(limits[kind]);
    QCOMPARE(static_cast<int>(shape.kind()), kind);
    QVERIFY(plots::sameLimit(shape.limit(), limits[kind]));
    // Each place lies on the curve, at the height of its handle.
    for (const plots::HandlePlace& place : shape.places()) {
      if (place.handle == LimitShape::rotationHandle) continue;
      const double own = shape.handles().at(place.handle).stretch;
      QVERIFY(near(stretchAt(limits[kind], place.angle), own));
      QVERIFY(std::abs(std::remainder(place.handleAngle(place.angle) - shape.handles()[place.handle].angle, pi)) <
              1e-9);
    }
  }

  void aMirroredCurveIsEditedByAQuarter() {
    LimitShape shape(curve({{0, 1.02}, {40, 1.15}, {90, 1.03}, {140, 1.15}}));
    QCOMPARE(shape.symmetry(), LimitSymmetry::mirrored);
    QCOMPARE(shape.handleCount(), 3);
    QCOMPARE(shape.places().size(), std::size_t(2 + 4 + 2));
    QCOMPARE(shape.drag(1, {50 * degree, 1.2}), std::string());
    for (const double angle : {50, 130, 230, 310}) QVERIFY(near(stretchAt(shape.limit(), angle * degree), 1.2));
    // It cannot leave its quarter, nor pass its neighbour.
    shape.drag(1, {120 * degree, 1.2});
    QVERIFY(near(shape.handles()[1].angle, 89 * degree));
    shape.setSymmetry(LimitSymmetry::none);
    QCOMPARE(shape.handleCount(), 4);
    shape.drag(1, {60 * degree, 1.3});
    QVERIFY(near(stretchAt(shape.limit(), 60 * degree), 1.3));
    QVERIFY(stretchAt(shape.limit(), 120 * degree) < 1.21);
    // Mirrored again, the half between warp and weft is what stays.
    shape.setSymmetry(LimitSymmetry::mirrored);
    QVERIFY(near(stretchAt(shape.limit(), 120 * degree), 1.3));
  }

  void mirroringKeepsTheOtherQuarterWhereThereIsNoFirst() {
    LimitShape shape(curve({{120, 1.1}, {150, 1.2}}));
    shape.setSymmetry(LimitSymmetry::mirrored);
    QCOMPARE(shape.handleCount(), 2);
    QVERIFY(near(stretchAt(shape.limit(), 30 * degree), 1.2));
    QVERIFY(near(stretchAt(shape.limit(), 60 * degree), 1.1));
  }

  void draggingPassesThroughTheWarp() {
    LimitShape shape(curve({{5, 1.1}, {60, 1.2}, {100, 1.3}}));
    QCOMPARE(shape.symmetry(), LimitSymmetry::none);
    shape.drag(0, {-10 * degree, 1.15});
    QVERIFY(near(shape.handles()[0].angle, 170 * degree));
    QVERIFY(near(stretchAt(shape.limit(), 170 * degree), 1.15));
    // Not past the neighbour on the other side.
    shape.drag(0, {-85 * degree, 1.15});
    QVERIFY(near(shape.handles()[0].angle, 101 * degree));
    const int sorted = shape.sort(0);
    QCOMPARE(sorted, 2);
    QVERIFY(near(shape.handles()[2].stretch, 1.15));
  }

  void whatIsInfeasibleIsRefused() {
    LimitShape shape(curve({{0, 1.1}, {60, 1.2}, {100, 1.3}}));
    QVERIFY(!shape.drag(0, {0, 0.9}).empty());
    QCOMPARE(shape.handles()[0].stretch, 1.0);  // as far as it goes
    const auto before = shape.limit();
    QVERIFY(!shape.put(1, {60 * degree, 0.999}).empty());
    QVERIFY(!shape.put(1, {100 * degree, 1.2}).empty());
    QVERIFY(!shape.put(1, {NAN, 1.2}).empty());
    QVERIFY(!shape.put(1, {1, INFINITY}).empty());
    QVERIFY(!shape.add(60.5 * degree).empty());
    QVERIFY(plots::sameLimit(shape.limit(), before));
    QVERIFY(shape.remove(0).empty());
    QVERIFY(shape.remove(0).empty());
    QVERIFY(!shape.remove(0).empty());
    QCOMPARE(shape.handleCount(), 1);
    LimitShape isotropic;
    QVERIFY(!isotropic.add(1).empty());
    QVERIFY(!isotropic.remove(0).empty());
    QVERIFY(!isotropic.put(0, {0, 0.5}).empty());
  }

  void aNewPointLiesOnTheCurve() {
    LimitShape shape(curve({{0, 1.1}, {60, 1.2}, {100, 1.3}}));
    const double there = stretchAt(shape.limit(), 30 * degree);
    QVERIFY(shape.add(210 * degree).empty());
    QCOMPARE(shape.handleCount(), 4);
    const int added = shape.nearestHandle(30 * degree);
    QVERIFY(near(shape.handles()[added].angle, 30 * degree) && near(shape.handles()[added].stretch, there));
  }

  void kindsChangeIntoWhatIsNear() {
    LimitShape shape(cloth::OrthotropicLimit{1.2, 1.05, 0});
    shape.setKind(LimitKind::free);
    QCOMPARE(shape.symmetry(), LimitSymmetry::mirrored);
    for (int i = 0; i < 8; ++i) {
      const double angle = pi * i / 8;
      QVERIFY(near(stretchAt(shape.limit(), angle), std::hypot(1.2 * std::cos(angle), 1.05 * std::sin(angle))));
    }
    shape.setKind(LimitKind::orthotropic);
    const auto back = std::get<cloth::OrthotropicLimit>(shape.limit());
    QVERIFY(near(back.first, 1.2) && near(back.second, 1.05) && back.angle == 0);
    shape.setKind(LimitKind::isotropic);
    QVERIFY(near(std::get<cloth::IsotropicLimit>(shape.limit()).stretch, 1.05));
  }

  void anOrthotropicLimitTurnsByItsOwnHandle() {
    LimitShape shape(cloth::OrthotropicLimit{1.2, 1.05, 0});
    shape.drag(0, {1, 1.3});
    shape.drag(LimitShape::rotationHandle, {0.4, 5});
    auto limit = std::get<cloth::OrthotropicLimit>(shape.limit());
    QVERIFY(near(limit.first, 1.3) && near(limit.second, 1.05) && near(limit.angle, 0.4));
    // The angle of the second direction says the same.
    QVERIFY(shape.put(1, {0.1 + pi / 2, 1.06}).empty());
    limit = std::get<cloth::OrthotropicLimit>(shape.limit());
    QVERIFY(near(limit.first, 1.3) && near(limit.second, 1.06) && near(limit.angle, 0.1));
  }

  void presetsAreFeasible() {
    QVERIFY(plots::limitPresets().size() >= 5);
    for (const plots::LimitPreset& preset : plots::limitPresets()) QVERIFY(smallestStretch(preset.limit) >= 1);
  }

  void theAxisTellsSmallStretchesApart() {
    plots::PolarAxis axis;
    axis.setCircle({200, 200}, 100);
    for (const double largest : {1.004, 1.05, 1.2, 1.6, 3.0}) {
      axis.fit(largest);
      QVERIFY(axis.outer() >= largest && axis.outer() - 1 < 2.1 * (largest - 1));
      QVERIFY(near(axis.radiusOf(1), 34) && near(axis.radiusOf(axis.outer()), 100));
      QVERIFY(axis.rings().size() >= 2 && axis.rings().size() <= 5);
      const double stretch = 1 + 0.7 * (largest - 1);
      const QPointF place = axis.point(2.1, stretch);
      QVERIFY(near(axis.stretchAt(place), stretch) && near(axis.angleAt(place), 2.1));
    }
    QVERIFY(!axis.refit(2.8));  // it keeps still
    QVERIFY(axis.refit(1.1));
    QCOMPARE(plots::stretchText(1.05, false, 2), QString("1.05"));
    QCOMPARE(plots::stretchText(1.05, true, 3), QString("+5.0 %"));
  }

  void theEnvelopeIsTheFlattestEllipse() {
    const cloth::StretchLimit limit = curve({{0, 1.02}, {45, 1.15}, {90, 1.03}, {135, 1.15}});
    const auto constraints = cloth::ellipseConstraints(limit, 12);
    const auto excess = [&](double angle) {
      return cloth::envelopeStretch(constraints, angle) / stretchAt(limit, angle);
    };
    double largest = 0, at = 0;
    for (int i = 0; i < 1440; ++i) {
      QVERIFY(excess(pi * i / 1440) >= 1 - 1e-9);
      if (excess(pi * i / 1440) <= largest) continue;
      at = pi * i / 1440;
      largest = excess(at);
    }
    // The largest of all lies in a corner of the envelope beside the largest sample.
    for (double step = pi / 1440; step > 1e-12; step /= 2)
      for (const double side : {-1.0, 1.0})
        if (excess(at + side * step) > largest) largest = excess(at += side * step);
    QVERIFY2(std::abs(largest - 1 - constraints.overshoot) < 1e-9,
             qPrintable(QString::number(largest - 1 - constraints.overshoot)));
    QVERIFY(std::isinf(cloth::envelopeStretch(cloth::directionConstraints(limit, 6), 0.3)));
  }

  void measurementsAreReadAndWhatIsWrongIsNamed_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("sentence");
    const auto row = [](const char* name, const char* text, const char* sentence) {
      QTest::newRow(name) << QByteArray(text) << QString::fromUtf8(sentence);
    };
    row("empty", "", "line 1 must name the columns");
    row("nothing below", "angle [deg],stretch\n", "There is no measurement below the header.");
    row("no stretch", "angle [deg],force [N]\n0,1\n", "Line 1: the header names no column “stretch”.");
    row("no angle", "\nstretch\n1.1\n", "Line 2: the header names no column “angle [deg]”.");
    row("NaN", "angle [deg],stretch\n0,1.1\n10,nan\n", "Line 3: the stretch “nan” is no finite number.");
    row("empty cell", "angle [deg],stretch\n0,1.1\n\n,1.2\n", "Line 4: the angle is empty.");
    row("too few", "angle [deg],stretch\n0\n", "Line 2 has 1 columns, but the header has 2.");
    row("negative", "angle [deg],stretch\n0,-1\n", "Line 2: the stretch must be above 0.");
    row("other unit", "angle [grad],stretch\n0,1\n", "Line 1: angles are in deg or rad, not in grad.");
    row("half a bar", "angle [deg],stretch,lower\n0,1,1\n", "there is only one.");
    row("outside", "angle [deg],stretch,lower,upper\n0,1.1,1.2,1.3\n", "outside of its error bar.");
  }

  void measurementsAreReadAndWhatIsWrongIsNamed() {
    QFETCH(QByteArray, text);
    QFETCH(QString, sentence);
    QTemporaryDir folder;
    const QString name = folder.filePath("limits.csv");
    const auto write = [&](const QByteArray& content) {
      QFile file(name);
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(content);
    };
    write(text);
    try {
      plots::readMeasuredLimits(name);
      QFAIL("it was read");
    } catch (const base::InputError& error) {
      QVERIFY2(QString::fromUtf8(error.what()).contains(sentence), error.what());
    }
    write("# chainmail A\r\nAngle [deg], Stretch, Error\r\n90, 1.2, 0.05\r\n");
    const auto read = plots::readMeasuredLimits(name);
    QCOMPARE(read.size(), std::size_t(1));
    QVERIFY(near(read[0].angle, pi / 2) && near(read[0].lower, 1.15) && near(read[0].upper, 1.25));
  }
};

QTEST_GUILESS_MAIN(TestLimitShape)
#include "test_limit_shape.moc"
