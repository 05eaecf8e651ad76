#include <QHBoxLayout>
#include <QVBoxLayout>

#include "ui/plots/response_plot_parts.hpp"

namespace pliant::plots {

void ResponsePlot::build() {
  Parts& p = *parts_;
  p.pages = new QStackedLayout(this);
  p.pages->setContentsMargins(0, 0, 0, 0);

  p.emptyPage = new QWidget;
  p.emptyPage->setAutoFillBackground(true);
  p.emptyPage->setBackgroundRole(QPalette::Base);
  auto* column = new QVBoxLayout(p.emptyPage);
  column->setSpacing(16);
  p.emptyText = new QLabel;
  p.emptyText->setAlignment(Qt::AlignCenter);
  p.emptyText->setWordWrap(true);
  p.emptyAction = new QPushButton;
  p.emptyAction->setObjectName(QStringLiteral("emptyAction"));
  column->addStretch();
  column->addWidget(p.emptyText);
  column->addWidget(p.emptyAction, 0, Qt::AlignHCenter);
  column->addStretch();
  connect(p.emptyAction, &QPushButton::clicked, this, &ResponsePlot::emptyActionTriggered);
  p.pages->addWidget(p.emptyPage);

  p.plot = new QCustomPlot;
  p.plot->setNoAntialiasingOnDrag(false);
  p.plot->setAntialiasedElements(QCP::aeAll);
  p.plot->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  p.plot->setMouseTracking(true);
  p.plot->axisRect()->setMinimumMargins(QMargins(64, 16, 24, 48));
  p.plot->axisRect()->setAutoMargins(QCP::msNone);
  p.plot->axisRect()->setMargins(QMargins(72, 16, 24, 48));
  p.pages->addWidget(p.plot);

  QCPAxis* x = p.plot->xAxis;
  QCPAxis* y = p.plot->yAxis;
  const auto makeCurve = [&] {
    auto* curve = new QCPCurve(x, y);
    curve->setAntialiased(true);
    curve->setSelectable(QCP::stNone);
    return curve;
  };
  QCPLayer* main = p.plot->layer(QStringLiteral("main"));
  p.plot->addLayer(QStringLiteral("markers"), main, QCustomPlot::limAbove);
  p.markers = p.plot->layer(QStringLiteral("markers"));
  p.markers->setMode(QCPLayer::lmBuffered);
  p.earlier = makeCurve();
  p.selected = makeCurve();
  p.unstable = makeCurve();
  p.folds = makeCurve();
  p.peaks = makeCurve();
  p.bifurcations = makeCurve();
  p.step = makeCurve();
  p.shown = makeCurve();
  p.predicted = makeCurve();
  p.predictedCurve = makeCurve();
  p.predictedPeaks = makeCurve();
  p.hover = makeCurve();
  for (QCPCurve* marker : {p.folds, p.peaks, p.bifurcations, p.shown, p.predicted, p.predictedPeaks, p.hover})
    marker->setLineStyle(QCPCurve::lsNone);

  p.plot->legend->setVisible(false);
  p.plot->legend->setSelectableParts(QCPLegend::spNone);
  p.plot->axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignTop | Qt::AlignLeft);
  p.plot->setAutoAddPlottableToLegend(false);

  p.cursor = new QCPItemStraightLine(p.plot);
  p.cursor->setVisible(false);
  const auto makeText = [&](Qt::Alignment alignment) {
    auto* text = new QCPItemText(p.plot);
    text->setPositionAlignment(alignment);
    text->setPadding(QMargins(8, 4, 8, 4));
    text->setVisible(false);
    text->setSelectable(false);
    return text;
  };
  p.cursorLabel = makeText(Qt::AlignTop | Qt::AlignLeft);
  p.cursorLabel->position->setTypeX(QCPItemPosition::ptPlotCoords);
  p.cursorLabel->position->setTypeY(QCPItemPosition::ptAxisRectRatio);
  p.predictedLabel = makeText(Qt::AlignVCenter | Qt::AlignLeft);
  p.hoverLabel = makeText(Qt::AlignBottom | Qt::AlignLeft);
  p.hoverLabel->position->setType(QCPItemPosition::ptAbsolute);

  p.chip = new QPushButton(p.plot);
  p.chip->setObjectName(QStringLiteral("chip"));
  p.chip->setFocusPolicy(Qt::NoFocus);
  p.chip->hide();
  connect(p.chip, &QPushButton::clicked, this, [this] {
    if (parts_->stale) Q_EMIT updateRequested();
  });

  connect(p.plot, &QCustomPlot::mousePress, this, &ResponsePlot::press);
  connect(p.plot, &QCustomPlot::mouseMove, this, &ResponsePlot::move);
  connect(p.plot, &QCustomPlot::mouseRelease, this, &ResponsePlot::release);
  connect(p.plot, &QCustomPlot::mouseDoubleClick, this, &ResponsePlot::fit);
  connect(p.plot, &QCustomPlot::mouseWheel, this, [this] { parts_->zoomed = true; });
  for (QCPLayerable* marker :
       {static_cast<QCPLayerable*>(p.predictedCurve), static_cast<QCPLayerable*>(p.predictedPeaks),
        static_cast<QCPLayerable*>(p.step), static_cast<QCPLayerable*>(p.shown),
        static_cast<QCPLayerable*>(p.predicted), static_cast<QCPLayerable*>(p.hover),
        static_cast<QCPLayerable*>(p.cursor), static_cast<QCPLayerable*>(p.cursorLabel),
        static_cast<QCPLayerable*>(p.predictedLabel), static_cast<QCPLayerable*>(p.hoverLabel)})
    marker->setLayer(p.markers);
  connect(p.plot, &QCustomPlot::beforeReplot, this, &ResponsePlot::placeLabels);
  connect(p.plot, &QCustomPlot::afterReplot, this, [this] {
    parts_->outdated = false;
    parts_->drawnRanges = {parts_->plot->xAxis->range(), parts_->plot->yAxis->range()};
  });
}

void ResponsePlot::applyStyle() {
  Parts& p = *parts_;
  p.style = plotStyle(palette());
  const PlotStyle& s = p.style;
  p.plot->setBackground(s.background);
  QFont small = font();
  small.setPointSizeF(font().pointSizeF() * 0.9);
  for (QCPAxis* axis : {p.plot->xAxis, p.plot->yAxis}) {
    axis->setBasePen(QPen(s.mutedText, 1));
    axis->setTickPen(QPen(s.mutedText, 1));
    axis->setSubTicks(false);
    axis->setTickLabelColor(s.mutedText);
    axis->setLabelColor(s.text);
    axis->setTickLabelFont(small);
    axis->setLabelFont(font());
    axis->setLabelPadding(6);
    axis->grid()->setPen(QPen(s.grid, 1));
    axis->grid()->setZeroLinePen(Qt::NoPen);
    axis->setNumberFormat(QStringLiteral("gb"));
    axis->setNumberPrecision(5);
  }
  p.plot->legend->setFont(small);
  p.plot->legend->setTextColor(s.text);
  QColor legend = s.background;
  legend.setAlpha(224);
  p.plot->legend->setBrush(legend);
  p.plot->legend->setBorderPen(Qt::NoPen);
  p.plot->xAxis->ticker()->setTickCount(8);

  const auto marker = [](QCPScatterStyle::ScatterShape shape, const QPen& pen, const QBrush& brush, double size) {
    return QCPScatterStyle(shape, pen, brush, size);
  };
  p.earlier->setPen(QPen(s.stale, 1.5));
  p.folds->setScatterStyle(marker(QCPScatterStyle::ssDiamond, QPen(s.mutedText, 1.5), s.background, 8));
  p.bifurcations->setScatterStyle(marker(QCPScatterStyle::ssSquare, QPen(s.warning, 1.5), s.background, 8));
  p.peaks->setScatterStyle(marker(QCPScatterStyle::ssTriangle, QPen(s.text, 1.5), s.text, 8));
  p.shown->setScatterStyle(marker(QCPScatterStyle::ssCircle, QPen(s.background, 2), s.shown, 13));
  p.predicted->setScatterStyle(
      marker(QCPScatterStyle::ssCircle, QPen(s.prediction, 2, Qt::SolidLine), s.background, 12));
  p.predictedCurve->setPen(QPen(s.prediction, 1.5, Qt::DashLine));
  p.predictedPeaks->setScatterStyle(marker(QCPScatterStyle::ssTriangle, QPen(s.prediction, 1.5), s.background, 8));
  p.hover->setScatterStyle(marker(QCPScatterStyle::ssCircle, QPen(s.curve, 1.5), s.background, 8));
  p.step->setPen(QPen(s.prediction, 1.5, Qt::DashLine));
  p.cursor->setPen(QPen(s.shown, 1.5));
  QColor box = s.background;
  box.setAlpha(232);
  for (QCPItemText* text : {p.cursorLabel, p.predictedLabel, p.hoverLabel}) {
    text->setFont(small);
    text->setColor(s.text);
    text->setBrush(box);
    text->setPen(Qt::NoPen);
  }
  p.hoverLabel->setPen(QPen(s.grid, 1));
  p.chip->setFont(small);
  redrawCurves();
  redrawMarkers();
  updateChip();
}

void ResponsePlot::updateChip() {
  Parts& p = *parts_;
  using document::StudyStatus;
  QString text;
  QColor color = p.style.mutedText;
  const ResponseCurve* curve = p.curve();
  const bool any = curve && !curve->omega.empty();
  const QString where = any ? formatFrequency(curve->omega.back(), p.hertz) : QString();
  switch (p.status) {
    case StudyStatus::running: text = tr("Tracing … %1").arg(where); break;
    case StudyStatus::waiting: text = tr("Waiting to be traced"); break;
    case StudyStatus::cancelled: text = tr("Cancelled at %1").arg(where); break;
    case StudyStatus::failed: text = any ? tr("Stopped at %1").arg(where) : tr("Failed"); break;
    default: break;
  }
  if (p.status == StudyStatus::cancelled || p.status == StudyStatus::failed) color = p.style.warning;
  if (p.stale && p.status != StudyStatus::running && p.status != StudyStatus::waiting) {
    text = text.isEmpty() ? tr("Stale  ·  Update") : tr("%1  ·  stale  ·  Update").arg(text);
    color = p.style.warning;
  }
  p.chip->setText(text);
  p.chip->setToolTip(p.stale ? tr("The scene has changed since this curve was traced. Click to trace it again (U).")
                             : p.note);
  p.chip->setStyleSheet(
      QStringLiteral("QPushButton { color: %1; background: %2; border: 1px solid %1; border-radius: 12px; "
                     "padding: 3px 12px; }")
          .arg(color.name(), p.style.background.name()));
  p.chip->setCursor(p.stale ? Qt::PointingHandCursor : Qt::ArrowCursor);
  p.chip->setVisible(!text.isEmpty());
  p.chip->adjustSize();
  p.chip->move(p.plot->width() - 32 - p.chip->width(), 20);
}

}  // namespace pliant::plots
