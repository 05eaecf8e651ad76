#include "ui/panels/slider_row.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/panels/icon.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/value_field.hpp"
#include "ui/panels/value_text.hpp"

namespace pliant::panels {

namespace {

constexpr int fieldWidth = 96, endWidth = 56;

QLabel* endLabel(QWidget* parent) {
  auto* label = new QLabel(parent);
  QFont small = label->font();
  small.setPointSizeF(small.pointSizeF() * 0.9);
  label->setFont(small);
  label->setForegroundRole(QPalette::PlaceholderText);
  return label;
}

}  // namespace

SliderRow::SliderRow(const QString& name, const base::ParameterSpec& spec, Ends ends, QWidget* parent)
    : QWidget(parent) {
  auto* title = new QLabel(this);
  title->setText(spec.symbol.empty()
                     ? name.toHtmlEscaped()
                     : QStringLiteral("%1&nbsp;&nbsp;<i>%2</i>")
                           .arg(name.toHtmlEscaped(), QString::fromStdString(spec.symbol).toHtmlEscaped()));
  title->setWordWrap(true);
  title->setToolTip(explanation(spec));
  field_ = new ValueField(this);
  field_->setFixedWidth(fieldWidth);
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
  low_ = endLabel(this);
  high_ = endLabel(this);
  high_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);

  const bool beside = ends == Ends::beside;
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(16, beside ? 0 : 8, 8, beside ? 0 : 8);
  grid->setHorizontalSpacing(4);
  grid->setVerticalSpacing(0);
  grid->setColumnStretch(0, 1);
  grid->addWidget(title, 0, 0);
  grid->addWidget(field_, 0, 1);
  grid->addWidget(reset_, 0, 2);
  below_ = new QGridLayout;
  below_->setContentsMargins(0, 0, 8, 0);
  below_->setVerticalSpacing(0);
  grid->addLayout(below_, 1, 0, 1, 3);
  if (!beside) {
    below_->addWidget(slider_, 0, 0, 1, 2);
    below_->addWidget(low_, 1, 0);
    below_->addWidget(high_, 1, 1);
    return;
  }
  for (QLabel* end : {low_, high_}) end->setFixedWidth(endWidth);
  below_->setHorizontalSpacing(4);
  below_->setColumnStretch(1, 1);
  below_->addWidget(low_, 0, 0);
  below_->addWidget(slider_, 0, 1);
  below_->addWidget(high_, 0, 2);
}

void SliderRow::showEnds(const QString& low, const QString& high) {
  low_->setText(low);
  high_->setText(high);
}

void SliderRow::showReset(bool differs, const QString& saved) {
  reset_->setVisible(differs);
  if (differs) reset_->setToolTip(tr("Reset to %1, the value in the file").arg(saved));
}

}  // namespace pliant::panels
