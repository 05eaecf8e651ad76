#include <algorithm>
#include <cmath>

#include "ui/viewport/viewport.hpp"

namespace pliant::viewport {
namespace {

constexpr double stepsPerSecond = 5;  ///< of a drape, whose clock counts load steps

}  // namespace

void Viewport::showView(render::View& view) {
  if (view_ == &view) return;
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
  time_ = 0;
  followsNewest_ = true;
  cloth_.setProblem(std::move(problem));
  if (shown)
    showView(cloth_);
  else
    showView(motion_);
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
  growing_ = growing;
  frameClock_ = clock;
  cloth_.setFrames(std::move(frames));
  // A fit follows what the cloth reaches for as long as nobody moves the camera.
  if (framed_) cloth_.fit();
  Q_EMIT clothChanged();
  const bool follows = growing_ && followsNewest_ && !isPlaying();
  setTime(follows ? duration() : std::min(time_, duration()));
  redraw();
}

void Viewport::setTime(double time) {
  if (!showsCloth() || frames_.empty() || !std::isfinite(time)) return;
  time_ = std::clamp(time, frames_.front()->time, duration());
  followsNewest_ = time_ >= duration();
  const double reached = time_ + 1e-9 * std::max(1.0, std::abs(time_));
  const auto after = std::upper_bound(
      frames_.begin(), frames_.end(), reached, [](double value, const auto& frame) { return value < frame->time; });
  const int frame = std::max(0, static_cast<int>(after - frames_.begin()) - 1);
  if (frame != cloth_.frame()) {
    cloth_.setFrame(frame);
    redraw(true);
  }
  Q_EMIT timeChanged(time_);
}

void Viewport::advanceCloth(double seconds) {
  if (frames_.empty()) return;
  const double next = time_ + clothSpeed_ * seconds * (frameClock_ == FrameClock::steps ? stepsPerSecond : 1);
  const bool ended = time_ >= duration();
  // The last frame is seen before it begins again; of a study that runs it waits for the next.
  setTime(ended && !growing_ ? 0 : next);
}

}  // namespace pliant::viewport
