/// `pliant-bench-ui ui|ui-design [--json FILE]`: what a designer waits for in the window.
#include <QApplication>
#include <QElapsedTimer>
#include <stdexcept>

#include "tests/benchmarks/bench_program.hpp"
#include "tests/benchmarks/ui/bench_design_ui.hpp"
#include "tests/benchmarks/ui/bench_row.hpp"
#include "tests/benchmarks/ui/bench_sheet.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/viewport/viewport.hpp"

namespace {

using namespace pliant;
using base::Json;
using bench::repetitions;
using bench::rowOf;

constexpr int patience = 300'000;  // milliseconds

template <class Condition>
void waitFor(const Condition& condition, const char* what) {
  QElapsedTimer watch;
  watch.start();
  while (!condition()) {
    if (watch.elapsed() > patience) throw std::runtime_error(std::string("waited too long for ") + what);
    QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents, 20);
  }
}

/// The fork's motion in a window of 1280 x 800.
Json measure() {
  shell::MainWindow window(false);
  window.resize(1280, 800);
  window.show();
  window.openFile(QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/fork.json"));
  jobs::MotionSession& session = window.session();
  auto* viewport = window.findChild<viewport::Viewport*>();
  waitFor([&] { return window.document().model() != nullptr; }, "the scene");
  session.run({"motion"});
  waitFor([&] { return !session.isBusy() && !session.effects().empty(); }, "the motion");
  viewport->pause();
  const std::string pointer = window.document().model()->parameters.front()->pointer();
  const double mass = window.document().valueAt(pointer).get<double>();
  const int size = static_cast<int>(session.shown()->problem->size());
  std::printf("drawn by %s\n", viewport->surfaceName().toUtf8().constData());

  Json rows = Json::array();
  rows.push_back(rowOf("ui/fork/frame", size, [&](int i) { viewport->setTau(0.1 * (i + 1)); }));
  rows.push_back(
      rowOf("ui/fork/ghost", size, [&](int i) { session.preview(pointer, mass * (1 + 0.5 * (i + 1) / repetitions)); }));
  rows.push_back(rowOf("ui/fork/ghost-and-frame", size, [&](int i) {
    session.preview(pointer, mass * (1 + 0.5 * (i + 1) / repetitions));
    viewport->setTau(0.1 * (i + 1));
  }));
  session.endPreview();
  bench::measureSheets(rows);
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  pliant::bench::TimedApplication application(argc, argv);
  return pliant::bench::runBenchmark(argc, argv, {{"ui", measure}, {"ui-design", pliant::bench::measureDesign}});
}
