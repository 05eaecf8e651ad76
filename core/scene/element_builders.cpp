#include "core/scene/element_builders.hpp"

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"

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

void addMembrane(const ElementContext& context) {
  mechanics::Model& model = context.model;
  const mechanics::Triangles triangles = trianglesOf(context);
  const mechanics::ShellMaterial material = shellMaterial(context);
  model.energies.push_back(mechanics::makeMembrane(model.dimension, model.restPositions, triangles, material));
  mechanics::addShellMass(model.dimension, model.restPositions, triangles, material, context.massMatrix, context.mass);
}

void addBending(const ElementContext& context) {
  auto bending = mechanics::makeHingeBending(context.model.restPositions, trianglesOf(context), shellMaterial(context));
  if (bending) context.model.energies.push_back(std::move(bending));
}

void addShell(const ElementContext& context) {
  addMembrane(context);
  addBending(context);
}

}  // namespace

const std::map<std::string, ElementBuilder>& elementBuilders() {
  static const std::map<std::string, ElementBuilder> builders{
      {"shell", addShell}, {"membrane", addMembrane}, {"bending", addBending}};
  return builders;
}

}  // namespace pliant::scene
