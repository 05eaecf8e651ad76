#include "ui/render/boundary_view.hpp"

#include <vtkMapper.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ui/render/axes_box.hpp"
#include "ui/render/boundary_surface_figure.hpp"
#include "ui/render/bounds.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/ring.hpp"
#include "ui/render/stage.hpp"
#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

using scene::BoundaryQuantity;
using scene::BoundarySurface;

constexpr double comparedOpacity = 0.4, planeOpacity = 0.16;
constexpr double seenThrough = 0.9;  ///< opacity from which on what is behind is hidden
constexpr double labelRoom = 0.1;    ///< that numbers take around the box, of its extent
/// Of BoundaryQuantity::Kind::way: Okabe and Ito's blue, orange and reddish purple.
constexpr std::array<Color, 3> wayColors{{{0.0, 0.447, 0.698}, {0.902, 0.624, 0.0}, {0.8, 0.475, 0.655}}};
constexpr std::array<const char*, 3> wayNames{"■ straight", "■ raised by\n    a neighbour", "■ not\n    star-shaped"};

bool hasRange(const Bounds& bounds) { return bounds.low[0] <= bounds.high[0]; }

/// All that is drawn of one boundary but its colours.
struct Body {
  std::shared_ptr<const BoundarySurface> surface;
  TranslucentSurface figure;
  std::array<ShadowFigure, 3> shadows;
  LinePrimitive slice{2.6};

  const TriangleList& triangles() const { return surface->triangles; }
  bool isSeen() const { return surface && !surface->triangles.empty(); }
};

}  // namespace

struct BoundaryView::Parts {
  Stage& stage;
  AxesBox box;
  vtkNew<vtkLookupTable> table;
  Body first, compared;
  DotPrimitive stateDots{3.5}, restDots{9}, insideDots{4};
  Points inside = Points(3, 0);
  std::optional<int> ringed;  ///< of those inside
  LinePrimitive restLines{1.0}, planeFrame{1.2};
  SurfacePrimitive plane;
  std::array<vtkNew<vtkTextActor>, 3> ways;
  vtkNew<vtkTextActor> wayTitle, restLabel;
  Ring selectionRing, hoverRing;

  BoundaryStyle style;
  bool stale = false;
  bool namesWays = false;  ///< in the place of the scalar bar
  std::optional<int> selected, hovered;
  Bounds bounds;
  std::array<double, 3> walls{};

  explicit Parts(Stage& around) : stage(around) {
    vtkRenderer* renderer = stage.renderer();
    box.addTo(renderer);
    for (Body* body : {&first, &compared})
      for (ShadowFigure& shadow : body->shadows) shadow.addTo(renderer);
    for (vtkActor* actor : {restLines.actor(), restDots.actor(), insideDots.actor()}) renderer->AddActor(actor);
    for (Body* body : {&first, &compared})
      body->slice.actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-2, -8);
    orderBodies();
    plane.actor()->GetProperty()->LightingOff();
    plane.actor()->GetProperty()->SetOpacity(planeOpacity);
    plane.actor()->ForceOpaqueOn();
    for (auto& way : ways) renderer->AddActor2D(way);
    renderer->AddActor2D(wayTitle);
    renderer->AddActor2D(restLabel);
    selectionRing.addTo(renderer);
    hoverRing.addTo(renderer);
    for (std::size_t i = 0; i < ways.size(); ++i) ways[i]->SetInput(wayNames[i]);
    restLabel->SetInput("rest");
    stage.setGizmoVisible(false);  // the box has names on its axes
    stage.legend().setTable(table);
    stage.onLayOut = [this] { layOut(); };
    stage.onTheme = [this] { applyTheme(); };
    stage.onPixelRatio = [this] { applyPixelRatio(); };
    stage.onField = [this] { showColors(); };
    showSurfaces();
    stage.setTheme(Theme::light);
  }

  /// The smaller one is drawn first, so that it is seen through the other where it lies inside.
  void orderBodies() {
    const auto extent = [](const Body& body) {
      Bounds box;
      if (body.isSeen()) box.add(body.surface->points);
      return hasRange(box) ? (box.high - box.low).prod() : 0;
    };
    std::array<Body*, 2> order{&first, &compared};
    if (compared.isSeen() && extent(compared) < extent(first)) std::swap(order[0], order[1]);
    vtkRenderer* renderer = stage.renderer();
    const auto addLast = [renderer](vtkActor* actor) {
      renderer->RemoveActor(actor);
      renderer->AddActor(actor);
    };
    for (Body* body : order) {
      addLast(body->slice.actor());
      for (vtkActor* side : body->figure.actors()) addLast(side);
    }
    for (vtkActor* actor : {stateDots.actor(), planeFrame.actor(), plane.actor()}) addLast(actor);
  }

  const BoundaryQuantity* quantity() const {
    return first.isSeen() && stage.fieldVisible() ? first.surface->quantity(style.quantity) : nullptr;
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    box.setTheme(colors);
    setColor(restLines.actor(), mixed(colors.background, colors.text, 0.5));
    setColor(restDots.actor(), colors.text);
    setColor(stateDots.actor(), colors.outline);
    setColor(insideDots.actor(), colors.text);
    setColor(planeFrame.actor(), colors.text);
    setColor(plane.actor(), mixed(colors.background, colors.text, 0.6));
    setColor(first.slice.actor(), colors.text);
    setColor(compared.slice.actor(), mixed(colors.prediction, colors.text, 0.25));
    for (ShadowFigure& shadow : first.shadows)
      shadow.setColors(mixed(colors.background, colors.mass, 0.22), mixed(colors.background, colors.mass, 0.55));
    for (ShadowFigure& shadow : compared.shadows) shadow.setColors(colors.prediction, colors.prediction);
    selectionRing.setColors(colors.text, colors.background);
    hoverRing.setColors(mixed(colors.background, colors.text, 0.6), colors.background);
    setTextStyle(restLabel->GetTextProperty(), 12, colors.text);
    restLabel->GetTextProperty()->SetVerticalJustificationToCentered();
    setTextStyle(wayTitle->GetTextProperty(), 12, colors.text);
    for (std::size_t i = 0; i < ways.size(); ++i)
      setTextStyle(ways[i]->GetTextProperty(), 12, mixed(wayColors[i], colors.text, 0.15));
    for (vtkTextActor* text : {wayTitle.Get(), ways[0].Get(), ways[1].Get(), ways[2].Get()}) {
      text->GetTextProperty()->SetVerticalJustificationToTop();
      text->GetTextProperty()->SetLineSpacing(1.15);
    }
    stage.setNotice(stale && first.isSeen() ? "inputs have changed since this was computed" : "", colors.text);
    showColors();
  }

  void applyPixelRatio() {
    const double ratio = stage.pixelRatio();
    box.setPixelRatio(ratio);
    for (Body* body : {&first, &compared}) {
      body->slice.setPixelRatio(ratio);
      for (ShadowFigure& shadow : body->shadows) shadow.setPixelRatio(ratio);
    }
    for (DotPrimitive* dots : {&stateDots, &restDots, &insideDots}) dots->setPixelRatio(ratio);
    for (LinePrimitive* lines : {&restLines, &planeFrame}) lines->setPixelRatio(ratio);
    for (Ring* ring : {&selectionRing, &hoverRing}) ring->setPixelRatio(ratio);
  }

  /// Places of everything; then colours.
  void showSurfaces() {
    bounds = Bounds();
    for (Body* body : {&first, &compared})
      if (body->isSeen())
        for (const auto& triangle : body->triangles())
          for (const int corner : triangle) bounds.add(body->surface->points.col(corner));
    orderBodies();
    const bool any = hasRange(bounds);
    if (any) bounds.add(Points::Zero(3, 1));
    box.setVisible(any);
    if (any) {
      const scene::BoundarySpace& space = (first.isSeen() ? first : compared).surface->space;
      std::array<std::string, 3> names;
      for (std::size_t i = 0; i < 3; ++i) names[i] = space.axes[i] + " [" + space.unit + "]";
      box.setRange(bounds.low, bounds.high, names, space.factor);
      const Eigen::Vector3d around = labelRoom * Eigen::Vector3d::Constant((box.high() - box.low()).maxCoeff());
      Bounds reach;
      reach.low = box.low() - around;
      reach.high = box.high() + around;
      stage.camera().setReach(reach.corners());
      box.layOut(stage.camera());
    }
    std::vector<int> known;
    if (first.isSeen())
      for (std::size_t i = 0; i < first.surface->known.size(); ++i)
        if (first.surface->known[i]) known.push_back(static_cast<int>(i));
    stateDots.setNodes(known);
    stateDots.setPoints(first.surface ? first.surface->points : Points(3, 0));
    showShadows();
    showSlice();
    showColors();
  }

  void showShadows() {
    for (int axis = 0; axis < 3; ++axis) walls[static_cast<std::size_t>(axis)] = box.wall(axis);
    for (Body* body : {&first, &compared})
      for (int axis = 0; axis < 3; ++axis) {
        ShadowFigure& shadow = body->shadows[static_cast<std::size_t>(axis)];
        // A little before the wall, the first behind the second, so that neither flickers.
        const double before = (body == &first ? 1e-3 : 2e-3) * (box.high() - box.low()).norm();
        if (body->isSeen())
          shadow.setOutline(shadowOutline(body->surface->points, body->triangles(), axis), axis,
                            box.wall(axis) + (box.wallIsHigh(axis) ? -before : before));
        shadow.setFilled(body == &first);
        shadow.setVisible(style.shadows && body->isSeen());
      }
    showRest();
  }

  /// The rest state, and its shadows, on lines along the axes.
  void showRest() {
    Points places = Points::Zero(3, 4);
    vtkNew<vtkPoints> ends;
    for (int axis = 0; axis < 3; ++axis) {
      places(axis, axis + 1) = box.wall(axis);
      for (const double end : {box.low()[axis], box.high()[axis]}) {
        const Eigen::Vector3d place = end * Eigen::Vector3d::Unit(axis);
        ends->InsertNextPoint(place.data());
      }
    }
    restDots.setNodes({0, 1, 2, 3});
    restDots.setPoints(places);
    restLines.setPoints(ends);
    restLines.setTopology({{0, 1}, {2, 3}, {4, 5}});
    for (vtkActor* actor : {restDots.actor(), restLines.actor()}) actor->SetVisibility(hasRange(bounds));
  }

  void showSlice() {
    const bool shown = style.sliceAxis && hasRange(bounds);
    for (Body* body : {&first, &compared}) {
      const bool cut = shown && body->isSeen();
      body->slice.actor()->SetVisibility(cut);
      if (!cut) continue;
      std::vector<Points> closed;
      for (SliceCurve& curve :
           sliceCurves(body->surface->points, body->triangles(), *style.sliceAxis, style.slicePosition))
        if (curve.closed) closed.push_back(std::move(curve.points));
      body->slice.setClosedCurves(closed, 0);
    }
    for (vtkActor* actor : {plane.actor(), planeFrame.actor()}) actor->SetVisibility(shown);
    if (!shown) return;
    const int axis = *style.sliceAxis, second = (axis + 1) % 3, third = (axis + 2) % 3;
    Points corners(3, 4);
    for (int i = 0; i < 4; ++i) {
      corners(axis, i) = style.slicePosition;
      corners(second, i) = i == 0 || i == 3 ? box.low()[second] : box.high()[second];
      corners(third, i) = i < 2 ? box.low()[third] : box.high()[third];
    }
    vtkNew<vtkPoints> points;
    for (const auto& corner : corners.colwise()) points->InsertNextPoint(corner.data());
    plane.setPoints(points);
    plane.setTopology({{0, 1, 2}, {0, 2, 3}});
    planeFrame.setClosedCurves({corners}, 0);
  }

  void showColors() {
    const BoundaryQuantity* shown = quantity();
    const bool byWay = shown && shown->kind == BoundaryQuantity::Kind::way;
    double least = 0, most = 0;
    if (shown && !byWay) {
      least = std::numeric_limits<double>::infinity(), most = -least;
      for (const double value : shown->values)
        if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
      if (!(least <= most)) least = most = 0;
      if (!(most > least)) most = least + std::max(1e-12, 1e-3 * std::abs(least));
      setViridis(table, least, most, stale);
      const bool coordinate = shown->kind == BoundaryQuantity::Kind::coordinate;
      const std::string& unit = first.surface->space.unit;
      stage.legend().setQuantity(shown->label, coordinate && unit == "%" ? Legend::Scale::strain : Legend::Scale::plain,
                                 coordinate ? unit : "");
      stage.legend().setRange(least, most);
    }
    stage.setLegendVisible(shown != nullptr);
    namesWays = byWay;
    if (byWay) wayTitle->SetInput(shown->label.c_str());
    for (vtkTextActor* text : {wayTitle.Get(), ways[0].Get(), ways[1].Get(), ways[2].Get()}) text->SetVisibility(byWay);
    for (Body* body : {&first, &compared}) {
      body->figure.setVisible(body->isSeen());
      if (!body->isSeen()) continue;
      std::vector<Color> colors(static_cast<std::size_t>(body->surface->points.cols()));
      for (std::size_t i = 0; i < colors.size(); ++i)
        colors[i] = body == &compared ? stage.colors().prediction : colorOf(shown, i, least, most);
      body->figure.setSurface(body->surface->points, body->triangles(), colors);
    }
    first.figure.setOpacity(style.opacity);
    compared.figure.setOpacity(comparedOpacity);
    stateDots.actor()->SetVisibility(style.states && first.isSeen());
  }

  Color colorOf(const BoundaryQuantity* shown, std::size_t point, double least, double most) const {
    const Palette& colors = stage.colors();
    const auto fresh = [this](const Color& color) { return stale ? faded(color) : color; };
    if (!first.surface->known[point]) return colors.rest;
    if (!shown) return fresh(mixed(colors.rest, colors.mass, 0.35));
    const double value = shown->values[static_cast<Eigen::Index>(point)];
    if (!std::isfinite(value)) return colors.rest;
    if (shown->kind == BoundaryQuantity::Kind::way) return fresh(wayColors[static_cast<std::size_t>(value)]);
    return fresh(viridis((value - least) / (most - least)));
  }

  std::optional<Eigen::Vector2d> placeOf(std::optional<int> state) const {
    if (!state || !first.isSeen() || *state < 0 || *state >= first.surface->points.cols()) return std::nullopt;
    return stage.camera().pixelOf(first.surface->points.col(*state));
  }

  /// Where a shadow of the rest state is seen that no surface covers: on the floor, else on another wall.
  std::optional<Eigen::Vector2d> openRestPixel() const {
    const Eigen::Vector3d eye = stage.camera().pose().position;
    for (const int axis : {2, 1, 0}) {
      const Eigen::Vector3d place = box.wall(axis) * Eigen::Vector3d::Unit(axis);
      const auto hit = first.isSeen() && style.opacity > seenThrough
                           ? firstHit(first.surface->points, first.triangles(), eye, place - eye)
                           : std::nullopt;
      if (!hit || hit->distance >= 1) return stage.camera().pixelOf(place);
    }
    return std::nullopt;
  }

  void layOut() {
    if (namesWays) stage.legend().setVisible(false);
    selectionRing.setPlace(ringed ? stage.camera().pixelOf(inside.col(*ringed)) : placeOf(selected));
    hoverRing.setPlace(hovered == selected ? std::nullopt : placeOf(hovered));
    restLabel->SetVisibility(false);
    if (!hasRange(bounds)) return;
    box.layOut(stage.camera());
    for (int axis = 0; axis < 3; ++axis)
      if (walls[static_cast<std::size_t>(axis)] != box.wall(axis)) {
        showShadows();
        break;
      }
    const double ratio = stage.pixelRatio();
    if (const auto pixel = openRestPixel()) {
      restLabel->SetPosition(pixel->x() + 9 * ratio, pixel->y() - 2 * ratio);
      restLabel->SetVisibility(true);
    }
    const int* size = stage.renderer()->GetSize();
    double top = 0.5 * size[1] + 70 * ratio;
    const double left = size[0] - (Legend::width - 4) * ratio;
    wayTitle->SetPosition(left, top);
    top -= 40 * ratio;
    for (auto& way : ways) {
      way->SetPosition(left, top);
      top -= (way == ways[0] ? 22 : 38) * ratio;
    }
  }
};

BoundaryView::BoundaryView() : parts_(std::make_unique<Parts>(stage())) {}

BoundaryView::~BoundaryView() { attach(nullptr); }

void BoundaryView::setSurface(std::shared_ptr<const BoundarySurface> surface) {
  parts_->first.surface = std::move(surface);
  parts_->hovered.reset();
  parts_->showSurfaces();
  parts_->applyTheme();
}

void BoundaryView::setCompared(std::shared_ptr<const BoundarySurface> surface) {
  parts_->compared.surface = std::move(surface);
  parts_->showSurfaces();
}

void BoundaryView::setStyle(const BoundaryStyle& style) {
  parts_->style = style;
  parts_->showShadows();
  parts_->showSlice();
  parts_->showColors();
}

const BoundaryStyle& BoundaryView::style() const { return parts_->style; }

void BoundaryView::setStale(bool stale) {
  if (parts_->stale == stale) return;
  parts_->stale = stale;
  parts_->applyTheme();
}

void BoundaryView::setSelected(std::optional<int> state) { parts_->selected = state; }
void BoundaryView::setHovered(std::optional<int> state) { parts_->hovered = state; }
std::optional<int> BoundaryView::selected() const { return parts_->selected; }

void BoundaryView::setInside(const Eigen::Matrix3Xd& places, std::optional<int> ringed) {
  parts_->inside = places;
  parts_->ringed = ringed;
  std::vector<int> all(static_cast<std::size_t>(places.cols()));
  std::iota(all.begin(), all.end(), 0);
  parts_->insideDots.setNodes(std::move(all));
  parts_->insideDots.setPoints(places);
}

std::array<double, 2> BoundaryView::range(int axis) const {
  const Bounds& bounds = parts_->bounds;
  return hasRange(bounds) ? std::array{bounds.low[axis], bounds.high[axis]} : std::array{0.0, 0.0};
}

std::optional<Eigen::Vector2d> BoundaryView::pixelOf(int state) const {
  const auto pixel = parts_->placeOf(state);
  if (!pixel) return std::nullopt;
  return Eigen::Vector2d(pixel->x(), parts_->stage.renderer()->GetSize()[1] - pixel->y());
}

std::optional<int> BoundaryView::pickNode(double x, double y, double) const {
  const Parts& p = *parts_;
  if (!p.first.isSeen()) return std::nullopt;
  const Eigen::Vector3d eye = cameraPose().position;
  const auto beside = stage().camera().pointBeside(cameraPose().focus, x, y);
  if (!beside) return std::nullopt;
  const BoundarySurface& surface = *p.first.surface;
  const auto hit = firstHit(surface.points, surface.triangles, eye, *beside - eye);
  if (!hit) return std::nullopt;
  const auto& corners = surface.triangles[static_cast<std::size_t>(hit->triangle)];
  std::optional<int> nearest;
  double most = -1;
  for (int i = 0; i < 3; ++i)
    if (surface.known[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])] && hit->weights[i] > most) {
      most = hit->weights[i];
      nearest = corners[static_cast<std::size_t>(i)];
    }
  return nearest;
}

}  // namespace pliant::render
