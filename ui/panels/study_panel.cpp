#include "ui/panels/study_panel.hpp"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QStackedLayout>
#include <QToolButton>
#include <algorithm>

#include "core/base/error.hpp"
#include "ui/plots/plot_export.hpp"

namespace pliant::panels {

namespace {

constexpr int controlHeight = 28;

}  // namespace

StudyPanel::StudyPanel(document::Document& document, std::vector<std::string> types, QWidget* parent)
    : QWidget(parent), document_(document), types_(std::move(types)) {
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

  studies_ = new StudyChoice(
      document_, [this](const document::StudyState& study) { return shows(study.type); }, this);
  studies_->setFixedHeight(controlHeight);
  stale_ = new QLabel(tr("inputs have changed since this was computed"));
  head_ = new QHBoxLayout;
  head_->setContentsMargins(16, 4, 16, 4);
  head_->setSpacing(8);
  head_->addWidget(studies_);
  switches_ = new QHBoxLayout;
  switches_->setSpacing(12);
  head_->addLayout(switches_);
  head_->addWidget(stale_);
  head_->addStretch();
  shown_ = new QWidget;
  auto* column = new QVBoxLayout(shown_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head_);
  pages_ = new QStackedLayout(this);
  pages_->addWidget(empty);
  pages_->addWidget(shown_);
}

void StudyPanel::setPlot(QWidget* plot) {
  connect(addButton(tr("Export…"), tr("Write the plot as PDF, SVG or PNG, or its numbers as CSV")),
          &QToolButton::clicked, this, &StudyPanel::chooseExport);
  static_cast<QVBoxLayout*>(shown_->layout())->addWidget(plot, 1);
  connect(run_, &QPushButton::clicked, this, [this] { Q_EMIT runRequested(study()); });
  connect(studies_, &QComboBox::activated, this, [this] {
    refresh();
    Q_EMIT studyChosen(study());
  });
  connect(&document_, &document::Document::sceneReplaced, this, &StudyPanel::refresh);
  connect(&document_, &document::Document::sceneEdited, this, &StudyPanel::refresh);
  connect(&document_, &document::Document::studyChanged, this, [this](const std::string& name) {
    if (name == study()) refresh();
  });
  refresh();
}

QToolButton* StudyPanel::addButton(const QString& text, const QString& tooltip) {
  auto* made = new QToolButton;
  made->setText(text);
  made->setToolTip(tooltip);
  made->setFixedHeight(controlHeight);
  head_->addWidget(made);
  return made;
}

bool StudyPanel::isBusy(const document::StudyState& study) {
  return study.status == document::StudyStatus::running || study.status == document::StudyStatus::waiting;
}

bool StudyPanel::shows(const std::string& type) const { return std::ranges::find(types_, type) != types_.end(); }

void StudyPanel::setStudy(const std::string& name) {
  studies_->choose(name);
  refresh();
}

void StudyPanel::refresh() {
  const document::StudyState* state = document_.study(study());
  const bool busy = state && isBusy(*state);
  run_->setVisible(state != nullptr);
  run_->setEnabled(!busy);
  run_->setText(tr("Run %1").arg(studies_->currentText()));
  note_->setText(!state ? absentNote() : busy ? tr("The result is on its way.") : waitingNote(studies_->currentText()));
  pages_->setCurrentIndex(present(state) ? 1 : 0);
  stale_->setVisible(state && state->stale);
}

void StudyPanel::chooseExport() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Export the plot"), {}, plots::plotExportFilters());
  if (!file.isEmpty()) attempt([&] { exportTo(file); });
}

void StudyPanel::attempt(const std::function<void()>& act) {
  try {
    act();
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

}  // namespace pliant::panels
