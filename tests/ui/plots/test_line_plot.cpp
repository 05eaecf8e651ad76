#include <QSignalSpy>
#include <QTest>
#include <cmath>

#include "ui/plots/custom_plot.hpp"
#include "ui/plots/line_plot.hpp"

using namespace pliant;
using plots::LineChart;
using plots::LinePlot;

namespace {

LineChart decay(int points, bool logarithmic = false) {
  LineChart chart{"Time  [s]", "Total energy  [J]", logarithmic, {}};
  for (const double rate : {1.0, 2.0}) {
    plots::PlotLine line;
    line.name = QStringLiteral("rate %1").arg(rate);
    line.group = static_cast<int>(rate);
    for (int i = 0; i < points; ++i) {
      line.x.push_back(0.1 * i);
      line.y.push_back(std::exp(-rate * 0.1 * i) - (logarithmic && i == 3 ? 2 : 0));
    }
    chart.lines.push_back(line);
  }
  return chart;
}

}  // namespace

/// Lines that grow.
class TestLinePlot : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() {
    plot_ = std::make_unique<LinePlot>();
    plot_->resize(480, 240);
    plot_->show();
    QVERIFY(QTest::qWaitForWindowExposed(plot_.get()));
  }
  void cleanup() { plot_.reset(); }

  void whatGrowsIsShownUntilSomebodyZooms() {
    plot_->setChart(decay(5));
    QVERIFY(std::abs(plot_->plot()->xAxis->range().upper - 0.4) < 1e-12);
    plot_->setChart(decay(21));
    QVERIFY(std::abs(plot_->plot()->xAxis->range().upper - 2.0) < 1e-12);
    QVERIFY(plot_->plot()->yAxis->range().contains(1.0) && plot_->plot()->yAxis->range().contains(std::exp(-4.0)));
    // Dragging pans; what comes then does not move the axes.
    QTest::mousePress(plot_->plot(), Qt::LeftButton, {}, {200, 100});
    QTest::mouseMove(plot_->plot(), {240, 100});
    QTest::mouseRelease(plot_->plot(), Qt::LeftButton, {}, {240, 100});
    const QCPRange panned = plot_->plot()->xAxis->range();
    QVERIFY(panned.lower < 0);
    plot_->setChart(decay(41));
    QCOMPARE(plot_->plot()->xAxis->range(), panned);
    plot_->fit();
    QVERIFY(std::abs(plot_->plot()->xAxis->range().upper - 4.0) < 1e-12);
  }

  void aLogarithmLeavesOutWhatHasNone() {
    plot_->setChart(decay(11, true));
    QCOMPARE(plot_->plot()->graph(0)->dataCount(), 10);
    QVERIFY(plot_->plot()->yAxis->range().lower > 0);
    plot_->setChart(decay(11, false));
    QCOMPARE(plot_->plot()->graph(0)->dataCount(), 11);
  }

  void aClickChoosesAnInstant() {
    plot_->setChart(decay(21));
    QTest::qWait(50);
    QSignalSpy chosen(plot_.get(), &LinePlot::placeChosen);
    const int x = static_cast<int>(plot_->plot()->xAxis->coordToPixel(1.3));
    QTest::mouseClick(plot_->plot(), Qt::LeftButton, {}, {x, 100});
    QCOMPARE(chosen.count(), 1);
    QVERIFY(std::abs(chosen[0][0].toDouble() - 1.3) < 0.02);
  }

  void numbersAreExported() {
    plot_->setChart(decay(3));
    const QStringList lines = plot_->toCsv().trimmed().split('\n');
    QCOMPARE(lines.size(), 4);
    QCOMPARE(
        lines[0], QString("rate 1: Time  [s],rate 1: Total energy  [J],rate 2: Time  [s],rate 2: Total energy  [J]"));
    QCOMPARE(lines[2].split(',')[1].toDouble(), std::exp(-0.1));
    plot_->setNote("Nothing.");
    QVERIFY(plot_->toCsv().isEmpty());
  }

 private:
  std::unique_ptr<LinePlot> plot_;
};

QTEST_MAIN(TestLinePlot)
#include "test_line_plot.moc"
