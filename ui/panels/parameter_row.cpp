#include "ui/panels/parameter_row.hpp"

#include <QGridLayout>
#include <QHBoxLayout>
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

base::ParameterSpec specOf(const document::Document& document, const mechanics::DesignParameter& parameter) {
  if (const base::ParameterSpec* declared = scene::specAt(document.scene(), parameter.pointer())) return *declared;
  base::ParameterSpec spec;
  spec.dimension = parameter.dimension();
  return spec;
}

}  // namespace

ParameterRow::ParameterRow(document::Document& document, std::shared_ptr<const mechanics::DesignParameter> parameter,
                           double& impliedMaximum, QWidget* parent)
    : SliderRow(QString::fromStdString(parameter->name()), specOf(document, *parameter), Ends::below, parent),
      document_(document),
      parameter_(std::move(parameter)),
      pointer_(parameter_->pointer()),
      name_(parameter_->name()),
      impliedMaximum_(impliedMaximum),
      spec_(specOf(document, *parameter_)) {
  field_->setToolTip(tr("Double-click to type an exact value, such as \"12 g\"."));
  slider_->setToolTip(tr("Drag to see the predicted motion. Arrow keys nudge, with Shift ten times finer."));
  effect_ = new EffectBar(this);
  lock_ = new QToolButton(this);
  lock_->setAutoRaise(true);
  lock_->setCheckable(true);
  lock_->setIcon(icon(QStringLiteral("lock")));
  lock_->setIconSize({14, 14});
  lock_->setFocusPolicy(Qt::NoFocus);
  lock_->setAccessibleName(tr("Lock %1").arg(QString::fromStdString(name_)));
  lock_->setToolTip(tr("Locked, it keeps its value when all parameters are moved together."));
  auto* effectRow = new QHBoxLayout;
  effectRow->setSpacing(4);
  effectRow->addWidget(effect_, 1);
  effectRow->addWidget(lock_);
  below_->addLayout(effectRow, 2, 0, 1, 2);
  connect(lock_, &QToolButton::toggled, this, [this](bool locked) {
    slider_->setEnabled(!locked);
    field_->setEnabled(!locked);
    Q_EMIT lockChanged(locked);
  });

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
    Json changed = document_.scene().json();
    writeTo(changed, value);
    document_.setValue(entryPointer(), changed.at(Json::json_pointer(entryPointer())), text);
  } else {
    document_.setValue(pointer_, near.text, text, nudge ? mergeIdOf(pointer_) : -1);
  }
  refresh();
  Q_EMIT dragEnded();
}

void ParameterRow::writeTo(Json& scene, double value) const {
  const RoundedQuantity near = rounded(value, spec_.dimension);
  scene[Json::json_pointer(pointer_)] = near.text;
  // Zero implies no maximum: the one that the slider has is written with it.
  if (near.value == 0 && !givesMaximum())
    scene[Json::json_pointer(entryPointer() + "/maximum")] =
        base::formatQuantityExactly(impliedMaximum_, spec_.dimension);
}

void ParameterRow::setTrusted(const std::optional<harmonic::ParameterRange>& range) {
  QString tip = tr("Drag to see the predicted motion. Arrow keys nudge, with Shift ten times finer.");
  if (range) {
    const auto text = [&](double value) { return QString::fromStdString(rounded(value, spec_.dimension).text); };
    slider_->setTrusted(range->lower, range->upper);
    tip += tr("\nFrom %1 to %2 the predicted motion is off by less than 10 % of the swing (second-order estimate); the "
              "track fades beyond. Update solves anew.")
               .arg(text(range->lower), text(range->upper));
  } else {
    slider_->clearTrusted();
  }
  slider_->setToolTip(tip);
}

void ParameterRow::showPreview(double value) {
  slider_->setRealValue(value);
  field_->showTransient(QString::fromStdString(rounded(value, spec_.dimension).text));
}

void ParameterRow::setLocked(bool locked) { lock_->setChecked(locked); }

bool ParameterRow::isLocked() const { return lock_->isChecked(); }

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
  showEnds(text(low), text(high));
  field_->setTexts(text(value), editText(value, Json(), spec_));
  const Json saved = document_.savedValueAt(pointer_);
  const bool differs = saved.is_number() && saved.get<double>() != value;
  showReset(differs, differs ? text(saved.get<double>()) : QString());
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
