#include "core/harmonic/mode_sensitivity.hpp"

#include <array>

#include "core/harmonic/steady_drive.hpp"

namespace pliant::harmonic {

namespace {

constexpr std::array<double, 5> firstDifference = {1. / 12, -8. / 12, 0, 8. / 12, -1. / 12};
constexpr std::array<double, 5> secondDifference = {-1. / 12, 16. / 12, -30. / 12, 16. / 12, -1. / 12};

/// x + k ε direction for k = -2 to 2, a row each; ε moves no coordinate by more than a small part of the model's size.
struct Line {
  Matrix configurations;
  double step;

  Line(const Model& model, const Vector& x, const Vector& direction) {
    constexpr double share = 2e-3;
    const auto nodes =
        model.restPositions.head(model.nodeCount() * model.dimension).reshaped(model.dimension, model.nodeCount());
    const double size = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
    step = share * (size > 0 ? size : 1) / direction.cwiseAbs().maxCoeff();
    configurations.resize(5, x.size());
    for (int k = 0; k < 5; ++k) configurations.row(k) = (x + (k - 2) * step * direction).transpose();
  }

  /// The difference of functions of the configurations, a row each.
  Vector first(const Matrix& values) const { return combined(values, firstDifference) / step; }
  Vector second(const Matrix& values) const { return combined(values, secondDifference) / (step * step); }

 private:
  static Vector combined(const Matrix& values, const std::array<double, 5>& weights) {
    Vector sum = Vector::Zero(values.cols());
    for (int k = 0; k < 5; ++k) sum += weights[static_cast<std::size_t>(k)] * values.row(k).transpose();
    return sum;
  }
};

/// ∇E at some configurations, on all coordinates.
Matrix elasticForces(const mechanics::ElasticAssembler& assembler, const Matrix& configurations) {
  Matrix padded(
      mechanics::ElasticAssembler::paddedRows(static_cast<int>(configurations.rows())), configurations.cols()),
      gradient;
  padded.topRows(configurations.rows()) = configurations;
  padded.bottomRows(padded.rows() - configurations.rows()).rowwise() = configurations.row(0);
  assembler.evaluate(padded, gradient, nullptr);
  return gradient.topRows(configurations.rows());
}

/// How the steady part of loads and drives (HarmonicBalanceProblem::setDriveFraction) depends on parameters.
class SteadyDerivative {
 public:
  explicit SteadyDerivative(const HarmonicBalanceProblem& problem) : model_(problem.model()) {
    for (int i = 0; i < problem.basis().samples(); ++i) instants_.push_back(problem.samplePhases(i));
    for (const auto& drive : model_.drives)
      steadyInstants_.push_back(instants_[static_cast<std::size_t>(
          steadySample(*drive, model_.restPositions(drive->coordinates()), instants_))]);
  }

  Vector force(const mechanics::ModelDerivative& change) const {
    Vector mean = Vector::Zero(model_.coordinateCount());
    for (const math::Phases& at : instants_) mean += change.externalForce(at) / static_cast<double>(instants_.size());
    return mean;
  }
  /// Of the coordinates that are not free.
  Vector place(const mechanics::ModelDerivative& change) const {
    Vector moved = change.prescribed(0);
    for (std::size_t d = 0; d < model_.drives.size(); ++d) {
      const Vector atAngle = change.prescribed(steadyInstants_[d]);
      for (const int coordinate : model_.drives[d]->coordinates()) moved[coordinate] = atAngle[coordinate];
    }
    return moved;
  }

 private:
  const Model& model_;
  std::vector<math::Phases> instants_;
  std::vector<math::Phases> steadyInstants_;  ///< of each drive
};

}  // namespace

Matrix naturalFrequencyDerivatives(const HarmonicBalanceProblem& problem, const LinearModes& modes,
                                   const std::vector<int>& chosen, const std::vector<int>& parameters) {
  const Model& model = problem.model();
  const std::vector<int>& free = model.dofs.freeCoordinates;
  const mechanics::ElasticAssembler& assembler = problem.assembler();
  const SteadyDerivative steady(problem);
  Matrix derivatives =
      Matrix::Zero(static_cast<Eigen::Index>(chosen.size()), static_cast<Eigen::Index>(parameters.size()));
  math::SparseFactorization stiffness;
  if (chosen.empty() || !stiffness.factorize(assembler.hessian(modes.equilibrium))) return derivatives;

  struct ModeLine {
    const LinearMode& mode;
    Vector shape;  ///< over all coordinates
    Line line;
    Vector bending;  ///< ∇³E φ φ
    Vector adjoint;  ///< K⁻¹ of its free part
  };
  std::vector<ModeLine> lines;
  for (const int index : chosen) {
    const LinearMode& mode = modes.modes.at(static_cast<std::size_t>(index));
    Vector shape = Vector::Zero(model.coordinateCount());
    shape(free) = mode.shape;
    Line line(model, modes.equilibrium, shape);
    Vector bending = line.second(elasticForces(assembler, line.configurations));
    Vector adjoint = stiffness.solve(Vector(bending(free)));
    lines.push_back({mode, std::move(shape), std::move(line), std::move(bending), std::move(adjoint)});
  }
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto change = model.parameters.at(static_cast<std::size_t>(parameters[p]))->derivative(model);
    const SparseMatrix mass = change->mass();
    const Vector moved = steady.place(*change);
    const Matrix elastic = change->gradient(modes.equilibrium.transpose());
    Vector unbalanced = elastic.row(0);
    unbalanced -= steady.force(*change);
    if (!moved.isZero(0)) {
      const Line line(model, modes.equilibrium, moved);
      unbalanced += line.first(elasticForces(assembler, line.configurations));
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto& [mode, shape, line, bending, adjoint] = lines[i];
      // With the coordinates that are not free, the stiffness moves directly; the free ones follow the equilibrium.
      const double squared = shape.dot(line.first(change->gradient(line.configurations))) + bending.dot(moved) -
                             adjoint.dot(Vector(unbalanced(free))) - mode.omega * mode.omega * shape.dot(mass * shape);
      derivatives(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(p)) = squared / (2 * mode.omega);
    }
  }
  return derivatives;
}

}  // namespace pliant::harmonic
