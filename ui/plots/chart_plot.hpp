#pragma once

#include <QWidget>
#include <optional>

#include "core/harmonic/motion_chart.hpp"

class QCustomPlot;
class QCPItemStraightLine;
class QLabel;
class QStackedLayout;

namespace pliant::plots {

/// Draws a chart of a motion, and a predicted one over it in dashes; a line marks an instant. Wheel and drag zoom and
/// pan, a double click shows everything.
class ChartPlot final : public QWidget {
  Q_OBJECT

 public:
  explicit ChartPlot(QWidget* parent = nullptr);

  /// `predicted` has the series of `solved`, or none.
  void setChart(const harmonic::MotionChart& solved, const std::optional<harmonic::MotionChart>& predicted);
  /// A sentence instead of a chart.
  void setNote(const QString& sentence);
  /// An instant of a chart over time [s].
  void setInstant(double seconds);
  void fit();

  QCustomPlot* plot() const { return plot_; }
  /// What is shown as text, a column a series, SI units in the header.
  QString toCsv() const;

  QSize sizeHint() const override { return {480, 240}; }
  QSize minimumSizeHint() const override { return {240, 140}; }

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void redraw();
  void addSeries(const harmonic::MotionChart& chart, const harmonic::ChartSeries& series, std::size_t index,
                 bool predicted);
  void applyStyle();

  QStackedLayout* pages_;
  QCustomPlot* plot_;
  QLabel* note_;
  QCPItemStraightLine* instant_ = nullptr;
  harmonic::MotionChart chart_;
  std::optional<harmonic::MotionChart> predicted_;
  double xFactor_ = 1;  ///< from SI to what the axes show
  double yFactor_ = 1;
};

}  // namespace pliant::plots
