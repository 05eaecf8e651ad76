#include "ui/panels/modes_panel.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedLayout>
#include <QTableWidget>
#include <QVBoxLayout>
#include <numbers>

namespace pliant::panels {

namespace {

enum Column { hertzColumn, radiansColumn, dampingColumn, residualColumn, columnCount };

/// The largest displacement of the slider's place, as a fraction of the model's extent.
double swingOf(const QSlider& slider) { return 0.3 * slider.value() / slider.maximum(); }

double extentOf(const mechanics::Model& model) {
  const auto nodes =
      model.restPositions.head(model.nodeCount() * model.dimension).reshaped(model.dimension, model.nodeCount());
  const double extent = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
  return extent > 0 ? extent : 1;
}

}  // namespace

ModesPanel::ModesPanel(document::Document& document, jobs::MotionSession& session, QWidget* parent)
    : QWidget(parent), document_(document), session_(session) {
  auto* empty = new QWidget;
  auto* column = new QVBoxLayout(empty);
  note_ = new QLabel;
  note_->setWordWrap(true);
  note_->setAlignment(Qt::AlignCenter);
  run_ = new QPushButton;
  column->addStretch();
  column->addWidget(note_);
  column->addWidget(run_, 0, Qt::AlignHCenter);
  column->addStretch();

  auto* gallery = new QWidget;
  table_ = new QTableWidget(0, columnCount);
  table_->setAccessibleName(tr("Linear modes"));
  table_->setHorizontalHeaderLabels({tr("f [Hz]"), tr("ω [rad/s]"), tr("ζ [%]"), tr("residual")});
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setAlternatingRowColors(true);
  table_->setToolTip(tr("Choose a mode to see it in the viewport; choose it again to leave it"));
  swing_ = new QSlider(Qt::Horizontal);
  swing_->setRange(0, 100);
  swing_->setValue(33);
  swing_->setToolTip(tr("How far the mode swings in the viewport; linear modes have no swing of their own"));
  auto* foot = new QHBoxLayout;
  foot->setContentsMargins(12, 4, 12, 8);
  foot->addWidget(new QLabel(tr("Swing")));
  foot->addWidget(swing_, 1);
  auto* page = new QVBoxLayout(gallery);
  page->setContentsMargins(0, 0, 0, 0);
  page->addWidget(table_, 1);
  page->addLayout(foot);

  choice_ = new StudyChoice(
      document_, [](const document::StudyState& study) { return study.type == "linear_modes"; }, this);
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->setSpacing(0);
  whole->addWidget(choice_);
  pages_ = new QStackedLayout;
  whole->addLayout(pages_, 1);
  pages_->addWidget(empty);
  pages_->addWidget(gallery);

  connect(run_, &QPushButton::clicked, this, [this] { session_.run({choice_->name()}); });
  connect(choice_, &StudyChoice::chosen, this, &ModesPanel::refresh);
  connect(table_, &QTableWidget::cellClicked, this, &ModesPanel::choose);
  connect(table_, &QTableWidget::currentCellChanged, this, [this](int row) {
    if (row >= 0 && played_ >= 0 && row != played_) choose(row);  // by the arrow keys
  });
  connect(swing_, &QSlider::valueChanged, this, &ModesPanel::play);
  connect(&document_, &document::Document::sceneReplaced, this, &ModesPanel::refresh);
  connect(&document_, &document::Document::sceneEdited, this, &ModesPanel::refresh);
  connect(&document_, &document::Document::studyChanged, this, &ModesPanel::refresh);
  refresh();
}

void ModesPanel::refresh() {
  const std::string name = choice_->name();
  const document::StudyState* state = name.empty() ? nullptr : document_.study(name);
  auto result = state && !state->stale ? std::dynamic_pointer_cast<const scene::ModesResult>(state->result) : nullptr;
  if (result && result->modes.modes.empty()) result = nullptr;
  run_->setVisible(!name.empty());
  run_->setText(tr("Run %1").arg(name.c_str()));
  note_->setText(name.empty() ? tr("A study of the type linear_modes finds the natural frequencies and modes. This "
                                   "scene has none; add one in the scene's tree.")
                              : tr("The study “%1” finds the natural frequencies and modes.").arg(name.c_str()));
  pages_->setCurrentIndex(result ? 1 : 0);
  if (result == result_) return;
  if (played_ >= 0) {
    leave();
    Q_EMIT modeLeft();
  }
  result_ = std::move(result);
  const QSignalBlocker block(table_);
  table_->setRowCount(0);
  if (!result_) return;
  const auto& modes = result_->modes.modes;
  table_->setRowCount(static_cast<int>(modes.size()));
  for (int row = 0; row < table_->rowCount(); ++row) {
    const harmonic::LinearMode& mode = modes[static_cast<std::size_t>(row)];
    const auto put = [&](int at, const QString& text) {
      auto* item = new QTableWidgetItem(text);
      item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      table_->setItem(row, at, item);
    };
    put(hertzColumn, QString::number(mode.omega / (2 * std::numbers::pi), 'g', 5));
    put(radiansColumn, QString::number(mode.omega, 'g', 5));
    put(dampingColumn, QString::number(100 * mode.dampingRatio, 'g', 3));
    put(residualColumn, QString::number(mode.residual, 'e', 0));
  }
}

void ModesPanel::choose(int row) {
  if (row == played_) {
    leave();
    Q_EMIT modeLeft();
    return;
  }
  played_ = row;
  play();
}

void ModesPanel::play() {
  if (played_ < 0 || !result_) return;
  const harmonic::LinearMode& mode = result_->modes.modes.at(static_cast<std::size_t>(played_));
  const double swing = swingOf(*swing_) * extentOf(result_->problem->model());
  Q_EMIT modeChosen(
      result_->problem, result_->motion(static_cast<std::size_t>(played_), swing),
      tr("mode %1 of the linear analysis, %2 Hz").arg(played_ + 1).arg(mode.omega / (2 * std::numbers::pi), 0, 'g', 5));
}

void ModesPanel::leave() {
  played_ = -1;
  const QSignalBlocker block(table_);
  table_->setCurrentCell(-1, -1);
  table_->clearSelection();
}

}  // namespace pliant::panels
