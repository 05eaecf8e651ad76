#include "ui/viewport/playback.hpp"

#include <algorithm>
#include <cmath>

namespace pliant::viewport {

void Playback::setTimes(std::vector<double> times, bool growing, FrameClock clock, bool playing) {
  times_ = std::move(times);
  growing_ = growing;
  clock_ = clock;
  if (!times_.empty()) setTime(growing_ && followsNewest_ && !playing ? duration() : std::min(time_, duration()));
}

void Playback::setTime(double time) {
  if (times_.empty()) return;
  time_ = std::clamp(time, times_.front(), duration());
  followsNewest_ = time_ >= duration();
}

double Playback::after(double seconds, double factor) const {
  if (time_ >= duration() && !growing_) return 0;
  return time_ + factor * seconds * render::clockRate(clock_);
}

int Playback::frame() const {
  const double reached = time_ + 1e-9 * std::max(1.0, std::abs(time_));
  return static_cast<int>(std::upper_bound(times_.begin(), times_.end(), reached) - times_.begin()) - 1;
}

}  // namespace pliant::viewport
