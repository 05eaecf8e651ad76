#include <QTest>

#include "core/interlock/element_families.hpp"
#include "core/interlock/patch.hpp"
#include "tests/ui/render/pixels.hpp"
#include "ui/render/boundary_picture.hpp"
#include "ui/render/element_tints.hpp"

namespace pliant::render {

namespace {

using Eigen::Vector3d;

/// A hexagon of 19 elements and its neighbours' rings.
std::shared_ptr<const interlock::UnitCell> hexagon() {
  static const auto patch = std::make_shared<const interlock::UnitCell>(
      interlock::cutPatch(interlock::threefold(), {interlock::PatchOutline::Kind::circle, {0, 0}, 0.03, {0, 0}}));
  return patch;
}

std::shared_ptr<PatchConfiguration> atRest() {
  auto configuration = std::make_shared<PatchConfiguration>();
  configuration->patch = hexagon();
  configuration->state = interlock::restState(*hexagon());
  return configuration;
}

Image draw(const std::shared_ptr<const PatchConfiguration>& configuration, AxisView view = AxisView::top) {
  PictureOptions options;
  options.width = 480;
  options.height = 400;
  options.view = view;
  return drawPatch(configuration, options);
}

bool isDark(int red, int green, int blue) { return std::max({red, green, blue}) < 110; }
bool isPink(int red, int green, int blue) { return red > green + 25 && blue > green + 10; }
bool isOrange(int red, int green, int blue) { return red > blue + 60 && red > green + 25; }

/// Pixels of elements and marks: the key at the bottom right becomes background, as the top left corner is.
Blob found(Image image, const PixelTest& test) {
  for (int y = image.height - 100; y < image.height; ++y)
    for (int x = image.width - 120; x < image.width; ++x)
      std::copy_n(&image.pixels[0], 3, &image.pixels[4 * (static_cast<std::size_t>(y) * image.width + x)]);
  return findBlob(image, test);
}

}  // namespace

/// Finite patches as they are drawn.
class TestPatchView : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// On a lattice of triangles three tints keep linked elements apart.
  void linkedElementsDiffer() {
    const std::vector<int> tints = elementTints(*hexagon(), 3);
    QVERIFY(!hexagon()->links.empty());
    for (const interlock::Link& link : hexagon()->links)
      QVERIFY(tints[static_cast<std::size_t>(link.a)] != tints[static_cast<std::size_t>(link.b)]);
  }

  /// Elements are drawn where they are, turned as they are: a ring that stands is a line from above.
  void instancesHaveTheirPoses() {
    auto alone = std::make_shared<interlock::UnitCell>();
    alone->shapes = {
        {"ring", {interlock::wire(interlock::ClosedCurve::circle(Vector3d::Zero(), Vector3d::UnitZ(), 0.01), 0.001)}}};
    alone->elements = {
        {0, Vector3d::Zero(), Eigen::Matrix3d::Identity()}, {0, Vector3d(0.05, 0, 0), Eigen::Matrix3d::Identity()}};
    auto configuration = std::make_shared<PatchConfiguration>();
    configuration->patch = alone;
    configuration->state = interlock::restState(*alone);
    const auto isElement = differsFrom(palette(Theme::light).background);
    const Blob both = found(draw(configuration), isElement);
    // Turned about x by a right angle they are as high as their wire.
    configuration = std::make_shared<PatchConfiguration>(*configuration);
    configuration->state.rotations[1] << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    configuration->state.rotations[0] = configuration->state.rotations[1];
    const Blob turned = found(draw(configuration), isElement);
    QVERIFY(both.pixels > 0 && turned.pixels > 0);
    const double wire = static_cast<double>(turned.bottom - turned.top) / (both.bottom - both.top);
    QVERIFY2(wire > 0.06 && wire < 0.13, qPrintable(QString::number(wire)));  // 2 mm of 22 mm
    // 22 mm and 50 mm beside each other, and 22 mm high.
    const double sides = static_cast<double>(both.right - both.left) / (both.bottom - both.top);
    QVERIFY2(std::abs(sides - 72.0 / 22) < 0.1, qPrintable(QString::number(sides)));
  }

  void clampedElementsAndContactsAreMarked() {
    const auto plain = atRest();
    auto marked = std::make_shared<PatchConfiguration>(*plain);
    marked->clamped = {0, 1, 2};
    interlock::CellContactForce contact{};
    contact.place = {0, 0, 0.01};
    marked->contacts = {contact};
    const Image before = draw(plain), after = draw(marked);
    QCOMPARE(found(before, isPink).pixels, 0);
    QVERIFY(found(after, isPink).pixels > 500);
    QCOMPARE(found(before, isOrange).pixels, 0);
    const Blob dot = found(after, isOrange);
    QVERIFY(dot.pixels > 20 && std::abs(dot.x - 240) < 60 && std::abs(dot.y - 200) < 60);
    PatchView view;
    view.setConfiguration(marked);
    QCOMPARE(view.markCount(), 1);
    view.setConfiguration(nullptr);
    QCOMPARE(view.markCount(), 0);
  }

  /// The paraboloid is behind everything: it changes no pixel of an element, and it bends to its side.
  void theParaboloidIsBehind() {
    auto bent = std::make_shared<PatchConfiguration>(*atRest());
    bent->curvature = Vector3d(-40, 0, 0);
    const Image image = draw(bent, AxisView::front), plain = draw(atRest(), AxisView::front);
    const auto isThere = differsFrom(palette(Theme::light).background);
    QVERIFY(found(image, isThere).pixels > found(plain, isThere).pixels + 200);
    // A dome hangs below the elements.
    QVERIFY(found(image, isThere).bottom > found(plain, isThere).bottom);
  }

  void weightHasAnArrow() {
    auto hanging = std::make_shared<PatchConfiguration>(*atRest());
    hanging->gravity = Vector3d(0, 0, -9.81);
    const Blob arrow = found(draw(hanging, AxisView::front), isDark);
    QVERIFY(arrow.pixels > 100);
    // Its head is below: more of it is dark there.
    QVERIFY(arrow.y > 0.5 * (arrow.top + arrow.bottom));
  }
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestPatchView)
#include "test_patch_view.moc"
