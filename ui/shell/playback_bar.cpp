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
  speed_->setFocusPolicy(Qt::NoFocus);
  fillSpeeds();
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8);
  for (QWidget* widget : {static_cast<QWidget*>(button), static_cast<QWidget*>(scrub_), static_cast<QWidget*>(place_),
                          static_cast<QWidget*>(speed_)})
    row->addWidget(widget);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);

  connect(scrub_, &QSlider::valueChanged, this, [this](int step) {
    viewport_.pause();
    if (ofFrames_)
      viewport_.setTime(viewport_.duration() * step / (steps - 1));
    else
      viewport_.setTau(turn * step / steps);
  });
  connect(speed_, &QComboBox::activated, this, [this] {
    const double chosen = speed_->currentData().toDouble();
    if (ofFrames_)
      viewport_.setClothSpeed(chosen);
    else
      viewport_.setSpeed(chosen);
  });
  connect(&viewport_, &viewport::Viewport::tauChanged, this, &PlaybackBar::showTau);
  connect(&viewport_, &viewport::Viewport::timeChanged, this, &PlaybackBar::showTime);
  connect(&viewport_, &viewport::Viewport::clothChanged, this, [this] {
    if (ofFrames_ != viewport_.showsFrames()) fillSpeeds();
    scrub_->setEnabled(!viewport_.isLive());
    speed_->setEnabled(!viewport_.isLive());
    if (ofFrames_)
      showTime(viewport_.time());
    else
      showTau(viewport_.tau());
  });
  showTau(viewport_.tau());
}

void PlaybackBar::fillSpeeds() {
  ofFrames_ = viewport_.showsFrames();
  speed_->clear();
  for (const double speed : {0.1, 0.25, 0.5, 1.0, 2.0})
    speed_->addItem(ofFrames_ ? tr("%1 × speed").arg(speed) : tr("%1 periods/s").arg(speed), speed);
  speed_->setCurrentIndex(speed_->findData(ofFrames_ ? viewport_.clothSpeed() : viewport_.speed()));
  speed_->setToolTip(ofFrames_ ? tr("How fast it is shown, beside real time")
                               : tr("How many periods are shown in a second"));
  scrub_->setToolTip(ofFrames_ ? tr("The time of the frame") : tr("The place in the period"));
}

void PlaybackBar::showTau(double tau) {
  if (ofFrames_) return;
  const QSignalBlocker block(scrub_);
  scrub_->setValue(static_cast<int>(std::lround(tau / turn * steps)) % steps);
  if (const int periods = viewport_.motionView().periods(); periods > 1)
    place_->setText(tr("period %1 of %2").arg(periods * tau / turn, 0, 'f', 1).arg(periods));
  else
    place_->setText(QStringLiteral("τ = %1°").arg(std::lround(tau / turn * 360) % 360));
}

void PlaybackBar::showTime(double time) {
  if (!ofFrames_) return;
  const QSignalBlocker block(scrub_);
  const double duration = viewport_.duration();
  scrub_->setValue(duration > 0 ? static_cast<int>(std::lround(time / duration * (steps - 1))) : 0);
  switch (viewport_.frameClock()) {
    case render::FrameClock::seconds: place_->setText(QStringLiteral("%1 s").arg(time, 0, 'f', 2)); break;
    case render::FrameClock::steps: place_->setText(tr("step %1").arg(std::lround(time))); break;
    case render::FrameClock::loads: place_->setText(tr("load %1 %").arg(std::lround(100 * time)));
  }
}

}  // namespace pliant::shell
