#include "core/scene/cloth_builder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "core/scene/body_builder.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

Eigen::Vector3d spaceVector(const Json& values) {
  return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
}

class ClothBuilder {
 public:
  ClothBuilder(const Scene& scene, std::shared_ptr<const mechanics::Model> model)
      : scene_(scene), json_(scene.normalized()), model_(std::move(model)) {
    if (json_["dimension"] != 3) throw InputError("/dimension", "Studies of cloth need a scene of dimension 3.");
    geometries_ = placeGeometry(scene);
  }

  std::shared_ptr<const cloth::ClothProblem> build() {
    addPins();
    problem_.model = model_;
    addTriangles();
    forEachEntry("stretch_limits", [&](const Json& entry, const std::string& pointer) { addLimit(entry, pointer); });
    problem_.bodies = buildBodies(scene_);
    forEachEntry("loads", [&](const Json& entry, const std::string&) {
      if (entry["type"] != "wind") return;
      if (problem_.wind) throw InputError("", "studies of cloth know one wind alone");
      problem_.wind = cloth::Wind{
          spaceVector(entry["velocity"]), entry["air_density"], entry["drag"], entry["gust"], entry["gust_period"]};
    });
    if (json_["contact"]["friction"] != 0.0)
      throw InputError("/contact/friction", "Studies of cloth know no friction; sheets of interlocking material do.");
    problem_.contactDistance = json_["contact"]["distance"];
    problem_.selfContact = json_["contact"]["self_contact"];
    finishSheet();
    locate("/elements", [&] { checkClothProblem(problem_); });
    checkSeams();
    return std::make_shared<const cloth::ClothProblem>(std::move(problem_));
  }

 private:
  template <class Body>
  void forEachEntry(const char* list, const Body& body) {
    for (std::size_t i = 0; i < json_[list].size(); ++i) {
      const std::string pointer = childPointer("/" + std::string(list), i);
      locate(pointer, [&] { body(json_[list][i], pointer); });
    }
  }

  /// What the model locks for the sake of other studies is free again where a pin says how it moves.
  void addPins() {
    auto model = std::make_shared<mechanics::Model>(*model_);
    std::set<int> pinned, locked;
    forEachEntry("boundary_conditions", [&](const Json& entry, const std::string& pointer) {
      const std::vector<int> nodes = selectNodes(entry["at"], pointer + "/at", geometries_);
      if (entry["type"] == "locked") {
        if (entry.contains("coordinates") && entry["coordinates"].get<std::set<std::string>>().size() < 3)
          throw InputError(
              pointer + "/coordinates", "Studies of cloth hold nodes with all three coordinates or not at all.");
        locked.insert(nodes.begin(), nodes.end());
        return;
      }
      cloth::Pin pin{entry["name"], nodes, motionOf(entry), std::nullopt};
      if (entry.contains("release")) pin.release = entry["release"].get<double>();
      for (const int node : nodes) {
        if (!pinned.insert(node).second)
          throw InputError(pointer + "/at", "Node " + std::to_string(node) + " is pinned twice.");
        for (int axis = 0; axis < 3; ++axis)
          model->lockedCoordinates[3 * static_cast<std::size_t>(node) + static_cast<std::size_t>(axis)] = 0;
      }
      problem_.pins.push_back(std::move(pin));
    });
    for (const int node : locked)
      if (pinned.contains(node))
        throw InputError("/boundary_conditions", "Node " + std::to_string(node) + " is both pinned and locked.");
    if (problem_.pins.empty()) return;
    locate("/boundary_conditions", [&] { model->finish(); });
    model_ = std::move(model);
  }

  const PlacedGeometry& geometryNamed(const Json& name) const {
    return *std::find_if(
        geometries_.begin(), geometries_.end(), [&](const PlacedGeometry& g) { return g.name == name; });
  }

  static bool isSheet(const Json& element) { return element["type"] == "shell" || element["type"] == "membrane"; }

  /// The triangles of every geometry that is a sheet, once.
  void addTriangles() {
    for (const Json& element : json_["elements"]) {
      const std::string name = element.value("geometry", "");
      if (!isSheet(element) || firstTriangle_.contains(name)) continue;
      const PlacedGeometry& geometry = geometryNamed(name);
      firstTriangle_[name] = problem_.sheet.triangles.size();
      const Eigen::Vector2d none = Eigen::Vector2d::Zero();
      for (const auto& nodes : geometry.global(geometry.mesh.triangles))
        problem_.sheet.triangles.push_back({nodes, {none, none, none}, -1});
    }
    problem_.sheet.nodeCount = model_->nodeCount();
  }

  static cloth::StretchLimit limitOf(const Json& entry) {
    if (entry["type"] == "isotropic") return cloth::IsotropicLimit{entry["stretch"]};
    if (entry["type"] == "orthotropic") return cloth::OrthotropicLimit{entry["first"], entry["second"], entry["angle"]};
    std::vector<cloth::DirectionLimit> points;
    for (const Json& point : entry["points"]) points.push_back({point["angle"], point["stretch"]});
    return cloth::LimitCurve(std::move(points));
  }

  static cloth::LimitConstraints constraintsOf(const Json& entry, const cloth::StretchLimit& limit) {
    if (entry["type"] == "curve") {
      const std::string kind = entry["constraints"];
      const int count = entry["count"];
      return kind == "ellipses"     ? cloth::ellipseConstraints(limit, count)
             : kind == "directions" ? cloth::directionConstraints(limit, count)
                                    : cloth::limitConstraints(limit, count);
    }
    return entry.contains("directions") ? cloth::directionConstraints(limit, entry["directions"])
                                        : cloth::exactConstraints(limit);
  }

  void addLimit(const Json& entry, const std::string& pointer) {
    const auto& elements = json_["elements"];
    const auto element =
        std::find_if(elements.begin(), elements.end(), [&](const Json& e) { return e["name"] == entry["element"]; });
    if (!isSheet(*element))
      throw InputError(pointer + "/element", quote(entry["element"].get<std::string>()) + " is no shell or membrane.");
    const PlacedGeometry& geometry = geometryNamed((*element)["geometry"]);
    const std::size_t index = static_cast<std::size_t>(element - elements.begin());
    const RestShape rest = restShapeOf(*element, childPointer("/elements", index), geometry, scene_.directory());
    const cloth::StretchLimit limit = limitOf(entry);
    if (const double smallest = cloth::smallestStretch(limit); smallest < 1)
      throw InputError(pointer, "The rest shape breaks this limit: its smallest stretch is " +
                                    base::formatQuantityExactly(smallest, {}) + ", below 1.");
    const int number = static_cast<int>(problem_.sheet.limits.size());
    problem_.sheet.constraints.push_back(constraintsOf(entry, limit));
    problem_.sheet.limits.push_back(limit);
    const std::set<int> chosen = nodesOfGroup(entry, pointer, geometry);
    const std::size_t first = firstTriangle_.at(geometry.name);
    bool any = false;
    for (std::size_t t = 0; t < geometry.mesh.triangles.size(); ++t) {
      cloth::SheetTriangle& triangle = problem_.sheet.triangles[first + t];
      const auto& corners = triangle.nodes;
      if (entry.contains("group") &&
          !std::all_of(corners.begin(), corners.end(), [&](int node) { return chosen.contains(node); }))
        continue;
      Eigen::Matrix3d points;
      for (int corner = 0; corner < 3; ++corner)
        points.col(corner) = rest.positions.segment<3>(3 * rest.triangles[t][static_cast<std::size_t>(corner)]);
      triangle.gradients = cloth::shapeGradients(points, spaceVector(entry["direction"]));
      triangle.limit = number;
      any = true;
    }
    if (!any) throw InputError(pointer + "/group", "No triangle has all its nodes in this group.");
  }

  std::set<int> nodesOfGroup(const Json& entry, const std::string& pointer, const PlacedGeometry& geometry) const {
    if (!entry.contains("group")) return {};
    const Json selection{{"geometry", geometry.name}, {"group", entry["group"]}};
    const std::vector<int> nodes = selectNodes(selection, pointer, geometries_);
    return {nodes.begin(), nodes.end()};
  }

  /// A projection with contact starts inside the limits, so what closing the seams has stretched it cannot take back.
  void checkSeams() const {
    if (json_["seams"].empty() || (problem_.bodies.empty() && !problem_.selfContact)) return;
    const Eigen::VectorXd ratios =
        cloth::stretchRatios(problem_.sheet, model_->restPositions.reshaped(3, model_->nodeCount()));
    for (const auto& [name, first] : firstTriangle_) {
      const PlacedGeometry& geometry = geometryNamed(name);
      for (std::size_t t = 0; t < geometry.mesh.triangles.size(); ++t) {
        const auto& nodes = geometry.mesh.triangles[t];
        const double ratio = ratios[static_cast<Eigen::Index>(first + t)];
        if (ratio >= 1 && geometry.mesh.points(Eigen::all, nodes) != geometry.unsewn(Eigen::all, nodes))
          throw InputError("/seams", "Closing the seams stretches triangle " + std::to_string(t) + " of the geometry " +
                                         quote(name) + " to " + base::formatQuantity(ratio, {}) +
                                         " times its limit, and with contact limits must hold from the start; put the "
                                         "edges nearer to each other.");
      }
    }
  }

  void finishSheet() {
    problem_.sheet.fixed = heldNodes(problem_, 0);
    problem_.sheet.masses = cloth::lumpedMasses(*model_);
    // A held node may have no mass, and the weight of what cannot move does not matter.
    for (Eigen::Index node = 0; node < problem_.sheet.masses.size(); ++node)
      if (problem_.sheet.fixed[static_cast<std::size_t>(node)] && !(problem_.sheet.masses[node] > 0))
        problem_.sheet.masses[node] = 1;
  }

  const Scene& scene_;
  const Json& json_;
  std::shared_ptr<const mechanics::Model> model_;
  std::vector<PlacedGeometry> geometries_;
  cloth::ClothProblem problem_;
  std::map<std::string, std::size_t> firstTriangle_;  ///< of each geometry in the sheet
};

}  // namespace

std::shared_ptr<const cloth::ClothProblem> buildClothProblem(const Scene& scene,
                                                             std::shared_ptr<const mechanics::Model> model) {
  try {
    return ClothBuilder(scene, std::move(model)).build();
  } catch (const InputError& error) {
    throw error.inside(scene.name());
  }
}

}  // namespace pliant::scene
