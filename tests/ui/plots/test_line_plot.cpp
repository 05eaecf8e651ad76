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

  /// Points that belong to something are chosen by a click and said when hovered; others are places.
  void itemsAreChosen() {
    LineChart chart = decay(11);
    chart.lines[0].joined = false;
    chart.lines[0].dots = true;
    for (int i = 0; i < 11; ++i) chart.lines[0].items.push_back(100 + i);
    plot_->setItemText([](int item) { return QStringLiteral("number %1").arg(item); });
    plot_->setChart(chart);
    QCoreApplication::processEvents();
    const auto at = [&](int line, int i) {
      const auto& drawn = chart.lines[static_cast<std::size_t>(line)];
      return QPoint(
          static_cast<int>(std::lround(plot_->plot()->xAxis->coordToPixel(drawn.x[static_cast<std::size_t>(i)]))),
          static_cast<int>(std::lround(plot_->plot()->yAxis->coordToPixel(drawn.y[static_cast<std::size_t>(i)]))));
    };
    QSignalSpy items(plot_.get(), &LinePlot::itemChosen), places(plot_.get(), &LinePlot::placeChosen);
    QTest::mouseClick(plot_->plot(), Qt::LeftButton, {}, at(0, 5) + QPoint(2, -2));
    QCOMPARE(items.count(), 1);
    QCOMPARE(items[0][0].toInt(), 105);
    QTest::mouseClick(plot_->plot(), Qt::LeftButton, {}, at(1, 5));  // of nothing, and far from what is
    QCOMPARE(items.count(), 1);
    QCOMPARE(places.count(), 1);
    QTest::mouseMove(plot_->plot(), at(0, 7));
    QCOMPARE(plot_->hoverText(), QString("number 107"));
    QTest::mouseMove(plot_->plot(), at(1, 5));
    QVERIFY(plot_->hoverText().isEmpty());
    plot_->plot()->replot();
    const QImage before = plot_->grab().toImage();
    plot_->setChosenItem(105);
    plot_->plot()->replot();
    QVERIFY(plot_->grab().toImage() != before);
    plot_->setChosenItem(-1);
    plot_->plot()->replot();
    QCOMPARE(plot_->grab().toImage(), before);
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
