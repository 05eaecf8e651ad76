#pragma once

#include <QWidget>

#include "core/harmonic/motion_chart.hpp"
#include "ui/jobs/motion_session.hpp"

class QComboBox;
class QLabel;

namespace pliant::plots {
class ChartPlot;
}

namespace pliant::panels {

/// Charts of the motion on show: harmonic content, displacement, phase plane, strain, rigidity; with the predicted
/// motion over the solved one while a parameter is dragged.
class MotionPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit MotionPanel(jobs::MotionSession& session, QWidget* parent = nullptr);

  plots::ChartPlot* plot() const { return plot_; }
  QComboBox* kinds() const { return kinds_; }
  /// The place in the period [rad] that the viewport shows.
  void setTau(double tau);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void refresh();
  void exportChart();

  jobs::MotionSession& session_;
  QComboBox* kinds_;
  QLabel* subject_;
  plots::ChartPlot* plot_;
};

}  // namespace pliant::panels
