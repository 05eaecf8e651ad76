#include "ui/panels/cell_parameter_row.hpp"

#include <QToolButton>
#include <cmath>
#include <numbers>

#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/value_field.hpp"
#include "ui/panels/value_text.hpp"

namespace pliant::panels {

namespace {

constexpr double beyond = 1.25;  ///< a value that was typed, that the slider goes
constexpr double perDegree = std::numbers::pi / 180;

/// How a quantity is written: its unit, how many SI units that is, and to which part of it a hand is exact.
struct Unit {
  QString name;
  double size = 1;
  double step = 0;  ///< 0: four digits
};

Unit unitOf(const base::ParameterSpec& spec) {
  if (spec.kind == base::ValueKind::integer) return {{}, 1, 1};
  if (spec.dimension == base::dimensions::length) return {QStringLiteral("mm"), 1e-3, 0.01};
  if (spec.dimension == base::dimensions::angle) return {QStringLiteral("deg"), perDegree, 0.1};
  return {QString::fromStdString(base::siUnit(spec.dimension)), 1, 0};
}

double roundedTo(double value, const Unit& unit) {
  if (unit.step > 0) return std::round(value / unit.size / unit.step) * unit.step;
  return QString::number(value, 'g', 4).toDouble();
}

/// "Ring radius"; of a letter what it stands for: "Turns about the axis".
QString nameOf(const base::ParameterSpec& spec) {
  if (spec.key.size() > 1) return humanName(spec.key);
  QString meaning = QString::fromStdString(spec.description);
  if (meaning.endsWith(QLatin1Char('.'))) meaning.chop(1);
  return meaning;
}

double defaultOf(const base::ParameterSpec& spec) {
  if (spec.defaultValue.is_number()) return spec.defaultValue.get<double>();
  if (spec.defaultValue.is_string()) return base::parseQuantity(spec.defaultValue.get<std::string>(), spec.dimension);
  return 1;
}

/// The next of 1, 1.5, 2, 3, 4, 5, 6, 8 and 10 times a power of ten.
double roundEnd(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (value <= step * decade * (1 + 1e-9)) return step * decade;
  return 10 * decade;
}

}  // namespace

bool CellParameterRow::fits(const base::ParameterSpec& spec) {
  return spec.kind == base::ValueKind::number || spec.kind == base::ValueKind::integer;
}

CellParameterRow::CellParameterRow(base::ParameterSpec spec, QWidget* parent)
    : SliderRow(nameOf(spec), spec, Ends::beside, parent), spec_(std::move(spec)) {
  field_->setToolTip(tr("Double-click to type an exact value, such as \"4.8 mm\"."));
  slider_->setToolTip(tr("Drag to see the material change. Arrow keys nudge, with Shift ten times finer."));
  if (spec_.dimension == base::dimensions::angle) {
    low_ = std::max(-90 * perDegree, spec_.minimum);
    high_ = std::min(90 * perDegree, spec_.maximum);
  } else {
    high_ = std::isfinite(spec_.maximum) ? spec_.maximum : 2 * std::abs(defaultOf(spec_));
    low_ = std::isfinite(spec_.minimum) ? spec_.minimum : -high_;
    if (spec_.exclusiveMinimum) low_ += 0.02 * (high_ - low_);  // the end itself is refused
  }
  connect(slider_, &ParameterSlider::dragged, this, [this](double value) {
    field_->showTransient(shown(value));
    Q_EMIT dragged(spec_.key, written(value));
  });
  connect(slider_, &ParameterSlider::dragCancelled, this, [this] {
    setValue(value_, saved_);
    Q_EMIT dragEnded();
  });
  connect(slider_, &ParameterSlider::committed, this, &CellParameterRow::commit);
  connect(field_, &ValueField::typed, this, &CellParameterRow::type);
  connect(reset_, &QToolButton::clicked, this, [this] {
    base::Json exact = static_cast<int>(std::lround(saved_));
    if (spec_.kind == base::ValueKind::number) exact = base::formatQuantityExactly(saved_, spec_.dimension);
    Q_EMIT committed(spec_.key, exact, tr("Reset %1").arg(nameOf(spec_)), false);
  });
  showBounds();
}

base::Json CellParameterRow::written(double value) const {
  const Unit unit = unitOf(spec_);
  if (spec_.kind == base::ValueKind::integer) return static_cast<int>(std::lround(value));
  if (unit.name.isEmpty()) return roundedTo(value, unit);
  return shown(value).toStdString();
}

QString CellParameterRow::shown(double value) const {
  const Unit unit = unitOf(spec_);
  const QString digits = QString::number(roundedTo(value, unit), 'g', 6);
  return unit.name.isEmpty() ? digits : digits + ' ' + unit.name;
}

void CellParameterRow::setValue(double value, double saved) {
  value_ = value;
  saved_ = saved;
  widenTo(value);
  slider_->setReference(std::isfinite(saved) ? saved : value);
  slider_->setRealValue(value);
  const Unit unit = unitOf(spec_);
  const QString exact = QString::number(value / unit.size, 'g', 12);
  field_->setTexts(shown(value), unit.name.isEmpty() ? exact : exact + ' ' + unit.name);
  showReset(std::isfinite(saved) && saved != value, shown(saved));
}

void CellParameterRow::widenTo(double value) {
  if (value >= low_ && value <= high_) return;
  const Unit unit = unitOf(spec_);
  const double end = unit.size * roundEnd(beyond * std::abs(value) / unit.size);
  if (value > high_)
    high_ = std::min(spec_.maximum, value > 0 ? end : 0);
  else if (value < 0)
    low_ = std::max(spec_.minimum, -end);
  else  // towards zero, which may be refused
    low_ = std::max(spec_.exclusiveMinimum ? 0.5 * value : 0, spec_.minimum);
  showBounds();
}

void CellParameterRow::showBounds() {
  slider_->setBounds(low_, high_);
  showEnds(shown(low_), shown(high_));
}

void CellParameterRow::commit(double value, bool nudge) {
  Q_EMIT committed(spec_.key, written(value), tr("%1 to %2").arg(nameOf(spec_), shown(value)), nudge);
}

void CellParameterRow::type(const QString& text) {
  Q_EMIT committed(
      spec_.key, parseText(text, field_->shownText(), spec_), tr("%1 to %2").arg(nameOf(spec_), text), false);
}

}  // namespace pliant::panels
