#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <vector>

#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/contact_barrier.hpp"

namespace pliant::mechanics {

/// A net of springs along the edges of a mesh, in implicit Euler steps by Newton's method with a line search whose
/// steps the barrier cuts: just enough to push a sheet around.
class ClothExample {
 public:
  static constexpr double mass = 1e-3;      ///< of a node [kg]
  static constexpr double stiffness = 20;   ///< of a spring [N/m]
  static constexpr double timeStep = 0.01;  ///< [s]

  /// The nodes of `sheet` come first in x, then those of bodies.
  ClothExample(const geometry::SurfaceMesh& sheet, Eigen::Matrix3Xd start, ContactBarrier barrier)
      : x(std::move(start)), contact(std::move(barrier)), count_(static_cast<int>(sheet.points.cols())) {
    velocity = Eigen::Matrix3Xd::Zero(3, count_);
    for (const auto& edge : geometry::meshEdges(sheet.triangles))
      springs_.push_back({edge.nodes, (sheet.points.col(edge.nodes[1]) - sheet.points.col(edge.nodes[0])).norm()});
  }

  Eigen::Matrix3Xd x;         ///< [m]
  Eigen::Matrix3Xd velocity;  ///< of the sheet [m/s]
  ContactBarrier contact;
  double newtonDecrement = 0;  ///< of the last iteration of the last step [J]

  /// One step under the acceleration of gravity; bodies move by `motion` (their columns alone are used), as far as they
  /// get at a time. Calls `check` after each change of x.
  template <class Check>
  void step(const Eigen::Vector3d& gravity, Eigen::Matrix3Xd motion, const Check& check) {
    const Eigen::Matrix3Xd before = x.leftCols(count_);
    target_ = before + timeStep * velocity;
    target_.colwise() += timeStep * timeStep * gravity;
    motion.leftCols(count_).setZero();
    for (int part = 0; part < 50; ++part) {
      const double share = motion.isZero(0) ? 1 : contact.largestStep(x, motion);
      x += share * motion;
      motion *= 1 - share;
      check();
      minimise(check);
      if (share == 1) break;
    }
    velocity = (x.leftCols(count_) - before) / timeStep;
  }

 private:
  struct Spring {
    std::array<int, 2> nodes;
    double rest;
  };

  double value(const Eigen::Matrix3Xd& at) {
    double energy = 0.5 * mass / (timeStep * timeStep) * (at.leftCols(count_) - target_).squaredNorm();
    for (const auto& [nodes, rest] : springs_)
      energy += 0.5 * stiffness * std::pow((at.col(nodes[1]) - at.col(nodes[0])).norm() - rest, 2);
    contact.update(at);
    return energy + contact.value();
  }

  /// Gradient and a positive definite approximation of the Hessian.
  void linearise(Eigen::Matrix3Xd& gradient, Eigen::SparseMatrix<double>& hessian) {
    value(x);
    gradient = mass / (timeStep * timeStep) * (x.leftCols(count_) - target_);
    std::vector<ContactBlock> blocks;
    contact.addHessian(blocks);
    contact.addGradient(gradient);
    for (const auto& [nodes, rest] : springs_) {
      const Eigen::Vector3d r = x.col(nodes[1]) - x.col(nodes[0]);
      const double length = r.norm(), stretch = length - rest;
      const Eigen::Matrix3d along = r * r.transpose() / (length * length);
      const Eigen::Matrix3d entry =
          stiffness * (along + std::max(0.0, stretch / length) * (Eigen::Matrix3d::Identity() - along));
      gradient.col(nodes[1]) += stiffness * stretch / length * r;
      gradient.col(nodes[0]) -= stiffness * stretch / length * r;
      for (const int node : nodes) blocks.push_back({node, node, entry});
      blocks.push_back({std::max(nodes[0], nodes[1]), std::min(nodes[0], nodes[1]), -entry});
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < 3 * count_; ++i) entries.emplace_back(i, i, mass / (timeStep * timeStep));
    for (const ContactBlock& block : blocks)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) entries.emplace_back(3 * block.row + i, 3 * block.column + j, block.entry(i, j));
    hessian.resize(3 * count_, 3 * count_);
    hessian.setFromTriplets(entries.begin(), entries.end());
  }

  template <class Check>
  void minimise(const Check& check) {
    Eigen::Matrix3Xd gradient, dx = Eigen::Matrix3Xd::Zero(3, x.cols());
    Eigen::SparseMatrix<double> hessian;
    for (int iteration = 0; iteration < 60; ++iteration) {
      linearise(gradient, hessian);
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors(hessian);
      const Eigen::VectorXd change = factors.solve(-gradient.reshaped());
      dx.leftCols(count_) = change.reshaped(3, count_);
      newtonDecrement = -change.dot(gradient.reshaped());
      if (dx.colwise().norm().maxCoeff() < 1e-6) return;
      const double from = value(x);
      double share = contact.largestStep(x, dx);
      while (value(x + share * dx) > from - 1e-4 * share * newtonDecrement && share > 1e-12) share *= 0.5;
      x += share * dx;
      check();
    }
  }

  int count_;
  std::vector<Spring> springs_;
  Eigen::Matrix3Xd target_;
};

}  // namespace pliant::mechanics
