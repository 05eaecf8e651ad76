#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "ui/viewport/viewport.hpp"

namespace pliant::viewport {
void Viewport::showView(render::View& view) {
  if (view_ == &view) return;
  clearBeside();
  view_->attach(nullptr);
  view_ = &view;
  view_->setPixelRatio(devicePixelRatioF());
  attachToSurface();
}

void Viewport::setCloth(std::shared_ptr<const cloth::ClothProblem> problem) {
  if (problem == clothProblem_) return;
  const bool shown = problem != nullptr;
  const bool alike =
      shown && clothProblem_ && clothProblem_->model->restPositions.size() == problem->model->restPositions.size();
  clothProblem_ = problem;
  frames_.clear();
  clothPlayback_.clear();
  if (!alike) pulled_.reset();
  cloth_.setProblem(std::move(problem));
  if (!guest_) showOwnView();
  // Another run of the same cloth is seen from where the last one was.
  if (shown && !alike) {
    framed_ = true;
    motionFramed_ = false;
    cloth_.setAxisView(render::AxisView::isometric);
  }
  Q_EMIT clothChanged();
  redraw();
}

void Viewport::setClothFrames(std::vector<std::shared_ptr<const scene::ClothFrame>> frames, bool growing,
                              FrameClock clock) {
  if (!showsCloth()) return;
  frames_ = frames;
  std::vector<double> times;
  for (const auto& frame : frames_) times.push_back(frame->time);
  cloth_.setFrames(std::move(frames));
  clothPlayback_.setTimes(std::move(times), growing, clock, isPlaying());
  // A fit follows what the cloth reaches for as long as nobody moves the camera.
  if (framed_) cloth_.fit();
  Q_EMIT clothChanged();
  showPlayback();
  redraw();
}

void Viewport::setGuestFrames(std::vector<double> times, bool growing, FrameClock clock) {
  guestPlayback_.setTimes(std::move(times), growing, clock, isPlaying());
  if (guestPlayback_.isEmpty()) pause();
  Q_EMIT clothChanged();
  showPlayback();
}

const Playback* Viewport::playback() const {
  if (showsCloth()) return &clothPlayback_;
  return guest_ && view_ == guest_.get() && !guestPlayback_.isEmpty() ? &guestPlayback_ : nullptr;
}

void Viewport::setTime(double time) {
  if (!playback() || !std::isfinite(time)) return;
  playback()->setTime(time);
  showPlayback();
}

void Viewport::showPlayback() {
  if (!playback() || playback()->isEmpty()) return;
  auto& view = static_cast<render::FrameView&>(*view_);
  const int frame = std::max(0, playback()->frame());
  if (frame != view.frame()) {
    view.setFrame(frame);
    redraw(true);
  }
  Q_EMIT timeChanged(time());
}

void Viewport::setLive(bool live) {
  if (live == live_) return;
  pause();
  live_ = live;
  pulled_.reset();
  handheld_.clear();
  cloth_.setHands({});
  setMouseTracking(live);
  unsetCursor();
  Q_EMIT clothChanged();
  redraw();
}

void Viewport::showLive(std::shared_ptr<const scene::ClothFrame> frame, std::vector<render::Hand> hands) {
  if (!showsCloth() || !live_) return;
  handheld_.clear();
  for (const render::Hand& hand : hands) handheld_.push_back(hand.node);
  clothPlayback_.clear();
  clothPlayback_.setTimes({frame->time}, false, FrameClock::seconds, false);
  frames_ = {std::move(frame)};
  cloth_.setFrames(frames_);
  cloth_.setFrame(0);
  cloth_.setHands(std::move(hands));
  if (framed_) cloth_.fit();
  redraw(true);
  Q_EMIT timeChanged(time());
}

void Viewport::beginPull(const QMouseEvent& event) {
  if (!showsCloth() || (event.modifiers() & Qt::ShiftModifier)) return;
  pulled_ = nodeAt(event.position());
  if (!pulled_) return;
  framed_ = false;  // a view that follows what is pulled would run away from the mouse
  heldBefore_ = std::find(handheld_.begin(), handheld_.end(), *pulled_) != handheld_.end();
  pullBegin_ = cloth_.nodePosition(*pulled_);
  pullFrom_ = event.position();
  setCursor(Qt::ClosedHandCursor);
  Q_EMIT nodePulled(*pulled_, pullBegin_);
}

void Viewport::movePull(const QPointF& place) {
  const double ratio = devicePixelRatioF();
  const auto from = cloth_.pointBeside(pullBegin_, pullFrom_.x() * ratio, pullFrom_.y() * ratio);
  const auto to = cloth_.pointBeside(pullBegin_, place.x() * ratio, place.y() * ratio);
  if (from && to) Q_EMIT nodePulled(*pulled_, pullBegin_ + *to - *from);
}

/// `toggles`: whether hands hold the node changes.
void Viewport::endPull(bool toggles) {
  const int node = *pulled_;
  pulled_.reset();
  setCursor(Qt::OpenHandCursor);
  Q_EMIT nodeLetGo(node, heldBefore_ != toggles);
}

void Viewport::refreshCursor(const QPointF& place) {
  if (showsCell() ? gripAt(place).has_value() : nodeAt(place).has_value())
    setCursor(Qt::OpenHandCursor);
  else
    unsetCursor();
}

}  // namespace pliant::viewport
