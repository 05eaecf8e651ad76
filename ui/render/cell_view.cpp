#include "ui/render/cell_view.hpp"

#include <vtkFloatArray.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkProperty.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/interlock/cell_surface.hpp"
#include "ui/render/bounds.hpp"
#include "ui/render/marks.hpp"
#include "ui/render/sheet_primitive.hpp"
#include "ui/render/stage.hpp"

namespace pliant::render {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using interlock::UnitCell;

constexpr double surfaceTurn = 0.17;                 // [rad] between the cross-sections of a wire
constexpr double handleSize = 0.045;                 // of the patch's extent
constexpr double contactSize = 8, overlapSize = 15;  // device-independent pixels
constexpr double paler = 0.55;                       // of the way to the background

/// The surface of one shape, in its own coordinates.
geometry::SurfaceMesh surfaceOf(const UnitCell& cell, int shape) {
  UnitCell alone = cell;
  alone.elements = {{shape, Vector3d::Zero(), Eigen::Matrix3d::Identity()}};
  return interlock::cellSurface(alone, interlock::restState(alone), 1, 1, surfaceTurn);
}

}  // namespace

struct CellView::Parts {
  /// An element of the cell, or an image of one.
  struct Body {
    int element;
    std::array<int, 2> shift;
    vtkNew<vtkActor> actor;
    vtkNew<vtkMatrix4x4> pose;
  };

  Stage& stage;
  CellPatch patch;
  std::vector<interlock::LiveContact> contacts;
  std::optional<interlock::NearestElements> overlap;
  std::optional<std::pair<Vector3d, Vector3d>> hand;
  bool handlesVisible = true;

  std::vector<Points> surfaces;  ///< of the shapes, in their coordinates
  std::vector<std::unique_ptr<SheetPrimitive>> shapes;
  std::vector<std::unique_ptr<Body>> bodies;
  LinePrimitive outline{1.5}, handLine{2.0};
  Balls handles, handMark;
  Marks contactMarks{contactSize}, overlapMark{overlapSize};

  explicit Parts(Stage& around) : stage(around) {
    vtkRenderer* renderer = stage.renderer();
    for (LinePrimitive* line : {&outline, &handLine}) renderer->AddActor(line->actor());
    for (Balls* balls : {&handles, &handMark}) renderer->AddActor(balls->actor());
    for (Marks* marks : {&contactMarks, &overlapMark})
      for (vtkActor* actor : marks->actors()) renderer->AddActor(actor);
    seeThrough(handles.actor(), 0.03);  // whatever hides them, they can be taken
    stage.onTheme = [this] { applyTheme(); };
    stage.onPixelRatio = [this] {
      for (LinePrimitive* line : {&outline, &handLine}) line->setPixelRatio(stage.pixelRatio());
      for (Marks* marks : {&contactMarks, &overlapMark}) marks->setPixelRatio(stage.pixelRatio());
    };
    stage.onLayOut = [] {};
    showState();
    stage.setTheme(Theme::light);
  }

  ~Parts() { clearBodies(); }

  void clearBodies() {
    for (const auto& body : bodies) stage.renderer()->RemoveActor(body->actor);
    bodies.clear();
    shapes.clear();
    surfaces.clear();
  }

  void build() {
    clearBodies();
    const auto& cell = patch.cell();
    if (!cell) return;
    for (std::size_t i = 0; i < cell->shapes.size(); ++i) {
      const geometry::SurfaceMesh mesh = surfaceOf(*cell, static_cast<int>(i));
      surfaces.push_back(mesh.points);
      auto shape = std::make_unique<SheetPrimitive>();
      shape->setTopology(mesh.triangles);
      shape->setPoints(mesh.points);
      shapes.push_back(std::move(shape));
    }
    const int images = patch.neighbours();
    for (int i = -images; i <= images; ++i)
      for (int j = -images; j <= images; ++j)
        for (std::size_t k = 0; k < cell->elements.size(); ++k) {
          auto body = std::make_unique<Body>();
          body->element = static_cast<int>(k);
          body->shift = {i, j};
          vtkActor* shape = shapes[static_cast<std::size_t>(cell->elements[k].shape)]->actor();
          body->actor->SetMapper(shape->GetMapper());
          body->actor->GetProperty()->DeepCopy(shape->GetProperty());
          body->actor->GetProperty()->SetAmbient(0.3);
          body->actor->GetProperty()->SetDiffuse(0.75);
          body->actor->GetProperty()->SetSpecular(0.25);
          body->actor->GetProperty()->SetSpecularPower(25);
          body->actor->SetUserMatrix(body->pose);
          stage.renderer()->AddActor(body->actor);
          bodies.push_back(std::move(body));
        }
  }

  void showState() {
    for (const auto& body : bodies) {
      const Eigen::Matrix3d& turn = patch.state().rotations[static_cast<std::size_t>(body->element)];
      const Vector3d place = patch.placeOf(body->element, body->shift, Vector3d::Zero());
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) body->pose->SetElement(row, column, turn(row, column));
        body->pose->SetElement(row, 3, place[row]);
      }
    }
    showHandles();
    showContacts();
    showOverlap();
    showHand();
  }

  void showHandles() {
    std::vector<Vector3d> places;
    Points corners(3, 0);
    if (patch.cell() && handlesVisible) {
      for (const CellPick& handle : patch.handles()) places.push_back(handle.place);
      corners.resize(3, 4);
      for (int i = 0; i < 4; ++i) corners.col(i) = places[static_cast<std::size_t>(2 * i)];
    }
    outline.setClosedCurves(corners.cols() > 0 ? std::vector<Points>{corners} : std::vector<Points>(),
                            corners.cols() > 0 ? 0.02 * patch.extent() : 0);
    handles.show(places, 0.25 * handleSize * patch.extent());
  }

  void showContacts() { contactMarks.show(patch.places(contacts)); }

  void showOverlap() {
    std::vector<Vector3d> places;
    if (patch.cell() && overlap) places.push_back(overlap->place);
    overlapMark.show(places);
  }

  void showHand() {
    std::vector<Vector3d> places;
    Points line(3, 0);
    if (patch.cell() && hand) {
      places.push_back(hand->first);
      line.resize(3, 2);
      line << hand->first, hand->second;
    }
    handMark.show(places, 0.25 * handleSize * patch.extent());
    handLine.actor()->SetVisibility(line.cols() > 0);
    if (line.cols() > 0) handLine.setClosedCurves({line}, 0);
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    for (const auto& body : bodies) {
      const bool own = body->shift == std::array{0, 0};
      // Elements of the cell a little apart from one another, so that one sees which is repeated.
      const std::size_t count = patch.cell()->elements.size();
      const double step = count > 1 && count < 8 ? 0.35 * body->element / static_cast<double>(count - 1) : 0;
      const Color base = mixed(mixed(colors.mass, colors.rest, 0.35), colors.text, step);
      setColor(body->actor, own ? base : mixed(mixed(base, colors.rest, 0.5), colors.background, 0.5 * paler));
    }
    setColor(outline.actor(), colors.spring);
    setColor(handles.actor(), colors.text);
    contactMarks.setColors(colors.prediction, colors.background);
    overlapMark.setColors({0.85, 0.1, 0.15}, colors.background);
    setColor(handMark.actor(), colors.prediction);
    setColor(handLine.actor(), colors.prediction);
  }

  void showReach() {
    Bounds bounds;
    if (patch.cell()) {
      Points places(3, 8);
      const auto shown = patch.handles();
      double high = 0;
      for (const Points& surface : surfaces) high = std::max(high, surface.colwise().norm().maxCoeff());
      for (int i = 0; i < 8; ++i) places.col(i) = shown[static_cast<std::size_t>(i)].place;
      bounds.add(places);
      bounds.low.z() -= 0.5 * high;
      bounds.high.z() += 0.5 * high;
    }
    stage.camera().setReach(bounds.corners());
  }
};

CellView::CellView() : parts_(std::make_unique<Parts>(stage())) {}

CellView::~CellView() { attach(nullptr); }

void CellView::setCell(std::shared_ptr<const UnitCell> cell) {
  Parts& p = *parts_;
  p.patch.setCell(std::move(cell));
  p.contacts.clear();
  p.overlap.reset();
  p.hand.reset();
  p.build();
  p.showReach();
  p.showState();
  p.applyTheme();
}

const std::shared_ptr<const UnitCell>& CellView::cell() const { return parts_->patch.cell(); }

const interlock::CellState& CellView::state() const { return parts_->patch.state(); }

void CellView::setState(const interlock::CellState& state, const std::vector<interlock::LiveContact>& contacts) {
  Parts& p = *parts_;
  if (!p.patch.cell()) return;
  p.patch.setState(state);
  p.contacts = contacts;
  p.showReach();
  p.showState();
}

void CellView::setOverlap(std::optional<interlock::NearestElements> overlap) {
  parts_->overlap = std::move(overlap);
  parts_->showOverlap();
}

void CellView::setHand(std::optional<std::pair<Vector3d, Vector3d>> hand) {
  parts_->hand = std::move(hand);
  parts_->showHand();
}

void CellView::setHandlesVisible(bool visible) {
  parts_->handlesVisible = visible;
  parts_->showHandles();
}

std::vector<CellPick> CellView::handles() const { return parts_->patch.handles(); }

std::optional<Vector2d> CellView::pixelOf(const Vector3d& point) const { return stage().camera().pixelOf(point); }

std::optional<CellPick> CellView::pick(double x, double y, double radius) const {
  const Parts& p = *parts_;
  if (!p.patch.cell()) return std::nullopt;
  if (p.handlesVisible) {
    const std::vector<CellPick> handles = p.patch.handles();
    Points places(3, static_cast<Eigen::Index>(handles.size()));
    for (std::size_t i = 0; i < handles.size(); ++i) places.col(static_cast<Eigen::Index>(i)) = handles[i].place;
    if (const auto nearest = p.stage.camera().nearestPoint(places, x, y, radius))
      return handles[static_cast<std::size_t>(*nearest)];
  }
  // Of all elements that have a corner of their surface near the pixel, the one that is nearest to the camera.
  const Vector3d eye = p.stage.camera().pose().position;
  std::optional<CellPick> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& body : p.bodies) {
    const int shape = p.patch.cell()->elements[static_cast<std::size_t>(body->element)].shape;
    const Points& surface = p.surfaces[static_cast<std::size_t>(shape)];
    const Vector3d origin = p.patch.placeOf(body->element, body->shift, Vector3d::Zero());
    const Points places =
        (p.patch.state().rotations[static_cast<std::size_t>(body->element)] * surface).colwise() + origin;
    const auto nearest = p.stage.camera().nearestPoint(places, x, y, radius);
    if (!nearest) continue;
    const double distance = (places.col(*nearest) - eye).norm();
    if (distance >= least) continue;
    least = distance;
    best = CellPick{
        {body->element, surface.col(*nearest), Vector2d(body->shift[0], body->shift[1])}, places.col(*nearest), false};
  }
  return best;
}

std::optional<Vector3d> CellView::handAt(const CellPick& picked, double x, double y) const {
  const CameraControl& camera = parts_->stage.camera();
  const auto beside = camera.pointBeside(picked.place, x, y);
  if (!beside || !picked.handle) return beside;
  const Vector3d eye = camera.pose().position, ray = *beside - eye;
  const double height = picked.place.z() - eye.z();
  // Looking along the plane there is no place in it under the pixel.
  if (std::abs(ray.z()) < 0.02 * ray.norm() || height / ray.z() <= 0) return beside;
  return Vector3d(eye + height / ray.z() * ray);
}

}  // namespace pliant::render
