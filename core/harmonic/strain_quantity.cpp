#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/harmonic/design_constraint.hpp"
#include "core/harmonic/smooth_extreme.hpp"

namespace pliant::harmonic {

namespace {

constexpr int fewestStrainInstants = 128;

/// Edges from the first of D + 1 nodes: coordinates x D.
template <int D, class Element>
Eigen::Matrix<double, 3, D> edgesOf(int dimension, const double* x, const Element& element) {
  Eigen::Matrix<double, 3, D> edges = Eigen::Matrix<double, 3, D>::Zero();
  for (int k = 0; k < D; ++k)
    for (int axis = 0; axis < dimension; ++axis)
      edges(axis, k) =
          x[element[static_cast<std::size_t>(k) + 1] * dimension + axis] - x[element[0] * dimension + axis];
  return edges;
}

/// What turns edges into the deformation gradient: the inverse of the rest edges in a frame of the element.
template <int D>
Eigen::Matrix<double, D, D> inverseRest(const Eigen::Matrix<double, 3, D>& rest) {
  // Any frame will do: Cholesky's triangle of the metric is the edges in one of them.
  const Eigen::Matrix<double, D, D> metric = rest.transpose() * rest;
  const Eigen::Matrix<double, D, D> edges = metric.llt().matrixU();
  return edges.inverse();
}

/// The largest principal stretch minus 1, and its derivative by the edges.
template <int D>
double strainOf(const Eigen::Matrix<double, 3, D>& edges, const Eigen::Matrix<double, D, D>& inverse,
                Eigen::Matrix<double, 3, D>* gradient) {
  const Eigen::Matrix<double, 3, D> f = edges * inverse;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>> squares(f.transpose() * f);
  const double stretch = std::sqrt(std::max(0.0, squares.eigenvalues()[D - 1]));
  if (gradient) {
    const Eigen::Matrix<double, D, 1> direction = squares.eigenvectors().col(D - 1);
    *gradient = f * direction * (inverse * direction).transpose() / std::max(stretch, 1e-300);
  }
  return stretch - 1;
}

class LargestStrain final : public ConstraintQuantity {
 public:
  explicit LargestStrain(StrainGoal goal) : goal_(std::move(goal)) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    const Model& model = problem.model();
    const math::HarmonicBasis basis = instantsOf(problem, 1);
    const Matrix positions = positionsAt(problem, z, basis);
    const Eigen::ArrayXXd strains = strainsAt(model.dimension, model.restPositions, positions);
    const SmoothMaximum largest = smoothMaximum(strains, goal_.sharpness);
    ObjectiveValue result{largest.value, Matrix(), Vector::Zero(static_cast<Eigen::Index>(model.parameters.size()))};
    Matrix byPositions = Matrix::Zero(positions.rows(), positions.cols());
    addGradient<2>(model, positions, goal_.triangles, largest.weights, 0, byPositions);
    addGradient<3>(model, positions, goal_.tetrahedra, largest.weights,
                   static_cast<Eigen::Index>(goal_.triangles.size()), byPositions);
    result.byCoefficients = basis.synthesis().transpose() * byPositions.transpose();
    for (std::size_t i = 0; i < model.parameters.size(); ++i)
      result.byParameters[static_cast<Eigen::Index>(i)] = byRestShape(model, *model.parameters[i], positions);
    return result;
  }

  double exactValue(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    constexpr int times = 4;
    const Model& model = problem.model();
    return strainsAt(model.dimension, model.restPositions, positionsAt(problem, z, instantsOf(problem, times)))
        .maxCoeff();
  }

 private:
  static math::HarmonicBasis instantsOf(const HarmonicBalanceProblem& problem, int times) {
    const math::HarmonicBasis& basis = problem.basis();
    return {basis.harmonics(), times * std::max(fewestStrainInstants, basis.samples())};
  }

  /// Coordinates x instants.
  static Matrix positionsAt(const HarmonicBalanceProblem& problem, const Vector& z, const math::HarmonicBasis& basis) {
    const Matrix coefficients = problem.basis().analysis() * problem.trajectories(z);
    return (basis.synthesis() * coefficients).transpose();
  }

  /// Elements x instants.
  Eigen::ArrayXXd strainsAt(int dimension, const Vector& rest, const Matrix& positions) const {
    const auto triangles = static_cast<Eigen::Index>(goal_.triangles.size());
    const auto tetrahedra = static_cast<Eigen::Index>(goal_.tetrahedra.size());
    Eigen::ArrayXXd strains(triangles + tetrahedra, positions.cols());
    fillStrains<2>(dimension, rest, positions, goal_.triangles, 0, strains);
    fillStrains<3>(dimension, rest, positions, goal_.tetrahedra, triangles, strains);
    return strains;
  }

  template <int D, class Elements>
  static void fillStrains(int dimension, const Vector& rest, const Matrix& positions, const Elements& elements,
                          Eigen::Index firstRow, Eigen::ArrayXXd& strains) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const auto inverse = inverseRest<D>(edgesOf<D>(dimension, rest.data(), elements[e]));
      for (Eigen::Index i = 0; i < positions.cols(); ++i)
        strains(firstRow + static_cast<Eigen::Index>(e), i) =
            strainOf<D>(edgesOf<D>(dimension, positions.col(i).data(), elements[e]), inverse, nullptr);
    }
  }

  template <int D, class Elements>
  static void addGradient(const Model& model, const Matrix& positions, const Elements& elements,
                          const Eigen::ArrayXXd& weights, Eigen::Index firstRow, Matrix& byPositions) {
    const int dimension = model.dimension;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const auto inverse = inverseRest<D>(edgesOf<D>(dimension, model.restPositions.data(), elements[e]));
      for (Eigen::Index i = 0; i < positions.cols(); ++i) {
        const double weight = weights(firstRow + static_cast<Eigen::Index>(e), i);
        if (weight == 0) continue;
        Eigen::Matrix<double, 3, D> byEdges;
        strainOf<D>(edgesOf<D>(dimension, positions.col(i).data(), elements[e]), inverse, &byEdges);
        for (int k = 0; k < D; ++k)
          for (int axis = 0; axis < dimension; ++axis) {
            byPositions(elements[e][static_cast<std::size_t>(k) + 1] * dimension + axis, i) +=
                weight * byEdges(axis, k);
            byPositions(elements[e][0] * dimension + axis, i) -= weight * byEdges(axis, k);
          }
      }
    }
  }

  /// What the value gains because a parameter moves the rest shape, the motion fixed.
  double byRestShape(const Model& model, const mechanics::DesignParameter& parameter, const Matrix& positions) const {
    const std::string pointer = parameter.pointer();
    if (pointer.starts_with("/point_masses/") || pointer.find("/stiffness_factors/") != std::string::npos) return 0;
    // Into the range, since there may be no model beyond its ends.
    const double at = parameter.value(model), minimum = parameter.minimum(model), maximum = parameter.maximum(model);
    const double step = (at - minimum < maximum - at ? 1e-4 : -1e-4) * (maximum - minimum);
    const auto restAt = [&](int steps) { return parameter.withValue(model, at + steps * step).restPositions; };
    const Vector moved = 2 * restAt(1) - 1.5 * model.restPositions - 0.5 * restAt(2);  // step times the derivative
    if (moved.isZero(0)) return 0;
    const auto valueAt = [&](double share) {
      const Vector rest = model.restPositions + share * moved;
      return smoothMaximum(strainsAt(model.dimension, rest, positions), goal_.sharpness).value;
    };
    return (8 * (valueAt(1) - valueAt(-1)) - (valueAt(2) - valueAt(-2))) / (12 * step);
  }

  StrainGoal goal_;
};

}  // namespace

std::shared_ptr<const ConstraintQuantity> makeLargestStrain(StrainGoal goal) {
  return std::make_shared<LargestStrain>(std::move(goal));
}

}  // namespace pliant::harmonic
