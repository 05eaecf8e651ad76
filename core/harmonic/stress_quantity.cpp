#include "core/harmonic/stress_quantity.hpp"

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/harmonic/smooth_extreme.hpp"
#include "core/mechanics/family_parameter.hpp"

namespace pliant::harmonic {

namespace {

using mechanics::ElementStress;

constexpr int fewestStressInstants = 128;

class LargestStress final : public ConstraintQuantity {
 public:
  explicit LargestStress(StressGoal goal) : goal_(std::move(goal)) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    const Model& model = problem.model();
    const math::HarmonicBasis basis = instantsOf(problem, 1);
    const Matrix positions = positionsAt(problem, z, basis);
    const ElementStress stress = stressOf(model);
    SmoothMaximum largest = smoothMaximum(valuesAt(stress, positions), goal_.sharpness);
    constexpr double negligible = 1e-16;  // of weights whose sum is 1
    largest.weights = (largest.weights > negligible).select(largest.weights, 0.0);
    Matrix byPositions = Matrix::Zero(positions.rows(), positions.cols());
    Vector gradient;
    for (Eigen::Index i = 0; i < positions.cols(); ++i) {
      gradient.setZero(positions.rows());
      stress.addGradient(positions.col(i), largest.weights.col(i), gradient);
      byPositions.col(i) = gradient;
    }
    return {largest.value, basis.synthesis().transpose() * byPositions.transpose(),
            byParameters(model, stress, positions, largest.weights)};
  }

  double exactValue(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    constexpr int times = 4;
    return valuesAt(stressOf(problem.model()), positionsAt(problem, z, instantsOf(problem, times))).maxCoeff();
  }

 private:
  static math::HarmonicBasis instantsOf(const HarmonicBalanceProblem& problem, int times) {
    const math::HarmonicBasis& basis = problem.basis();
    return {basis.harmonics(), times * std::max(fewestStressInstants, basis.samples())};
  }

  /// Coordinates x instants.
  static Matrix positionsAt(const HarmonicBalanceProblem& problem, const Vector& z, const math::HarmonicBasis& basis) {
    const Matrix coefficients = problem.basis().analysis() * problem.trajectories(z);
    return (basis.synthesis() * coefficients).transpose();
  }

  ElementStress stressOf(const Model& model) const {
    ElementStress stress(model, goal_.triangles, goal_.tetrahedra, goal_.measure);
    if (stress.count() == 0) throw base::InputError("", "there are no membranes, shells or solids to be stressed");
    return stress;
  }

  /// Places x instants.
  static Eigen::ArrayXXd valuesAt(const ElementStress& stress, const Matrix& positions) {
    Eigen::ArrayXXd values(stress.count(), positions.cols());
    for (Eigen::Index i = 0; i < positions.cols(); ++i) values.col(i) = stress.values(positions.col(i)).array();
    return values;
  }

  /// What the value gains because parameters change the elements, the motion fixed.
  Vector byParameters(const Model& model, const ElementStress& stress, const Matrix& positions,
                      const Eigen::ArrayXXd& weights) const {
    Vector result = Vector::Zero(static_cast<Eigen::Index>(model.parameters.size()));
    // The value is that of few instants.
    const std::vector<Eigen::Index> active = activeInstants(weights);
    const Matrix configurations = positions(Eigen::all, active);
    const Eigen::ArrayXXd shares = weights(Eigen::all, active);
    std::map<std::pair<int, int>, double> byStiffness;
    for (Eigen::Index i = 0; i < configurations.cols(); ++i) {
      const Vector ofPlaces = stress.byStiffness(configurations.col(i), shares.col(i));
      for (Eigen::Index place = 0; place < ofPlaces.size(); ++place) {
        const mechanics::ElementPlace& at = stress.elements()[static_cast<std::size_t>(place)];
        byStiffness[{at.energy, at.element}] += ofPlaces[place];
      }
    }
    const auto weighted = [&](const Model& changed) {
      return (valuesAt(stressOf(changed), configurations) * shares).sum();
    };
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
      const mechanics::DesignParameter& parameter = *model.parameters[i];
      double& derivative = result[static_cast<Eigen::Index>(i)];
      if (const auto place = mechanics::factoredElement(parameter)) {
        const auto found = byStiffness.find({place->energy, place->element});
        if (found != byStiffness.end()) derivative = found->second / parameter.value(model);
      } else if (!parameter.pointer().starts_with("/point_masses/")) {
        // A rest shape that is changed by a step strains everything by as much: little against the strains there are.
        constexpr double relativeStep = 3e-6;
        derivative = mechanics::derivativeOf(weighted, parameter, model, relativeStep);
      }
    }
    return result;
  }

  static std::vector<Eigen::Index> activeInstants(const Eigen::ArrayXXd& weights) {
    std::vector<Eigen::Index> active;
    for (Eigen::Index i = 0; i < weights.cols(); ++i)
      if ((weights.col(i) > 0).any()) active.push_back(i);
    return active;
  }

  StressGoal goal_;
};

}  // namespace

std::shared_ptr<const ConstraintQuantity> makeLargestStress(StressGoal goal) {
  return std::make_shared<LargestStress>(std::move(goal));
}

}  // namespace pliant::harmonic
