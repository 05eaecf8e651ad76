#include "core/mechanics/contact_body.hpp"

#include <cmath>

#include "core/base/error.hpp"

namespace pliant::mechanics {

Eigen::Matrix3Xd bodyPointsAt(const std::vector<Body>& bodies, double time) {
  Eigen::Index count = 0;
  for (const Body& body : bodies) count += body.points.cols();
  Eigen::Matrix3Xd points(3, count);
  count = 0;
  for (const Body& body : bodies) {
    points.middleCols(count, body.points.cols()) = placementAt(body.path, time).apply(body.points, body.centre);
    count += body.points.cols();
  }
  return points;
}

std::shared_ptr<ContactBarrier> makeSheetContact(const SheetContact& contact, const Eigen::Matrix3Xd& rest,
                                                 double weight) {
  if (contact.bodies.empty() && !contact.selfContact) return nullptr;
  const int nodes = static_cast<int>(rest.cols());
  ContactGeometry geometry;
  geometry.selfContact = contact.selfContact;
  geometry.triangles = contact.triangles;
  geometry.radii.assign(static_cast<std::size_t>(nodes), 0);
  geometry.bodies.assign(static_cast<std::size_t>(nodes), 0);
  int first = nodes, number = 0;
  for (const Body& body : contact.bodies) {
    const int count = static_cast<int>(body.points.cols());
    for (const auto& [a, b, c] : body.triangles) geometry.triangles.push_back({first + a, first + b, first + c});
    for (const auto& [a, b] : body.edges) geometry.edges.push_back({first + a, first + b});
    if (body.triangles.empty() && body.edges.empty())
      for (int i = 0; i < count; ++i) geometry.points.push_back(first + i);
    geometry.radii.insert(geometry.radii.end(), static_cast<std::size_t>(count), body.radius);
    geometry.bodies.insert(geometry.bodies.end(), static_cast<std::size_t>(count), ++number);
    first += count;
  }
  const double range = contact.distance;
  if (!(std::isfinite(range) && range > 0)) throw base::InputError("", "the contact distance must be a number above 0");
  // Half-way into the range the barrier falls by 1.193 range a metre.
  const double stiffness = 10 * weight / (1.193 * range);
  Eigen::Matrix3Xd all(3, first);
  all << rest, bodyPointsAt(contact.bodies, 0);
  return std::make_shared<ContactBarrier>(
      std::move(geometry), all, ContactOptions{.range = range, .stiffness = stiffness, .separation = 0});
}

}  // namespace pliant::mechanics
