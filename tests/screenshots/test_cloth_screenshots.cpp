#include <QApplication>
#include <QFile>
#include <QFontDatabase>
#include <QPalette>
#include <QTest>
#include <numbers>

#include "tests/screenshots/screenshot.hpp"
#include "tests/ui/render/hanging_sheet.hpp"
#include "ui/plots/polar_editor.hpp"
#include "ui/shell/theme.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::screenshots {
namespace {

/// A limit with all that can lie over it.
QImage drawPolar(double stretchAtBias, bool dark) {
  constexpr double degree = std::numbers::pi / 180;
  shell::applyTheme(dark ? shell::Theme::dark : shell::Theme::light);
  plots::PolarEditor editor;
  editor.resize(360, 400);
  const cloth::StretchLimit limit = cloth::LimitCurve(
      {{0, 1.03}, {30 * degree, 1.09}, {50 * degree, stretchAtBias}, {90 * degree, 1.05}, {140 * degree, 1.12}});
  editor.setLimit(limit, true);
  editor.setConstraints(cloth::ellipseConstraints(limit, 6));
  editor.setMeasured({{20 * degree, 1.07, 1.05, 1.09}, {75 * degree, 1.1, 1.07, 1.12}});
  Eigen::VectorXd reached(90);
  for (int i = 0; i < 90; ++i) reached[i] = 1 + 0.7 * (cloth::stretchAt(limit, 2 * i * degree) - 1);
  editor.setReached(reached, QStringLiteral("the worst of all triangles"));
  editor.select(2);
  editor.show();
  const QImage picture = QTest::qWaitForWindowExposed(&editor) ? editor.grab().toImage() : QImage();
  shell::applyTheme(shell::Theme::light);
  return picture;
}

QImage drawCloth(double time) {
  const render::HangingSheet sheet;
  viewport::Viewport widget;
  widget.resize(720, 480);
  widget.setCloth(sheet.problem);
  widget.setClothFrames(sheet.frames, false, viewport::Viewport::FrameClock::seconds);
  widget.setTime(time);
  widget.setCaption(QStringLiteral("Hanging sheet\nswing,  10 steps,  limits kept to 1e-09"));
  widget.show();
  return QTest::qWaitForWindowExposed(&widget) ? widget.grabImage() : QImage();
}

}  // namespace

/// Pictures of the cloth area.
class TestClothScreenshots : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    QVERIFY2(QFontDatabase::families().contains("DejaVu Sans"), "the package fonts-dejavu-core is not installed");
    QApplication::setFont(QFont("DejaVu Sans", 9));
    shell::applyTheme(shell::Theme::light);
  }

  void thePolarEditor() {
    constexpr int allowed = 60;
    const QString problem = compareWithBaseline(drawPolar(1.18, false), "polar", allowed, Sharpness::smooth);
    QVERIFY2(problem.isEmpty(), qPrintable(problem));
    const QString dark = compareWithBaseline(drawPolar(1.18, true), "polar_dark", allowed, Sharpness::smooth);
    QVERIFY2(dark.isEmpty(), qPrintable(dark));
    if (qEnvironmentVariableIntValue("PLIANT_RECORD_SCREENSHOTS")) return;
    requireNoticed(compareWithBaseline(drawPolar(1.16, false), "polar", allowed, Sharpness::smooth), "polar");
  }

  void theClothInTheViewport() {
    constexpr int allowed = 100;
    const QString problem = compareWithBaseline(drawCloth(0.7), "cloth", allowed);
    QVERIFY2(problem.isEmpty(), qPrintable(problem));
    if (qEnvironmentVariableIntValue("PLIANT_RECORD_SCREENSHOTS")) return;
    requireNoticed(compareWithBaseline(drawCloth(0.6), "cloth", allowed), "cloth");
  }

 private:
  /// Another picture differs, and what was kept of it goes.
  void requireNoticed(const QString& difference, const char* name) {
    QVERIFY2(difference.contains("pixels differ"), qPrintable(difference));
    for (const char* kind : {".actual.png", ".difference.png"})
      QVERIFY(QFile::remove(QStringLiteral(PLIANT_BINARY_DIR "/screenshots/") + name + kind));
  }
};

}  // namespace pliant::screenshots

QTEST_MAIN(pliant::screenshots::TestClothScreenshots)
#include "test_cloth_screenshots.moc"
