#pragma once

#include <cmath>
#include <numbers>

#include "core/geometry/mesh_generators.hpp"
#include "core/scene/cloth_result.hpp"

namespace pliant::render {

/// A square sheet with a stretch limit of 5 % that hangs from two corners over a sphere, with frames in closed form: it
/// falls and stretches downwards until its lower edge is at the limit.
struct HangingSheet {
  static constexpr int cells = 16;
  static constexpr int frameCount = 11;
  static constexpr double side = 0.5;  ///< [m]
  static constexpr double limit = 1.05;

  std::shared_ptr<const cloth::ClothProblem> problem;
  std::vector<std::shared_ptr<const scene::ClothFrame>> frames;

  HangingSheet() {
    constexpr int across = cells + 1;
    mechanics::Model made;
    made.dimension = 3;
    Eigen::Matrix3Xd rest(3, across * across);
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) rest.col(j * across + i) = Eigen::Vector3d(side * i, side * j, 0) / cells;
    made.restPositions = rest.reshaped();
    made.gravity = mechanics::Vector::Zero(3);
    made.lockedCoordinates.assign(made.coordinateCount(), 0);
    made.elementMass = std::make_shared<mechanics::SparseMatrix>(made.coordinateCount(), made.coordinateCount());
    mechanics::DisplayPart& part = made.parts.emplace_back();
    part.name = "sheet";
    part.nodeCount = across * across;
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const int a = j * across + i, b = a + 1, c = a + across, d = c + 1;
        part.triangles.push_back({a, b, d});
        part.triangles.push_back({a, d, c});
      }
    auto cloth = std::make_shared<cloth::ClothProblem>();
    cloth->sheet.nodeCount = across * across;
    for (const auto& nodes : part.triangles) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k) corners.col(k) = rest.col(nodes[k]);
      cloth->sheet.triangles.push_back({nodes, cloth::shapeGradients(corners, Eigen::Vector3d::UnitX()), 0});
    }
    cloth->sheet.limits = {cloth::IsotropicLimit{limit}};
    cloth->sheet.constraints = {cloth::exactConstraints(cloth->sheet.limits[0])};
    cloth->pins = {{"corners", {0, cells}, {}, 0.75}};
    cloth::Body ball;
    ball.name = "ball";
    ball.points = Eigen::Matrix3Xd::Zero(3, 1);
    ball.points.col(0) << 0.25, 0.3, -0.22;
    ball.radius = 0.08;
    cloth->bodies = {ball};
    made.finish();
    cloth->model = std::make_shared<const mechanics::Model>(std::move(made));
    for (int f = 0; f < frameCount; ++f) frames.push_back(frame(rest, cloth->sheet, ball, 0.1 * f));
    problem = cloth;
  }

 private:
  std::shared_ptr<const scene::ClothFrame> frame(const Eigen::Matrix3Xd& rest, const cloth::LimitedSheet& sheet,
                                                 const cloth::Body& ball, double time) const {
    auto made = std::make_shared<scene::ClothFrame>();
    made->time = time;
    made->positions = rest;
    const double turn = -0.45 * std::numbers::pi * time;
    for (auto point : made->positions.colwise()) {
      const double x = point.x(), y = point.y();
      const double along = y + 0.5 * (limit - 1) * time * y * y / side;
      point = Eigen::Vector3d(x, along * std::cos(turn), along * std::sin(turn));
      point.z() += 0.005 * time * std::sin(6 * std::numbers::pi * x / side) * y / side;
    }
    made->bodyPoints = ball.points;
    made->stretchRatios = cloth::stretchRatios(sheet, made->positions);
    made->limitForces = (made->stretchRatios.array() - 0.98).max(0);
    return made;
  }
};

}  // namespace pliant::render
