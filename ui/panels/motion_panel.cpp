#include "ui/panels/motion_panel.hpp"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QMessageBox>
#include <QToolButton>

#include "core/base/error.hpp"
#include "ui/plots/chart_plot.hpp"
#include "ui/plots/plot_export.hpp"

namespace pliant::panels {

MotionPanel::MotionPanel(jobs::MotionSession& session, QWidget* parent) : QWidget(parent), session_(session) {
  kinds_ = new QComboBox;
  kinds_->setFixedHeight(28);
  kinds_->setAccessibleName(tr("Kind of chart"));
  for (const harmonic::MotionChartKind& kind : harmonic::motionChartKinds()) {
    kinds_->addItem(QString::fromStdString(kind.title));
    kinds_->setItemData(kinds_->count() - 1, QString::fromStdString(kind.description), Qt::ToolTipRole);
  }
  subject_ = new QLabel;
  auto* exporter = new QToolButton;
  exporter->setText(tr("Export…"));
  exporter->setFixedHeight(28);
  exporter->setToolTip(tr("Write the chart as PDF, SVG or PNG, or its numbers as CSV"));
  plot_ = new plots::ChartPlot;
  auto* head = new QHBoxLayout;
  head->setContentsMargins(16, 4, 16, 4);
  head->setSpacing(8);
  head->addWidget(kinds_);
  head->addWidget(subject_);
  head->addStretch();
  head->addWidget(exporter);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(plot_, 1);
  connect(kinds_, &QComboBox::currentIndexChanged, this, &MotionPanel::refresh);
  connect(exporter, &QToolButton::clicked, this, &MotionPanel::exportChart);
  connect(&session_, &jobs::MotionSession::shownChanged, this, &MotionPanel::refresh);
  connect(&session_, &jobs::MotionSession::predictionChanged, this, &MotionPanel::refresh);
  connect(&session_, &jobs::MotionSession::nodeChanged, this, &MotionPanel::refresh);
  refresh();
}

void MotionPanel::setTau(double tau) {
  const auto& shown = session_.shown();
  if (isVisible() && shown) plot_->setInstant(shown->problem->drivePeriods() * tau / shown->motion.omega);
}

void MotionPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void MotionPanel::refresh() {
  if (!isVisible()) return;
  const auto& shown = session_.shown();
  const harmonic::MotionChartKind& kind = harmonic::motionChartKinds().at(kinds_->currentIndex());
  kinds_->setToolTip(QString::fromStdString(kind.description));
  if (!shown) {
    subject_->clear();
    plot_->setNote(tr("Run a study to see charts of its motion."));
    return;
  }
  const mechanics::Model& model = shown->problem->model();
  QString subject;
  if (kind.ofNode) {
    subject = tr("of node %1").arg(session_.node());
    for (const mechanics::Probe& probe : model.probes)
      if (probe.node == session_.node()) subject = tr("of %1").arg(QString::fromStdString(probe.name));
  }
  subject_->setText(subject);
  const double omega = shown->motion.omega;
  std::optional<harmonic::MotionChart> predicted;
  if (session_.prediction()) predicted = kind.make(*shown->problem, *session_.prediction(), omega, session_.node());
  plot_->setChart(kind.make(*shown->problem, shown->motion.z, omega, session_.node()), predicted);
}

void MotionPanel::exportChart() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Export the chart"), {}, plots::plotExportFilters());
  if (file.isEmpty()) return;
  try {
    plots::exportPlot(*plot_->plot(), file, [this] { return plot_->toCsv(); });
  } catch (const base::InputError& error) {
    QMessageBox::warning(this, tr("Export"), QString::fromStdString(error.problem()));
  }
}

}  // namespace pliant::panels
