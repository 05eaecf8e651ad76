#include "ui/panels/energy_panel.hpp"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>

#include <algorithm>

#include "core/base/error.hpp"
#include "ui/plots/plot_export.hpp"

namespace pliant::panels {

std::vector<ClothRun> clothRuns(const document::Document& document, const std::string& first) {
  std::vector<ClothRun> runs;
  int group = -1;
  for (const document::StudyState& study : document.studies()) {
    if (!document::isClothStudy(study.type)) continue;
    ++group;
    if (!study.result || study.result->kind() != "cloth") continue;
    ClothRun run{QString::fromStdString(study.name), std::static_pointer_cast<const scene::ClothResult>(study.result),
                 group, study.type != "cloth_motion"};
    if (run.result->steps.empty()) continue;
    runs.insert(study.name == first ? runs.begin() : runs.end(), std::move(run));
  }
  return runs;
}

EnergyPanel::EnergyPanel(document::Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  studies_ = new QComboBox;
  studies_->setToolTip(tr("Which study is in the viewport"));
  studies_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  kinds_ = new QComboBox;
  kinds_->setAccessibleName(tr("Kind of chart"));
  for (const ClothChartKind& each : clothChartKinds()) {
    kinds_->addItem(each.title);
    kinds_->setItemData(kinds_->count() - 1, each.description, Qt::ToolTipRole);
  }
  compare_ = new QToolButton;
  compare_->setText(tr("Compare"));
  compare_->setCheckable(true);
  compare_->setChecked(true);
  compare_->setToolTip(tr("Show the other studies in the same chart"));
  auto* exporter = new QToolButton;
  exporter->setText(tr("Export…"));
  exporter->setToolTip(tr("Write the chart as PDF, SVG or PNG, or its numbers as CSV"));
  plot_ = new plots::LinePlot;
  auto* head = new QHBoxLayout;
  head->setContentsMargins(16, 4, 16, 4);
  head->setSpacing(8);
  for (QWidget* widget : std::initializer_list<QWidget*>{studies_, kinds_, compare_, exporter})
    widget->setFixedHeight(28);
  head->addWidget(studies_);
  head->addWidget(kinds_);
  head->addStretch();
  head->addWidget(compare_);
  head->addWidget(exporter);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(plot_, 1);

  connect(studies_, &QComboBox::activated, this, [this] {
    refresh();
    Q_EMIT studyChosen(studies_->currentText().toStdString());
  });
  connect(kinds_, &QComboBox::currentIndexChanged, this, &EnergyPanel::refresh);
  connect(compare_, &QToolButton::toggled, this, &EnergyPanel::refresh);
  connect(exporter, &QToolButton::clicked, this, &EnergyPanel::exportChart);
  connect(plot_, &plots::LinePlot::placeChosen, this, [this](double x) {
    if (kind().overTime) Q_EMIT instantChosen(x);
  });
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    fillStudies();
    refresh();
  });
  connect(&document_, &document::Document::sceneEdited, this, &EnergyPanel::fillStudies);
  connect(&document_, &document::Document::studyChanged, this, &EnergyPanel::refresh);
  fillStudies();
  refresh();
}

const ClothChartKind& EnergyPanel::kind() const {
  return clothChartKinds().at(static_cast<std::size_t>(kinds_->currentIndex()));
}

void EnergyPanel::fillStudies() {
  const QSignalBlocker block(studies_);
  const QString before = studies_->currentText();
  studies_->clear();
  for (const document::StudyState& study : document_.studies())
    if (document::isClothStudy(study.type)) studies_->addItem(QString::fromStdString(study.name));
  studies_->setCurrentIndex(std::max(0, studies_->findText(before)));
  studies_->setVisible(studies_->count() > 1);
}

void EnergyPanel::setStudy(const std::string& name) {
  const int index = studies_->findText(QString::fromStdString(name));
  if (index < 0 || index == studies_->currentIndex()) return;
  studies_->setCurrentIndex(index);
  refresh();
}

void EnergyPanel::setInstant(double seconds) {
  if (isVisible() && kind().overTime) plot_->setInstant(seconds);
}

void EnergyPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void EnergyPanel::refresh() {
  if (!isVisible()) return;
  kinds_->setToolTip(kind().description);
  compare_->setVisible(kind().ofMany && studies_->count() > 1);
  const std::string study = studies_->currentText().toStdString();
  std::vector<ClothRun> runs = clothRuns(document_, study);
  const bool own = !runs.empty() && runs[0].name.toStdString() == study;
  if (!kind().ofMany || !compare_->isChecked()) {
    if (!own) runs.clear();
    runs.resize(std::min<std::size_t>(runs.size(), 1));
  }
  if (runs.empty()) {
    plot_->setNote(studies_->count() == 0
                       ? tr("A study of the type cloth_motion fills this chart. This scene has none.")
                       : tr("Run the study “%1” to see how its energy changes.").arg(studies_->currentText()));
    return;
  }
  const plots::LineChart chart = kind().make(runs);
  const bool any =
      std::any_of(chart.lines.begin(), chart.lines.end(), [](const auto& line) { return !line.x.empty(); });
  if (any)
    plot_->setChart(chart);
  else
    plot_->setNote(tr("This study has nothing for this chart."));
}

void EnergyPanel::exportChart() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Export the chart"), {}, plots::plotExportFilters());
  if (file.isEmpty()) return;
  try {
    plots::exportPlot(*plot_->plot(), file, [this] { return plot_->toCsv(); });
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

}  // namespace pliant::panels
