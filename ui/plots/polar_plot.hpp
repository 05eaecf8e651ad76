#pragma once

#include <QPen>
#include <QWidget>
#include <optional>

#include "core/scene/polar_curves.hpp"
#include "ui/plots/measured_table.hpp"
#include "ui/plots/polar_circle.hpp"

class QPainter;

namespace pliant::plots {

/// Any number of curves over the direction in one polar plot (thesis Figs. 4.6, 4.7), with measured values and their
/// error bars. Under the pointer the nearest computed direction is read out.
class PolarPlot final : public QWidget {
  Q_OBJECT

 public:
  explicit PolarPlot(QWidget* parent = nullptr);

  void setCurves(scene::PolarCurves curves);
  const scene::PolarCurves& curves() const { return curves_; }
  void setCurveVisible(int curve, bool visible);
  bool isCurveVisible(int curve) const;
  QColor curveColor(int curve) const;
  /// Takes the place of what was measured of the same quantity; those whose quantity names no curve are not drawn.
  void addMeasured(MeasuredTable measured);
  void clearMeasured();
  const std::vector<MeasuredTable>& measured() const { return measured_; }
  void setEmptyText(const QString& text);
  /// Greys the curves: inputs have changed since.
  void setStale(bool stale);

  const PolarCircle& scale() const { return scale_; }
  /// What is read out at a place; none where no curve is near.
  struct Readout {
    int curve = -1;
    double angle = 0, value = 0;
    QString text;  ///< such as "30°: stretch 8.317 % (at most 0.004 % more)"
  };
  std::optional<Readout> readoutAt(const QPointF& place) const;

  /// All numbers that are drawn: a row a direction, a column a curve.
  QString toCsv() const;
  /// PDF, SVG, PNG or CSV, by the extension. Throws base::InputError.
  void exportTo(const QString& file);

  QSize sizeHint() const override { return {320, 320}; }
  QSize minimumSizeHint() const override { return {200, 200}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;

 private:
  void layOut();
  void paint(QPainter& painter, bool withReadout) const;
  void paintGrid(QPainter& painter) const;
  void paintGridLabels(QPainter& painter) const;
  void paintCurves(QPainter& painter) const;
  void paintMeasured(QPainter& painter) const;
  void paintLegend(QPainter& painter) const;
  void paintReadout(QPainter& painter) const;
  struct LegendLine {
    QString text;
    QPen pen;
  };
  std::vector<LegendLine> legend() const;

  scene::PolarCurves curves_;
  std::vector<bool> hidden_;
  std::vector<MeasuredTable> measured_;
  PolarCircle scale_;
  QString emptyText_;
  bool stale_ = false;
  std::optional<Readout> readout_;
};

}  // namespace pliant::plots
