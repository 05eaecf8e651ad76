#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "core/geometry/mesh_generators.hpp"
#include "core/harmonic/harmonic_balance_problem.hpp"
#include "core/mechanics/prescribed_motion.hpp"

namespace pliant::render {

/// A fork-shaped shell with two point masses, whose base is driven and whose prongs wave: a motion made up by formula,
/// so that pictures of it do not depend on a solver.
struct SwingingFork {
  std::shared_ptr<const mechanics::Model> model;
  std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem;
  int leftTip = 0;
  int rightTip = 0;

  SwingingFork() {
    const geometry::SurfaceMesh mesh = geometry::makeFork({.handleLength = 0.065,
                                                           .prongLength = 0.07,
                                                           .width = 0.01,
                                                           .spacing = 0.02,
                                                           .handleCells = 13,
                                                           .prongCells = 14,
                                                           .widthCells = 2});
    const auto middle = [&](const char* group) { return mesh.groups.at(group)[mesh.groups.at(group).size() / 2]; };
    leftTip = middle("left_tip");
    rightTip = middle("right_tip");
    mechanics::Model made;
    made.dimension = 3;
    made.restPositions = mesh.points.reshaped();
    made.gravity = mechanics::Vector::Zero(3);
    made.lockedCoordinates.assign(made.coordinateCount(), 0);
    made.elementMass = std::make_shared<mechanics::SparseMatrix>(made.coordinateCount(), made.coordinateCount());
    made.pointMasses = {{"left", {leftTip}, 0.002, 0, 0.02}, {"right", {rightTip}, 0.01, 0, 0.02}};
    made.probes = {{"left tip", leftTip}, {"right tip", rightTip}};
    mechanics::DisplayPart& part = made.parts.emplace_back();
    part.name = "fork";
    part.nodeCount = static_cast<int>(mesh.points.cols());
    part.triangles = mesh.triangles;
    made.drives = {mechanics::makeTranslation(
        mesh.groups.at("base"), mechanics::Vector::Unit(3, 2), {.terms = {{1, 0.004, 0.0}}})};
    made.finish();
    model = std::make_shared<const mechanics::Model>(std::move(made));
    problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(model, math::HarmonicBasis(3, 32));
  }

  /// Coefficients of a motion in which the prongs swing by about `swing` [m].
  mechanics::Vector motion(double swing) const {
    mechanics::Vector z = problem->restCoefficients();
    const int size = problem->basis().size();
    for (int i = 0; i < model->dofs.freeCount(); ++i) {
      const int node = model->dofs.freeCoordinates[i] / 3, axis = model->dofs.freeCoordinates[i] % 3;
      const double along = model->restPositions[3 * node] / 0.145, across = model->restPositions[3 * node + 1] / 0.01;
      const double bend = swing * along * along;
      auto coefficients = z.segment(i * size, size);
      if (axis == 2) {
        coefficients[1] += bend * (0.9 + 0.35 * across);
        coefficients[2] += 0.004 * (1 - along) - 0.4 * bend;
        coefficients[5] += 0.12 * bend * across;
      } else if (axis == 0) {
        coefficients[0] -= 6 * bend * bend;
        coefficients[3] += 3 * bend * bend;
      }
    }
    return z;
  }
};

}  // namespace pliant::render
