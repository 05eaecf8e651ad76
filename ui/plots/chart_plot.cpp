#include "ui/plots/chart_plot.hpp"

#include <QEvent>
#include <QLabel>
#include <QSharedPointer>
#include <QStackedLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/plots/custom_plot.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::plots {

namespace {

using harmonic::ChartAxis;
using harmonic::ChartSeries;
using harmonic::MotionChart;

/// Okabe and Ito's blue, orange and green, which colour-blind people tell apart.
constexpr std::array<QRgb, 3> seriesColors{0xff0072b2, 0xffd55e00, 0xff009e73};
constexpr std::array<QRgb, 3> seriesColorsOnDark{0xff56b4e9, 0xffe69f00, 0xff2fc49b};
constexpr double decadesShown = 12;
constexpr int mostStemTicks = 15;

/// The unit that `axis` is shown in and how many of it make the SI unit.
LengthUnit unitOf(const ChartAxis& axis, double largest) {
  if (axis.logarithmic || axis.dimension != base::dimensions::length) {
    if (axis.dimension == base::dimensions::none && axis.label.find("elative") != std::string::npos)
      return {QStringLiteral("%"), 100};
    return {QString::fromStdString(base::siUnit(axis.dimension)), 1};
  }
  return fittingLengthUnit(largest);
}

double largestOf(const MotionChart& chart, bool ofX) {
  double largest = 0;
  for (const ChartSeries& series : chart.series)
    largest = std::max(largest, (ofX ? series.x : series.y).cwiseAbs().maxCoeff());
  return largest;
}

QString axisText(const ChartAxis& axis, const QString& unit) {
  const QString label = QString::fromStdString(axis.label);
  return unit.isEmpty() ? label : QStringLiteral("%1  [%2]").arg(label, unit);
}

}  // namespace

ChartPlot::ChartPlot(QWidget* parent)
    : QWidget(parent), pages_(new QStackedLayout(this)), plot_(new QCustomPlot), note_(new QLabel) {
  note_->setAlignment(Qt::AlignCenter);
  note_->setWordWrap(true);
  note_->setMargin(16);
  pages_->addWidget(note_);
  pages_->addWidget(plot_);
  plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  plot_->setAccessibleName(tr("Chart of the motion"));
  connect(plot_, &QCustomPlot::mouseDoubleClick, this, &ChartPlot::fit);
  applyStyle();
}

void ChartPlot::setNote(const QString& sentence) {
  chart_ = {};
  predicted_.reset();
  note_->setText(sentence);
  pages_->setCurrentWidget(note_);
}

void ChartPlot::setChart(const MotionChart& solved, const std::optional<MotionChart>& predicted) {
  if (!solved.note.empty() || solved.series.empty()) {
    setNote(QString::fromStdString(solved.note));
    return;
  }
  const bool another = chart_.x.label != solved.x.label || chart_.y.label != solved.y.label ||
                       chart_.series.size() != solved.series.size();
  const double before = largestOf(chart_, false);
  chart_ = solved;
  predicted_ = predicted;
  pages_->setCurrentWidget(plot_);
  redraw();
  // Axes keep still while a motion changes a little, so that one sees it change.
  const double now = std::max(largestOf(chart_, false), predicted_ ? largestOf(*predicted_, false) : 0.0);
  if (another || now > before || now < 0.25 * before) fit();
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void ChartPlot::setInstant(double seconds) {
  if (!instant_ || pages_->currentWidget() != plot_ || chart_.x.dimension != base::dimensions::time) return;
  instant_->point1->setCoords(seconds * xFactor_, 0);
  instant_->point2->setCoords(seconds * xFactor_, 1);
  instant_->setVisible(true);
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void ChartPlot::fit() {
  plot_->rescaleAxes();
  if (chart_.y.logarithmic) {
    const double top = largestOf(chart_, false) * yFactor_;
    const double bottom = std::max(plot_->yAxis->range().lower, top * std::pow(10, -decadesShown));
    plot_->yAxis->setRange(bottom / 3, top * 3);
  } else {
    plot_->yAxis->scaleRange(1.12);
  }
  if (chart_.style == MotionChart::Style::stems) {
    plot_->xAxis->setRange(plot_->xAxis->range().lower - 0.6, plot_->xAxis->range().upper + 0.6);
  } else if (chart_.style == MotionChart::Style::closedLine) {
    plot_->xAxis->scaleRange(1.12);
  }
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void ChartPlot::redraw() {
  plot_->clearPlottables();
  plot_->clearItems();
  instant_ = new QCPItemStraightLine(plot_);
  instant_->setVisible(false);
  const LengthUnit x = unitOf(chart_.x, largestOf(chart_, true)), y = unitOf(chart_.y, largestOf(chart_, false));
  xFactor_ = x.perMetre;
  yFactor_ = y.perMetre;
  plot_->xAxis->setLabel(axisText(chart_.x, x.name));
  plot_->yAxis->setLabel(axisText(chart_.y, y.name));
  plot_->yAxis->setScaleType(chart_.y.logarithmic ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
  plot_->yAxis->setTicker(chart_.y.logarithmic ? QSharedPointer<QCPAxisTicker>(new QCPAxisTickerLog)
                                               : QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
  // A tick for each stem, as long as their numbers have room.
  QSharedPointer<QCPAxisTicker> ticker(new QCPAxisTicker);
  if (chart_.style == MotionChart::Style::stems && largestOf(chart_, true) <= mostStemTicks) {
    const QSharedPointer<QCPAxisTickerFixed> whole(new QCPAxisTickerFixed);
    whole->setTickStep(1);
    ticker = whole;
  }
  plot_->xAxis->setTicker(ticker);
  plot_->yAxis->setNumberFormat(chart_.y.logarithmic ? QStringLiteral("eb") : QStringLiteral("gb"));
  plot_->yAxis->setNumberPrecision(chart_.y.logarithmic ? 0 : 5);
  plot_->yAxis->ticker()->setTickCount(4);
  for (std::size_t i = 0; i < chart_.series.size(); ++i) addSeries(chart_, chart_.series[i], i, false);
  if (predicted_)
    for (std::size_t i = 0; i < predicted_->series.size(); ++i) addSeries(*predicted_, predicted_->series[i], i, true);
  plot_->legend->setVisible(chart_.series.size() > 1);
  applyStyle();
}

void ChartPlot::addSeries(const MotionChart& chart, const ChartSeries& series, std::size_t index, bool predicted) {
  const PlotStyle style = plotStyle(palette());
  const auto& colors = isDark(palette()) ? seriesColorsOnDark : seriesColors;
  const QColor color = predicted ? style.prediction : QColor(colors[index % colors.size()]);
  const QPen pen(color, predicted ? 1.5 : 2, predicted ? Qt::DashLine : Qt::SolidLine);
  QVector<double> x, y, order;
  for (Eigen::Index i = 0; i < series.x.size(); ++i) {
    x.append(series.x[i] * xFactor_);
    y.append(series.y[i] * yFactor_);
    order.append(static_cast<double>(i));
  }
  if (chart.style == MotionChart::Style::stems) {
    // Stems of several series stand side by side.
    const double shift = 0.16 * (static_cast<double>(index) - 0.5 * static_cast<double>(chart.series.size() - 1));
    for (double& place : x) place += shift + (predicted ? 0.05 : 0);
    QCPGraph* graph = plot_->addGraph();
    graph->setLineStyle(QCPGraph::lsImpulse);
    graph->setScatterStyle(
        QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(color, 1.5), predicted ? style.background : color, 7));
    graph->setPen(pen);
    graph->setData(x, y, true);
  } else {
    auto* curve = new QCPCurve(plot_->xAxis, plot_->yAxis);
    curve->setPen(pen);
    curve->setData(order, x, y, true);
  }
  QCPAbstractPlottable* plottable = plot_->plottable(plot_->plottableCount() - 1);
  plottable->setName(QString::fromStdString(series.name));
  if (predicted) plottable->removeFromLegend();
}

void ChartPlot::applyStyle() {
  styleChart(*plot_, *this);
  if (instant_) instant_->setPen(QPen(plotStyle(palette()).shown, 1.2));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void ChartPlot::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
    if (pages_->currentWidget() == plot_)
      redraw();
    else
      applyStyle();
  }
  QWidget::changeEvent(event);
}

QString ChartPlot::toCsv() const {
  if (chart_.series.empty()) return {};
  const auto header = [](const ChartAxis& axis, const std::string& name) {
    const std::string unit = base::siUnit(axis.dimension);
    return QString::fromStdString((name.empty() ? axis.label : axis.label + " " + name) +
                                  (unit.empty() ? "" : " [" + unit + "]"));
  };
  QStringList names;
  for (const ChartSeries& series : chart_.series) {
    names << header(chart_.x, chart_.series.size() > 1 ? series.name : "")
          << header(chart_.y, chart_.series.size() > 1 ? series.name : "");
  }
  QString text = names.join(',') + '\n';
  Eigen::Index rows = 0;
  for (const ChartSeries& series : chart_.series) rows = std::max(rows, series.x.size());
  for (Eigen::Index i = 0; i < rows; ++i) {
    QStringList values;
    for (const ChartSeries& series : chart_.series)
      values << (i < series.x.size() ? QString::number(series.x[i], 'g', 17) : QString())
             << (i < series.y.size() ? QString::number(series.y[i], 'g', 17) : QString());
    text += values.join(',') + '\n';
  }
  return text;
}

}  // namespace pliant::plots
