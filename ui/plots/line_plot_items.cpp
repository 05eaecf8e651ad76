#include <algorithm>
#include <cmath>

#include "ui/plots/custom_plot.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::plots {

namespace {

constexpr double reach = 10;  ///< of a click, device-independent pixels

bool isOfOneItem(const PlotLine& line) {
  return line.joined &&
         std::adjacent_find(line.items.begin(), line.items.end(), std::not_equal_to<>()) == line.items.end();
}

}  // namespace

int LinePlot::itemAt(const QPointF& pixel) const {
  if (pages_->currentWidget() != plot_ || !plot_->axisRect()->rect().contains(pixel.toPoint())) return -1;
  int nearest = -1;
  double least = reach;
  for (const PlotLine& line : chart_.lines)
    for (std::size_t i = 0; i < line.items.size(); ++i) {
      const double distance = std::hypot(
          plot_->xAxis->coordToPixel(line.x[i]) - pixel.x(), plot_->yAxis->coordToPixel(line.y[i]) - pixel.y());
      if (!(distance < least)) continue;
      least = distance;
      nearest = line.items[i];
    }
  return nearest;
}

void LinePlot::setChosenItem(int item) {
  if (chosenItem_ == item) return;
  chosenItem_ = item;
  markChosenItem();
}

/// Over the lines.
void LinePlot::makeItemMarks() {
  chosenLine_ = new QCPCurve(plot_->xAxis, plot_->yAxis);
  chosenPoints_ = new QCPCurve(plot_->xAxis, plot_->yAxis);
  chosenPoints_->setLineStyle(QCPCurve::lsNone);
  hoverLabel_ = new QCPItemText(plot_);
  hoverLabel_->setVisible(false);
  hoverLabel_->setPadding(QMargins(8, 4, 8, 4));
  hoverLabel_->position->setType(QCPItemPosition::ptAbsolute);
  hoverLabel_->setTextAlignment(Qt::AlignLeft);
  const PlotStyle style = plotStyle(palette());
  chosenLine_->setPen(QPen(style.shown, 3));
  chosenPoints_->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(style.shown, 2.5), Qt::NoBrush, 12));
  QFont small = font();
  small.setPointSizeF(font().pointSizeF() * 0.9);
  hoverLabel_->setFont(small);
  hoverLabel_->setColor(style.text);
  hoverLabel_->setBrush(style.background);
  hoverLabel_->setPen(QPen(style.grid, 1));
  markChosenItem();
}

void LinePlot::markChosenItem() {
  if (!chosenLine_ || pages_->currentWidget() != plot_) return;
  chosenLine_->data()->clear();
  chosenPoints_->data()->clear();
  for (const PlotLine& line : chart_.lines) {
    QCPCurve* into = isOfOneItem(line) ? chosenLine_ : chosenPoints_;
    for (std::size_t i = 0; chosenItem_ >= 0 && i < line.items.size(); ++i)
      if (line.items[i] == chosenItem_) into->addData(line.x[i], line.y[i]);
  }
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void LinePlot::hover(const QPointF& pixel) {
  if (!hoverLabel_ || !itemText_) return;
  const int item = itemAt(pixel);
  plot_->setCursor(item >= 0 ? Qt::PointingHandCursor : Qt::ArrowCursor);
  const QString text = item >= 0 ? itemText_(item) : QString();
  if (text.isEmpty() && !hoverLabel_->visible()) return;
  hoverLabel_->setVisible(!text.isEmpty());
  hoverLabel_->setText(text);
  // On the side where there is room.
  const QRectF frame = plot_->axisRect()->rect();
  const bool flip = pixel.x() > frame.center().x(), below = pixel.y() < frame.center().y();
  hoverLabel_->setPositionAlignment((flip ? Qt::AlignRight : Qt::AlignLeft) | (below ? Qt::AlignTop : Qt::AlignBottom));
  hoverLabel_->position->setCoords(pixel + QPointF(flip ? -12 : 12, below ? 8 : -8));
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

QString LinePlot::hoverText() const { return hoverLabel_ && hoverLabel_->visible() ? hoverLabel_->text() : QString(); }

}  // namespace pliant::plots
