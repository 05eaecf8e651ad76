#pragma once

#include <vector>

#include "ui/render/film.hpp"

namespace pliant::viewport {

/// Where in a recording somebody looks. While frames are added the newest is shown, unless another one was chosen.
class Playback {
 public:
  using FrameClock = render::FrameClock;

  /// At the beginning of nothing.
  void clear() { *this = Playback(); }
  /// Of all frames in ascending order. `playing`: what is shown moves on by itself, and does not jump to the newest.
  void setTimes(std::vector<double> times, bool growing, FrameClock clock, bool playing);
  bool isEmpty() const { return times_.empty(); }
  FrameClock clock() const { return clock_; }
  /// Of the last frame, and the place in it [s, or what the clock counts].
  double duration() const { return times_.empty() ? 0 : times_.back(); }
  double time() const { return time_; }
  /// Within what there is.
  void setTime(double time);
  /// The time that follows after these seconds, `factor` times faster than life: the last frame is seen before the
  /// first comes again, or waits for the next one while there are to be more.
  double after(double seconds, double factor) const;
  /// The last one that is not after the time; -1: there is none.
  int frame() const;

 private:
  std::vector<double> times_;
  FrameClock clock_ = FrameClock::seconds;
  double time_ = 0;
  bool growing_ = false;
  bool followsNewest_ = true;
};

}  // namespace pliant::viewport
