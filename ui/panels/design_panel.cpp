#include "ui/panels/design_panel.hpp"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedLayout>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/designed_scene.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {

enum Column { nameColumn, beforeColumn, shownColumn, rangeColumn, columnCount };

QString quantity(double value, const base::Dimension& dimension) {
  return QString::fromStdString(rounded(value, dimension).text);
}

const mechanics::DesignParameter& parameterOf(const scene::DesignResult& result, int row) {
  return *result.before().model->parameters[static_cast<std::size_t>(result.parameters[static_cast<std::size_t>(row)])];
}

/// "wing tip 78.1 mm → 300 mm (×3.85)", a probe each.
QString gainText(const scene::DesignResult& result, const harmonic::DesignIterate& design) {
  QStringList list;
  const auto& probes = result.before().model->probes;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const double before = result.before().amplitudes[i].pathLength, now = design.amplitudes[i].pathLength;
    list += QObject::tr("%1 %2 → %3 (×%4)")
                .arg(QString::fromStdString(probes[i].name), plots::formatLength(before), plots::formatLength(now))
                .arg(now / before, 0, 'f', 2);
  }
  return list.join(QStringLiteral(",  "));
}

}  // namespace

DesignPanel::DesignPanel(document::Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  pages_ = new QStackedLayout(this);
  auto* empty = new QWidget;
  auto* emptyColumn = new QVBoxLayout(empty);
  note_ = new QLabel;
  note_->setAlignment(Qt::AlignCenter);
  note_->setWordWrap(true);
  run_ = new QPushButton(tr("Design"));
  emptyColumn->addStretch();
  emptyColumn->addWidget(note_);
  emptyColumn->addWidget(run_, 0, Qt::AlignHCenter);
  emptyColumn->addStretch();
  pages_->addWidget(empty);

  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(6, 6, 6, 6);
  summary_ = new QLabel;
  summary_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  summary_->setWordWrap(true);
  column->addWidget(summary_);
  auto* middle = new QHBoxLayout;
  plot_ = new plots::LinePlot;
  table_ = new QTableWidget(0, columnCount);
  table_->setAccessibleName(tr("Parameters of the design"));
  table_->setHorizontalHeaderLabels({tr("parameter"), tr("before"), tr("this design"), tr("of its range")});
  table_->horizontalHeaderItem(rangeColumn)->setToolTip(tr("0 %: at its lower bound, 100 %: at its upper bound"));
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(nameColumn, QHeaderView::Stretch);
  table_->verticalHeader()->hide();
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setFocusPolicy(Qt::NoFocus);
  table_->setAlternatingRowColors(true);
  table_->setShowGrid(false);
  middle->addWidget(plot_, 1);
  middle->addWidget(table_, 1);
  column->addLayout(middle, 1);
  auto* bottom = new QHBoxLayout;
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setAccessibleName(tr("Design on show"));
  slider_->setToolTip(tr("From the first design to the best; its motion plays in the viewport"));
  position_ = new QLabel;
  take_ = new QPushButton(tr("Take This Design"));
  take_->setToolTip(tr("Puts its parameters into the scene; undo brings the old ones back"));
  bottom->addWidget(new QLabel(tr("Design")));
  bottom->addWidget(slider_, 1);
  bottom->addWidget(position_);
  bottom->addWidget(take_);
  column->addLayout(bottom);
  pages_->addWidget(page);

  connect(run_, &QPushButton::clicked, this, [this] {
    if (const auto* own = study()) Q_EMIT runRequested(own->name);
  });
  connect(slider_, &QSlider::valueChanged, this, &DesignPanel::showDesign);
  connect(plot_, &plots::LinePlot::placeChosen, this,
          [this](double x) { slider_->setValue(static_cast<int>(std::lround(x))); });
  connect(take_, &QPushButton::clicked, this, &DesignPanel::takeDesign);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    result_.reset();
    shown_ = -1;
    refresh();
  });
  connect(&document_, &document::Document::sceneEdited, this, &DesignPanel::refresh);
  connect(&document_, &document::Document::studyChanged, this, &DesignPanel::follow);
  refresh();
}

bool DesignPanel::hasDesign(const document::Document& document) {
  return std::any_of(document.studies().begin(), document.studies().end(),
                     [](const document::StudyState& study) { return study.type == "design"; });
}

const document::StudyState* DesignPanel::study() const {
  for (const document::StudyState& each : document_.studies())
    if (each.type == "design") return &each;
  return nullptr;
}

QString DesignPanel::summary() const { return summary_->text(); }

void DesignPanel::follow(const std::string& name) {
  const document::StudyState* own = study();
  if (!own || own->name != name) return;
  const auto result = std::dynamic_pointer_cast<const scene::DesignResult>(own->result);
  const bool began = result && !result->design.history.empty() && own->status == document::StudyStatus::running &&
                     (!result_ || result_->design.history.empty());
  if (result != result_ && result) {
    result_ = result;
    if (result->design.history.size() <= 1) follows_ = true;
  }
  refresh();
  if (began) Q_EMIT designsGrow();
}

void DesignPanel::refresh() {
  const document::StudyState* own = study();
  const bool any = own && result_ && !result_->design.history.empty();
  pages_->setCurrentIndex(any ? 1 : 0);
  run_->setVisible(own);
  if (!own) {
    note_->setText(
        tr("This scene has no study of the type design. Add one in the tree of the scene: what may change, "
           "and what is to be reached."));
    return;
  }
  if (!any) {
    const bool running = own->status == document::StudyStatus::running;
    run_->setEnabled(!running && own->status != document::StudyStatus::waiting);
    note_->setText(running                   ? tr("The first design's motion is being found.")
                   : !own->message.isEmpty() ? own->message
                                             : tr("%1 has not been run.").arg(QString::fromStdString(own->name)));
    return;
  }
  const auto& history = result_->design.history;
  plots::PlotLine line;
  line.dots = true;
  for (std::size_t i = 0; i < history.size(); ++i) {
    line.x.push_back(static_cast<double>(i));
    line.y.push_back(history[i].objective);
  }
  plot_->setChart({.xLabel = tr("design"), .yLabel = tr("objective"), .lines = {std::move(line)}});
  const int last = static_cast<int>(history.size()) - 1;
  {
    const QSignalBlocker block(slider_);
    slider_->setRange(0, last);
  }
  showDesign(follows_ || shown_ < 0 ? last : std::min(shown_, last));
}

void DesignPanel::showDesign(int index) {
  if (!result_ || result_->design.history.empty()) return;
  const auto& history = result_->design.history;
  const int last = static_cast<int>(history.size()) - 1;
  const bool another = index != shown_ || !follows_;
  shown_ = std::clamp(index, 0, last);
  follows_ = shown_ == last;
  {
    const QSignalBlocker block(slider_);
    slider_->setValue(shown_);
  }
  const harmonic::DesignIterate& design = history[static_cast<std::size_t>(shown_)];
  plot_->setInstant(shown_);
  position_->setText(tr("%1 of %2").arg(shown_).arg(last));
  const document::StudyState* own = study();
  QString text = gainText(*result_, design);
  if (own && own->stale) text += tr("  –  the scene has changed since");
  summary_->setText(text);
  take_->setEnabled(own && own->status != document::StudyStatus::running);
  fillTable();
  if (another && isVisible()) play();
}

void DesignPanel::fillTable() {
  const harmonic::DesignIterate& design = result_->design.history[static_cast<std::size_t>(shown_)];
  const auto count = static_cast<int>(result_->parameters.size());
  table_->setRowCount(count);
  const auto put = [&](int row, int column, const QString& text) {
    auto* item = new QTableWidgetItem(text);
    item->setTextAlignment((column == nameColumn ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    table_->setItem(row, column, item);
  };
  const mechanics::Model& model = *result_->before().model;
  for (int row = 0; row < count; ++row) {
    const mechanics::DesignParameter& parameter = parameterOf(*result_, row);
    const double low = parameter.minimum(model), high = parameter.maximum(model), now = design.values[row];
    put(row, nameColumn, QString::fromStdString(parameter.name()));
    put(row, beforeColumn, quantity(result_->before().values[row], parameter.dimension()));
    put(row, shownColumn, quantity(now, parameter.dimension()));
    put(row, rangeColumn, QStringLiteral("%1 %").arg(100 * (now - low) / (high - low), 0, 'f', 0));
  }
}

void DesignPanel::play() {
  const harmonic::DesignIterate& design = result_->design.history[static_cast<std::size_t>(shown_)];
  const auto motion = result_->motionOf(design);
  const document::StudyState* own = study();
  Q_EMIT designChosen(motion->problem, design.z,
                      tr("%1: %2 of %3")
                          .arg(own ? QString::fromStdString(own->name) : QString())
                          .arg(shown_)
                          .arg(result_->design.history.size() - 1));
}

void DesignPanel::takeDesign() {
  if (!result_ || shown_ < 0 || document_.isEmpty()) return;
  try {
    const scene::Json json =
        scene::designedScene(document_.scene(), *result_, result_->design.history[static_cast<std::size_t>(shown_)]);
    document_.setValue("", json, tr("Take design %1").arg(shown_));
    Q_EMIT designLeft();
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

}  // namespace pliant::panels
