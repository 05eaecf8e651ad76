#include "core/scene/mirrored_nodes.hpp"

#include <set>

#include "core/base/error.hpp"

namespace pliant::scene {

using mechanics::Vector;

std::vector<int> withMirrorImages(const mechanics::Model& model, const std::vector<int>& nodes, const Json& plane,
                                  const std::string& pointer) {
  const auto vectorAt = [&](const char* key) {
    const auto values = plane[key].get<std::vector<double>>();
    return Vector(Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  const Vector point = vectorAt("point"), normal = vectorAt("normal").stableNormalized();
  if (!(normal.norm() > 0)) throw base::InputError(pointer + "/normal", "A normal must have a direction.");
  const mechanics::Matrix places =
      model.restPositions.head(model.nodeCount() * model.dimension).reshaped(model.dimension, model.nodeCount());
  constexpr double onPlane = 1e-9;  // of the size of the model
  const double size = (places.rowwise().maxCoeff() - places.rowwise().minCoeff()).norm();
  std::set<int> result(nodes.begin(), nodes.end());
  for (const int node : nodes) {
    const double height = normal.dot(places.col(node) - point);
    if (std::abs(height) <= onPlane * size) continue;
    const Vector mirrored = places.col(node) - 2 * height * normal;
    Eigen::Index image = 0;
    for (Eigen::Index other = 1; other < places.cols(); ++other)
      if ((places.col(other) - mirrored).squaredNorm() < (places.col(image) - mirrored).squaredNorm()) image = other;
    if (normal.dot(places.col(image) - point) * height >= 0)
      throw base::InputError(pointer, "Node " + std::to_string(node) + " has no mirror image in this plane.");
    result.insert(static_cast<int>(image));
  }
  return {result.begin(), result.end()};
}

}  // namespace pliant::scene
