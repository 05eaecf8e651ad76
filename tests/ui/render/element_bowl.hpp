#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/geometry/hexagon_mesh.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/macro_result.hpp"
#include "core/scene/scene.hpp"

namespace pliant::render {

/// A sheet of 10,584 triangles bent to a bowl, with about so many threefold elements, which follow it as if nothing
/// were in their way.
inline std::shared_ptr<scene::MacroResult> elementBowl(int count) {
  constexpr int rings = 42;
  constexpr double depth = 0.3;  // over its radius
  const scene::Scene file = scene::Scene::load(PLIANT_SOURCE_DIR "/scenes/interlock/macro_drape.json");
  auto result = std::make_shared<scene::MacroResult>();
  result->cell = std::make_shared<const interlock::UnitCell>(scene::buildCell(file, "material"));
  const interlock::UnitCell& cell = *result->cell;
  const double area = std::abs(cell.lattice.determinant()) / static_cast<double>(cell.elements.size());
  const double radius = std::sqrt(count * area / std::numbers::pi), curvature = depth / radius;
  const auto bent = [&](const Eigen::Vector3d& flat) {
    return Eigen::Vector3d(flat.x(), flat.y(), flat.z() - curvature * flat.head<2>().squaredNorm());
  };
  auto sheet = std::make_shared<interlock::MacroSheet>();
  sheet->mesh = geometry::makeDisk(radius, rings);
  const auto triangles = static_cast<Eigen::Index>(sheet->mesh.triangles.size());
  result->state.positions.resize(sheet->mesh.points.size());
  for (Eigen::Index i = 0; i < sheet->mesh.points.cols(); ++i)
    result->state.positions.segment<3>(3 * i) = bent(sheet->mesh.points.col(i));
  result->state.stretchGauge.resize(triangles);
  result->state.bendingGauge.setZero(triangles);
  for (Eigen::Index t = 0; t < triangles; ++t)
    result->state.stretchGauge[t] =
        sheet->mesh.points.col(sheet->mesh.triangles[static_cast<std::size_t>(t)][0]).norm() / radius;
  result->sheet = std::move(sheet);
  interlock::SheetDetail detail;
  std::vector<Eigen::Vector3d> places;
  const int reach = static_cast<int>(2 * radius / cell.lattice.colwise().norm().minCoeff()) + 1;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (std::size_t e = 0; e < cell.elements.size(); ++e) {
        Eigen::Vector3d flat = cell.elements[e].position;
        flat.head<2>() += cell.lattice * Eigen::Vector2d(i, j);
        if (flat.head<2>().norm() > radius) continue;
        detail.elements.push_back({static_cast<int>(e), {i, j}});
        places.push_back(bent(flat));
        const Eigen::Vector3d normal(2 * curvature * flat.x(), 2 * curvature * flat.y(), 1);
        detail.state.rotations.push_back(
            Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix() *
            cell.elements[e].rotation);
      }
  detail.state.positions.resize(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) detail.state.positions.col(static_cast<Eigen::Index>(i)) = places[i];
  detail.pulls.setZero(detail.state.positions.cols());
  detail.turns.setZero(detail.state.positions.cols());
  result->placed.emplace();
  result->placed->detail = std::move(detail);
  return result;
}

}  // namespace pliant::render
