#include "ui/render/body_figure.hpp"

#include <vtkProperty.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace pliant::render {
namespace {

constexpr int sectors = 40, stacks = 24;

using Triangles = std::vector<std::array<int, 3>>;

/// Adds a grid of quadrilaterals between `rows` rings of `sectors` points each, beginning at point `first`.
void addRings(Triangles& triangles, int first, int rows) {
  for (int row = 0; row + 1 < rows; ++row)
    for (int i = 0; i < sectors; ++i) {
      const int a = first + row * sectors + i, b = first + row * sectors + (i + 1) % sectors;
      triangles.push_back({a, b, b + sectors});
      triangles.push_back({a, b + sectors, a + sectors});
    }
}

/// A ring of points of radius `radius` about `centre`, in the plane of two unit vectors.
void addRing(Points& points, Eigen::Index first, const Eigen::Vector3d& centre, const Eigen::Vector3d& u,
             const Eigen::Vector3d& v, double radius) {
  for (int i = 0; i < sectors; ++i) {
    const double angle = 2 * std::numbers::pi * i / sectors;
    points.col(first + i) = centre + radius * (std::cos(angle) * u + std::sin(angle) * v);
  }
}

}  // namespace

void BodyFigure::setBodies(const std::vector<cloth::Body>& bodies) {
  for (const auto& part : parts_) renderer_->RemoveActor(part->surface.actor());
  parts_.clear();
  int first = 0;
  for (const cloth::Body& body : bodies) {
    const int count = static_cast<int>(body.points.cols());
    auto part = std::make_unique<Part>();
    for (int i = 0; i < count; ++i) part->points.push_back(first + i);
    part->radius = body.radius;
    part->edges = body.edges;
    part->swept = body.triangles.empty();
    Triangles triangles = body.triangles;
    if (part->swept) {
      for (int i = 0; i < count; ++i) addRings(triangles, i * sectors * (stacks + 1), stacks + 1);
      for (std::size_t i = 0; i < body.edges.size(); ++i)
        addRings(triangles, count * sectors * (stacks + 1) + 2 * static_cast<int>(i) * sectors, 2);
    }
    part->surface.setTopology(triangles);
    renderer_->AddActor(part->surface.actor());
    first += count;
    parts_.push_back(std::move(part));
  }
  setColor(color_);
}

void BodyFigure::setPoints(const Points& points) {
  for (const auto& part : parts_) {
    const auto count = static_cast<Eigen::Index>(part->points.size());
    if (count == 0) continue;
    const Points own = points.middleCols(part->points.front(), count);
    if (part->swept)
      setSwept(*part, own);
    else
      part->surface.setPoints(own, part->radius);
  }
}

void BodyFigure::setSwept(Part& part, const Points& points) {
  const Eigen::Index perSphere = Eigen::Index{sectors} * (stacks + 1);
  Points places(3, points.cols() * perSphere + 2 * sectors * static_cast<Eigen::Index>(part.edges.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (int stack = 0; stack <= stacks; ++stack) {
      const double polar = std::numbers::pi * stack / stacks;
      addRing(places, i * perSphere + stack * sectors,
              points.col(i) - part.radius * std::cos(polar) * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(),
              Eigen::Vector3d::UnitY(), part.radius * std::sin(polar));
    }
  Eigen::Index next = points.cols() * perSphere;
  for (const auto& [a, b] : part.edges) {
    const Eigen::Vector3d along = points.col(b) - points.col(a);
    const Eigen::Vector3d u = along.unitOrthogonal(), v = along.normalized().cross(u);
    for (const int end : {a, b}) {
      addRing(places, next, points.col(end), u, v, part.radius);
      next += sectors;
    }
  }
  part.surface.setPoints(places);
}

void BodyFigure::setColor(const Color& color) {
  color_ = color;
  for (const auto& part : parts_) part->surface.actor()->GetProperty()->SetColor(color[0], color[1], color[2]);
}

}  // namespace pliant::render
