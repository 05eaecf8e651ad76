#include "ui/render/native_half.hpp"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>

#include <array>

#include "core/interlock/cell_surface.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/element_tints.hpp"

namespace pliant::render {

namespace {

constexpr int tintCount = 3;
constexpr double surfaceTurn = 0.26;  ///< of the pieces that curves are cut into [rad]

geometry::SurfaceMesh shapeSurface(const interlock::ElementShape& shape) {
  interlock::UnitCell alone;
  alone.shapes = {shape};
  alone.elements = {{0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()}};
  return interlock::cellSurface(alone, interlock::restState(alone), 1, 1, surfaceTurn);
}

}  // namespace

NativeHalf::NativeHalf(Stage& left, std::shared_ptr<const interlock::UnitCell> patch)
    : left_(left), patch_(std::move(patch)), tintOf_(elementTints(*patch_, tintCount)) {
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(line_);
  divider_->SetMapper(mapper);
  stage_.renderer()->AddActor2D(divider_);
  for (std::size_t shape = 0; shape < patch_->shapes.size(); ++shape) {
    auto kind = std::make_unique<Kind>();
    for (std::size_t i = 0; i < patch_->elements.size(); ++i)
      if (patch_->elements[i].shape == static_cast<int>(shape)) kind->elements.push_back(static_cast<int>(i));
    if (kind->elements.empty()) continue;
    kind->bodies.setShape(shapeSurface(patch_->shapes[shape]));
    stage_.renderer()->AddActor(kind->bodies.actor());
    kinds_.push_back(std::move(kind));
  }
  pose(interlock::restState(*patch_));
  stage_.renderer()->SetActiveCamera(left_.renderer()->GetActiveCamera());
  stage_.setGizmoVisible(false);
  stage_.onLayOut = [this] {
    const double height = stage_.renderer()->GetSize()[1];
    vtkNew<vtkPoints> ends;
    ends->InsertNextPoint(0, 0, 0);
    ends->InsertNextPoint(0, height, 0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({0, 1});
    line_->SetPoints(ends);
    line_->SetLines(cells);
  };
  left_.renderer()->SetViewport(0, 0, 0.5, 1);
  stage_.renderer()->SetViewport(0.5, 0, 1, 1);
  stage_.setPixelRatio(left_.pixelRatio());
  stage_.attach(left_.window());
}

NativeHalf::~NativeHalf() {
  stage_.attach(nullptr);
  left_.renderer()->SetViewport(0, 0, 1, 1);
}

void NativeHalf::pose(const interlock::CellState& state) {
  for (const auto& kind : kinds_) {
    std::vector<Eigen::Matrix3d> rotations;
    for (const int element : kind->elements) rotations.push_back(state.rotations[static_cast<std::size_t>(element)]);
    kind->bodies.setPoses(state.positions(Eigen::all, kind->elements), rotations);
  }
}

void NativeHalf::setTheme(Theme theme, bool stale) {
  stage_.setTheme(theme);
  const Palette& colors = stage_.colors();
  const std::array<Color, tintCount> tones{
      mixed(colors.rest, colors.mass, 0.28), mixed(colors.rest, {1, 1, 1}, 0.25), colors.rest};
  for (const auto& kind : kinds_) {
    std::vector<Color> own;
    for (const int element : kind->elements) {
      const Color& tone = tones[static_cast<std::size_t>(tintOf_[static_cast<std::size_t>(element)])];
      own.push_back(stale ? faded(tone) : tone);
    }
    kind->bodies.setColors(own);
  }
  divider_->GetProperty()->SetColor(colors.rest.data());
}

}  // namespace pliant::render
