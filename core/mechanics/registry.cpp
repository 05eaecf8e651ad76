#include "core/mechanics/registry.hpp"

#include <numeric>

#include "core/geometry/mesh_generators.hpp"
#include "core/geometry/tet_mesh.hpp"
#include "core/mechanics/admissible_strain_set.hpp"
#include "core/mechanics/driven_examples.hpp"
#include "core/mechanics/family_parameter.hpp"
#include "core/mechanics/mechanism.hpp"
#include "core/mechanics/point_mass_parameter.hpp"
#include "core/mechanics/prescribed_motion.hpp"
#include "core/mechanics/rod.hpp"
#include "core/mechanics/shell.hpp"
#include "core/mechanics/solid.hpp"
#include "core/mechanics/spring.hpp"
#include "core/mechanics/stiffness_factor.hpp"
#include "core/mechanics/strain_limits.hpp"

namespace pliant::mechanics {

namespace {

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

Vector randomVector(std::mt19937& random, int size, double scale) {
  return Vector::NullaryExpr(size, [&] { return uniform(random, -scale, scale); });
}

ShellMaterial randomMaterial(std::mt19937& random) {
  return {.youngModulus = uniform(random, 1e5, 1e7),
          .poissonRatio = uniform(random, -0.3, 0.45),
          .density = uniform(random, 500, 2000),
          .thickness = uniform(random, 1e-3, 1e-2)};
}

SpringLaw randomLaw(std::mt19937& random) {
  return {{uniform(random, 1, 10), uniform(random, -3, 3), uniform(random, 0.5, 5)}};
}

/// A patch of 2 x 2 cells with its points moved by up to a fifth of a cell, bent out of its plane in 3 dimensions.
Model randomPatch(std::mt19937& random, int dimension, Triangles& triangles) {
  const geometry::SurfaceMesh mesh = geometry::makeGrid(0.2, 0.2, 2, 2);
  triangles = mesh.triangles;
  Model model;
  model.dimension = dimension;
  model.restPositions = mesh.points.topRows(dimension).reshaped();
  model.restPositions += randomVector(random, model.coordinateCount(), 0.02);
  return model;
}

Model membraneExample(std::mt19937& random, int dimension) {
  Triangles triangles;
  Model model = randomPatch(random, dimension, triangles);
  model.energies.push_back(makeMembrane(dimension, model.restPositions, triangles, randomMaterial(random)));
  model.finish();
  return model;
}

Model hingeExample(std::mt19937& random, int) {
  Triangles triangles;
  Model model = randomPatch(random, 3, triangles);
  model.energies.push_back(makeHingeBending(model.restPositions, triangles, randomMaterial(random)));
  model.finish();
  return model;
}

/// An octahedron whose corners are about `radius` from a middle near 0.
std::shared_ptr<const AdmissibleStrainSet> randomStrainSet(std::mt19937& random, double radius) {
  const Eigen::Vector3d middle = randomVector(random, 3, 0.1 * radius);
  geometry::SurfaceMesh boundary;
  boundary.points.resize(3, 6);
  for (int i = 0; i < 6; ++i)
    boundary.points.col(i) =
        middle + uniform(random, 0.8, 1.2) * radius * (i % 2 ? -1 : 1) * Eigen::Vector3d::Unit(i / 2);
  boundary.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return std::make_shared<const AdmissibleStrainSet>(std::move(boundary), middle);
}

/// A patch of which some triangles have limits: of all sizes that occur for a penalty, wide ones for a barrier.
Model strainLimitExample(std::mt19937& random, StrainLimitFunction::Kind function, bool ofCurvature) {
  Triangles triangles;
  Model model = randomPatch(random, 3, triangles);
  const bool isBarrier = function == StrainLimitFunction::Kind::barrier;
  const double radius = ofCurvature ? (isBarrier ? 120 : 9) : (isBarrier ? 3 : 0.1);
  std::vector<LimitedTriangle> limited;
  for (const std::array<int, 3>& nodes : triangles) {
    LimitedTriangle& triangle = limited.emplace_back();
    triangle.nodes = nodes;
    for (int i = 0; i < 3; ++i) triangle.rest.col(i) = model.restPositions.segment<2>(3 * nodes[i]);
    if (limited.size() % 4 != 0) (ofCurvature ? triangle.bending : triangle.stretch) = randomStrainSet(random, radius);
  }
  const StrainLimitFunction limit{function, uniform(random, 0.5, 2)};
  model.energies.push_back(ofCurvature ? makeCurvatureLimit(limited, limit) : makeStretchLimit(limited, limit));
  model.finish();
  return model;
}

Model solidExample(std::mt19937& random, int) {
  const geometry::TetMesh mesh =
      geometry::makeBlocks({{"", {0, 0, 0}, {0.2, 0.1, 0.1}}}, Eigen::Vector3d::Constant(0.1));
  Model model;
  model.restPositions = mesh.points.reshaped();
  model.restPositions += randomVector(random, model.coordinateCount(), 0.02);
  std::vector<double> factors(mesh.tetrahedra.size());
  for (double& factor : factors) factor = uniform(random, 0.5, 2);
  const SolidMaterial material{uniform(random, 1e5, 1e7), uniform(random, -0.3, 0.45), uniform(random, 500, 2000)};
  model.energies.push_back(makeSolid(model.restPositions, mesh.tetrahedra, material, factors));
  model.finish();
  return model;
}

/// A rod with a kink, a joint of three segments and a frame at one end, of sections so thick that all its energies are
/// of one size. Its twists are turned as far as its nodes are moved.
Model rodExample(std::mt19937& random, int) {
  Model model;
  model.dimension = 3;
  model.restPositions.resize(15);
  model.restPositions << 0, 0, 0, 2, 0, 0.5, 3, 2, 0, 3, 3, 2, 5, 2, -1;
  model.restPositions += randomVector(random, 15, 0.2);
  std::vector<RodSegment> segments;
  for (const std::array<int, 2> nodes : {std::array{0, 1}, {2, 1}, {2, 3}, {4, 2}}) {
    RodSegment segment;
    segment.nodes = nodes;
    segment.material = {.youngModulus = uniform(random, 1, 3), .shearModulus = uniform(random, 1, 2), .density = 1};
    segment.section = rectangularSection(uniform(random, 1, 2), uniform(random, 1, 2));
    segment.director = randomVector(random, 3, 1);
    segment.prestrain = randomVector(random, 3, 0.3);
    segments.push_back(segment);
  }
  const RodNetwork rods(model.restPositions, segments, {0}, model.coordinateCount());
  model.energies = rods.energies();
  model.addScalars(rods.scalarCount());
  model.finish();
  return model;
}

/// Nodes for springs, at places that are about 1 m apart.
Model randomNodes(std::mt19937& random, int dimension, int count) {
  Model model;
  model.dimension = dimension;
  model.restPositions = randomVector(random, count * dimension, 0.2);
  for (int node = 0; node < count; ++node) {
    const int metres = 1 + node / dimension;
    model.restPositions[node * dimension + node % dimension] += metres;
  }
  return model;
}

Model springExample(std::mt19937& random, int dimension) {
  Model model = randomNodes(random, dimension, 3);
  model.energies.push_back(makeSpring(dimension, 0, 1, uniform(random, 0.5, 1), randomLaw(random)));
  model.energies.push_back(makeSpring(dimension, 2, 1, 0, randomLaw(random)));
  model.finish();
  return model;
}

Model anchoredSpringExample(std::mt19937& random, int dimension) {
  Model model = randomNodes(random, dimension, 1);
  model.energies.push_back(makeAnchoredSpring(
      dimension, 0, randomVector(random, dimension, 0.2), uniform(random, 0.5, 1), randomLaw(random)));
  model.finish();
  return model;
}

Model groundedSpringExample(std::mt19937& random, int dimension) {
  Model model = randomNodes(random, dimension, 1);
  model.energies.push_back(makeGroundedSpring(
      dimension, 0, model.restPositions, randomVector(random, dimension, 1).normalized(), randomLaw(random)));
  model.finish();
  return model;
}

Model rigidBarExample(std::mt19937& random, int dimension, int joints) {
  Model model = randomNodes(random, dimension, joints);
  std::vector<int> nodes(static_cast<std::size_t>(joints));
  std::iota(nodes.begin(), nodes.end(), 0);
  model.energies = makeRigidBar(dimension, model.restPositions, nodes, uniform(random, 10, 100));
  model.finish();
  return model;
}

Model localSpringExample(std::mt19937& random, int dimension) {
  Model model = randomNodes(random, dimension, 4);
  const auto onLink = [&](int a, int b) {
    const double across = dimension == 2 ? uniform(random, -0.2, 0.2) : 0;
    return attachedToLink(dimension, model.restPositions, a, b, uniform(random, -0.1, 0.4), across);
  };
  const auto join = [&](const AttachmentPoint& from, const AttachmentPoint& to, double restLength) {
    model.energies.push_back(makeLocalSpring(dimension, from, to, restLength, randomLaw(random)));
  };
  join(onLink(0, 1), onLink(2, 3), uniform(random, 0.5, 1));
  join(onLink(0, 1), onLink(1, 2), 0);
  join(onLink(3, 1), attachedToNode(dimension, 0), uniform(random, 0.5, 1));
  model.finish();
  return model;
}

Model anchoredLocalSpringExample(std::mt19937& random, int dimension) {
  Model model = randomNodes(random, dimension, 2);
  const AttachmentPoint point = attachedToLink(dimension, model.restPositions, 0, 1, uniform(random, 0, 1), 0);
  const AttachmentPoint anchor = fixedPlace(randomVector(random, dimension, 0.2));
  model.energies.push_back(makeLocalSpring(dimension, point, anchor, uniform(random, 0.5, 1), randomLaw(random)));
  model.finish();
  return model;
}

Model torsionSpringExample(std::mt19937& random, int) {
  Model model = randomNodes(random, 2, 3);
  model.energies.push_back(makeTorsionSpring(model.restPositions, 0, 1, 2, uniform(random, 1, 10)));
  model.finish();
  return model;
}

Model servoExample(std::mt19937& random, int dimension) {
  Model model = randomNodes(random, dimension, dimension + 1);
  const double stiffness = uniform(random, 1, 10), lever = uniform(random, 0.5, 2);
  const int scalar = model.addScalars(1);
  model.energies.push_back(dimension == 2 ? makeServo(model.restPositions, 0, 1, 2, stiffness, scalar, lever)
                                          : makeAxisServo(model.restPositions, 0, 1, 2, 3, stiffness, scalar, lever));
  model.finish();
  return model;
}

Model pointMassExample(std::mt19937& random) {
  Model model = springExample(random, 3);
  model.gravity = randomVector(random, 3, 10);
  model.pointMasses.push_back({"tip", {0, 2}, uniform(random, 0.1, 1), 0.05, 2});
  model.parameters.push_back(makePointMassParameter(0, "tip"));
  model.finish();
  return model;
}

/// Springs, a mass, a load, a drive and the damping, all of which depend on one value.
Model familyExample(std::mt19937& random) {
  Model nodes = randomNodes(random, 3, 4);
  const SpringLaw law = randomLaw(random);
  const Vector direction = randomVector(random, 3, 1).normalized();
  const auto family = std::make_shared<const ModelFamily>([=](const std::vector<double>& values) {
    const double value = values.at(0);
    Model member = nodes;
    member.restPositions.tail(3) *= 1 + value;
    for (const int node : {0, 2, 3})
      member.energies.push_back(makeSpring(3, node, 1, 0.5 + 0.1 * value, {{law.coefficients[0] * std::exp(value)}}));
    member.pointMasses.push_back({"mass", {1}, 0.1 + value * value, 0, 10});
    member.gravity = direction;
    member.forces.push_back({"load", {2}, direction, {{{1, std::sin(value), 0.2}}}});
    member.drives.push_back(makeTranslation({0}, direction, {{{1, 0.1, value}}}));
    member.lockedCoordinates.assign(member.coordinateCount(), 0);
    member.lockedCoordinates.back() = 1;
    member.massDamping = value;
    member.stiffnessDamping = 0.1 * value;
    member.familyValues = values;
    member.finish();
    return member;
  });
  Model model = (*family)({uniform(random, 0.5, 1.5)});
  model.parameters.push_back(makeFamilyParameter(0, {"value", "/value", base::dimensions::none, 0.2, 2}, family));
  return model;
}

Model withFactors(Model model, std::mt19937& random) {
  StiffnessFactorOptions options{"factor", "/factors", {}, 0.1, 10};
  for (int e = 0; e < model.energies[0]->elementCount(); ++e) options.values.push_back(uniform(random, 0.5, 2));
  model.parameters = makeStiffnessFactors(model, 0, options);
  return model;
}
Model membraneFactorExample(std::mt19937& random) { return withFactors(membraneExample(random, 3), random); }
Model solidFactorExample(std::mt19937& random) { return withFactors(solidExample(random, 3), random); }

template <class Example>
EnergyKind kind(const std::string& name, int dimension, const Example& example) {
  return {name + " " + std::to_string(dimension) + "D",
          [example, dimension](std::mt19937& random) { return example(random, dimension); }};
}

}  // namespace

const std::vector<EnergyKind>& energyKinds() {
  static const std::vector<EnergyKind> kinds = [] {
    std::vector<EnergyKind> list;
    for (const int dimension : {1, 2, 3}) {
      if (dimension > 1) list.push_back(kind("membrane", dimension, membraneExample));
      list.push_back(kind("spring", dimension, springExample));
      list.push_back(kind("anchored_spring", dimension, anchoredSpringExample));
      list.push_back(kind("grounded_spring", dimension, groundedSpringExample));
      list.push_back(kind("local_spring", dimension, localSpringExample));
      list.push_back(kind("anchored_local_spring", dimension, anchoredLocalSpringExample));
      for (const int joints : {2, 3, 6})
        list.push_back(kind("rigid_bar of " + std::to_string(joints), dimension,
                            [joints](std::mt19937& random, int d) { return rigidBarExample(random, d, joints); }));
    }
    list.push_back(kind("torsion_spring", 2, torsionSpringExample));
    list.push_back(kind("servo", 2, servoExample));
    list.push_back(kind("servo", 3, servoExample));
    list.push_back(kind("hinge_bending", 3, hingeExample));
    for (const bool ofCurvature : {false, true})
      for (const auto function : {StrainLimitFunction::Kind::barrier, StrainLimitFunction::Kind::penalty})
        list.push_back(kind(std::string(ofCurvature ? "curvature" : "stretch") + "_limit by " +
                                (function == StrainLimitFunction::Kind::barrier ? "barrier" : "penalty"),
                            3, [function, ofCurvature](std::mt19937& random, int) {
                              return strainLimitExample(random, function, ofCurvature);
                            }));
    list.push_back(kind("rod", 3, rodExample));
    list.push_back(kind("solid", 3, solidExample));
    return list;
  }();
  return kinds;
}

const std::vector<ParameterKind>& parameterKinds() {
  static const std::vector<ParameterKind> kinds = {
      {"point_mass", pointMassExample, drivenPointMassExample},
      {"family", familyExample, drivenFamilyExample},
      {"stiffness_factor of membranes", membraneFactorExample, drivenStiffnessFactorExample},
      {"stiffness_factor of solids", solidFactorExample, drivenStiffnessFactorExample}};
  return kinds;
}

}  // namespace pliant::mechanics
