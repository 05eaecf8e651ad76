#include "ui/panels/parameter_row.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <cmath>

#include "ui/panels/effect_bar.hpp"
#include "ui/panels/icon.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/value_field.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {

/// Nudges of one parameter in a row are one undo step; its number among all pointers ever nudged tells them apart.
int mergeIdOf(const std::string& pointer) {
  return static_cast<int>(qHash(QString::fromStdString(pointer)) & 0x3fffffff);
}

QLabel* mutedLabel(QWidget* parent) {
  auto* label = new QLabel(parent);
  QFont small = label->font();
  small.setPointSizeF(small.pointSizeF() * 0.9);
  label->setFont(small);
  label->setForegroundRole(QPalette::PlaceholderText);
  return label;
}

}  // namespace

ParameterRow::ParameterRow(document::Document& document, std::shared_ptr<const mechanics::DesignParameter> parameter,
                           double& impliedMaximum, QWidget* parent)
    : QWidget(parent),
      document_(document),
      parameter_(std::move(parameter)),
      pointer_(parameter_->pointer()),
      name_(parameter_->name()),
      impliedMaximum_(impliedMaximum) {
  spec_.dimension = parameter_->dimension();
  if (const base::ParameterSpec* declared = scene::specAt(document_.scene(), pointer_)) spec_ = *declared;
  const QString name = QString::fromStdString(parameter_->name());

  auto* title = new QLabel(this);
  title->setText(spec_.symbol.empty()
                     ? name.toHtmlEscaped()
                     : QStringLiteral("%1&nbsp;&nbsp;<i>%2</i>")
                           .arg(name.toHtmlEscaped(), QString::fromStdString(spec_.symbol).toHtmlEscaped()));
  title->setToolTip(explanation(spec_));
  field_ = new ValueField(this);
  field_->setFixedWidth(96);
  field_->setToolTip(tr("Double-click to type an exact value, such as \"12 g\"."));
  field_->setAccessibleName(tr("Value of %1").arg(name));
  reset_ = new QToolButton(this);
  reset_->setAutoRaise(true);
  reset_->setIcon(icon(QStringLiteral("reset")));
  reset_->setIconSize({16, 16});
  reset_->setFocusPolicy(Qt::NoFocus);
  reset_->setAccessibleName(tr("Reset %1").arg(name));
  QSizePolicy keepsPlace = reset_->sizePolicy();
  keepsPlace.setRetainSizeWhenHidden(true);
  reset_->setSizePolicy(keepsPlace);
  slider_ = new ParameterSlider(this);
  slider_->setAccessibleName(name);
  slider_->setToolTip(tr("Drag to see the predicted motion. Arrow keys nudge, with Shift ten times finer."));
  low_ = mutedLabel(this);
  high_ = mutedLabel(this);
  high_->setAlignment(Qt::AlignRight);
  effect_ = new EffectBar(this);

  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(16, 8, 8, 8);
  grid->setHorizontalSpacing(4);
  grid->setVerticalSpacing(0);
  grid->setColumnStretch(0, 1);
  grid->addWidget(title, 0, 0);
  grid->addWidget(field_, 0, 1);
  grid->addWidget(reset_, 0, 2);
  auto* below = new QGridLayout;
  below->setContentsMargins(0, 0, 8, 0);
  below->setVerticalSpacing(0);
  below->addWidget(slider_, 0, 0, 1, 2);
  below->addWidget(low_, 1, 0);
  below->addWidget(high_, 1, 1);
  below->addWidget(effect_, 2, 0, 1, 2);
  grid->addLayout(below, 1, 0, 1, 3);

  connect(slider_, &ParameterSlider::dragged, this, [this](double value) {
    const RoundedQuantity near = rounded(value, spec_.dimension);
    field_->showTransient(QString::fromStdString(near.text));
    Q_EMIT dragged(pointer_, near.value);
  });
  connect(slider_, &ParameterSlider::dragCancelled, this, [this] {
    refresh();
    Q_EMIT dragEnded();
  });
  connect(slider_, &ParameterSlider::committed, this, &ParameterRow::commit);
  connect(field_, &ValueField::typed, this, &ParameterRow::type);
  connect(reset_, &QToolButton::clicked, this, &ParameterRow::resetValue);
  setReference(parameter_->value(*document_.model()));
  refresh();
}

bool ParameterRow::givesMaximum() const {
  return document_.scene().json().contains(Json::json_pointer(entryPointer() + "/maximum"));
}

std::string ParameterRow::entryPointer() const { return pointer_.substr(0, pointer_.rfind('/')); }

void ParameterRow::commit(double value, bool nudge) {
  const RoundedQuantity near = rounded(value, spec_.dimension);
  const QString text =
      tr("%1 to %2").arg(QString::fromStdString(parameter_->name()), QString::fromStdString(near.text));
  if (near.value == 0 && !givesMaximum()) {
    // Zero implies no maximum: the one that the slider has is written with it.
    Json changed = document_.scene().json().at(Json::json_pointer(entryPointer()));
    changed[pointer_.substr(pointer_.rfind('/') + 1)] = near.text;
    changed["maximum"] = base::formatQuantityExactly(impliedMaximum_, spec_.dimension);
    document_.setValue(entryPointer(), changed, text);
  } else {
    document_.setValue(pointer_, near.text, text, nudge ? mergeIdOf(pointer_) : -1);
  }
  refresh();
  Q_EMIT dragEnded();
}

void ParameterRow::type(const QString& text) {
  const Json value = parseText(text, field_->shownText(), spec_);
  document_.setValue(pointer_, value, tr("%1 to %2").arg(QString::fromStdString(parameter_->name()), text));
  refresh();
}

void ParameterRow::resetValue() {
  const Json saved = document_.savedValueAt(pointer_);
  if (saved.is_null()) return;
  document_.setValue(pointer_, saved, tr("Reset %1").arg(QString::fromStdString(parameter_->name())));
}

void ParameterRow::refresh() {
  const auto model = document_.model();
  for (const auto& parameter : model->parameters)
    if (parameter->pointer() == pointer_) parameter_ = parameter;
  const double value = parameter_->value(*model);
  const double low = parameter_->minimum(*model);
  double high = 0;
  if (givesMaximum()) {
    high = parameter_->maximum(*model);
  } else {
    if (impliedMaximum_ == 0) impliedMaximum_ = parameter_->maximum(*model);
    if (value > impliedMaximum_) {
      const Json implied = document_.valueAt(entryPointer() + "/maximum");
      impliedMaximum_ = implied.is_number() ? implied.get<double>() : value;
    }
    high = impliedMaximum_;
  }
  slider_->setBounds(low, high);
  slider_->setRealValue(value);
  const auto text = [&](double number) {
    return QString::fromStdString(base::formatQuantity(number, spec_.dimension));
  };
  low_->setText(text(low));
  high_->setText(text(high));
  field_->setTexts(text(value), editText(value, Json(), spec_));
  const Json saved = document_.savedValueAt(pointer_);
  const bool differs = saved.is_number() && saved.get<double>() != value;
  reset_->setVisible(differs);
  if (differs) reset_->setToolTip(tr("Reset to %1, the value in the file").arg(text(saved.get<double>())));
}

void ParameterRow::setReference(double value) { slider_->setReference(value); }

void ParameterRow::setSlope(double slope, double largestEffect) {
  const double value = parameter_->value(*document_.model());
  const double effect = slope * value;
  const QString change = plots::formatLength(std::abs(0.1 * effect));
  effect_->setEffect(largestEffect > 0 ? effect / largestEffect : 0,
                     tr("+10 %: %1%2").arg(effect < 0 ? QStringLiteral("−") : QStringLiteral("+"), change));
  effect_->setToolTip(tr("What ten per cent more of %1 would do to the amplitude of the selected node, to first order "
                         "(d amplitude / d %1 = %2 m per SI unit).")
                          .arg(QString::fromStdString(parameter_->name()))
                          .arg(slope, 0, 'g', 4));
}

void ParameterRow::clearSlope() { effect_->clear(); }

}  // namespace pliant::panels
