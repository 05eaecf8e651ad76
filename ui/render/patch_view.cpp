#include "ui/render/patch_view.hpp"

#include <vtkArrowSource.h>
#include <vtkMatrix4x4.h>
#include <vtkProperty.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/interlock/cell_surface.hpp"
#include "core/interlock/paraboloid.hpp"
#include "ui/render/body_glyphs.hpp"
#include "ui/render/bounds.hpp"
#include "ui/render/color_key.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/dot_overlay.hpp"
#include "ui/render/element_tints.hpp"
#include "ui/render/marks.hpp"
#include "ui/render/sheet_primitive.hpp"
#include "ui/render/stage.hpp"

namespace pliant::render {
namespace {

using Eigen::Vector3d;

constexpr int tints = 3;
constexpr double captionRoom = 84;                   // device-independent pixels
constexpr double fineTurn = 0.15, coarseTurn = 0.3;  // [rad] between the cross-sections of a wire
constexpr std::size_t many = 40;                     // elements from which on they are drawn coarsely
constexpr int rings = 10, spokes = 24, between = 4;  // grid lines of a paraboloid, and pieces of each
constexpr double arrowLength = 0.3;                  // of the patch
constexpr double roomyRadius = 48;  // of an element, where marks have their full size [device-independent pixels]
constexpr double farBehind = 0.02, lineBehind = 0.03;
constexpr double rimRoom = 1.15;  ///< of the height of a paraboloid, over that of the elements

/// The surface of one shape, in its own coordinates.
geometry::SurfaceMesh surfaceOf(const interlock::UnitCell& patch, int shape) {
  interlock::UnitCell alone = patch;
  alone.elements = {{shape, Vector3d::Zero(), Eigen::Matrix3d::Identity()}};
  const double turn = patch.elements.size() > many ? coarseTurn : fineTurn;
  return interlock::cellSurface(alone, interlock::restState(alone), 1, 1, turn);
}

/// All copies of one shape.
struct Kind {
  BodyGlyphs bodies;
  std::vector<int> elements;
};

}  // namespace

struct PatchView::Parts {
  Stage& stage;
  std::vector<std::unique_ptr<Kind>> kinds;
  SheetPrimitive sheet;
  LinePrimitive grid{1.0}, rim{1.4};
  vtkNew<vtkActor> arrow;
  vtkNew<vtkMatrix4x4> arrowPose;
  DotOverlay marks;  // over everything: contacts lie where elements hide them
  ColorKey key;
  std::shared_ptr<const PatchConfiguration> configuration;
  std::vector<int> tintOf;
  bool contactsVisible = true, stale = false;
  double reach = 0;          ///< of the elements from the axis [m]
  double elementRadius = 0;  ///< of the largest around its origin [m]

  explicit Parts(Stage& around) : stage(around) {
    vtkRenderer* renderer = stage.renderer();
    for (vtkActor* actor : {sheet.actor(), grid.actor(), rim.actor()}) {
      seeBehind(actor, actor == sheet.actor() ? farBehind : lineBehind);
      renderer->AddActor(actor);
    }
    sheet.actor()->GetProperty()->SetAmbient(0.75);
    sheet.actor()->GetProperty()->SetDiffuse(0.25);
    vtkNew<vtkArrowSource> shape;
    shape->SetTipResolution(24);
    shape->SetShaftResolution(24);
    shape->SetShaftRadius(0.02);
    shape->SetTipRadius(0.07);
    shape->SetTipLength(0.25);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(shape->GetOutputPort());
    arrow->SetMapper(mapper);
    arrow->SetUserMatrix(arrowPose);
    renderer->AddActor(arrow);
    marks.addTo(renderer);
    key.addTo(renderer);
    stage.onLayOut = [this] {
      placeMarks();
      key.layOut();
    };
    stage.onTheme = [this] { applyTheme(); };
    stage.onField = [this] { applyTheme(); };
    stage.onPixelRatio = [this] {
      for (LinePrimitive* line : {&grid, &rim}) line->setPixelRatio(stage.pixelRatio());
      key.setPixelRatio(stage.pixelRatio());
      stage.camera().setTopMargin(captionRoom * stage.pixelRatio());
    };
    show();
    stage.setTheme(Theme::light);
  }

  void show() {
    for (const auto& kind : kinds) stage.renderer()->RemoveActor(kind->bodies.actor());
    kinds.clear();
    const bool bent = configuration && configuration->curvature;
    for (vtkActor* actor : {sheet.actor(), grid.actor(), rim.actor()}) actor->SetVisibility(bent);
    arrow->SetVisibility(false);
    marks.setVisible(configuration && contactsVisible);
    if (!configuration) return;
    const Bounds bounds = showElements();
    stage.camera().setReach(bounds.corners());
    if (bent) showParaboloid(interlock::Paraboloid{*configuration->curvature}, bounds);
    if (configuration->gravity) showWeight(bounds);
  }

  Bounds showElements() {
    const interlock::UnitCell& patch = *configuration->patch;
    const interlock::CellState& state = configuration->state;
    tintOf = elementTints(patch, tints);
    Bounds bounds;
    reach = elementRadius = 0;
    for (std::size_t shape = 0; shape < patch.shapes.size(); ++shape) {
      auto kind = std::make_unique<Kind>();
      for (std::size_t i = 0; i < patch.elements.size(); ++i)
        if (patch.elements[i].shape == static_cast<int>(shape)) kind->elements.push_back(static_cast<int>(i));
      if (kind->elements.empty()) continue;
      const geometry::SurfaceMesh mesh = surfaceOf(patch, static_cast<int>(shape));
      elementRadius = std::max(elementRadius, mesh.points.colwise().norm().maxCoeff());
      Points positions(3, static_cast<Eigen::Index>(kind->elements.size()));
      std::vector<Eigen::Matrix3d> rotations;
      for (std::size_t i = 0; i < kind->elements.size(); ++i) {
        const int element = kind->elements[i];
        positions.col(static_cast<Eigen::Index>(i)) = state.positions.col(element);
        rotations.push_back(state.rotations[static_cast<std::size_t>(element)]);
        const Points places = (rotations.back() * mesh.points).colwise() + Vector3d(state.positions.col(element));
        bounds.add(places);
        reach = std::max(reach, places.topRows<2>().colwise().norm().maxCoeff());
      }
      kind->bodies.setShape(mesh);
      kind->bodies.setPoses(positions, rotations);
      stage.renderer()->AddActor(kind->bodies.actor());
      kinds.push_back(std::move(kind));
    }
    return bounds;
  }

  /// As far as there are elements, to the sides and in height.
  void showParaboloid(const interlock::Paraboloid& paraboloid, const Bounds& bounds) {
    const auto at = [&](double share, double angle) {
      const double rise = paraboloid.height(std::cos(angle), std::sin(angle));
      const double height = rimRoom * std::max(0.2 * reach, rise > 0 ? bounds.high.z() : -bounds.low.z());
      const double radius = share * std::min(reach, std::sqrt(height / std::max(1e-12, std::abs(rise))));
      const double x = radius * std::cos(angle), y = radius * std::sin(angle);
      return Vector3d(x, y, paraboloid.height(x, y));
    };
    constexpr int around = spokes * between, across = rings * between;
    Points places(3, around * across + 1);
    std::vector<std::array<int, 3>> triangles;
    places.col(around * across).setZero();
    for (int i = 0; i < across; ++i)
      for (int k = 0; k < around; ++k) {
        places.col(i * around + k) = at((i + 1.0) / across, 2 * std::numbers::pi * k / around);
        const int next = (k + 1) % around;
        if (i == 0) {
          triangles.push_back({around * across, k, next});
          continue;
        }
        const int inner = (i - 1) * around, outer = i * around;
        triangles.push_back({inner + k, outer + k, outer + next});
        triangles.push_back({inner + k, outer + next, inner + next});
      }
    sheet.setTopology(triangles);
    sheet.setPoints(places);
    std::vector<Points> lines;
    for (int i = 1; i < rings; ++i) lines.emplace_back(places.middleCols((i * between - 1) * around, around));
    for (int k = 0; k < spokes / 2; ++k) {
      // There and back along a diameter, as a closed curve.
      Points line(3, 4 * across);
      for (int i = 0; i < 2 * across; ++i) {
        const double share = static_cast<double>(i) / across - 1;
        const double angle = 2 * std::numbers::pi * k / spokes;
        line.col(i) = line.col(4 * across - 1 - i) = at(share, angle);
      }
      lines.push_back(std::move(line));
    }
    grid.setClosedCurves(lines, 0);
    rim.setClosedCurves({places.middleCols((across - 1) * around, around)}, 0);
  }

  /// An arrow the way the weight pulls, beside the elements.
  void showWeight(const Bounds& bounds) {
    if (!(configuration->gravity->norm() > 0)) return;
    const double size = (bounds.high - bounds.low).norm();
    const Vector3d along = configuration->gravity->normalized();
    const Vector3d beside = (Vector3d::UnitX() - along.x() * along).stableNormalized();
    const Vector3d tail = 0.5 * (bounds.low + bounds.high) - 0.5 * arrowLength * size * along +
                          (0.5 * (bounds.high - bounds.low).cwiseProduct(beside).norm() + 0.1 * size) * beside;
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), along).toRotationMatrix();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        arrowPose->SetElement(row, column, arrowLength * size * turn(row, column));
      arrowPose->SetElement(row, 3, tail[row]);
    }
    arrow->SetVisibility(true);
    Bounds all = bounds;
    all.add(tail);
    all.add(tail + arrowLength * size * along);
    stage.camera().setReach(all.corners());
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    const std::array<Color, tints> tones{mixed(colors.rest, colors.mass, 0.28), mixed(colors.rest, {1, 1, 1}, 0.25),
                                         mixed(colors.rest, colors.trajectory, 0.3)};
    const Color clamped = mixed(colors.driven, colors.background, 0.15);
    const Color arrowColor = mixed(colors.text, colors.background, 0.25);
    const auto fresh = [this](const Color& color) { return stale ? faded(color) : color; };
    std::vector<bool> held(tintOf.size(), false);
    if (configuration)
      for (const int element : configuration->clamped) held[static_cast<std::size_t>(element)] = true;
    for (const auto& kind : kinds) {
      std::vector<Color> own;
      for (const int element : kind->elements) {
        const auto index = static_cast<std::size_t>(element);
        const Color& tone = stage.fieldVisible() ? tones[static_cast<std::size_t>(tintOf[index])] : colors.rest;
        own.push_back(fresh(held[index] ? clamped : tone));
      }
      kind->bodies.setColors(own);
    }
    setColor(sheet.actor(), mixed(colors.background, colors.mass, 0.12));
    setColor(grid.actor(), mixed(colors.background, colors.mass, 0.25));
    setColor(rim.actor(), mixed(colors.background, colors.mass, 0.5));
    setColor(arrow, arrowColor);
    marks.setColors(colors.prediction, colors.background);
    std::vector<ColorKey::Entry> entries;
    if (configuration) {
      if (!configuration->clamped.empty()) entries.push_back({"■", "clamped", clamped});
      if (configuration->gravity) entries.push_back({"→", "weight", arrowColor});
      if (configuration->curvature) entries.push_back({"■", "paraboloid", mixed(colors.background, colors.mass, 0.4)});
      if (contactsVisible && !configuration->contacts.empty()) entries.push_back({"●", "contact", colors.prediction});
    }
    key.setEntries(std::move(entries), colors.text);
    stage.setNotice(stale && configuration ? "inputs have changed since this was computed" : "", colors.text);
  }

  /// Marks are smaller where elements are, so that these are seen.
  double markScale() const {
    const Vector3d place = configuration->state.positions.rowwise().mean();
    const auto from = stage.camera().pixelOf(place);
    const auto to = stage.camera().pixelOf(place + elementRadius * stage.camera().pose().up);
    return from && to ? std::clamp((*to - *from).norm() / stage.pixelRatio() / roomyRadius, 0.45, 1.0) : 1;
  }

  void placeMarks() {
    if (!configuration) return;
    marks.setPixelRatio(stage.pixelRatio() * markScale());
    Eigen::Matrix2Xd pixels(2, static_cast<Eigen::Index>(configuration->contacts.size()));
    Eigen::Index count = 0;
    for (const interlock::CellContactForce& contact : configuration->contacts)
      if (const auto pixel = stage.camera().pixelOf(contact.place)) pixels.col(count++) = *pixel;
    marks.setPlaces(pixels.leftCols(count));
  }
};

PatchView::PatchView() : parts_(std::make_unique<Parts>(stage())) {}

PatchView::~PatchView() { attach(nullptr); }

void PatchView::setConfiguration(std::shared_ptr<const PatchConfiguration> configuration) {
  parts_->configuration = std::move(configuration);
  parts_->show();
  parts_->applyTheme();
}

const std::shared_ptr<const PatchConfiguration>& PatchView::configuration() const { return parts_->configuration; }

void PatchView::setContactsVisible(bool visible) {
  parts_->contactsVisible = visible;
  parts_->marks.setVisible(visible && parts_->configuration);
  parts_->applyTheme();
}

int PatchView::markCount() const {
  return parts_->configuration ? static_cast<int>(parts_->configuration->contacts.size()) : 0;
}

void PatchView::setStale(bool stale) {
  if (parts_->stale == stale) return;
  parts_->stale = stale;
  parts_->applyTheme();
}

std::optional<int> PatchView::pickNode(double, double, double) const { return std::nullopt; }

}  // namespace pliant::render
