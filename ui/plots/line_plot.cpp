#include "ui/plots/line_plot.hpp"

#include <QEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QSharedPointer>
#include <QStackedLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/plots/custom_plot.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::plots {

namespace {

/// Okabe and Ito's, those with too little contrast made darker on white.
constexpr std::array<QRgb, 7> lineColors{
    0xff0072b2, 0xffd55e00, 0xff009e73, 0xffcc79a7, 0xffb07800, 0xff56b4e9, 0xff4d4d4d};
constexpr std::array<QRgb, 7> lineColorsOnDark{
    0xff56b4e9, 0xffe69f00, 0xff2fc49b, 0xffe39fc4, 0xfff0e442, 0xff7d9cff, 0xffc8c8c8};

}  // namespace

LinePlot::LinePlot(QWidget* parent)
    : QWidget(parent), pages_(new QStackedLayout(this)), plot_(new QCustomPlot), note_(new QLabel) {
  note_->setAlignment(Qt::AlignCenter);
  note_->setWordWrap(true);
  note_->setMargin(16);
  pages_->addWidget(note_);
  pages_->addWidget(plot_);
  plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  plot_->setAutoAddPlottableToLegend(false);
  connect(plot_, &QCustomPlot::mouseDoubleClick, this, &LinePlot::fit);
  connect(plot_, &QCustomPlot::mouseWheel, this, [this] { zoomed_ = true; });
  connect(plot_, &QCustomPlot::mousePress, this, [this](QMouseEvent* event) { press_ = event->pos(); });
  connect(plot_, &QCustomPlot::mouseRelease, this, [this](QMouseEvent* event) {
    const QPoint moved = event->pos() - press_;
    if (moved.manhattanLength() > 4)
      zoomed_ = true;
    else if (const int item = itemAt(event->position()); item >= 0)
      Q_EMIT itemChosen(item);
    else if (plot_->axisRect()->rect().contains(event->pos()))
      Q_EMIT placeChosen(plot_->xAxis->pixelToCoord(event->pos().x()));
  });
  plot_->setMouseTracking(true);
  connect(plot_, &QCustomPlot::mouseMove, this, [this](QMouseEvent* event) { hover(event->position()); });
  applyStyle();
}

void LinePlot::setNote(const QString& sentence) {
  chart_ = {};
  chosenItem_ = -1;
  note_->setText(sentence);
  pages_->setCurrentWidget(note_);
}

void LinePlot::setChart(LineChart chart) {
  const bool another = chart.yLabel != chart_.yLabel || chart.xLabel != chart_.xLabel ||
                       chart.logarithmicY != chart_.logarithmicY || pages_->currentWidget() != plot_;
  chart_ = std::move(chart);
  pages_->setCurrentWidget(plot_);
  redraw();
  if (another || !zoomed_) fit();
}

void LinePlot::setInstant(double x) {
  shownInstant_ = x;
  instantSet_ = true;
  if (!instant_ || pages_->currentWidget() != plot_) return;
  const bool marked = std::isfinite(x);
  instant_->point1->setCoords(marked ? x : 0, 0);
  instant_->point2->setCoords(marked ? x : 0, 1);
  instant_->setVisible(marked);
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void LinePlot::fit() {
  zoomed_ = false;
  plot_->rescaleAxes();
  const QCPRange y = plot_->yAxis->range();
  if (chart_.logarithmicY)
    plot_->yAxis->setRange(y.lower / 2, y.upper * 2);
  else if (chart_.fromZero)
    plot_->yAxis->setRange(std::min(0.0, y.lower), 1.12 * std::max(y.upper, 0.0));
  else
    plot_->yAxis->scaleRange(1.12);
  // Points are whole at the ends, too.
  const bool dots =
      std::any_of(chart_.lines.begin(), chart_.lines.end(), [](const PlotLine& line) { return line.dots; });
  if (chart_.fromZero || dots) plot_->xAxis->scaleRange(chart_.fromZero ? 1.12 : 1.06);
  plot_->axisRect()->insetLayout()->setInsetAlignment(0, legendCorner());
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void LinePlot::redraw() {
  plot_->clearPlottables();
  plot_->clearItems();
  instant_ = new QCPItemStraightLine(plot_);
  instant_->setVisible(false);
  plot_->xAxis->setLabel(chart_.xLabel);
  plot_->yAxis->setLabel(chart_.yLabel);
  plot_->yAxis->setScaleType(chart_.logarithmicY ? QCPAxis::stLogarithmic : QCPAxis::stLinear);
  plot_->yAxis->setTicker(chart_.logarithmicY ? QSharedPointer<QCPAxisTicker>(new QCPAxisTickerLog)
                                              : QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
  plot_->yAxis->setNumberFormat(chart_.logarithmicY ? QStringLiteral("eb") : QStringLiteral("gb"));
  plot_->yAxis->setNumberPrecision(chart_.logarithmicY ? 0 : 5);
  plot_->yAxis->ticker()->setTickCount(4);
  const auto& colors = isDark(palette()) ? lineColorsOnDark : lineColors;
  for (const PlotLine& line : chart_.lines) {
    const QColor color(colors[static_cast<std::size_t>(line.group) % colors.size()]);
    const QPen pen(color, 1.8, line.dashed ? Qt::DashLine : Qt::SolidLine);
    QVector<double> x, y, order;
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!std::isfinite(line.y[i]) || (chart_.logarithmicY && line.y[i] <= 0)) continue;
      x.append(line.x[i]);
      y.append(line.y[i]);
      order.append(static_cast<double>(i));
    }
    const QCPScatterStyle dots =
        line.dots ? QCPScatterStyle(QCPScatterStyle::ssDisc, color, 5) : QCPScatterStyle(QCPScatterStyle::ssNone);
    if (line.joined && std::is_sorted(x.begin(), x.end())) {
      QCPGraph* graph = plot_->addGraph();
      graph->setScatterStyle(dots);
      graph->setData(x, y, true);
    } else {  // paths go to and fro, which graphs over x do not
      auto* curve = new QCPCurve(plot_->xAxis, plot_->yAxis);
      curve->setLineStyle(line.joined ? QCPCurve::lsLine : QCPCurve::lsNone);
      curve->setScatterStyle(dots);
      curve->setData(order, x, y, true);
    }
    QCPAbstractPlottable* drawn = plot_->plottable(plot_->plottableCount() - 1);
    drawn->setPen(pen);
    drawn->setName(line.name);
    if (!line.name.isEmpty()) drawn->addToLegend();
  }
  makeItemMarks();
  plot_->legend->setVisible(plot_->legend->itemCount() > 1);
  plot_->axisRect()->insetLayout()->setInsetAlignment(0, legendCorner());
  applyStyle();
  if (instantSet_) setInstant(shownInstant_);
}

void LinePlot::applyStyle() {
  styleChart(*plot_, *this);
  if (instant_) instant_->setPen(QPen(plotStyle(palette()).mutedText, 1.2, Qt::DotLine));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void LinePlot::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) {
    if (pages_->currentWidget() == plot_)
      redraw();
    else
      applyStyle();
  }
  QWidget::changeEvent(event);
}

QString LinePlot::toCsv() const {
  QStringList names;
  std::size_t rows = 0;
  for (const PlotLine& line : chart_.lines) {
    const QString name = line.name.isEmpty() ? QString() : line.name + QStringLiteral(": ");
    names << QString(name + chart_.xLabel).remove(',') << QString(name + chart_.yLabel).remove(',');
    rows = std::max(rows, line.x.size());
  }
  if (names.isEmpty()) return {};
  QString text = names.join(',') + '\n';
  for (std::size_t i = 0; i < rows; ++i) {
    QStringList values;
    for (const PlotLine& line : chart_.lines)
      values << (i < line.x.size() ? QString::number(line.x[i], 'g', 17) : QString())
             << (i < line.y.size() ? QString::number(line.y[i], 'g', 17) : QString());
    text += values.join(',') + '\n';
  }
  return text;
}

}  // namespace pliant::plots
