#pragma once

#include <QApplication>
#include <string>

#include "core/scene/json_text.hpp"

namespace pliant::bench {

/// How long something took.
struct EventTime {
  double wall = 0;       ///< [s]
  double processor = 0;  ///< of this thread [s]
  std::string what;      ///< who got which event
};

/// Knows the event that kept the window from answering longest.
class TimedApplication final : public QApplication {
 public:
  using QApplication::QApplication;

  bool notify(QObject* receiver, QEvent* event) override;
  void forgetEvents() { longest_ = {}; }
  /// By the processor's time, which a busy machine changes little.
  const EventTime& longestEvent() const { return longest_; }

 private:
  int depth_ = 0;  ///< of events that are sent while others are handled
  EventTime longest_;
};

/// The dragon's wing in a window of 1280 x 800: a slider's mouse move with everything that is predicted, and the
/// longest event while a response is traced, while a design is sought, and while it is taken over. Needs a
/// TimedApplication.
base::Json measureDesign();

}  // namespace pliant::bench
