#include "core/scene/model_builder.hpp"

#include <algorithm>
#include <set>

#include "core/mechanics/mechanism.hpp"
#include "core/mechanics/point_mass_parameter.hpp"
#include "core/mechanics/prescribed_motion.hpp"
#include "core/mechanics/spring.hpp"
#include "core/scene/element_builders.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/interlock_builder.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/mechanism_builders.hpp"
#include "core/scene/mirrored_nodes.hpp"
#include "core/scene/placed_geometry.hpp"
#include "core/scene/scene_parameters.hpp"

namespace pliant::scene {

using base::InputError;
using mechanics::Vector;

namespace {

Vector toVector(const Json& values) {
  Vector result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) result[static_cast<Eigen::Index>(i)] = values[i].get<double>();
  return result;
}

mechanics::PeriodicSignal toSignal(const Json& harmonics) {
  mechanics::PeriodicSignal signal;
  for (const Json& term : harmonics)
    signal.terms.push_back(
        {term["order"], term["amplitude"], term["phase"], term.value("of", "") == "second_frequency"});
  return signal;
}

class Builder {
 public:
  explicit Builder(const Scene& scene)
      : scene_(scene.normalized()),
        directory_(scene.directory()),
        dimension_(scene_["dimension"]),
        geometries_(placeGeometry(scene)) {
    model_.dimension = dimension_;
  }

  mechanics::Model build() {
    addNodes();
    forEach("drives", [&](const Json& entry, const std::string& pointer) {
      if (entry["type"] == "servo")
        addServo({scene_, geometries_, model_}, entry, pointer, toSignal(entry["harmonics"]));
    });
    addElements();
    forEach("point_masses", [&](const Json& entry, const std::string& pointer) { addPointMass(entry, pointer); });
    forEach("springs", [&](const Json& entry, const std::string& pointer) { addSpring(entry, pointer); });
    forEach("boundary_conditions", [&](const Json& entry, const std::string& pointer) { lock(entry, pointer); });
    forEach("drives", [&](const Json& entry, const std::string& pointer) {
      if (entry["type"] != "servo") addDrive(entry, pointer);
    });
    forEach("loads", [&](const Json& entry, const std::string& pointer) { addLoad(entry, pointer); });
    forEach("probes", [&](const Json& entry, const std::string& pointer) {
      model_.probes.push_back({entry["name"], selectNode(entry["at"], pointer + "/at", geometries_)});
    });
    model_.massDamping = scene_["damping"]["mass_proportional"];
    model_.stiffnessDamping = scene_["damping"]["stiffness_proportional"];
    locate("/geometry", [&] { model_.finish(); });
    checkEveryNodeIsHeld();
    return std::move(model_);
  }

 private:
  template <class Body>
  void forEach(const char* list, const Body& body) {
    for (std::size_t i = 0; i < scene_[list].size(); ++i) {
      const std::string pointer = childPointer("/" + std::string(list), i);
      locate(pointer, [&] { body(scene_[list][i], pointer); });
    }
  }

  std::vector<int> nodesAt(const Json& entry, const std::string& pointer) const {
    return selectNodes(entry["at"], pointer + "/at", geometries_);
  }

  const PlacedGeometry& geometryOf(int node) const {
    return *std::find_if(geometries_.begin(), geometries_.end(),
                         [&](const PlacedGeometry& g) { return node < g.firstNode + g.ownCount; });
  }

  Vector restOf(int node) const { return model_.restPositions.segment(node * dimension_, dimension_); }

  void addNodes() {
    const PlacedGeometry& last = geometries_.back();
    model_.restPositions.resize((last.firstNode + last.ownCount) * dimension_);
    for (const PlacedGeometry& geometry : geometries_) {
      for (int node = 0; node < geometry.nodeCount(); ++node)
        model_.restPositions.segment(geometry.nodes[static_cast<std::size_t>(node)] * dimension_, dimension_) =
            geometry.mesh.points.col(node).head(dimension_);
      model_.parts.push_back({geometry.name,
                              geometry.firstNode,
                              geometry.ownCount,
                              geometry.global(geometry.mesh.triangles),
                              geometry.global(geometry.tetrahedra),
                              {},
                              {},
                              {}});
    }
    model_.lockedCoordinates.assign(static_cast<std::size_t>(model_.restPositions.size()), 0);
  }

  /// Nodes that a boundary condition locks wholly, or that are driven.
  std::set<int> heldNodes() {
    std::set<int> held;
    const auto hold = [&](const Json& entry, const std::string& pointer) {
      if (entry["type"] == "servo" || entry.contains("coordinates")) return;
      for (const int node : nodesAt(entry, pointer)) held.insert(node);
    };
    forEach("boundary_conditions", hold);
    forEach("drives", hold);
    return held;
  }

  void addElements() {
    std::vector<Eigen::Triplet<double>> mass;
    const std::set<int> held = heldNodes();
    const auto kind =
        scene_["mass_matrix"] == "lumped" ? mechanics::MassMatrix::lumped : mechanics::MassMatrix::consistent;
    forEach("elements", [&](const Json& entry, const std::string& pointer) {
      const auto named = [&](const auto& list, const char* key) {
        return std::find_if(list.begin(), list.end(), [&](const Json& e) { return e["name"] == entry[key]; });
      };
      const Json* material = entry.contains("material") ? &*named(scene_["materials"], "material") : nullptr;
      const auto geometry = std::find_if(
          geometries_.begin(), geometries_.end(), [&](const PlacedGeometry& g) { return g.name == entry["geometry"]; });
      mechanics::DisplayPart& part = model_.parts[static_cast<std::size_t>(geometry - geometries_.begin())];
      elementBuilders().at(entry["type"])(
          {entry, pointer, material, *geometry, kind, held, model_, part, mass, frames_, panels_, directory_});
    });
    if (!scene_["seams"].empty())
      locate("/seams", [&] {
        if (auto bending = mechanics::makeSeamBending(panels_)) model_.energies.push_back(std::move(bending));
      });
    mechanics::SparseMatrix matrix(model_.restPositions.size(), model_.restPositions.size());
    matrix.setFromTriplets(mass.begin(), mass.end());
    model_.elementMass = std::make_shared<const mechanics::SparseMatrix>(std::move(matrix));
  }

  void addPointMass(const Json& entry, const std::string& pointer) {
    const int index = static_cast<int>(model_.pointMasses.size());
    std::vector<int> nodes = nodesAt(entry, pointer);
    if (entry.contains("mirrored")) nodes = withMirrorImages(model_, nodes, entry["mirrored"], pointer + "/mirrored");
    model_.pointMasses.push_back({entry["name"], std::move(nodes), entry["mass"], entry["minimum"], entry["maximum"]});
    model_.parameters.push_back(mechanics::makePointMassParameter(index, entry["name"]));
  }

  void addSpring(const Json& entry, const std::string& pointer) {
    const std::string type = entry["type"];
    if (type == "local") return addLocalSpring({scene_, geometries_, model_}, entry, pointer);
    if (type == "torsion") return addTorsionSpring({scene_, geometries_, model_}, entry, pointer);
    const mechanics::SpringLaw law{entry["coefficients"].get<std::vector<double>>()};
    const auto restLength = [&](const Vector& a, const Vector& b) {
      return entry.contains("rest_length") ? entry["rest_length"].get<double>() : (a - b).norm();
    };
    if (type == "between") {
      const int from = selectNode(entry["from"], pointer + "/from", geometries_);
      const int to = selectNode(entry["to"], pointer + "/to", geometries_);
      model_.energies.push_back(mechanics::makeSpring(dimension_, from, to, restLength(restOf(from), restOf(to)), law));
      addDisplayedSpring(from, mechanics::attachedToNode(dimension_, to));
    } else if (type == "anchored") {
      const int node = selectNode(entry["at"], pointer + "/at", geometries_);
      const Vector anchor = toVector(entry["anchor"]);
      model_.energies.push_back(
          mechanics::makeAnchoredSpring(dimension_, node, anchor, restLength(restOf(node), anchor), law));
      addDisplayedSpring(node, mechanics::fixedPlace(anchor));
    } else {
      const Vector direction = toVector(entry["direction"]).stableNormalized();
      for (const int node : nodesAt(entry, pointer)) {
        model_.energies.push_back(mechanics::makeGroundedSpring(dimension_, node, restOf(node), direction, law));
        addDisplayedSpring(node, mechanics::fixedPlace(restOf(node)));
      }
    }
  }

  void addDisplayedSpring(int node, const mechanics::AttachmentPoint& to) {
    partOf(node).springs.push_back({mechanics::attachedToNode(dimension_, node), to});
  }

  mechanics::DisplayPart& partOf(int node) {
    return model_.parts[static_cast<std::size_t>(&geometryOf(node) - geometries_.data())];
  }

  void lock(const Json& entry, const std::string& pointer) {
    for (const int node : nodesAt(entry, pointer)) {
      if (!entry.contains("coordinates")) {
        for (int axis = 0; axis < dimension_; ++axis) lockCoordinate(node, axis);
        for (const NodeFrame& frame : framesOf({node})) lockFrame(frame);
        continue;
      }
      for (const Json& axis : entry["coordinates"]) lockCoordinate(node, axis.get_ref<const std::string&>()[0] - 'x');
    }
  }

  void lockCoordinate(int node, int axis) { model_.lockedCoordinates[node * dimension_ + axis] = 1; }

  void lockFrame(const NodeFrame& frame) {
    for (int i = 0; i < 3; ++i) model_.lockedCoordinates[frame.firstCoordinate + i] = 1;
  }

  std::vector<NodeFrame> framesOf(const std::vector<int>& nodes) const {
    std::vector<NodeFrame> found;
    for (const NodeFrame& frame : frames_)
      if (std::find(nodes.begin(), nodes.end(), frame.node) != nodes.end()) found.push_back(frame);
    return found;
  }

  void addDrive(const Json& entry, const std::string& pointer) {
    const std::vector<int> nodes = nodesAt(entry, pointer);
    for (const int node : nodes) {
      const auto& locked = model_.lockedCoordinates;
      const auto first = locked.begin() + node * dimension_;
      if (std::find(first, first + dimension_, 1) != first + dimension_)
        throw InputError(pointer + "/at", nodeText(node) + " is both driven and locked.");
      if (!driven_.insert(node).second) throw InputError(pointer + "/at", nodeText(node) + " is driven twice.");
    }
    if (entry["type"] == "translation") {
      for (const NodeFrame& frame : framesOf(nodes)) lockFrame(frame);
      model_.drives.push_back(mechanics::makeTranslation(
          nodes, toVector(entry["direction"]).stableNormalized(), toSignal(entry["harmonics"])));
    } else {
      const Eigen::Vector3d axis = toVector(entry["axis"]);
      for (const NodeFrame& frame : framesOf(nodes))
        model_.drives.push_back(
            mechanics::makeFrameRotation(frame.firstCoordinate, frame.length, axis, toSignal(entry["harmonics"])));
      model_.drives.push_back(mechanics::makeRotation(
          nodes, toVector(entry["center"]), axis.stableNormalized(), toSignal(entry["harmonics"])));
    }
  }

  void addLoad(const Json& entry, const std::string& pointer) {
    if (entry["type"] == "gravity") {
      const Vector acceleration = toVector(entry["acceleration"]);
      model_.gravity = model_.gravity.size() == 0 ? acceleration : Vector(model_.gravity + acceleration);
    } else if (entry["type"] == "harmonic_force") {
      model_.forces.push_back({entry["name"], nodesAt(entry, pointer), toVector(entry["direction"]).stableNormalized(),
                               toSignal(entry["harmonics"])});
    }
  }

  std::string nodeText(int node) const {
    const PlacedGeometry& geometry = geometryOf(node);
    const auto local = std::find(geometry.nodes.begin(), geometry.nodes.end(), node) - geometry.nodes.begin();
    return "Node " + std::to_string(local) + " of the geometry " + quote(geometry.name);
  }

  /// A free node without mass and without elements would leave its motion undetermined.
  void checkEveryNodeIsHeld() const {
    std::vector<char> held(static_cast<std::size_t>(model_.coordinateCount()), 0);
    for (const auto& energy : model_.energies)
      for (int e = 0; e < energy->elementCount(); ++e)
        for (const int coordinate : energy->elementCoordinates(e)) held[static_cast<std::size_t>(coordinate)] = 1;
    const mechanics::SparseMatrix mass = model_.massMatrix();
    for (const int coordinate : model_.dofs.freeCoordinates)
      if (!held[static_cast<std::size_t>(coordinate)] && !(mass.coeff(coordinate, coordinate) > 0)) {
        if (coordinate >= model_.nodeCount() * dimension_) continue;  // elements give their own coordinates mass
        const int node = coordinate / dimension_;
        const auto index = static_cast<std::size_t>(&geometryOf(node) - geometries_.data());
        throw InputError(childPointer("/geometry", index),
                         nodeText(node) + " can move but has neither mass nor element nor spring.");
      }
  }

  const Json& scene_;
  const std::filesystem::path directory_;
  int dimension_;
  std::vector<PlacedGeometry> geometries_;
  mechanics::Model model_;
  std::set<int> driven_;
  std::vector<NodeFrame> frames_;
  std::vector<mechanics::ShellPanel> panels_;
};

mechanics::Model buildWithoutSceneParameters(const Scene& scene) {
  const Json& parts = scene.normalized();
  if (parts["geometry"].empty() && !parts["interlocking_cells"].empty()) return cellPicture(scene);
  return Builder(scene).build();
}

}  // namespace

std::shared_ptr<const mechanics::Model> buildModel(const Scene& scene) {
  try {
    auto model = std::make_shared<mechanics::Model>(buildWithoutSceneParameters(scene));
    addSceneParameters(scene, *model, buildWithoutSceneParameters);
    return model;
  } catch (const InputError& error) {
    throw error.inside(scene.name());
  }
}

geometry::SurfaceMesh surfaceAt(const mechanics::Model& model, const Vector& positions) {
  geometry::SurfaceMesh mesh;
  mesh.points.setZero(3, model.nodeCount());
  mesh.points.topRows(model.dimension) =
      positions.head(model.dimension * model.nodeCount()).reshaped(model.dimension, model.nodeCount());
  for (const mechanics::DisplayPart& part : model.parts)
    mesh.triangles.insert(mesh.triangles.end(), part.triangles.begin(), part.triangles.end());
  return mesh;
}

}  // namespace pliant::scene
