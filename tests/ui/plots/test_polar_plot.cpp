#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "ui/plots/polar_plot.hpp"

namespace pliant::plots {

namespace {

constexpr double pi = std::numbers::pi;

/// Limits of curvature of either sign, with a hole, and one over the whole turn.
scene::PolarCurves curvatures() {
  scene::PolarCurves all{"curvature", "1/m", 1, 1, {}};
  scene::PolarCurve up{"principal", {}, {}, {}, true, false}, down = up, whole = up;
  down.name = "orthogonal";
  whole.name = "turning";
  whole.halfTurn = false;
  for (int i = 0; i < 8; ++i) {
    up.angles.push_back(pi * i / 8);
    up.values.push_back(i == 3 ? std::numeric_limits<double>::quiet_NaN() : 20 + i);
    up.uncertain.push_back(0.5);
    down.angles.push_back(pi * i / 8);
    down.values.push_back(-10.0 - i);
    whole.angles.push_back(2 * pi * i / 8);
    whole.values.push_back(5);
  }
  all.curves = {up, down, whole};
  return all;
}

}  // namespace

/// Curves over the direction, with what was measured.
class TestPolarPlot : public QObject {
  Q_OBJECT

  std::unique_ptr<PolarPlot> plot_;
  QTemporaryDir folder_;

  QString write(const char* name, const QByteArray& text) {
    QFile file(folder_.filePath(name));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
    file.write(text);
    return file.fileName();
  }

  QString problemOf(const QByteArray& text) {
    try {
      readMeasuredTable(write("bad.csv", text), {"stretch", "free travel"});
    } catch (const base::InputError& error) {
      return QString::fromStdString(error.problem());
    }
    return {};
  }

 private Q_SLOTS:
  void init() {
    plot_ = std::make_unique<PolarPlot>();
    plot_->resize(420, 460);
    plot_->setCurves(curvatures());
  }

  void theNearestDirectionIsReadOut() {
    const PolarCircle& scale = plot_->scale();
    QVERIFY(scale.outer() >= 27 && scale.inner() < -17);
    // Between the directions of 22.5° and 45°, nearer to the first; on the other side of the plot as well.
    for (const double turn : {0.0, pi}) {
      const auto readout = plot_->readoutAt(scale.point(pi / 8 + 0.1 + turn, 21));
      QVERIFY(readout.has_value());
      QCOMPARE(readout->curve, 0);
      QVERIFY(std::abs(readout->angle - pi / 8 - turn) < 1e-12);
      QCOMPARE(readout->value, 21.0);
      QVERIFY2(readout->text.contains("principal 21.0 1/m (± 0.5)"), qPrintable(readout->text));
    }
    const auto negative = plot_->readoutAt(scale.point(pi / 4, -12));
    QVERIFY(negative && negative->curve == 1 && negative->text.contains("orthogonal −12.0 1/m"));
    // Where there is no value, nothing is told, and between the curves neither.
    QVERIFY(!plot_->readoutAt(scale.point(3 * pi / 8, 23)));
    QVERIFY(!plot_->readoutAt(scale.point(pi / 8, 13)));
    plot_->setCurveVisible(0, false);
    QVERIFY(!plot_->isCurveVisible(0));
    QVERIFY(!plot_->readoutAt(plot_->scale().point(pi / 8, 21)));
    QVERIFY(plot_->scale().outer() < 20);  // what is hidden takes no room
  }

  void curvesAndMeasurementsAreSeen() {
    const auto orange = [this] {
      const QImage image = plot_->grab().toImage();
      int count = 0;
      for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
          const QColor color = image.pixelColor(x, y);
          count += color.red() > 190 && color.blue() < 90 && color.green() < 150;
        }
      return count;
    };
    QCOMPARE(orange(), 0);
    plot_->addMeasured({"speed", {{0.3, 20, 18, 22}}});  // of nothing that is drawn
    QCOMPARE(orange(), 0);
    plot_->addMeasured({"principal", {{0.3, 40, 30, 50}}});
    const int one = orange();
    QVERIFY2(one > 40, qPrintable(QString::number(one)));
    QVERIFY(plot_->scale().outer() >= 50);                   // error bars are seen whole
    plot_->addMeasured({"principal", {{0.3, 20, 20, 20}}});  // in the place of those before
    QVERIFY(plot_->measured().size() == 2 && orange() < one);
    plot_->setCurveVisible(0, false);
    QCOMPARE(orange(), 0);
    plot_->setCurveVisible(0, true);
    plot_->clearMeasured();
    QCOMPARE(orange(), 0);
  }

  void numbersAreExported() {
    const QStringList lines = plot_->toCsv().split('\n');
    QCOMPARE(lines[0], QString("angle [deg],principal [1/m],orthogonal [1/m],turning [1/m]"));
    QCOMPARE(lines[1], QString("0,20,-10,5"));
    QCOMPARE(lines[2], QString("22.5,21,-11,"));
    QCOMPARE(lines[4], QString("67.5,,-13,"));
    plot_->exportTo(folder_.filePath("plot.csv"));
    plot_->exportTo(folder_.filePath("plot.svg"));
    plot_->exportTo(folder_.filePath("plot.png"));
    QVERIFY(QFileInfo(folder_.filePath("plot.svg")).size() > 2000);
    QVERIFY(QImage(folder_.filePath("plot.png")).width() >= 420);
    QVERIFY_EXCEPTION_THROWN(plot_->exportTo(folder_.filePath("plot.xyz")), base::InputError);
  }

  void measurementsAreRead() {
    const MeasuredTable table =
        readMeasuredTable(write("a.csv", "# by hand\nangle [deg], free travel [%], error\n0, 41.5, 2\n90,38,1.5\n"),
                          {"stretch", "free travel"});
    QCOMPARE(table.quantity, QString("free travel"));
    QCOMPARE(table.values.size(), std::size_t(2));
    QVERIFY(std::abs(table.values[0].value - 0.415) < 1e-15 && std::abs(table.values[0].upper - 0.435) < 1e-15);
    QVERIFY(std::abs(table.values[1].angle - pi / 2) < 1e-15 && std::abs(table.values[1].lower - 0.365) < 1e-15);
    const MeasuredTable bars =
        readMeasuredTable(write("b.csv", "angle [rad],stretch,lower,upper\n1,0.1,0.05,0.2\n"), {"stretch"});
    QCOMPARE(bars.values[0].angle, 1.0);
    QCOMPARE(bars.values[0].lower, 0.05);
    QVERIFY(problemOf("angle,speed\n1,2\n").contains("names no column “stretch” or “free travel”"));
    QVERIFY(problemOf("angle,stretch\n1,x\n").contains("Line 2: the stretch “x” is no finite number"));
    QVERIFY(problemOf("angle,stretch,lower,upper\n1,5,6,7\n").contains("outside of its error bar"));
    QVERIFY(problemOf("angle [turns],stretch\n1,5\n").contains("angles are in deg or rad"));
    QVERIFY(problemOf("").contains("empty"));
  }
};

}  // namespace pliant::plots

QTEST_MAIN(pliant::plots::TestPolarPlot)
#include "test_polar_plot.moc"
