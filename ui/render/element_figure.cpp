#include "ui/render/element_figure.hpp"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkQuadricDecimation.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/interlock/cell_surface.hpp"
#include "ui/render/primitives.hpp"

namespace pliant::render {

namespace {

constexpr int tints = 3;
/// Of a picture that software draws in about a second, with smooth edges, and of one that it draws in a moment.
constexpr std::size_t mostStillTriangles = 1'000'000, mostMovingTriangles = 100'000;
constexpr std::size_t coarseTriangles = 48;  ///< of an element, at least
constexpr double cut = 0.35;                 ///< by which pieces of a curve turn at most [rad]
constexpr double dotShare = 1.05;            ///< of the spacing, so that dots leave no gaps

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

/// The same surface with about so many triangles.
geometry::SurfaceMesh decimated(const geometry::SurfaceMesh& mesh, std::size_t triangles) {
  if (mesh.triangles.size() <= triangles) return mesh;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& point : mesh.points.colwise()) points->InsertNextPoint(point.data());
  for (const auto& [a, b, c] : mesh.triangles) cells->InsertNextCell({a, b, c});
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkQuadricDecimation> decimation;
  decimation->SetInputData(data);
  decimation->SetTargetReduction(1 - static_cast<double>(triangles) / static_cast<double>(mesh.triangles.size()));
  decimation->VolumePreservationOn();  // or wires get thin
  decimation->Update();
  vtkPolyData* made = decimation->GetOutput();
  geometry::SurfaceMesh result;
  result.points.resize(3, made->GetNumberOfPoints());
  for (vtkIdType i = 0; i < made->GetNumberOfPoints(); ++i) made->GetPoint(i, result.points.col(i).data());
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < made->GetNumberOfCells(); ++i) {
    made->GetCellPoints(i, corners);
    result.triangles.push_back({static_cast<int>(corners->GetId(0)), static_cast<int>(corners->GetId(1)),
                                static_cast<int>(corners->GetId(2))});
  }
  return result;
}

}  // namespace

ElementFigure::ElementFigure() {
  dotNormals_->SetNumberOfComponents(3);
  dotColors_->SetNumberOfComponents(3);
  dots_->SetPoints(dotPlaces_);
  dots_->GetPointData()->SetNormals(dotNormals_);
  dots_->GetPointData()->SetScalars(dotColors_);
  dotMapper_->SetInputData(dots_);
  dotActor_->SetMapper(dotMapper_);
  dotActor_->GetProperty()->SetAmbient(0.35);
  dotActor_->GetProperty()->SetDiffuse(0.6);
  dotActor_->VisibilityOff();
}

void ElementFigure::addTo(vtkRenderer* renderer) {
  renderer_ = renderer;
  renderer_->AddActor(dotActor_);
}

void ElementFigure::show(const scene::MacroResult* result) {
  if (result == shown_) return;
  shown_ = result;
  for (const auto& shape : shapes_)
    for (BodyGlyphs& glyphs : shape->glyphs) renderer_->RemoveActor(glyphs.actor());
  shapes_.clear();
  tints_.clear();
  dotActor_->VisibilityOff();
  if (!result) return;
  const interlock::SheetDetail& detail = result->placed->detail;
  const interlock::UnitCell& cell = *result->cell;
  spacing_ = std::sqrt(std::abs(cell.lattice.determinant()) / static_cast<double>(cell.elements.size()));
  std::vector<std::vector<Eigen::Index>> members(cell.shapes.size());
  for (std::size_t i = 0; i < detail.elements.size(); ++i) {
    const interlock::PatchElement& element = detail.elements[i];
    members[static_cast<std::size_t>(cell.elements[static_cast<std::size_t>(element.element)].shape)].push_back(
        static_cast<Eigen::Index>(i));
    const int tint = element.element + element.shift[0] + 2 * element.shift[1];
    tints_.push_back((tint % tints + tints) % tints);
  }
  for (std::size_t s = 0; s < members.size(); ++s) {
    if (members[s].empty()) continue;
    Shape& shape = *shapes_.emplace_back(std::make_unique<Shape>());
    shape.members = members[s];
    const geometry::SurfaceMesh surface = surfaceOf(cell.shapes[s], cut);
    const std::size_t still = std::max(coarseTriangles, mostStillTriangles / detail.elements.size());
    const std::size_t moving = std::max(coarseTriangles, mostMovingTriangles / detail.elements.size());
    const std::array<geometry::SurfaceMesh, levelCount> surfaces{
        surface, decimated(surface, still), decimated(surface, moving)};
    for (std::size_t level = 0; level < levelCount; ++level) {
      shape.glyphs[level].setShape(surfaces[level]);
      shape.triangles[level] = surfaces[level].triangles.size();
      shape.glyphs[level].actor()->VisibilityOff();
      renderer_->AddActor(shape.glyphs[level].actor());
    }
  }
  whole_.fill(false);
  setDots();
}

std::size_t ElementFigure::triangleCount(std::size_t level, const std::vector<char>* seen) const {
  std::size_t count = 0;
  for (const auto& shape : shapes_) {
    const auto drawn = seen ? std::count_if(shape->members.begin(), shape->members.end(),
                                            [&](Eigen::Index i) { return (*seen)[static_cast<std::size_t>(i)] != 0; })
                            : static_cast<std::ptrdiff_t>(shape->members.size());
    count += static_cast<std::size_t>(drawn) * shape->triangles[level];
  }
  return count;
}

void ElementFigure::chooseDetail(const CameraControl& camera, bool moves) {
  if (!shown_) return;
  const std::size_t most = moves ? mostMovingTriangles : mostStillTriangles;
  std::vector<char> inView;
  const std::vector<char>* seen = nullptr;
  std::size_t level = 0;
  if (triangleCount(0, nullptr) > most) {
    inView = camera.inView(shown_->placed->detail.state.positions, spacing_);
    seen = &inView;
    while (level < levelCount && triangleCount(level, seen) > most) ++level;
    if (level == levelCount && !moves) level = levelCount - 1;
  }
  for (std::size_t i = 0; i < levelCount; ++i) {
    for (const auto& shape : shapes_) {
      shape->glyphs[i].actor()->SetVisibility(i == level);
      if (i == level && (seen || !whole_[i])) pose(*shape, i, seen);
    }
    if (i == level) whole_[i] = !seen;
  }
  dotActor_->SetVisibility(level == levelCount);
  dotActor_->GetProperty()->SetPointSize(static_cast<float>(std::max(1.0, dotShare * spacing_ / camera.pixelSize())));
}

void ElementFigure::pose(Shape& shape, std::size_t level, const std::vector<char>* seen) {
  const interlock::CellState& state = shown_->placed->detail.state;
  std::vector<Eigen::Index> drawn;
  for (const Eigen::Index i : shape.members)
    if (!seen || (*seen)[static_cast<std::size_t>(i)]) drawn.push_back(i);
  std::vector<Eigen::Matrix3d> rotations;
  std::vector<Color> colors;
  for (const Eigen::Index i : drawn) {
    rotations.push_back(state.rotations[static_cast<std::size_t>(i)]);
    colors.push_back(colorOf(i));
  }
  shape.glyphs[level].setPoses(state.positions(Eigen::all, drawn), rotations);
  shape.glyphs[level].setColors(colors);
}

Color ElementFigure::colorOf(Eigen::Index element) const {
  switch (tints_[static_cast<std::size_t>(element)]) {
    case 0: return blended(colors_.rest, colors_.mass, 0.28);
    case 1: return blended(colors_.rest, {1, 1, 1}, 0.25);
    default: return colors_.rest;
  }
}

/// One an element, lit as the sheet around it.
void ElementFigure::setDots() {
  const interlock::CellState& state = shown_->placed->detail.state;
  dotPlaces_->SetNumberOfPoints(state.positions.cols());
  dotNormals_->SetNumberOfTuples(state.positions.cols());
  dotColors_->SetNumberOfTuples(state.positions.cols());
  vtkNew<vtkCellArray> vertices;
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    dotPlaces_->SetPoint(i, state.positions.col(i).data());
    const auto element = static_cast<std::size_t>(shown_->placed->detail.elements[static_cast<std::size_t>(i)].element);
    const Eigen::Vector3d up = state.rotations[static_cast<std::size_t>(i)] *
                               shown_->cell->elements[element].rotation.transpose() * Eigen::Vector3d::UnitZ();
    dotNormals_->SetTuple(i, up.data());
    const Color color = colorOf(i);
    for (int channel = 0; channel < 3; ++channel)
      dotColors_->SetComponent(i, channel, std::round(255 * color[static_cast<std::size_t>(channel)]));
    vertices->InsertNextCell({i});
  }
  dots_->SetVerts(vertices);
  dotPlaces_->Modified();
  dotNormals_->Modified();
  dotColors_->Modified();
  dots_->Modified();
}

void ElementFigure::setColors(const Palette& colors) {
  colors_ = colors;
  if (!shown_) return;
  whole_.fill(false);
  setDots();
}

}  // namespace pliant::render
