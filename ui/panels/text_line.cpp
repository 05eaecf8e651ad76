#include "ui/panels/text_line.hpp"

#include <QPainter>

namespace pliant::panels {

TextLine::TextLine(QWidget* parent) : QWidget(parent) { setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed); }

void TextLine::setText(const QString& text, const QColor& color) {
  if (text == text_ && color == color_) return;
  text_ = text;
  color_ = color;
  setAccessibleName(text);
  update();
}

QSize TextLine::sizeHint() const { return {0, fontMetrics().height()}; }

void TextLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setPen(color_);
  painter.drawText(rect(), Qt::AlignLeft | Qt::AlignVCenter, fontMetrics().elidedText(text_, Qt::ElideRight, width()));
}

}  // namespace pliant::panels
