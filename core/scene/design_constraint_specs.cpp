#include "core/scene/design_constraint_specs.hpp"

#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

base::ParameterSpec designConstraints() {
  ParameterSpec mass =
      object("total_mass", "The mass of the whole model, driven and locked parts included. One bound is needed.",
             {optional(positive(number("at_most", "", "Largest mass.", dimensions::mass))),
              optional(positive(number("at_least", "", "Smallest mass.", dimensions::mass))),
              optional(positive(number("equal", "", "The mass, exactly.", dimensions::mass)))});
  const ParameterSpec geometries = optional(list("geometries", "Only those of these geometries count; all if left out.",
                                                 reference("", "A geometry.", "geometry"), 1, 1000));
  ParameterSpec stress = object(
      "stress",
      "The largest von Mises stress of any membrane, shell or solid at any time: Cauchy stress of the elements' own "
      "law, that of a shell at both surfaces with the bending moments of its hinges, 6 M / h². Rods have none here.",
      {positive(number("at_most", "σ", "Largest stress.", dimensions::pressure)), geometries,
       withDefault(
           positive(number("sharpness", "",
                           "β σ of the smooth maximum ln(Σ exp(β stress)) / β over elements, surfaces and instants, "
                           "which is held: it exceeds the largest stress by ln(their number) / β at most.",
                           dimensions::none)),
           300)});
  ParameterSpec strain =
      object("strain",
             "The largest strain of any triangle, in its plane, or tetrahedron at any time: its largest principal "
             "stretch minus 1. Without \"surfaces\", bending does not strain the triangles of a shell.",
             {positive(number("at_most", "ε", "Largest strain.", dimensions::none)), geometries,
              withDefault(boolean("surfaces",
                                  "Whether it is the strain of a shell's surfaces that counts, which bending stretches "
                                  "(and of membranes and solids as before)."),
                          false),
              withDefault(
                  positive(number("sharpness", "",
                                  "β ε of the smooth maximum ln(Σ exp(β strain)) / β over elements and instants, which "
                                  "is held: it exceeds the largest strain by ln(their number) / β at most.",
                                  dimensions::none)),
                  300)});
  ParameterSpec clearance = object(
      "clearance", "The smallest distance of any of some nodes from something, at any time.",
      {list("probes", "Which nodes.", reference("", "A probe.", "probes"), 1, 1000),
       withDefault(number("at_least", "", "Smallest distance.", dimensions::length), 0),
       optional(object("plane", "From a plane; distances count along its normal.",
                       {vector("point", "Any point of it.", dimensions::length),
                        vector("normal", "Where nodes may be; only its direction counts.", dimensions::none)})),
       optional(object("sphere", "From a sphere, outside (a circle in 2 dimensions).",
                       {vector("centre", "Its centre.", dimensions::length),
                        notNegative(number("radius", "", "Its radius.", dimensions::length))})),
       optional(object("node", "From another node.", {reference("probe", "Which one.", "probes")})),
       withDefault(
           positive(number("resolution", "",
                           "1/β of the smooth minimum -ln(Σ exp(-β distance)) / β over nodes and instants, which "
                           "is held: it is below the smallest distance by ln(their number) / β at most.",
                           dimensions::length)),
           1e-4)});
  clearance.exactlyOne = {"plane", "sphere", "node"};
  return optional(list("constraints", "What a design must keep to; it is then found by Ipopt.",
                       variant("constraint", "One condition.",
                               {std::move(mass), std::move(strain), std::move(stress), std::move(clearance)}),
                       1, 100));
}

}  // namespace pliant::scene
