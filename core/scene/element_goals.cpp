#include "core/scene/element_goals.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/error.hpp"
#include "core/interlock/strain_space_boundary.hpp"
#include "core/scene/boundary_surface.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

namespace {

using base::InputError;
using Eigen::Vector3d;

Vector3d strainFrom(const Json& list) { return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()}; }

/// Strain coordinates of Green strain: F = (I + 2 E)^½.
Vector3d strainOfGreen(const Vector3d& green) {
  const Eigen::Matrix2d squared =
      Eigen::Matrix2d::Identity() + 2 * (Eigen::Matrix2d() << green[0], green[2], green[2], green[1]).finished();
  const Eigen::Matrix2d stretch = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(squared).operatorSqrt();
  return {0.5 * (stretch(0, 0) + stretch(1, 1)) - 1, 0.5 * (stretch(0, 0) - stretch(1, 1)), stretch(0, 1)};
}

/// How far a ray from rest goes until `isInside` of Green strain ends.
double distanceWithin(const Vector3d& direction, const std::function<bool(const Vector3d&)>& isInside) {
  double inside = 0, outside = 1e-3;
  while (isInside(interlock::greenStrain(outside * direction)) && outside < 100) inside = outside, outside *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (isInside(interlock::greenStrain(middle * direction)) ? inside : outside) = middle;
  }
  return inside;
}

/// Where a ray from the origin first meets triangles; infinite if nowhere (Möller and Trumbore 1997).
double distanceToTriangles(const Vector3d& direction, const Eigen::Matrix3Xd& points,
                           const std::vector<std::array<int, 3>>& triangles) {
  double nearest = std::numeric_limits<double>::infinity();
  constexpr double margin = 1e-9;  // rays may pass between two triangles otherwise
  for (const auto& [a, b, c] : triangles) {
    const Vector3d first = points.col(b) - points.col(a), second = points.col(c) - points.col(a);
    const Vector3d normal = direction.cross(second);
    const double determinant = first.dot(normal);
    if (determinant == 0) continue;
    const Vector3d from = -points.col(a), across = from.cross(first);
    const double u = from.dot(normal) / determinant, v = direction.dot(across) / determinant;
    const double t = second.dot(across) / determinant;
    if (u >= -margin && v >= -margin && u + v <= 1 + margin && t > 0) nearest = std::min(nearest, t);
  }
  return nearest;
}

class RegionReader {
 public:
  RegionReader(const Scene& scene, const Json& region, const std::string& pointer)
      : scene_(scene), region_(region), pointer_(pointer) {}

  std::function<double(const Vector3d&)> distance() const {
    const std::string type = region_["type"];
    if (type == "surface") return ofSurface();
    std::function<bool(const Vector3d&)> isInside;
    if (type == "box") {
      const Vector3d low = strainFrom(region_["minimum"]), high = strainFrom(region_["maximum"]);
      isInside = [=](const Vector3d& e) { return (e.array() > low.array()).all() && (e.array() < high.array()).all(); };
    } else {
      const Vector3d centre = strainFrom(region_["centre"]), axes = strainFrom(region_["half_axes"]);
      if (!(axes.array() > 0).all())
        throw InputError(scene_.name() + ": " + pointer_ + "/half_axes", "Half axes must be above 0.");
      isInside = [=](const Vector3d& e) { return (e - centre).cwiseQuotient(axes).squaredNorm() < 1; };
    }
    if (!isInside(Vector3d::Zero())) failRest();
    return [isInside](const Vector3d& direction) { return distanceWithin(direction, isInside); };
  }

 private:
  [[noreturn]] void failRest() const {
    throw InputError(scene_.name() + ": " + pointer_,
                     "The region must have the rest state, strain 0, inside, from where it is looked at.");
  }

  std::function<double(const Vector3d&)> ofSurface() const {
    const BoundarySurface surface = readBoundarySurface(scene_.directory() / region_["file"].get<std::string>());
    Eigen::Matrix3Xd points = surface.points;
    for (Eigen::Index i = 0; i < points.cols(); ++i) points.col(i) = strainOfGreen(points.col(i));
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {1.0, -1.0})
        if (!std::isfinite(distanceToTriangles(side * Vector3d::Unit(axis), points, surface.triangles))) failRest();
    return [points, triangles = surface.triangles](const Vector3d& direction) {
      return distanceToTriangles(direction, points, triangles);
    };
  }

  const Scene& scene_;
  const Json& region_;
  const std::string pointer_;
};

void addRegion(const Scene& scene, const Json& region, const std::string& pointer, std::vector<ElementGoal>& goals) {
  const auto distance = RegionReader(scene, region, pointer).distance();
  for (const Vector3d& direction : interlock::icosphere(region["subdivisions"]).directions) {
    ElementGoal goal;
    goal.kind = ElementGoal::Kind::ray;
    goal.direction = direction;
    goal.limit.drive = interlock::rayDrive(direction);
    goal.limit.wanted = distance(direction);
    goal.limit.weight = region["weight"];
    goal.limit.kind =
        region["wanted"] == "inside" ? interlock::LimitGoal::Kind::atLeast : interlock::LimitGoal::Kind::match;
    if (std::isfinite(goal.limit.wanted)) goals.push_back(goal);
  }
}

}  // namespace

std::string_view ElementGoal::name() const {
  switch (kind) {
    case Kind::stretch: return "stretch";
    case Kind::compression: return "compression";
    case Kind::ray: break;
  }
  return "ray";
}

std::vector<ElementGoal> elementGoals(const Scene& scene, const Json& options, const std::string& pointer,
                                      interlock::Lateral lateral) {
  std::vector<ElementGoal> goals;
  const auto add = [&](ElementGoal::Kind kind, double angle, double wanted, double weight) {
    const bool compress = kind == ElementGoal::Kind::compression;
    ElementGoal goal;
    goal.kind = kind;
    goal.angle = angle;
    goal.limit.drive = interlock::uniaxialDrive(angle, compress, lateral, options["ratio"]);
    goal.limit.wanted = compress ? -wanted : wanted;
    goal.limit.weight = weight;
    goals.push_back(goal);
  };
  for (const Json& entry : options.value("polar_limits", Json::array())) {
    if (entry.contains("stretch"))
      add(ElementGoal::Kind::stretch, entry["direction"], entry["stretch"], entry["weight"]);
    if (entry.contains("compression"))
      add(ElementGoal::Kind::compression, entry["direction"], entry["compression"], entry["weight"]);
  }
  if (options.contains("polar_file")) {
    const CsvTable table(scene.directory() / options["polar_file"].get<std::string>());
    for (std::size_t row = 0; row < table.size(); ++row)
      for (const auto& [column, kind] :
           {std::pair{"stretch", ElementGoal::Kind::stretch}, std::pair{"compression", ElementGoal::Kind::compression}})
        if (table.has(column) && !table.text(row, column).empty())
          add(kind, table.number(row, "direction [rad]"), table.number(row, column), 1);
  }
  if (options.contains("strain_region")) addRegion(scene, options["strain_region"], pointer + "/strain_region", goals);
  if (goals.empty())
    throw InputError(scene.name() + ": " + pointer,
                     "A design needs limits that are wanted: \"polar_limits\", \"polar_file\" or \"strain_region\".");
  return goals;
}

}  // namespace pliant::scene
