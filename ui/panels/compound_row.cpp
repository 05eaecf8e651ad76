#include "ui/panels/compound_row.hpp"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>

#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/text_line.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {

/// Short ways lie closer to the middle than long ones: predictions are best there.
double shareOf(double place) { return place * std::abs(place); }

}  // namespace

CompoundRow::CompoundRow(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(16, 4, 16, 4);
  grid->setVerticalSpacing(0);
  choice_ = new QComboBox;
  choice_->setAccessibleName(tr("What all parameters are moved towards"));
  choice_->setToolTip(tr("All parameters that are not locked are moved together, each in proportion to what it does."));
  choice_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  choice_->setMinimumContentsLength(12);
  slider_ = new ParameterSlider;
  slider_->setAccessibleName(tr("All parameters together"));
  slider_->setBounds(-1, 1);
  slider_->setReference(0);
  text_ = new TextLine;
  grid->addWidget(new QLabel(tr("All along")), 0, 0);
  grid->addWidget(choice_, 0, 1);
  grid->addWidget(slider_, 1, 0, 1, 2);
  grid->addWidget(text_, 2, 0, 1, 2);
  grid->setColumnStretch(1, 1);
  connect(choice_, &QComboBox::currentIndexChanged, this, &CompoundRow::goalChosen);
  connect(slider_, &ParameterSlider::dragged, this, [this](double place) { Q_EMIT dragged(shareOf(place)); });
  connect(slider_, &ParameterSlider::committed, this, [this](double place, bool) { Q_EMIT committed(shareOf(place)); });
  connect(slider_, &ParameterSlider::dragCancelled, this, &CompoundRow::dragCancelled);
}

void CompoundRow::setGoals(std::vector<jobs::CompoundGoal> goals) {
  const QSignalBlocker block(choice_);
  const int before = choice_->count() == static_cast<int>(goals.size()) ? choice_->currentIndex() : 0;
  goals_ = std::move(goals);
  choice_->clear();
  for (const jobs::CompoundGoal& goal : goals_) choice_->addItem(goal.name);
  choice_->setCurrentIndex(goals_.empty() ? -1 : std::max(0, before));
}

const jobs::CompoundGoal* CompoundRow::goal() const {
  const int index = choice_->currentIndex();
  return index >= 0 && index < static_cast<int>(goals_.size()) ? &goals_[static_cast<std::size_t>(index)] : nullptr;
}

void CompoundRow::setPrediction(const QString& text, bool moved) {
  const plots::PlotStyle style = plots::plotStyle(palette());
  text_->setText(text, moved ? style.warning : style.mutedText);
}

void CompoundRow::setMovable(bool movable, const QString& note) {
  slider_->setEnabled(movable);
  slider_->setToolTip(movable ? tr("To the right towards it, to the left away from it. Arrow keys nudge.") : note);
}

void CompoundRow::setTrusted(double towards, double away) {
  slider_->setTrusted(-std::sqrt(std::min(1.0, away)), std::sqrt(std::min(1.0, towards)));
}

void CompoundRow::clearTrusted() { slider_->clearTrusted(); }

void CompoundRow::rest() { slider_->setRealValue(0); }

QString CompoundRow::text() const { return text_->text(); }

}  // namespace pliant::panels
