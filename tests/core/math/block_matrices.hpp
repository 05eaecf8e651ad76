#pragma once

#include <Eigen/SparseCore>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "core/math/harmonic_basis.hpp"

namespace pliant::tests {

/// A matrix with the structure and the values of a harmonic-balance Jacobian of a shell: a triangulated grid of
/// `rows` x `columns` nodes with 3 coordinates each, coupled by triangles and by hinges of two triangles, every
/// coordinate with 2H+1 coefficients. `bordered` adds a dense last row and column, as in a continuation step.
struct HarmonicMatrixSpec {
  int rows = 2;
  int columns = 2;
  int harmonics = 1;
  bool bordered = false;
  unsigned seed = 1;
  double omega = 1;  ///< inertia: the matrix is indefinite
};

class HarmonicMatrixBuilder {
 public:
  explicit HarmonicMatrixBuilder(const HarmonicMatrixSpec& spec)
      : spec_(spec), basis_(spec.harmonics, 4 * spec.harmonics + 4), generator_(spec.seed), width_(3 * basis_.size()) {}

  Eigen::SparseMatrix<double> build() {
    for (int i = 0; i < spec_.rows; ++i) {
      for (int j = 0; j < spec_.columns; ++j) {
        addStiffness({{i, j}}, 0.001);
        addStiffness({{i, j}, {i + 1, j}, {i + 1, j + 1}}, 1);
        addStiffness({{i, j}, {i + 1, j + 1}, {i, j + 1}}, 1);
        addStiffness({{i, j}, {i + 1, j + 1}, {i + 1, j}, {i, j + 1}}, 0.05);
        addStiffness({{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j - 1}}, 0.05);
        addStiffness({{i, j}, {i, j + 1}, {i + 1, j + 1}, {i - 1, j}}, 0.05);
        addInertiaAndDamping(i * spec_.columns + j);
      }
    }
    return assemble();
  }

 private:
  using Nodes = std::vector<std::pair<int, int>>;

  Eigen::MatrixXd& block(int row, int column) {
    return blocks_.try_emplace({column, row}, Eigen::MatrixXd::Zero(width_, width_)).first->second;
  }

  /// Adds K(τ) = k g(τ) g(τ)ᵀ with a random periodic g, if all nodes are on the grid.
  void addStiffness(const Nodes& places, double stiffness) {
    std::vector<int> nodes;
    for (const auto& [i, j] : places) {
      if (i < 0 || j < 0 || i >= spec_.rows || j >= spec_.columns) return;
      nodes.push_back(i * spec_.columns + j);
    }
    const int coordinates = 3 * static_cast<int>(nodes.size());
    for (int mode = 0; mode < 3; ++mode) {
      Eigen::MatrixXd coefficients(basis_.size(), coordinates);
      for (Eigen::Index k = 0; k < coefficients.rows(); ++k) {
        const double size = k == 0 ? 1 : 0.3 / static_cast<double>(k);
        for (int c = 0; c < coordinates; ++c) coefficients(k, c) = size * normal_(generator_);
      }
      const Eigen::MatrixXd g = basis_.synthesis() * coefficients;
      for (int a = 0; a < coordinates; ++a) {
        for (int b = 0; b < coordinates; ++b) {
          const Eigen::VectorXd samples = stiffness * g.col(a).cwiseProduct(g.col(b));
          block(nodes[a / 3], nodes[b / 3])
              .block(a % 3 * basis_.size(), b % 3 * basis_.size(), basis_.size(), basis_.size()) +=
              basis_.analysis() * samples.asDiagonal() * basis_.synthesis();
        }
      }
    }
  }

  void addInertiaAndDamping(int node) {
    Eigen::MatrixXd& diagonal = block(node, node);
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 1; k <= spec_.harmonics; ++k) {
        const int sine = axis * basis_.size() + 2 * k - 1;
        const double speed = k * spec_.omega;
        diagonal(sine, sine) -= 0.5 * speed * speed;
        diagonal(sine + 1, sine + 1) -= 0.5 * speed * speed;
        diagonal(sine, sine + 1) -= 0.02 * speed;
        diagonal(sine + 1, sine) += 0.02 * speed;
      }
    }
  }

  Eigen::SparseMatrix<double> assemble() {
    const int unknowns = spec_.rows * spec_.columns * width_;
    const int size = unknowns + (spec_.bordered ? 1 : 0);
    Eigen::VectorXi heights = Eigen::VectorXi::Constant(size, spec_.bordered ? size : 0);
    if (spec_.bordered) heights.head(unknowns).setOnes();
    for (const auto& entry : blocks_) heights.segment(entry.first.first * width_, width_).array() += width_;
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.reserve(heights);
    for (const auto& [place, values] : blocks_) {  // by column, then by row
      for (int j = 0; j < width_; ++j) {
        for (int i = 0; i < width_; ++i)
          matrix.insert(place.second * width_ + i, place.first * width_ + j) = values(i, j);
      }
    }
    if (spec_.bordered) {
      for (int k = 0; k < unknowns; ++k) {
        matrix.insert(unknowns, k) = normal_(generator_);
        matrix.insert(k, unknowns) = 10 * normal_(generator_);
      }
      matrix.insert(unknowns, unknowns) = 0.3;
    }
    matrix.makeCompressed();
    return matrix;
  }

  HarmonicMatrixSpec spec_;
  math::HarmonicBasis basis_;
  std::mt19937 generator_;
  std::normal_distribution<double> normal_;
  int width_;                                              ///< unknowns of a node
  std::map<std::pair<int, int>, Eigen::MatrixXd> blocks_;  ///< by column node and row node
};

inline Eigen::SparseMatrix<double> harmonicMatrix(const HarmonicMatrixSpec& spec) {
  return HarmonicMatrixBuilder(spec).build();
}

/// The same pattern with values uniform in [-1, 1], plus `diagonal` on the diagonal.
inline Eigen::SparseMatrix<double> randomValues(Eigen::SparseMatrix<double> matrix, unsigned seed,
                                                double diagonal = 0) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (Eigen::Index j = 0; j < matrix.outerSize(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it) {
      it.valueRef() = uniform(generator) + (it.row() == j ? diagonal : 0);
    }
  }
  return matrix;
}

inline Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

inline double relativeDifference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

}  // namespace pliant::tests
