#include "core/scene/element_builders.hpp"

#include <algorithm>
#include <set>

#include "core/base/error.hpp"
#include "core/mechanics/solid.hpp"
#include "core/scene/cloth_builder.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/mechanism_builders.hpp"
#include "core/scene/rod_elements.hpp"

namespace pliant::scene {
namespace {

using base::InputError;

mechanics::Triangles trianglesOf(const ElementContext& context) {
  if (context.geometry.mesh.triangles.empty())
    throw InputError(
        context.pointer + "/geometry", "The geometry " + quote(context.geometry.name) + " has no triangles.");
  return context.geometry.global(context.geometry.mesh.triangles);
}

mechanics::ShellMaterial shellMaterial(const ElementContext& context) {
  const Json& material = *context.material;
  return {material["young_modulus"], material["poisson_ratio"], material["density"], context.entry["thickness"]};
}

RestShape restShape(const ElementContext& context) {
  if (context.entry.contains("pattern") && context.model.dimension != 3)
    throw InputError(context.pointer + "/pattern", "A pattern needs a scene of dimension 3.");
  RestShape rest = restShapeOf(context.entry, context.pointer, context.geometry, context.directory);
  const int dimension = context.model.dimension;
  if (dimension == 2)
    rest.positions = rest.positions.reshaped(3, rest.positions.size() / 3).topRows(2).reshaped().eval();
  return rest;
}

/// The factors of an entry, which live as long as this.
struct Factors {
  std::vector<double> stiffness, thickness;

  explicit Factors(const ElementContext& context, std::size_t elementCount)
      : stiffness(read(context, "stiffness_factors", elementCount)),
        thickness(read(context, "thickness_factors", elementCount)) {}

  operator mechanics::TriangleFactors() const { return {stiffness, thickness}; }

 private:
  static std::vector<double> read(const ElementContext& context, const char* key, std::size_t elementCount) {
    if (!context.entry.contains(key)) return {};
    auto factors = context.entry[key].get<std::vector<double>>();
    if (!factors.empty() && factors.size() != elementCount)
      throw InputError(context.pointer + "/" + key, "Expected a factor for each of the " +
                                                        std::to_string(elementCount) + " elements, found " +
                                                        std::to_string(factors.size()) + ".");
    return factors;
  }
};

void addMembrane(const ElementContext& context) {
  mechanics::Model& model = context.model;
  const mechanics::Triangles triangles = trianglesOf(context);
  const mechanics::ShellMaterial material = shellMaterial(context);
  const Factors factors(context, triangles.size());
  const RestShape rest = restShape(context);
  model.energies.push_back(
      mechanics::makeMembrane(model.dimension, rest.positions, triangles, material, factors, rest.triangles));
  mechanics::addShellMass(
      model.dimension, rest.positions, triangles, material, context.massMatrix, context.mass, factors, rest.triangles);
}

void addBending(const ElementContext& context) {
  const mechanics::Triangles triangles = trianglesOf(context);
  const mechanics::ShellMaterial material = shellMaterial(context);
  const Factors factors(context, triangles.size());
  RestShape rest = restShape(context);
  auto bending = mechanics::makeHingeBending(rest.positions, triangles, material, factors, rest.triangles);
  if (bending) context.model.energies.push_back(std::move(bending));
  context.panels.push_back({triangles, std::move(rest.positions), std::move(rest.triangles), material,
                            factors.stiffness, factors.thickness});
}

void addShell(const ElementContext& context) {
  addMembrane(context);
  addBending(context);
}

/// The geometry's tetrahedra, or those all of whose nodes are in the entry's group.
mechanics::Tetrahedra tetrahedraOf(const ElementContext& context) {
  const PlacedGeometry& geometry = context.geometry;
  mechanics::Tetrahedra tetrahedra = geometry.tetrahedra;
  if (context.entry.contains("group")) {
    const std::string name = context.entry["group"];
    const auto group = geometry.mesh.groups.find(name);
    if (group == geometry.mesh.groups.end())
      throw InputError(
          context.pointer + "/group", "The geometry " + quote(geometry.name) + " has no group " + quote(name) + ".");
    const std::set<int> nodes(group->second.begin(), group->second.end());
    std::erase_if(tetrahedra, [&](const auto& tetrahedron) {
      return !std::all_of(tetrahedron.begin(), tetrahedron.end(), [&](int node) { return nodes.contains(node); });
    });
  }
  if (tetrahedra.empty())
    throw InputError(
        context.pointer + "/geometry", "There are no tetrahedra here in the geometry " + quote(geometry.name) + ".");
  return geometry.global(tetrahedra);
}

void addSolid(const ElementContext& context) {
  mechanics::Model& model = context.model;
  const mechanics::Tetrahedra tetrahedra = tetrahedraOf(context);
  const Json& entry = *context.material;
  const mechanics::SolidMaterial material{entry["young_modulus"], entry["poisson_ratio"], entry["density"]};
  model.energies.push_back(
      mechanics::makeSolid(model.restPositions, tetrahedra, material, Factors(context, tetrahedra.size()).stiffness));
  mechanics::addSolidMass(model.restPositions, tetrahedra, material, context.massMatrix, context.mass);
}

}  // namespace

const std::map<std::string, ElementBuilder>& elementBuilders() {
  static const std::map<std::string, ElementBuilder> builders{
      {"shell", addShell}, {"membrane", addMembrane},      {"bending", addBending}, {"solid", addSolid},
      {"link", addLink},   {"rigid_angle", addRigidAngle}, {"rod", addRods},        {"flat_rod", addRods}};
  return builders;
}

}  // namespace pliant::scene
