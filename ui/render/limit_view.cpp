#include "ui/render/limit_view.hpp"

#include <vtkProperty.h>

#include <array>

#include "core/interlock/cell_surface.hpp"
#include "ui/render/bounds.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/dot_overlay.hpp"
#include "ui/render/sheet_primitive.hpp"
#include "ui/render/stage.hpp"

namespace pliant::render {
namespace {

constexpr int cells = 3;  ///< along each lattice vector
constexpr int tints = 3;
constexpr double captionRoom = 56;   ///< device-independent pixels
constexpr double dashLength = 0.02;  ///< of the extent

/// Puts a mesh after another one.
void append(const geometry::SurfaceMesh& mesh, const Eigen::Vector3d& shift, geometry::SurfaceMesh& all) {
  const auto before = all.points.cols();
  all.points.conservativeResize(3, before + mesh.points.cols());
  all.points.rightCols(mesh.points.cols()) = mesh.points.colwise() + shift;
  for (const auto& [a, b, c] : mesh.triangles) {
    const int first = static_cast<int>(before);
    all.triangles.push_back({first + a, first + b, first + c});
  }
}

/// Neighbours along both lattice vectors, and along the shorter one of their sum and difference, differ.
std::size_t tintOf(const Eigen::Matrix2d& lattice, int i, int j) {
  const bool acute = lattice.col(0).dot(lattice.col(1)) > 0;
  return static_cast<std::size_t>(acute ? i + 2 * j : i + j) % tints;
}

/// Outlines of all cells in the plane z = `height`.
std::vector<Points> cellOutlines(const Eigen::Matrix2d& lattice, const Eigen::Vector2d& from, double height) {
  std::vector<Points> outlines;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      Points outline = Points::Constant(3, 4, height);
      const std::array<Eigen::Vector2d, 4> corners{
          Eigen::Vector2d(i, j), Eigen::Vector2d(i + 1, j), Eigen::Vector2d(i + 1, j + 1), Eigen::Vector2d(i, j + 1)};
      for (int k = 0; k < 4; ++k) outline.col(k).head<2>() = from + lattice * corners[static_cast<std::size_t>(k)];
      outlines.push_back(std::move(outline));
    }
  return outlines;
}

}  // namespace

struct LimitView::Parts {
  Stage& stage;
  std::array<SheetPrimitive, tints> elements;
  LinePrimitive outline{1.6}, restOutline{1.2};
  DotOverlay marks;  // over everything: contacts lie where elements hide them
  std::shared_ptr<const CellConfiguration> configuration;
  Points contacts;
  bool contactsVisible = true;
  bool stale = false;

  explicit Parts(Stage& around) : stage(around) {
    vtkRenderer* renderer = stage.renderer();
    for (LinePrimitive* lines : {&restOutline, &outline}) renderer->AddActor(lines->actor());
    for (SheetPrimitive& each : elements) {
      renderer->AddActor(each.actor());
      vtkProperty* property = each.actor()->GetProperty();
      property->SetAmbient(0.35);
      property->SetDiffuse(0.6);
      property->SetSpecular(0.25);
      property->SetSpecularPower(25);
    }
    marks.addTo(renderer);
    stage.onLayOut = [this] { placeMarks(); };
    stage.onTheme = [this] { applyTheme(); };
    stage.onPixelRatio = [this] {
      for (LinePrimitive* lines : {&outline, &restOutline}) lines->setPixelRatio(stage.pixelRatio());
      marks.setPixelRatio(stage.pixelRatio());
      stage.camera().setTopMargin(captionRoom * stage.pixelRatio());
    };
    stage.onField = [this] { applyTheme(); };
    show();
    stage.setTheme(Theme::light);
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    const std::array<Color, tints> tones{mixed(colors.rest, colors.mass, 0.28), mixed(colors.rest, {1, 1, 1}, 0.25),
                                         mixed(colors.rest, colors.trajectory, 0.3)};
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const Color& tone = stage.fieldVisible() ? tones[i] : colors.rest;
      setColor(elements[i].actor(), stale ? faded(tone) : tone);
    }
    marks.setColors(colors.prediction, colors.background);
    setColor(outline.actor(), mixed(colors.background, colors.text, 0.7));
    setColor(restOutline.actor(), mixed(colors.background, colors.text, 0.45));
    stage.setNotice(stale && configuration ? "inputs have changed since this was computed" : "", colors.text);
  }

  void show() {
    const bool any = configuration && configuration->cell;
    for (SheetPrimitive& each : elements) each.actor()->SetVisibility(any);
    for (LinePrimitive* lines : {&outline, &restOutline}) lines->actor()->SetVisibility(any);
    marks.setVisible(any && contactsVisible);
    contacts.resize(3, 0);
    if (!any) return;
    const interlock::UnitCell& cell = *configuration->cell;
    const interlock::CellState& state = configuration->state;
    const Eigen::Matrix2d lattice = interlock::stretchOf(state.strain) * cell.lattice;
    showElements(cell, state, lattice);
    findContacts(lattice);
  }

  void showElements(const interlock::UnitCell& cell, const interlock::CellState& state,
                    const Eigen::Matrix2d& lattice) {
    std::array<geometry::SurfaceMesh, tints> meshes;
    for (auto& mesh : meshes) mesh.points.resize(3, 0);
    for (std::size_t k = 0; k < cell.elements.size(); ++k) {
      // One element at a time, so that each copy can have its tint.
      interlock::UnitCell alone = cell;
      alone.elements = {cell.elements[k]};
      const interlock::CellState own{
          state.positions.col(static_cast<Eigen::Index>(k)), {state.rotations[k]}, state.strain};
      const geometry::SurfaceMesh mesh = interlock::cellSurface(alone, own, 1, 1);
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          Eigen::Vector3d shift = Eigen::Vector3d::Zero();
          shift.head<2>() = lattice * Eigen::Vector2d(i, j);
          append(mesh, shift, meshes[(tintOf(cell.lattice, i, j) + k) % tints]);
        }
    }
    Bounds bounds;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      elements[i].setTopology(meshes[i].triangles);
      elements[i].setPoints(meshes[i].points);
      bounds.add(meshes[i].points);
    }
    // Below the elements, so that they cover what they stand on.
    const double height = bounds.low[2];
    const Eigen::Vector2d middle = 0.5 * (bounds.low + bounds.high).head<2>();
    const auto corner = [&](const Eigen::Matrix2d& vectors) {
      return Eigen::Vector2d(middle - 0.5 * cells * vectors.rowwise().sum());
    };
    outline.setClosedCurves(cellOutlines(lattice, corner(lattice), height), 0);
    const std::vector<Points> atRest = cellOutlines(cell.lattice, corner(cell.lattice), height);
    restOutline.setClosedCurves(atRest, dashLength * (bounds.high - bounds.low).norm());
    for (const Points& each : atRest) bounds.add(each);
    stage.camera().setReach(bounds.corners());
  }

  void findContacts(const Eigen::Matrix2d& lattice) {
    for (const interlock::CellContactForce& contact : configuration->contacts)
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          const int otherI = i + contact.pair.shift[0], otherJ = j + contact.pair.shift[1];
          if (otherI < 0 || otherI >= cells || otherJ < 0 || otherJ >= cells) continue;
          contacts.conservativeResize(3, contacts.cols() + 1);
          contacts.rightCols<1>() = contact.place;
          contacts.rightCols<1>().head<2>() += lattice * Eigen::Vector2d(i, j);
        }
  }

  void placeMarks() {
    Eigen::Matrix2Xd pixels(2, contacts.cols());
    Eigen::Index count = 0;
    for (const auto& contact : contacts.colwise())
      if (const auto pixel = stage.camera().pixelOf(contact)) pixels.col(count++) = *pixel;
    marks.setPlaces(pixels.leftCols(count));
  }
};

LimitView::LimitView() : parts_(std::make_unique<Parts>(stage())) {}

LimitView::~LimitView() { attach(nullptr); }

void LimitView::setConfiguration(std::shared_ptr<const CellConfiguration> configuration) {
  parts_->configuration = std::move(configuration);
  parts_->show();
  parts_->applyTheme();
}

const std::shared_ptr<const CellConfiguration>& LimitView::configuration() const { return parts_->configuration; }

void LimitView::setContactsVisible(bool visible) {
  parts_->contactsVisible = visible;
  parts_->marks.setVisible(visible && parts_->configuration);
}

bool LimitView::contactsVisible() const { return parts_->contactsVisible; }

int LimitView::markCount() const { return static_cast<int>(parts_->contacts.cols()); }

void LimitView::setStale(bool stale) {
  if (parts_->stale == stale) return;
  parts_->stale = stale;
  parts_->applyTheme();
}

std::optional<int> LimitView::pickNode(double, double, double) const { return std::nullopt; }

}  // namespace pliant::render
