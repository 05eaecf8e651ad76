#include "ui/shell/playback_bar.hpp"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <cmath>
#include <numbers>

#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

namespace {
constexpr int steps = 720;  ///< half degrees
constexpr double turn = 2 * std::numbers::pi;
}  // namespace

PlaybackBar::PlaybackBar(viewport::Viewport& viewport, QAction* playAction, QWidget* parent)
    : QWidget(parent), viewport_(viewport) {
  auto* button = new QToolButton;
  button->setDefaultAction(playAction);
  button->setAutoRaise(true);
  button->setIconSize({20, 20});
  button->setFocusPolicy(Qt::NoFocus);
  scrub_ = new QSlider(Qt::Horizontal);
  scrub_->setRange(0, steps - 1);
  scrub_->setFixedWidth(144);
  scrub_->setFocusPolicy(Qt::NoFocus);
  scrub_->setToolTip(tr("The place in the period"));
  scrub_->setAccessibleName(tr("Place in the period"));
  place_ = new QLabel;
  place_->setFixedWidth(place_->fontMetrics().horizontalAdvance(QStringLiteral("τ = 360°")) + 8);
  speed_ = new QComboBox;
  for (const double speed : {0.1, 0.25, 0.5, 1.0, 2.0}) speed_->addItem(tr("%1 periods/s").arg(speed), speed);
  speed_->setCurrentIndex(speed_->findData(viewport.speed()));
  speed_->setFocusPolicy(Qt::NoFocus);
  speed_->setToolTip(tr("How many periods are shown in a second"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  for (QWidget* widget : {static_cast<QWidget*>(button), static_cast<QWidget*>(scrub_), static_cast<QWidget*>(place_),
                          static_cast<QWidget*>(speed_)})
    row->addWidget(widget);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);

  connect(scrub_, &QSlider::valueChanged, this, [this](int step) {
    viewport_.pause();
    viewport_.setTau(turn * step / steps);
  });
  connect(speed_, &QComboBox::activated, this, [this] { viewport_.setSpeed(speed_->currentData().toDouble()); });
  connect(&viewport_, &viewport::Viewport::tauChanged, this, &PlaybackBar::showTau);
  showTau(viewport_.tau());
}

void PlaybackBar::showTau(double tau) {
  const QSignalBlocker block(scrub_);
  scrub_->setValue(static_cast<int>(std::lround(tau / turn * steps)) % steps);
  place_->setText(QStringLiteral("τ = %1°").arg(std::lround(tau / turn * 360) % 360));
}

}  // namespace pliant::shell
