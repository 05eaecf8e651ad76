#include "ui/panels/parameter_panel.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/panels/compound_row.hpp"
#include "ui/panels/effect_bar.hpp"
#include "ui/panels/icon.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/text_line.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

using jobs::AmplitudeMeasure;

QString nodeName(const mechanics::Model& model, int node) {
  for (const auto& probe : model.probes)
    if (probe.node == node) return QString::fromStdString(probe.name);
  return QStringLiteral("node %1").arg(node);
}

ParameterPanel::ParameterPanel(document::Document& document, jobs::MotionSession& session, QWidget* parent)
    : QWidget(parent), document_(document), session_(session), trust_(session) {
  auto* head = new QGridLayout;
  head->setContentsMargins(16, 8, 16, 8);
  head->setHorizontalSpacing(8);
  head->setVerticalSpacing(0);
  of_ = new QLabel;
  of_->setForegroundRole(QPalette::PlaceholderText);
  solved_ = new QLabel;
  QFont large = font();
  large.setPointSizeF(font().pointSizeF() * 1.6);
  solved_->setFont(large);
  predicted_ = new TextLine;
  note_ = new QLabel;
  note_->setWordWrap(true);
  note_->setForegroundRole(QPalette::PlaceholderText);
  update_ = new QPushButton(icon(QStringLiteral("update")), tr("Update"));
  update_->setToolTip(tr("Solve anew with the parameters as they are set (U)"));
  update_->setFocusPolicy(Qt::NoFocus);
  head->addWidget(of_, 0, 0, 1, 2);
  head->addWidget(solved_, 1, 0);
  head->addWidget(update_, 1, 1, Qt::AlignRight | Qt::AlignVCenter);
  head->addWidget(predicted_, 2, 0, 1, 2);
  head->addWidget(note_, 3, 0, 1, 2);
  head->setColumnStretch(0, 1);

  compound_ = new CompoundRow;
  auto* content = new QWidget;
  list_ = new QVBoxLayout(content);
  list_->setContentsMargins(0, 0, 0, 0);
  list_->setSpacing(0);
  empty_ = new QLabel(tr("Every point mass of a scene gets a slider here."));
  empty_->setWordWrap(true);
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setMargin(16);
  empty_->setForegroundRole(QPalette::PlaceholderText);
  list_->addWidget(empty_);
  list_->addStretch();
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(content);

  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(compound_);
  column->addWidget(scroll, 1);

  connect(update_, &QPushButton::clicked, &session_, &jobs::MotionSession::update);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    impliedMaxima_.clear();
    locked_.clear();
    rebuild();
    refreshGoals();
  });
  connect(&document_, &document::Document::sceneEdited, this, &ParameterPanel::refreshValues);
  connect(&document_, &document::Document::fileChanged, this, &ParameterPanel::refreshValues);
  connect(&session_, &jobs::MotionSession::shownChanged, this, &ParameterPanel::refreshReferences);
  connect(&session_, &jobs::MotionSession::effectsChanged, this, &ParameterPanel::refreshEffects);
  connect(&session_, &jobs::MotionSession::predictionChanged, this, &ParameterPanel::refreshSummary);
  connect(&session_, &jobs::MotionSession::nodeChanged, this, &ParameterPanel::refreshSummary);
  connect(&session_, &jobs::MotionSession::measureChanged, this, &ParameterPanel::refreshSummary);
  connect(&session_, &jobs::MotionSession::busyChanged, this, &ParameterPanel::refreshSummary);
  connect(&trust_, &jobs::TrustedRanges::changed, this, &ParameterPanel::refreshTrust);
  connectCompound();
  rebuild();
}

ParameterRow* ParameterPanel::row(const std::string& pointer) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](auto* row) { return row->pointer() == pointer; });
  return found == rows_.end() ? nullptr : *found;
}

QString ParameterPanel::summary() const {
  return QStringLiteral("%1 | %2 | %3").arg(of_->text(), solved_->text(), predicted_->text());
}

void ParameterPanel::rebuild() {
  for (ParameterRow* row : rows_) delete row;
  rows_.clear();
  const auto model = document_.model();
  if (model) {
    for (const auto& parameter : model->parameters) {
      auto* row = new ParameterRow(document_, parameter, impliedMaxima_[parameter->name()]);
      connect(row, &ParameterRow::dragged, &session_, &jobs::MotionSession::preview);
      connect(row, &ParameterRow::dragEnded, &session_, &jobs::MotionSession::endPreview);
      row->setLocked(locked_.contains(row->name()));
      connect(row, &ParameterRow::lockChanged, this, [this, name = row->name()](bool locked) {
        if (locked)
          locked_.insert(name);
        else
          locked_.erase(name);
        refreshDirection();
      });
      list_->insertWidget(static_cast<int>(rows_.size()), row);
      rows_.push_back(row);
    }
  }
  refreshTrust();
  empty_->setVisible(rows_.empty());
  compound_->setVisible(rows_.size() > 1);
  for (ParameterRow* row : rows_) row->lockButton()->setVisible(rows_.size() > 1);
  refreshSummary();
}

void ParameterPanel::refreshValues() {
  const auto model = document_.model();
  if (!model) return;
  const bool same =
      model->parameters.size() == rows_.size() &&
      std::equal(rows_.begin(), rows_.end(), model->parameters.begin(), [](auto* row, const auto& parameter) {
        return row->pointer() == parameter->pointer() && row->name() == parameter->name();
      });
  if (!same) {
    rebuild();
    refreshReferences();
    refreshEffects();
    return;
  }
  for (ParameterRow* row : rows_) row->refresh();
  refreshSummary();
}

void ParameterPanel::refreshReferences() {
  const auto& shown = session_.shown();
  const auto model = shown && session_.isComparable() ? shown->problem->sharedModel() : document_.model();
  if (!model) return;
  for (ParameterRow* row : rows_)
    for (const auto& parameter : model->parameters)
      if (parameter->pointer() == row->pointer()) row->setReference(parameter->value(*model));
  refreshSummary();
}

void ParameterPanel::refreshEffects() {
  for (ParameterRow* row : rows_) row->clearSlope();
  const auto model = document_.model();
  double largest = 0;
  const auto valueOf = [&](const std::string& pointer) {
    for (const auto& parameter : model->parameters)
      if (parameter->pointer() == pointer) return parameter->value(*model);
    return 0.0;
  };
  for (const auto& effect : session_.effects())
    largest = std::max(largest, std::abs(effect.slope * valueOf(effect.pointer)));
  for (const auto& effect : session_.effects())
    if (ParameterRow* found = row(effect.pointer)) found->setSlope(effect.slope, largest);
  refreshSummary();
}

void ParameterPanel::refreshTrust() {
  for (ParameterRow* each : rows_) each->setTrusted(trust_.range(each->pointer()));
  if (const auto& reach = trust_.reach())
    compound_->setTrusted(reach->towards, reach->away);
  else
    compound_->clearTrusted();
}

void ParameterPanel::refreshSummary() {
  const bool shown = session_.shown().has_value();
  if (!document_.isEmpty()) {
    const QString measure =
        session_.measure() == AmplitudeMeasure::pathLength ? tr("Path length of %1") : tr("Largest displacement of %1");
    of_->setText(measure.arg(nodeName(*document_.model(), session_.node())));
  }
  const double amplitude = session_.shownAmplitude();
  solved_->setText(shown ? plots::formatLength(amplitude) : QStringLiteral("–"));
  QString prediction;
  if (const auto predicted = session_.predictedAmplitude()) {
    const double change = amplitude > 0 ? 100 * (*predicted / amplitude - 1) : 0;
    prediction = tr("predicted %1 (%2%3 %)")
                     .arg(plots::formatLength(*predicted), change < 0 ? QStringLiteral("−") : QStringLiteral("+"))
                     .arg(std::abs(change), 0, 'f', 1);
  }
  predicted_->setText(prediction, plots::plotStyle(palette()).warning);
  const QString obstacle = session_.predictionObstacle();
  note_->setText(obstacle);
  note_->setVisible(!obstacle.isEmpty());
  update_->setEnabled(session_.isStale() && !session_.isBusy());
  update_->setVisible(shown);
}

}  // namespace pliant::panels
