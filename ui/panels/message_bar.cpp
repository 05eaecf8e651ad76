#include "ui/panels/message_bar.hpp"

#include <QEvent>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/panels/icon.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {
constexpr int newsMilliseconds = 10'000;
}

MessageBar::MessageBar(QWidget* parent) : QFrame(parent) {
  setObjectName(QStringLiteral("messageBar"));
  icon_ = new QLabel;
  text_ = new QLabel;
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  close_ = new QToolButton;
  close_->setAutoRaise(true);
  close_->setIcon(panels::icon(QStringLiteral("close")));
  close_->setAccessibleName(tr("Close the message"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(16, 4, 8, 4);
  row->setSpacing(8);
  row->addWidget(icon_);
  row->addWidget(text_, 1);
  row->addWidget(close_);
  connect(close_, &QToolButton::clicked, this, &MessageBar::dismiss);
  timer_.setSingleShot(true);
  timer_.setInterval(newsMilliseconds);
  connect(&timer_, &QTimer::timeout, this, &MessageBar::dismiss);
  hide();
}

void MessageBar::show(base::Severity severity, const QString& sentence) {
  severity_ = severity;
  text_->setText(sentence);
  applyStyle();
  if (severity == base::Severity::information)
    timer_.start();
  else
    timer_.stop();
  setVisible(true);
}

void MessageBar::dismiss() {
  timer_.stop();
  text_->clear();
  hide();
}

QString MessageBar::sentence() const { return text_->text(); }

void MessageBar::changeEvent(QEvent* event) {
  QFrame::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && text_ && !text_->text().isEmpty()) applyStyle();
}

void MessageBar::applyStyle() {
  const bool warning = severity_ == base::Severity::warning;
  icon_->setPixmap(panels::icon(warning ? QStringLiteral("warning") : QStringLiteral("information")).pixmap(16, 16));
  const bool dark = plots::isDark(QGuiApplication::palette());  // its own may still be that of the last sheet
  const QColor ground = warning ? (dark ? QColor(74, 56, 20) : QColor(255, 240, 209))
                                : (dark ? QColor(24, 52, 68) : QColor(221, 238, 248));
  const QString sheet = QStringLiteral("#messageBar { background: %1; border: none; }").arg(ground.name());
  if (sheet != styleSheet()) setStyleSheet(sheet);  // a new sheet changes the palette, which comes back here
}

}  // namespace pliant::panels
