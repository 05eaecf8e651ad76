#include "ui/shell/theme.hpp"

#include <QApplication>
#include <QPalette>
#include <QStyleFactory>

namespace pliant::shell {

namespace {

struct Colors {
  QColor window, base, alternate, text, muted, button, border, highlight, highlighted, disabled;
};

QPalette makePalette(const Colors& c) {
  QPalette palette(c.button, c.window);
  palette.setColor(QPalette::Window, c.window);
  palette.setColor(QPalette::WindowText, c.text);
  palette.setColor(QPalette::Base, c.base);
  palette.setColor(QPalette::AlternateBase, c.alternate);
  palette.setColor(QPalette::Text, c.text);
  palette.setColor(QPalette::PlaceholderText, c.muted);
  palette.setColor(QPalette::Button, c.button);
  palette.setColor(QPalette::ButtonText, c.text);
  palette.setColor(QPalette::BrightText, Qt::white);
  palette.setColor(QPalette::ToolTipBase, c.base);
  palette.setColor(QPalette::ToolTipText, c.text);
  palette.setColor(QPalette::Highlight, c.highlight);
  palette.setColor(QPalette::HighlightedText, c.highlighted);
  palette.setColor(QPalette::Link, c.highlight);
  palette.setColor(QPalette::Mid, c.border);
  palette.setColor(QPalette::Dark, c.border.darker(120));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, c.disabled);
  return palette;
}

}  // namespace

void applyTheme(Theme theme) {
  if (theme == Theme::system) {
    QApplication::setPalette(QPalette());
    return;
  }
  QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  QApplication::setPalette(
      theme == Theme::light
          ? makePalette({QColor(244, 245, 247), QColor(255, 255, 255), QColor(248, 249, 250), QColor(28, 32, 38),
                         QColor(92, 98, 106), QColor(238, 240, 243), QColor(205, 209, 214), QColor(0, 114, 178),
                         QColor(255, 255, 255), QColor(150, 156, 163)})
          : makePalette({QColor(37, 40, 45), QColor(29, 32, 36), QColor(34, 37, 42), QColor(230, 233, 237),
                         QColor(168, 174, 182), QColor(48, 52, 58), QColor(70, 75, 82), QColor(56, 140, 196),
                         QColor(255, 255, 255), QColor(118, 124, 132)}));
}

}  // namespace pliant::shell
