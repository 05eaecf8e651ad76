#include "ui/panels/effect_bar.hpp"

#include <QPainter>

#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

EffectBar::EffectBar(QWidget* parent) : QWidget(parent) { setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed); }

void EffectBar::setEffect(double share, const QString& text) {
  share_ = share;
  text_ = text;
  update();
}

void EffectBar::clear() { setEffect(0, {}); }

void EffectBar::paintEvent(QPaintEvent*) {
  if (text_.isEmpty()) return;
  const plots::PlotStyle style = plots::plotStyle(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double textWidth = 128;
  const double length = width() - textWidth - 8;
  const double middle = length / 2;
  const double y = height() / 2.0;
  painter.setPen(QPen(style.grid, 1));
  painter.drawLine(QPointF(0, y), QPointF(length, y));
  painter.setPen(QPen(share_ >= 0 ? style.shown : style.warning, 6, Qt::SolidLine, Qt::FlatCap));
  painter.drawLine(QPointF(middle, y), QPointF(middle + share_ * middle, y));
  painter.setPen(QPen(style.mutedText, 1));
  painter.drawLine(QPointF(middle, y - 5), QPointF(middle, y + 5));
  QFont small = font();
  small.setPointSizeF(font().pointSizeF() * 0.9);
  painter.setFont(small);
  painter.setPen(style.mutedText);
  painter.drawText(QRectF(width() - textWidth, 0, textWidth, height()), Qt::AlignRight | Qt::AlignVCenter, text_);
}

}  // namespace pliant::panels
