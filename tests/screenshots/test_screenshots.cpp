#include <QApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QFontDatabase>
#include <QLabel>
#include <QPalette>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <string>

#include "core/scene/json_text.hpp"
#include "tests/screenshots/screenshot.hpp"
#include "tests/ui/render/swinging_fork.hpp"
#include "ui/panels/compound_row.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/panels/parameter_row.hpp"
#include "ui/panels/parameter_slider.hpp"
#include "ui/panels/response_panel.hpp"
#include "ui/shell/job_status.hpp"
#include "ui/shell/main_window.hpp"
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

constexpr int patience = 600'000;  ///< milliseconds; nothing here is timed
const QString scenes = QStringLiteral(PLIANT_SOURCE_DIR "/scenes/harmonic/");

/// A resonance curve in closed form, leaning over, with a shown motion and a prediction.
std::unique_ptr<plots::ResponsePlot> makePlot(bool predicted) {
  plots::ResponseCurve curve, other;
  curve.name = "left tip";
  other.name = "right tip";
  for (int i = 0; i <= 200; ++i) {
    const double s = -1 + 0.01 * i;
    const double amplitude = 0.05 / (1 + 30 * s * s);
    curve.omega.push_back(10 + 5 * s + 40 * amplitude);
    curve.amplitude.push_back(amplitude);
    curve.kinds.push_back(i == 100 ? harmonic::PointKind::peak : harmonic::PointKind::regular);
    other.omega.push_back(curve.omega.back());
    other.amplitude.push_back(0.6 * amplitude);
  }
  other.kinds.assign(other.omega.size(), harmonic::PointKind::regular);
  auto plot = std::make_unique<plots::ResponsePlot>();
  plot->resize(800, 280);
  plot->setFrequencyRange(5, 15);
  plot->setAmplitudeLabel(QStringLiteral("Path length"));
  plot->setCurves(
      {curve, other}, 0, predicted ? document::StudyStatus::stale : document::StudyStatus::solved, predicted, {});
  plot->setShownMotion(plots::ResponsePlace{curve.omega[85], curve.amplitude[85]});
  if (predicted) {
    plot->setPrediction(plots::ResponsePlace{curve.omega[85], 1.3 * curve.amplitude[85]});
    plots::PredictedResponse foretold{curve, {}};
    for (double& omega : foretold.curve.omega) omega -= 1;
    for (double& amplitude : foretold.curve.amplitude) amplitude *= 1.2;
    foretold.peaks = {{foretold.curve.omega[100], foretold.curve.amplitude[100]}};
    plot->setPredictedCurve(std::move(foretold));
  }
  plot->show();
  return plot;
}

/// A window on a scene whose studies are solved; the motion stands at τ.
std::unique_ptr<shell::MainWindow> makeSolvedWindow(const QString& file, QSize size, double tau) {
  auto window = std::make_unique<shell::MainWindow>(false);
  window->resize(size);
  window->show();
  if (!QTest::qWaitForWindowExposed(window.get())) return nullptr;
  window->openFile(file, true);
  const bool solved = QTest::qWaitFor(
      [&] { return !window->document().isEmpty() && window->session().shown() && !window->session().isBusy(); },
      patience);
  if (!solved || !QTest::qWaitFor([&] { return !window->session().effects().empty(); }, patience)) return nullptr;
  // Everything that is found behind the motion.
  const jobs::CurvePredictor& curve = window->response().predictor();
  if (!QTest::qWaitFor([&] { return !curve.model() || curve.isComplete(); }, patience)) return nullptr;
  const auto& parameters = window->parameters();
  if (parameters.compound()->isVisible() && parameters.compound()->slider()->isEnabled() &&
      !QTest::qWaitFor([&] { return parameters.trust().reach().has_value(); }, patience))
    return nullptr;
  window->viewport().pause();
  window->viewport().setTau(tau);
  return window;
}

/// Moves the slider of the first mass and leaves it there, so that the prediction is seen.
void dragFirstMass(shell::MainWindow& window, int pixels) {
  panels::ParameterSlider* slider = window.parameters().row("/point_masses/0/mass")->slider();
  const QPoint start = slider->handlePosition();
  QTest::mousePress(slider, Qt::LeftButton, {}, start);
  QTest::mouseMove(slider, start + QPoint(pixels / 2, 0));
  QTest::mouseMove(slider, start + QPoint(pixels, 0));
}

QImage grab(shell::MainWindow& window) {
  // The seconds that the solves took are nobody's picture.
  for (QLabel* label : window.findChild<shell::JobStatus*>()->findChildren<QLabel*>()) label->setText("Ready");
  window.viewport().settle();
  QTest::qWait(200);
  return window.grab().toImage();
}

}  // namespace

class TestScreenshots : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase();
  void pictures_data();
  void pictures();
  void aChangedPictureIsNoticed();
  void thePlot();
  void theWholeWindow();
  void thePictureOfTheReadme();
};

void TestScreenshots::initTestCase() {
  QVERIFY(qEnvironmentVariableIsEmpty("DISPLAY"));
  // Pinned, so that the picture does not depend on the desktop.
  QVERIFY2(QFontDatabase::families().contains("DejaVu Sans"), "the package fonts-dejavu-core is not installed");
  QApplication::setFont(QFont("DejaVu Sans", 9));
  shell::applyTheme(shell::Theme::light);
}

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

void TestScreenshots::thePlot() {
  constexpr int allowed = 60;
  const auto picture = [](bool predicted) {
    const auto plot = makePlot(predicted);
    return QTest::qWaitForWindowExposed(plot.get()) ? plot->grab().toImage() : QImage();
  };
  const QString problem = compareWithBaseline(picture(true), "plot", allowed, Sharpness::smooth);
  QVERIFY2(problem.isEmpty(), qPrintable(problem));
  if (qEnvironmentVariableIntValue("PLIANT_RECORD_SCREENSHOTS")) return;
  // Without the prediction it is another picture.
  const QString changed = compareWithBaseline(picture(false), "plot", allowed, Sharpness::smooth);
  QVERIFY2(changed.contains("pixels differ"), qPrintable(changed));
  for (const char* kind : {".actual.png", ".difference.png"})
    QVERIFY(QFile::remove(QStringLiteral(PLIANT_BINARY_DIR "/screenshots/plot") + kind));
}

void TestScreenshots::theWholeWindow() {
  constexpr int allowed = 400;
  const auto window = makeSolvedWindow(scenes + "membrane_strip.json", {1280, 800}, 0.9);
  QVERIFY(window);
  dragFirstMass(*window, 24);
  QVERIFY(window->session().prediction().has_value());
  const std::string mass = window->document().model()->parameters.front()->pointer();
  QTRY_VERIFY(window->parameters().trust().range(mass).has_value());  // its track fades
  const QString problem = compareWithBaseline(grab(*window), "window", allowed, Sharpness::smooth);
  QVERIFY2(problem.isEmpty(), qPrintable(problem));
  if (qEnvironmentVariableIntValue("PLIANT_RECORD_SCREENSHOTS")) return;
  // A little more of the mass is another picture.
  dragFirstMass(*window, 12);
  const QString changed = compareWithBaseline(grab(*window), "window", allowed, Sharpness::smooth);
  QVERIFY2(changed.contains("pixels differ"), qPrintable(changed));
  for (const char* kind : {".actual.png", ".difference.png"})
    QVERIFY(QFile::remove(QStringLiteral(PLIANT_BINARY_DIR "/screenshots/window") + kind));
}

/// docs/window.png, made anew with PLIANT_RECORD_README=1.
void TestScreenshots::thePictureOfTheReadme() {
  if (!qEnvironmentVariableIntValue("PLIANT_RECORD_README")) QSKIP("the picture of the README is not asked for");
  // The dragon's wing with studies that take seconds.
  base::Json scene = base::Json::parse(scene::readTextFile((scenes + "dragon.json").toStdString()));
  scene["geometry"][0]["path"] = (scenes + "../assets/dragon_wing_fine.stl").toStdString();
  scene["studies"] = base::Json::parse(R"([
    {"name": "motion", "type": "periodic_motion", "frequency": "4 Hz", "harmonics": 3, "samples": 7},
    {"name": "response", "type": "frequency_response", "from": "2.5 Hz", "to": "6 Hz", "harmonics": 3, "samples": 7,
     "stability": "off"}])");
  scene.erase("expected");
  const QTemporaryDir folder;
  scene::writeTextFile(folder.filePath("dragon.json").toStdString(), scene.dump());
  const auto window = makeSolvedWindow(folder.filePath("dragon.json"), {1440, 900}, 3.6);
  QVERIFY(window);
  dragFirstMass(*window, 6);
  QVERIFY(window->session().prediction().has_value());
  const QString file = QStringLiteral(PLIANT_SOURCE_DIR "/docs/window.png");
  QVERIFY(QDir().mkpath(QFileInfo(file).absolutePath()));
  QVERIFY(grab(*window).convertToFormat(QImage::Format_RGB32).save(file));
  QVERIFY(QFileInfo(file).size() < 400'000);
}

}  // namespace pliant::screenshots

QTEST_MAIN(pliant::screenshots::TestScreenshots)
#include "test_screenshots.moc"
