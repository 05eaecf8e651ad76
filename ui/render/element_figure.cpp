#include "ui/render/element_figure.hpp"

#include <array>

#include "core/interlock/cell_surface.hpp"
#include "ui/render/primitives.hpp"

namespace pliant::render {

namespace {

constexpr int tints = 3;
constexpr double mostTriangles = 3e6;
/// By which pieces of a curve turn at most, from fine to coarse [rad].
constexpr std::array<double, 5> cuts = {0.2, 0.35, 0.5, 0.8, 1.1};

Color blended(const Color& a, const Color& b, double part) {
  Color color;
  for (std::size_t i = 0; i < color.size(); ++i) color[i] = (1 - part) * a[i] + part * b[i];
  return color;
}

geometry::SurfaceMesh surfaceOf(const interlock::ElementShape& shape, double turn) {
  interlock::UnitCell alone;
  alone.shapes = {shape};
  alone.elements = {{0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()}};
  return interlock::cellSurface(alone, interlock::restState(alone), 1, 1, turn);
}

}  // namespace

void ElementFigure::show(const scene::MacroResult* result) {
  if (result == shown_) return;
  shown_ = result;
  for (const auto& shape : shapes_) renderer_->RemoveActor(shape->glyphs.actor());
  shapes_.clear();
  triangleCount_ = 0;
  if (!result) return;
  const interlock::SheetDetail& detail = result->placed->detail;
  const interlock::UnitCell& cell = *result->cell;
  std::vector<std::vector<Eigen::Index>> members(cell.shapes.size());
  for (std::size_t i = 0; i < detail.elements.size(); ++i)
    members[static_cast<std::size_t>(cell.elements[static_cast<std::size_t>(detail.elements[i].element)].shape)]
        .push_back(static_cast<Eigen::Index>(i));
  for (std::size_t s = 0; s < members.size(); ++s) {
    if (members[s].empty()) continue;
    geometry::SurfaceMesh surface;
    for (const double turn : cuts) {
      surface = surfaceOf(cell.shapes[s], turn);
      const double all = static_cast<double>(surface.triangles.size()) * static_cast<double>(detail.elements.size());
      if (all <= mostTriangles) break;
    }
    Shape& shape = *shapes_.emplace_back(std::make_unique<Shape>());
    shape.glyphs.setShape(surface);
    triangleCount_ += static_cast<long>(surface.triangles.size() * members[s].size());
    std::vector<Eigen::Matrix3d> rotations;
    for (const Eigen::Index i : members[s]) {
      const interlock::PatchElement& element = detail.elements[static_cast<std::size_t>(i)];
      rotations.push_back(detail.state.rotations[static_cast<std::size_t>(i)]);
      const int tint = element.element + element.shift[0] + 2 * element.shift[1];
      shape.tints.push_back((tint % tints + tints) % tints);
    }
    shape.glyphs.setPoses(detail.state.positions(Eigen::all, members[s]), rotations);
    renderer_->AddActor(shape.glyphs.actor());
  }
  setColors(colors_);
}

void ElementFigure::setVisible(bool visible) {
  for (const auto& shape : shapes_) shape->glyphs.actor()->SetVisibility(visible);
}

void ElementFigure::setColors(const Palette& colors) {
  colors_ = colors;
  const std::array<Color, tints> tones{
      blended(colors.rest, colors.mass, 0.28), blended(colors.rest, {1, 1, 1}, 0.25), colors.rest};
  for (const auto& shape : shapes_) {
    std::vector<Color> own;
    for (const int tint : shape->tints) own.push_back(tones[static_cast<std::size_t>(tint)]);
    shape->glyphs.setColors(own);
  }
}

}  // namespace pliant::render
