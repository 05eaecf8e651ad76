#include <QTest>

#include "core/interlock/element_families.hpp"
#include "tests/ui/render/ellipsoid_boundary.hpp"
#include "tests/ui/render/pixels.hpp"
#include "ui/render/boundary_picture.hpp"
#include "ui/render/offscreen_target.hpp"

namespace pliant::render {

namespace {

constexpr int width = 420, height = 360;
const Eigen::Vector3d axes(0.1, 0.08, 0.06), middle(-0.04, 0.02, 0.01);

PictureOptions pictureFrom(AxisView view) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  options.view = view;
  return options;
}

Image draw(const BoundaryScenery& scenery, AxisView view = AxisView::isometric) {
  return drawBoundary(scenery, pictureFrom(view));
}

bool isOrange(int red, int green, int blue) { return red > blue + 60 && red > green + 25; }
/// Grey as `Palette::rest` in any light, and no other part of the picture is as large.
bool isGrey(int red, int green, int blue) {
  return std::abs(red - green) < 14 && std::abs(blue - green) < 24 && green > 60 && green < 225;
}
bool isViridis(int red, int green, int blue) {
  return std::max({red, green, blue}) - std::min({red, green, blue}) > 40 && !isOrange(red, green, blue);
}

/// Without the scalar bar.
int countOf(const Image& image, const PixelTest& test) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width - 112; ++x) {
      const std::uint8_t* p = &image.pixels[4 * (static_cast<std::size_t>(y) * image.width + x)];
      count += test(p[0], p[1], p[2]);
    }
  return count;
}

}  // namespace

/// Boundaries and limits as they are drawn and picked.
class TestBoundaryView : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void whatIsNotKnownIsGrey() {
    const auto whole = ellipsoidBoundary(axes, middle);
    auto half = std::make_shared<scene::BoundarySurface>(*whole);
    for (Eigen::Index i = 0; i < half->points.cols(); ++i)
      half->known[static_cast<std::size_t>(i)] = half->points(2, i) < middle.z();
    QVERIFY(half->knownCount() > 280 && half->knownCount() < 360);
    BoundaryStyle bare;
    bare.shadows = false;
    const Image full = draw({whole, nullptr, bare}, AxisView::top), upper = draw({half, nullptr, bare}, AxisView::top);
    const Image lower = draw({half, nullptr, bare}, AxisView::bottom);
    QVERIFY(countOf(full, isViridis) > 10 * countOf(upper, isViridis));
    QVERIFY(countOf(upper, isGrey) > countOf(full, isGrey) + countOf(full, isViridis) / 2);
    QVERIFY(countOf(lower, isViridis) > countOf(full, isViridis) * 3 / 4);
  }

  void anotherBoundaryIsDrawnOver() {
    const auto first = ellipsoidBoundary(axes, middle), second = ellipsoidBoundary(1.3 * axes, middle);
    BoundaryStyle plain;
    plain.quantity = "none";
    QCOMPARE(countOf(draw({first, nullptr, plain}), isOrange), 0);
    const int over = countOf(draw({first, second, plain}), isOrange);
    QVERIFY2(over > 5000, qPrintable(QString::number(over)));
    // Within the first it is hidden, as long as that is opaque; its shadows' outlines are left.
    const auto inner = ellipsoidBoundary(0.5 * axes, middle);
    const int hidden = countOf(draw({first, inner, plain}), isOrange);
    QVERIFY2(hidden < over / 5, qPrintable(QString::number(hidden)));
    plain.opacity = 0.3;
    QVERIFY(countOf(draw({first, inner, plain}), isOrange) > hidden + 500);
  }

  void shadowsSlicesAndDotsCanBeShown() {
    const auto surface = ellipsoidBoundary(axes, middle);
    BoundaryStyle style;
    style.shadows = false;
    const Image bare = draw({surface, nullptr, style});
    for (const auto change : {0, 1, 2, 3}) {
      BoundaryStyle changed = style;
      if (change == 0) changed.shadows = true;
      if (change == 1) changed.sliceAxis = 2, changed.slicePosition = 0.02;
      if (change == 2) changed.states = true;
      if (change == 3) changed.quantity = "way";
      QVERIFY(draw({surface, nullptr, changed}).pixels != bare.pixels);
    }
    QVERIFY(draw({surface, nullptr, style}).pixels == bare.pixels);
  }

  /// From each side the limit that is nearest is picked, never one behind it.
  void limitsArePickedOnTheNearSide() {
    OffscreenTarget target;
    target.setSize(width, height);
    BoundaryView view;
    view.attach(target.window());
    const auto surface = ellipsoidBoundary(axes, middle);
    view.setSurface(surface);
    Image image;
    for (const auto& [side, direction] :
         {std::pair(AxisView::top, Eigen::Vector3d(0, 0, 1)), std::pair(AxisView::bottom, Eigen::Vector3d(0, 0, -1)),
          std::pair(AxisView::front, Eigen::Vector3d(0, -1, 0)),
          std::pair(AxisView::right, Eigen::Vector3d(1, 0, 0))}) {
      view.setAxisView(side);
      target.render(image);
      Eigen::Index farthest = 0;
      (direction.transpose() * surface->points).maxCoeff(&farthest);
      const auto pixel = view.pixelOf(static_cast<int>(farthest));
      QVERIFY(pixel.has_value());
      QVERIFY(view.pickNode(pixel->x(), pixel->y(), 1) == static_cast<int>(farthest));
    }
    QVERIFY(!view.pickNode(3, 3, 100));
    QCOMPARE(view.range(0)[0], surface->points.row(0).minCoeff());
    QCOMPARE(view.range(2)[1], surface->points.row(2).maxCoeff());
  }

  void aLimitShowsItsContacts() {
    auto configuration = std::make_shared<CellConfiguration>();
    auto cell = std::make_shared<interlock::UnitCell>(interlock::ringNet({4e-3, 0.6e-3, 12e-3}));
    configuration->cell = cell;
    configuration->state = interlock::restState(*cell);
    PictureOptions options = pictureFrom(AxisView::top);
    const Image atRest = drawConfiguration(configuration, options);
    QVERIFY(countOf(atRest, differsFrom(palette(Theme::light).background)) > width * height / 8);
    // One contact within the cell and one with a neighbour: the latter is left out where the neighbour is not drawn.
    interlock::CellContactForce within{}, across{};
    within.pair = {0, 1, {0, 0}, 0, 0};
    across.pair = {0, 1, {1, 0}, 0, 0};
    across.place = {6e-3, 0, 0};
    configuration->contacts = {within, across};
    LimitView view;
    view.setConfiguration(configuration);
    QCOMPARE(view.markCount(), 9 + 6);
    const int marks = countOf(drawConfiguration(configuration, options), isOrange) - countOf(atRest, isOrange);
    QVERIFY2(marks > 15 * 20, qPrintable(QString::number(marks)));
    view.setConfiguration(nullptr);
    QCOMPARE(view.markCount(), 0);
  }
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestBoundaryView)
#include "test_boundary_view.moc"
