#include "tests/benchmarks/ui/bench_design_ui.hpp"

#include <QElapsedTimer>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>
#include <vector>

#include "ui/panels/design_panel.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/response_panel.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::bench {

namespace {

using base::Json;

constexpr int moves = 60;
constexpr qint64 patience = 1'800'000;  // milliseconds

double processorSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Condition>
void await(const char* what, const Condition& condition) {
  QElapsedTimer watch;
  watch.start();
  while (!condition()) {
    if (watch.elapsed() > patience) throw std::runtime_error(std::string("waited too long for ") + what);
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 20);
  }
}

Json row(const std::string& name, int size, int count, const EventTime& time) {
  std::printf("%-36s %7d %10.2f ms, processor %.2f ms  %s\n", name.c_str(), size, 1e3 * time.wall, 1e3 * time.processor,
              time.what.c_str());
  std::fflush(stdout);
  return {{"area", "ui-design"},       {"name", name},
          {"seconds", time.wall},      {"processor_seconds", time.processor},
          {"iterations", count},       {"unavoidable_seconds", nullptr},
          {"thesis_seconds", nullptr}, {"size", size}};
}

/// Of many, by the processor's time.
EventTime median(std::vector<EventTime> times) {
  std::sort(times.begin(), times.end(), [](const auto& a, const auto& b) { return a.processor < b.processor; });
  EventTime middle = times[times.size() / 2];
  char text[96];
  std::snprintf(text, sizeof text, "(processor: fastest %.2f, slowest %.2f)", 1e3 * times.front().processor,
                1e3 * times.back().processor);
  middle.what = text;
  return middle;
}

void send(QWidget& widget, QEvent::Type type, const QPointF& place, Qt::MouseButton button, Qt::MouseButtons buttons) {
  QMouseEvent event(type, place, widget.mapToGlobal(place), button, buttons, Qt::NoModifier);
  QCoreApplication::sendEvent(&widget, &event);
}

/// From each move of the mouse to the new pictures.
EventTime dragTime(panels::ParameterSlider& slider, const plots::ResponsePlot& plot) {
  const QPointF start = slider.handlePosition();
  send(slider, QEvent::MouseButtonPress, start, Qt::LeftButton, Qt::LeftButton);
  std::vector<EventTime> times;
  for (int i = 0; i < moves; ++i) {
    QElapsedTimer watch;
    watch.start();
    const double before = processorSeconds();
    send(slider, QEvent::MouseMove, start + QPointF(12 * (1.1 - std::cos(0.3 * (i + 1))), 0), Qt::NoButton,
         Qt::LeftButton);
    QCoreApplication::processEvents();
    QCoreApplication::processEvents();  // what the first ones asked for
    times.push_back({1e-9 * static_cast<double>(watch.nsecsElapsed()), processorSeconds() - before, {}});
  }
  if (!plot.predictedCurve()) throw std::runtime_error("no curve was predicted");
  QKeyEvent escape(QEvent::KeyPress, Qt::Key_Escape, Qt::NoModifier);
  QCoreApplication::sendEvent(&slider, &escape);
  return median(std::move(times));
}

}  // namespace

bool TimedApplication::notify(QObject* receiver, QEvent* event) {
  if (depth_ > 0) return QApplication::notify(receiver, event);
  const std::string name = receiver->metaObject()->className();  // it may be gone afterwards
  const int type = event->type();
  QElapsedTimer watch;
  watch.start();
  const double before = processorSeconds();
  ++depth_;
  const bool done = QApplication::notify(receiver, event);
  --depth_;
  const double spent = processorSeconds() - before;
  if (spent > longest_.processor)
    longest_ = {1e-9 * static_cast<double>(watch.nsecsElapsed()), spent, name + ", event " + std::to_string(type)};
  return done;
}

Json measureDesign() {
  auto& application = dynamic_cast<TimedApplication&>(*QCoreApplication::instance());
  shell::MainWindow window(false);
  window.resize(1280, 800);
  window.show();
  document::Document& document = window.document();
  jobs::MotionSession& session = window.session();
  Json rows = Json::array();

  application.forgetEvents();
  window.openFile(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/dragon.json"));
  await("the scene", [&] { return document.model() != nullptr; });
  Json studies = document.scene().json().at("studies");
  const Json solver{{"harmonics", 3}, {"samples", 7}};
  Json motion{{"name", "motion"}, {"type", "periodic_motion"}, {"frequency", "2.5 Hz"}};
  Json response{{"name", "response"}, {"type", "frequency_response"}, {"from", "2 Hz"}, {"to", "3 Hz"}};
  motion.update(solver);
  response.update(solver);
  studies.push_back(motion);
  studies.push_back(response);
  document.setValue("/studies", studies, QStringLiteral("studies"));
  await("the studies", [&] { return !document.isEditing() && document.study("response"); });
  const int size = static_cast<int>(document.model()->dofs.freeCount()) * 7;
  rows.push_back(row("ui/dragon/open/longest-event", size, 1, application.longestEvent()));

  session.run({"motion"});
  await("the motion", [&] { return !session.isBusy() && !session.effects().empty(); });
  application.forgetEvents();
  session.run({"response"});
  await("the response", [&] { return !session.isBusy(); });
  rows.push_back(row("ui/dragon/response/longest-event", size, 1, application.longestEvent()));
  application.forgetEvents();
  QElapsedTimer watch;
  watch.start();
  await("the predicted curve", [&] { return window.response().predictor().isComplete(); });
  rows.push_back(row("ui/dragon/predicted-curve/longest-event", size, 1, application.longestEvent()));
  std::printf("the curve can be predicted %.1f s after it was solved\n", 1e-3 * static_cast<double>(watch.elapsed()));

  // At its highest peak, where the ghost and the predicted curve move most.
  await("the motion on show", [&] { return !session.effects().empty() && session.shown()->study == "response"; });
  const std::string pointer = document.model()->parameters.front()->pointer();
  panels::ParameterSlider& slider = *window.parameters().row(pointer)->slider();
  const plots::ResponsePlot& plot = *window.response().plot();
  window.viewport().pause();
  rows.push_back(row("ui/dragon/mouse-move", size, moves, dragTime(slider, plot)));
  window.viewport().play();
  rows.push_back(row("ui/dragon/mouse-move-while-playing", size, moves, dragTime(slider, plot)));

  application.forgetEvents();
  session.run({"design"});
  await("the design", [&] {
    const auto status = document.study("design")->status;
    return status != document::StudyStatus::running && status != document::StudyStatus::waiting;
  });
  rows.push_back(row("ui/dragon/design/longest-event", size, 1, application.longestEvent()));
  application.forgetEvents();
  window.design().take()->click();
  await("the design's model", [&] { return !document.isEditing(); });
  for (int i = 0; i < moves; ++i) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 20);
  rows.push_back(row("ui/dragon/take-design/longest-event", size, 1, application.longestEvent()));
  return rows;
}

}  // namespace pliant::bench
