#include "ui/panels/size_panel.hpp"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedLayout>
#include <QToolButton>

#include "core/base/error.hpp"
#include "core/scene/bending_chart.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/plot_export.hpp"

namespace pliant::panels {

namespace {

constexpr int controlHeight = 28;

plots::LineChart chartOf(const scene::BendingSizeResult& result) {
  const scene::ResultChart chart = scene::bendingSizeChart(result);
  plots::LineChart lines;
  lines.xLabel = QString::fromStdString(chart.xLabel);
  lines.yLabel = QString::fromStdString(chart.yLabel);
  lines.fromZero = true;
  for (const scene::ResultSeries& series : chart.series) {
    if (series.mark == scene::ResultSeries::Mark::points) continue;  // lines mark theirs here
    plots::PlotLine line;
    line.name = QString::fromStdString(series.name);
    line.x = series.x;
    line.y = series.y;
    line.group = series.group;
    line.dashed = series.mark == scene::ResultSeries::Mark::dashedLine;
    line.dots = true;
    lines.lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

SizePanel::SizePanel(document::Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  auto* empty = new QWidget;
  auto* middle = new QVBoxLayout(empty);
  note_ = new QLabel;
  note_->setWordWrap(true);
  note_->setAlignment(Qt::AlignCenter);
  run_ = new QPushButton;
  middle->addStretch();
  middle->addWidget(note_);
  middle->addWidget(run_, 0, Qt::AlignHCenter);
  middle->addStretch();

  auto* shown = new QWidget;
  studies_ = new QComboBox;
  studies_->setToolTip(tr("Whose limits are shown"));
  studies_->setFixedHeight(controlHeight);
  stale_ = new QLabel(tr("inputs have changed since this was computed"));
  auto* exporter = new QToolButton;
  exporter->setText(tr("Export…"));
  exporter->setToolTip(tr("Write the plot as PDF, SVG or PNG, or its numbers as CSV"));
  exporter->setFixedHeight(controlHeight);
  connect(exporter, &QToolButton::clicked, this, &SizePanel::chooseExport);
  auto* head = new QHBoxLayout;
  head->setContentsMargins(16, 4, 16, 4);
  head->setSpacing(8);
  head->addWidget(studies_);
  head->addWidget(stale_);
  head->addStretch();
  head->addWidget(exporter);
  plot_ = new plots::LinePlot;
  plot_->setAccessibleName(tr("Limits of curvature over the size of the patch"));
  auto* column = new QVBoxLayout(shown);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(plot_, 1);
  pages_ = new QStackedLayout(this);
  pages_->addWidget(empty);
  pages_->addWidget(shown);

  connect(run_, &QPushButton::clicked, this, [this] { Q_EMIT runRequested(study()); });
  connect(studies_, &QComboBox::activated, this, &SizePanel::refresh);
  const auto renew = [this] {
    fillStudies();
    refresh();
  };
  connect(&document_, &document::Document::sceneReplaced, this, renew);
  connect(&document_, &document::Document::sceneEdited, this, renew);
  connect(&document_, &document::Document::studyChanged, this, [this](const std::string& name) {
    if (name == study()) refresh();
  });
  fillStudies();
  refresh();
}

std::string SizePanel::study() const { return studies_->currentText().toStdString(); }

void SizePanel::setStudy(const std::string& name) {
  const int index = studies_->findText(QString::fromStdString(name));
  if (index < 0) return;
  studies_->setCurrentIndex(index);
  refresh();
}

void SizePanel::fillStudies() {
  const QString before = studies_->currentText();
  studies_->clear();
  for (const document::StudyState& study : document_.studies())
    if (study.type == shownType) studies_->addItem(QString::fromStdString(study.name));
  studies_->setCurrentIndex(std::max(0, studies_->findText(before)));
  studies_->setVisible(studies_->count() > 1);
}

void SizePanel::refresh() {
  const document::StudyState* state = document_.study(study());
  const auto result = state ? std::dynamic_pointer_cast<const scene::BendingSizeResult>(state->result) : nullptr;
  const bool busy =
      state && (state->status == document::StudyStatus::running || state->status == document::StudyStatus::waiting);
  run_->setVisible(state != nullptr);
  run_->setEnabled(!busy);
  run_->setText(tr("Run %1").arg(studies_->currentText()));
  note_->setText(!state ? tr("A study of the type bending_size finds how far patches of several sizes bend. This scene "
                             "has none; add one in the scene's tree.")
                 : busy
                     ? tr("The first limits are on their way.")
                     : tr("The study “%1” finds how far patches of several sizes bend.").arg(studies_->currentText()));
  if (result != result_) {
    result_ = result;
    plots::LineChart chart = result ? chartOf(*result) : plots::LineChart();
    const bool any = !chart.lines.empty();
    if (any)
      plot_->setChart(std::move(chart));
    else
      plot_->setNote(busy ? tr("The first limits are on their way.") : tr("No limit: all of these patches fold."));
  }
  pages_->setCurrentIndex(result ? 1 : 0);
  stale_->setVisible(state && state->stale);
}

void SizePanel::exportTo(const QString& file) {
  plots::exportPlot(*plot_->plot(), file, [this] { return plot_->toCsv(); });
}

void SizePanel::chooseExport() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Export the plot"), {}, plots::plotExportFilters());
  if (file.isEmpty()) return;
  try {
    exportTo(file);
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

}  // namespace pliant::panels
