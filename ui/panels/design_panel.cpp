#include "ui/panels/design_panel.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QSpinBox>
#include <QStackedLayout>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/designed_scene.hpp"
#include "ui/panels/study_choice.hpp"
#include "ui/panels/target_bar.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/line_plot.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {

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
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->setSpacing(0);
  targets_ = new TargetBar;
  choice_ = new StudyChoice(
      document_, [](const document::StudyState& study) { return study.type == "design"; }, this);
  auto* head = new QHBoxLayout;
  head->setContentsMargins(0, 0, 6, 0);
  head->addWidget(targets_, 1);
  head->addWidget(choice_);
  whole->addLayout(head);
  pages_ = new QStackedLayout;
  whole->addLayout(pages_, 1);
  pages_->addWidget(makeEmptyPage());
  pages_->addWidget(makePage());
  connect(run_, &QPushButton::clicked, this, [this] {
    if (const auto* own = choice_->study()) Q_EMIT runRequested(own->name);
  });
  connect(slider_, &QSlider::valueChanged, this, &DesignPanel::showDesign);
  connect(
      plot_, &plots::LinePlot::placeChosen, this, [this](double x) { showDesign(static_cast<int>(std::lround(x))); });
  connect(compare_, &QPushButton::toggled, this, [this](bool on) {
    compared_->setEnabled(on);
    play();
  });
  connect(compared_, &QSpinBox::valueChanged, this, &DesignPanel::play);
  connect(take_, &QPushButton::clicked, this, &DesignPanel::takeDesign);
  connect(choice_, &StudyChoice::chosen, this, &DesignPanel::chooseStudy);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    forget();
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

QString DesignPanel::summary() const { return summary_->text(); }

void DesignPanel::forget() {
  result_.reset();
  problems_.clear();
  played_.clear();
  follows_ = true;
  picked_ = false;
  shown_ = -1;
  compare_->setChecked(false);
}

/// The designs of another study; what was looked at of the former one goes.
void DesignPanel::chooseStudy() {
  const bool looked = !played_.isEmpty();
  forget();
  if (looked) Q_EMIT designLeft();
  takeResult();
  refresh();
}

void DesignPanel::follow(const std::string& name) {
  const document::StudyState* own = choice_->study();
  const auto isRunning = [](const document::StudyState* study) {
    return study && study->status == document::StudyStatus::running;
  };
  const bool hadDesigns = own && own->name == name && result_ && !result_->design.history.empty();
  // A study that is run is one that somebody waits for.
  if (own && own->name != name && !isRunning(own) && isRunning(document_.study(name))) {
    choice_->choose(name);
    own = choice_->study();
  }
  if (!own || own->name != name) return;
  takeResult();
  const bool began = isRunning(own) && !hadDesigns && result_ && !result_->design.history.empty();
  refresh();
  if (began) Q_EMIT designsGrow();
}

void DesignPanel::takeResult() {
  const document::StudyState* own = choice_->study();
  const auto result = own ? std::dynamic_pointer_cast<const scene::DesignResult>(own->result) : nullptr;
  if (result != result_ && result) {
    const bool another = !result_ || result_->design.history.empty() || result->design.history.empty() ||
                         result->before().model != result_->before().model;
    result_ = result;
    if (another) {
      follows_ = true;
      picked_ = false;
      problems_.clear();
      played_.clear();
    }
  }
}

void DesignPanel::refresh() {
  const document::StudyState* own = choice_->study();
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
    const QSignalBlocker block(slider_), blockOther(compared_);
    slider_->setRange(0, last);
    compared_->setRange(0, last);
  }
  compare_->setEnabled(last > 0);
  put(follows_ || shown_ < 0 ? last : std::min(shown_, last));
}

void DesignPanel::showDesign(int index) {
  if (!result_ || result_->design.history.empty()) return;
  picked_ = true;
  played_.clear();
  put(index);
}

void DesignPanel::put(int index) {
  const auto& history = result_->design.history;
  const int last = static_cast<int>(history.size()) - 1;
  shown_ = std::clamp(index, 0, last);
  follows_ = shown_ == last;
  {
    const QSignalBlocker block(slider_);
    slider_->setValue(shown_);
  }
  plot_->setInstant(shown_);
  position_->setText(tr("%1 of %2").arg(shown_).arg(last));
  const document::StudyState* own = choice_->study();
  QString text = gainText(*result_, history[static_cast<std::size_t>(shown_)]);
  if (own && own->stale) text += tr("  –  the scene has changed since");
  summary_->setText(text);
  take_->setEnabled(own && own->status != document::StudyStatus::running);
  fillTable();
  if (isVisible()) play();
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

DesignMotion DesignPanel::motionOf(int index) {
  const harmonic::DesignIterate& design = result_->design.history[static_cast<std::size_t>(index)];
  auto& problem = problems_[design.model.get()];
  if (!problem) problem = result_->motionOf(design)->problem;
  const document::StudyState* own = choice_->study();
  const bool running = own && own->status == document::StudyStatus::running;
  const int last = static_cast<int>(result_->design.history.size()) - 1;
  const QString which = index == 0     ? tr("first design")
                        : index < last ? tr("design %1 of %2").arg(index).arg(last)
                        : running      ? tr("best design so far, %1").arg(index)
                                       : tr("best design, %1").arg(index);
  return {problem, design.z, tr("%1:  objective %2").arg(which, QString::number(design.objective, 'g', 4))};
}

void DesignPanel::play() {
  if (!result_ || result_->design.history.empty() || shown_ < 0) return;
  const DesignMotion shown = motionOf(shown_);
  const bool compares = compare_->isChecked();
  const bool overFirst = !compares && !picked_ && shown_ > 0;
  const DesignMotion other = motionOf(compares ? compared_->value() : 0);
  const QString what = QStringLiteral("%1|%2|%3").arg(compares ? 2 : overFirst ? 1 : 0).arg(other.label, shown.label);
  if (what == played_) return;
  played_ = what;
  if (compares)
    Q_EMIT comparisonChosen(other, shown);
  else if (overFirst)
    Q_EMIT progressMade(other, shown);
  else
    Q_EMIT designChosen(shown);
}

void DesignPanel::takeDesign() {
  if (!result_ || shown_ < 0 || document_.isEmpty()) return;
  try {
    const scene::Json json =
        scene::designedScene(document_.scene(), *result_, result_->design.history[static_cast<std::size_t>(shown_)]);
    document_.setValue("", json, tr("Take design %1").arg(shown_));
    compare_->setChecked(false);
    played_.clear();
    Q_EMIT designLeft();
  } catch (const base::InputError& error) {
    document_.raise(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

}  // namespace pliant::panels
