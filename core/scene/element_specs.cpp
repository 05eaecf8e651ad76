#include "core/scene/element_specs.hpp"

#include "core/scene/cloth_specs.hpp"
#include "core/scene/rod_elements.hpp"
#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec factors(std::string key, std::string description) {
  return withDefault(list(std::move(key), std::move(description),
                          positive(number("", "", "A factor.", dimensions::none)), 0, 6 * largestMesh),
                     Json::array());
}

ParameterSpec joints(int most) {
  return list("joints", "Indices of the nodes, counted from 0 in the geometry.", nodeIndex(), most == 3 ? 3 : 2, most);
}

ParameterSpec linkStiffness() {
  return withDefault(positive(number("stiffness", "K", "Force per relative change of length of the stiff penalty.",
                                     dimensions::force)),
                     1e7);
}

}  // namespace

base::ParameterSpec nodeIndex() { return integer("", "", "A node.", 0, 1'000'000'000); }

base::ParameterSpec materialSpecs() {
  return variant("material", "What elements are made of.",
                 {object("isotropic", "St. Venant-Kirchhoff, the same in every direction.",
                         {name(), positive(number("density", "ρ", "Mass per volume.", dimensions::density)),
                          positive(number("young_modulus", "E", "Young's modulus.", dimensions::pressure)),
                          within(number("poisson_ratio", "ν", "Poisson's ratio.", dimensions::none), -0.99, 0.5)})});
}

base::ParameterSpec elementSpecs() {
  const auto geometry = optional(reference("geometry", "Whose; may be left out where there is one.", "geometry"));
  const auto material = optional(reference("material", "May be left out where there is one.", "materials"));
  const auto stiffnessFactors =
      factors("stiffness_factors", "Multiply Young's modulus, one an element; all 1 if empty.");
  const auto sheet = [&](std::string type, std::string description) {
    return object(
        std::move(type), std::move(description),
        {name(), geometry, material, positive(number("thickness", "h", "Thickness.", dimensions::length)),
         stiffnessFactors, factors("thickness_factors", "Multiply the thickness, one a triangle; all 1 if empty."),
         patternSpec()});
  };
  ParameterSpec spec = variant(
      "element",
      "Turns the triangles, segments or tetrahedra of a geometry into an elastic body with mass, or joins its nodes.",
      {sheet("shell", "Triangles: a membrane that also resists bending (discrete shells), in 3 dimensions."),
       sheet("membrane",
             "Triangles that resist stretch and shear alone (constant strain, plane stress), in 2 or 3 dimensions."),
       sheet("bending", "Triangles that resist bending alone and have no mass, in 3 dimensions."),
       object("solid", "Tetrahedra of constant strain, in 3 dimensions.",
              {name(), geometry, material,
               optional(text("group", "Only the tetrahedra all of whose nodes are in this group of the geometry.")),
               stiffnessFactors}),
       object("link",
              "A rigid bar through two or more joints. Its local coordinates start in the first joint, along the "
              "line to the second.",
              {name(), geometry, joints(1000),
               withDefault(notNegative(number(
                               "mass", "m", "Mass, uniform along the line through the joints.", dimensions::mass)),
                           0),
               linkStiffness()}),
       object("rigid_angle", "Keeps the angle at the second of three joints, as if they were one bar.",
              {name(), geometry, joints(3), linkStiffness()})});
  for (ParameterSpec& rod : rodSpecs(geometry, material)) spec.items.push_back(std::move(rod));
  return spec;
}

}  // namespace pliant::scene
