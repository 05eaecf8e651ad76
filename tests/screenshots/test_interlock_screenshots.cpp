#include <QApplication>
#include <QFile>
#include <QFontDatabase>
#include <QTest>
#include <numbers>

#include "core/interlock/element_families.hpp"
#include "core/interlock/patch.hpp"
#include "tests/screenshots/screenshot.hpp"
#include "tests/ui/render/ellipsoid_boundary.hpp"
#include "ui/plots/polar_plot.hpp"
#include "ui/render/boundary_picture.hpp"
#include "ui/shell/theme.hpp"

namespace pliant::screenshots {
namespace {

QImage asImage(const render::Image& image) {
  return QImage(image.pixels.data(), image.width, image.height, 4 * image.width, QImage::Format_RGBA8888).copy();
}

render::PictureOptions options(bool dark) {
  render::PictureOptions made;
  made.width = 720;
  made.height = 480;
  made.theme = dark ? render::Theme::dark : render::Theme::light;
  made.caption = "Ellipsoid\nboundary,  642 limits";
  return made;
}

QImage drawBoundary(double slice, bool dark) {
  render::BoundaryScenery scenery;
  scenery.surface = render::ellipsoidBoundary({0.12, 0.09, 0.06}, {-0.04, -0.02, 0.01});
  scenery.compared = render::ellipsoidBoundary({0.08, 0.1, 0.05}, {0, 0, 0});
  scenery.style.opacity = 0.7;
  scenery.style.sliceAxis = 2;
  scenery.style.slicePosition = slice;
  return asImage(render::drawBoundary(scenery, options(dark)));
}

/// A ring net at rest, with a mark where its rings would touch.
QImage drawLimit(double place) {
  auto configuration = std::make_shared<render::CellConfiguration>();
  auto cell = std::make_shared<interlock::UnitCell>(interlock::ringNet());
  configuration->cell = cell;
  configuration->state = interlock::restState(*cell);
  interlock::CellContactForce contact{};
  contact.pair = {0, 1, {0, 0}, 0, 0};
  contact.place = {place, 0, 0};
  configuration->contacts = {contact};
  return asImage(render::drawConfiguration(configuration, options(false)));
}

/// A patch at rest, with a paraboloid and marks; nothing is computed, so that the picture is the same everywhere.
QImage drawPatch(double curvature, bool dark) {
  auto configuration = std::make_shared<render::PatchConfiguration>();
  auto patch = std::make_shared<interlock::UnitCell>(
      interlock::cutPatch(interlock::threefold(), {interlock::PatchOutline::Kind::circle, {0, 0}, 0.03, {0, 0}}));
  configuration->patch = patch;
  configuration->state = interlock::restState(*patch);
  configuration->clamped = {0, 1, 2};
  configuration->gravity = Eigen::Vector3d(0, 0, -9.81);
  configuration->curvature = Eigen::Vector3d(curvature, -6, 4);
  interlock::CellContactForce contact{};
  contact.place = {0.01, 0.005, 0.002};
  configuration->contacts = {contact};
  contact.place = {-0.012, 0.001, 0.001};
  configuration->contacts.push_back(contact);
  render::PictureOptions made = options(dark);
  made.caption = "Threefold chain mail\nbend:  18.00 1/m at 0°,  radius 55.56 mm,  across 6 1/m\nheld at 2 places";
  return asImage(render::drawPatch(configuration, made));
}

QImage drawCurvatureBoundary(double slice) {
  render::BoundaryScenery scenery;
  auto surface = std::make_shared<scene::BoundarySurface>(*render::ellipsoidBoundary({70, 50, 30}, {-20, -15, 5}));
  surface->space = scene::curvatureSpace();
  scenery.surface = surface;
  scenery.style.sliceAxis = 0;
  scenery.style.slicePosition = slice;
  scenery.style.opacity = 0.8;
  return asImage(render::drawBoundary(scenery, options(false)));
}

/// Limits of curvature up and down, as from a study that has not ended: some are not known.
QImage drawCurvatures(double limit, bool dark) {
  shell::applyTheme(dark ? shell::Theme::dark : shell::Theme::light);
  scene::CurvatureLimitsResult result;
  for (int i = 0; i < 12; ++i) {
    interlock::BendingLimits& limits = result.directions.emplace_back();
    for (interlock::BendingLimit* each : {&limits.up, &limits.down}) {
      const double sign = each == &limits.up ? 1 : -1;
      each->angle = i * std::numbers::pi / 12;
      each->kind = i == 5 || i == 7 ? interlock::BendingKind::unsettled : interlock::BendingKind::locked;
      each->curvature = sign * (limit + (sign < 0 ? 30 : 0) + 4 * std::cos(6 * each->angle));
      each->orthogonal = sign * -10;
    }
  }
  plots::PolarPlot plot;
  plot.resize(420, 460);
  plot.setCurves(scene::curvatureLimitCurves(result));
  plot.show();
  const QImage picture = QTest::qWaitForWindowExposed(&plot) ? plot.grab().toImage() : QImage();
  shell::applyTheme(shell::Theme::light);
  return picture;
}

QImage drawPolar(double limit, bool dark) {
  shell::applyTheme(dark ? shell::Theme::dark : shell::Theme::light);
  constexpr double degree = std::numbers::pi / 180;
  scene::PolarCurves curves{"free travel", "%", 100, 3, {}};
  scene::PolarCurve stretch{"stretch", {}, {}, {}, true, false}, compression = stretch;
  compression.name = "compression";
  for (int i = 0; i < 36; ++i) {
    stretch.angles.push_back(5 * i * degree);
    stretch.values.push_back(limit + 0.02 * std::cos(30 * i * degree));
    compression.angles.push_back(5 * i * degree);
    compression.values.push_back(-0.2 + 0.05 * std::cos(20 * i * degree));
  }
  curves.curves = {stretch, compression};
  plots::PolarPlot plot;
  plot.resize(420, 460);
  plot.setCurves(curves);
  plot.addMeasured({"stretch", {{20 * degree, 0.1, 0.08, 0.12}, {110 * degree, 0.07, 0.05, 0.08}}});
  plot.show();
  const QImage picture = QTest::qWaitForWindowExposed(&plot) ? plot.grab().toImage() : QImage();
  shell::applyTheme(shell::Theme::light);
  return picture;
}

}  // namespace

/// Pictures of the area of interlocking materials.
class TestInterlockScreenshots : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    QVERIFY2(QFontDatabase::families().contains("DejaVu Sans"), "the package fonts-dejavu-core is not installed");
    QApplication::setFont(QFont("DejaVu Sans", 9));
    shell::applyTheme(shell::Theme::light);
  }

  void theBoundary() {
    compare(drawBoundary(0.01, false), "boundary", 120);
    compare(drawBoundary(0.01, true), "boundary_dark", 120);
    requireNoticed(drawBoundary(0.02, false), "boundary", 120);
  }

  void theLimit() {
    compare(drawLimit(6e-3), "cell_limit", 100);
    requireNoticed(drawLimit(5e-3), "cell_limit", 100);
  }

  void thePatch() {
    compare(drawPatch(12, false), "patch", 150);
    compare(drawPatch(12, true), "patch_dark", 150);
    requireNoticed(drawPatch(-12, false), "patch", 150);
  }

  void theBendingBoundary() {
    compare(drawCurvatureBoundary(10), "bending_boundary", 120);
    requireNoticed(drawCurvatureBoundary(-20), "bending_boundary", 120);
  }

  void theCurvatures() {
    compare(drawCurvatures(45, false), "curvatures", 60, Sharpness::smooth);
    compare(drawCurvatures(45, true), "curvatures_dark", 60, Sharpness::smooth);
    requireNoticed(drawCurvatures(49, false), "curvatures", 60, Sharpness::smooth);
  }

  void thePolarPlot() {
    compare(drawPolar(0.1, false), "polar_plot", 60, Sharpness::smooth);
    compare(drawPolar(0.1, true), "polar_plot_dark", 60, Sharpness::smooth);
    requireNoticed(drawPolar(0.11, false), "polar_plot", 60, Sharpness::smooth);
  }

 private:
  static void compare(const QImage& picture, const char* name, int allowed, Sharpness sharpness = Sharpness::exact) {
    const QString problem = compareWithBaseline(picture, name, allowed, sharpness);
    QVERIFY2(problem.isEmpty(), qPrintable(problem));
  }

  /// Another picture differs, and what was kept of it goes.
  static void requireNoticed(const QImage& picture, const char* name, int allowed,
                             Sharpness sharpness = Sharpness::exact) {
    if (qEnvironmentVariableIntValue("PLIANT_RECORD_SCREENSHOTS")) return;
    const QString difference = compareWithBaseline(picture, name, allowed, sharpness);
    QVERIFY2(difference.contains("pixels differ"), qPrintable(difference));
    for (const char* kind : {".actual.png", ".difference.png"})
      QVERIFY(QFile::remove(QStringLiteral(PLIANT_BINARY_DIR "/screenshots/") + name + kind));
  }
};

}  // namespace pliant::screenshots

QTEST_MAIN(pliant::screenshots::TestInterlockScreenshots)
#include "test_interlock_screenshots.moc"
