#include <QFile>
#include <QPalette>
#include <QTest>
#include <functional>
#include <map>
#include <string>

#include "tests/screenshots/screenshot.hpp"
#include "tests/ui/render/swinging_fork.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::screenshots {
namespace {

/// One picture a line: what is shown, how, the baseline's name, and how many pixels may differ from it.
struct Row {
  const char* scene;
  const char* view;
  const char* baseline;
  int threshold;
};

constexpr Row rows[] = {
    {"swinging fork", "viewport", "viewport_solved", 100},
    {"swinging fork", "viewport, predicted", "viewport_predicted", 100},
    {"swinging fork", "viewport, stale, dark", "viewport_stale_dark", 100},
};

/// Mentioned words switch things on.
QImage drawViewport(const render::SwingingFork& fork, const std::string& view) {
  const auto asked = [&](const char* word) { return view.find(word) != std::string::npos; };
  viewport::Viewport widget;
  QPalette palette;
  palette.setColor(QPalette::Window, asked("dark") ? QColor(32, 34, 38) : QColor(240, 240, 240));
  widget.setPalette(palette);
  widget.resize(880, 560);
  widget.setModel(fork.model);
  widget.setMotion(fork.problem, fork.motion(0.03));
  widget.setCaption(QStringLiteral("response · ω = 52.40 rad/s · H = 3\nresidual 3.1e-11"));
  widget.setTau(1.2);
  widget.setSelectedNode(fork.leftTip);
  if (asked("predicted")) widget.setPrediction(fork.motion(0.034));
  if (asked("stale")) widget.setStale(true);
  widget.show();
  return QTest::qWaitForWindowExposed(&widget) ? widget.grabImage() : QImage();
}

}  // namespace

class TestScreenshots : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void pictures_data();
  void pictures();
  void aChangedPictureIsNoticed();
};

void TestScreenshots::pictures_data() {
  QTest::addColumn<int>("index");
  for (std::size_t i = 0; i < std::size(rows); ++i) QTest::newRow(rows[i].baseline) << static_cast<int>(i);
}

void TestScreenshots::pictures() {
  QFETCH(int, index);
  const Row& row = rows[index];
  const render::SwingingFork fork;
  const QString problem = compareWithBaseline(drawViewport(fork, row.view), row.baseline, row.threshold);
  QVERIFY2(problem.isEmpty(), qPrintable(problem));
}

void TestScreenshots::aChangedPictureIsNoticed() {
  if (qEnvironmentVariableIntValue("PLIANT_RECORD_SCREENSHOTS")) QSKIP("baselines are being recorded");
  const render::SwingingFork fork;
  const QImage other = drawViewport(fork, "viewport, predicted");
  const QString problem = compareWithBaseline(other, rows[0].baseline, rows[0].threshold);
  QVERIFY2(problem.contains("pixels differ"), qPrintable(problem));
  for (const char* kind : {".actual.png", ".difference.png"})
    QVERIFY(QFile::remove(QStringLiteral(PLIANT_BINARY_DIR "/screenshots/") + rows[0].baseline + kind));
}

}  // namespace pliant::screenshots

QTEST_MAIN(pliant::screenshots::TestScreenshots)
#include "test_screenshots.moc"
