#include "core/scene/macro_strains.hpp"

#include <Eigen/Geometry>

namespace pliant::scene {

namespace {

int materialAt(const MacroResult& result, int triangle) {
  const std::vector<int>& materials = result.sheet->materialOf;
  return materials.empty() ? 0 : materials[static_cast<std::size_t>(triangle)];
}

}  // namespace

Eigen::Matrix3Xd tensorComponents(const Eigen::Matrix3Xd& strains) {
  Eigen::Matrix3Xd components(3, strains.cols());
  components.row(0) = strains.row(0) + strains.row(1);
  components.row(1) = strains.row(0) - strains.row(1);
  components.row(2) = strains.row(2);
  return components;
}

std::shared_ptr<const BoundarySurface> materialBoundary(const MacroResult& result, SheetLimit limit, int triangle) {
  const auto& material = result.sheet->materials[static_cast<std::size_t>(materialAt(result, triangle))];
  const auto& set = limit == SheetLimit::stretch ? material.stretch : material.bending;
  if (!set) return nullptr;
  auto surface = std::make_shared<BoundarySurface>();
  surface->name = limit == SheetLimit::stretch ? "limits of stretch" : "limits of bending";
  surface->space = limit == SheetLimit::stretch ? strainSpace() : curvatureSpace();
  surface->points = tensorComponents(set->boundary().points);
  surface->triangles = set->boundary().triangles;
  surface->known.assign(static_cast<std::size_t>(surface->points.cols()), true);
  return surface;
}

std::vector<int> trianglesLike(const MacroResult& result, int triangle) {
  std::vector<int> like;
  for (int i = 0; i < static_cast<int>(result.sheet->mesh.triangles.size()); ++i)
    if (materialAt(result, i) == materialAt(result, triangle)) like.push_back(i);
  return like;
}

SheetMoment sheetMoment(const MacroResult& result, int frame) {
  if (frame < 0 || frame >= static_cast<int>(result.frames.size()))
    return {result.state.strains, result.state.stretchGauge, result.state.bendingGauge};
  const interlock::MacroSheet& sheet = *result.sheet;
  std::vector<mechanics::LimitedTriangle> triangles;
  for (std::size_t t = 0; t < sheet.mesh.triangles.size(); ++t) {
    mechanics::LimitedTriangle& triangle = triangles.emplace_back();
    triangle.nodes = sheet.mesh.triangles[t];
    const Eigen::Rotation2Dd toMaterial(sheet.angleOf.empty() ? 0 : -sheet.angleOf[t]);
    for (int i = 0; i < 3; ++i)
      triangle.rest.col(i) = toMaterial * sheet.mesh.points.col(triangle.nodes[static_cast<std::size_t>(i)]).head<2>();
  }
  const MacroFrame& shown = *result.frames[static_cast<std::size_t>(frame)];
  return {mechanics::sheetStrains(triangles, shown.positions.reshaped()), shown.stretchGauge, shown.bendingGauge};
}

Eigen::Matrix3Xd strainPlaces(const SheetMoment& moment, SheetLimit limit, const std::vector<int>& triangles) {
  const mechanics::SheetStrains& strains = moment.strains;
  const Eigen::Matrix3Xd& all = limit == SheetLimit::stretch ? strains.stretch : strains.curvature;
  return tensorComponents(all(Eigen::all, triangles));
}

double largestDeflection(const MacroResult& result) {
  if (result.deflections.cols() > 0) return result.deflections.colwise().norm().maxCoeff();
  const auto& rest = result.sheet->mesh.points;
  return (result.state.positions.reshaped(3, rest.cols()) - rest).colwise().norm().maxCoeff();
}

}  // namespace pliant::scene
