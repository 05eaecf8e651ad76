#include "core/harmonic/design_objective.hpp"

#include <cmath>

#include "core/harmonic/path_length.hpp"
#include "core/harmonic/resonance_objective.hpp"

namespace pliant::harmonic {

namespace {

ObjectiveValue nothing(const HarmonicBalanceProblem& problem) {
  const Model& model = problem.model();
  return {0, Matrix::Zero(problem.basis().size(), model.coordinateCount()),
          Vector::Zero(static_cast<Eigen::Index>(model.parameters.size()))};
}

class AmplitudeObjective final : public DesignObjective {
 public:
  explicit AmplitudeObjective(AmplitudeGoal goal) : goal_(std::move(goal)) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    ObjectiveValue result = nothing(problem);
    const int dimension = problem.model().dimension;
    std::vector<int> axes = goal_.axes;
    for (int axis = 0; goal_.axes.empty() && axis < dimension; ++axis) axes.push_back(axis);
    for (const int node : goal_.nodes) {
      const Matrix coefficients = nodeCoefficients(problem, z, node)(Eigen::all, axes);
      Matrix gradient;
      const double length = pathLength(problem.basis(), coefficients, &gradient);
      result.value += goal_.target ? (length - *goal_.target) * (length - *goal_.target) : -length;
      const double slope = goal_.target ? 2 * (length - *goal_.target) : -1;
      for (std::size_t i = 0; i < axes.size(); ++i)
        result.byCoefficients.col(node * dimension + axes[i]) += slope * gradient.col(static_cast<Eigen::Index>(i));
    }
    return result;
  }

 private:
  AmplitudeGoal goal_;
};

class ParameterRegularization final : public DesignObjective {
 public:
  ParameterRegularization(std::vector<int> parameters, Vector reference)
      : parameters_(std::move(parameters)), reference_(std::move(reference)) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector&) const override {
    ObjectiveValue result = nothing(problem);
    const Model& model = problem.model();
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      const auto& parameter = *model.parameters.at(static_cast<std::size_t>(parameters_[i]));
      const double range = parameter.maximum(model) - parameter.minimum(model);
      const double offset = (parameter.value(model) - reference_[static_cast<Eigen::Index>(i)]) / range;
      result.value += offset * offset;
      result.byParameters[parameters_[i]] += 2 * offset / range;
    }
    return result;
  }

 private:
  std::vector<int> parameters_;
  Vector reference_;
};

class WeightedSum final : public DesignObjective {
 public:
  explicit WeightedSum(std::vector<WeightedObjective> terms) : terms_(std::move(terms)) {}

  ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector& z) const override {
    ObjectiveValue sum = nothing(problem);
    for (const WeightedObjective& term : terms_) {
      const ObjectiveValue part = term.objective->evaluate(problem, z);
      sum.value += term.weight * part.value;
      sum.byCoefficients += term.weight * part.byCoefficients;
      sum.byParameters += term.weight * part.byParameters;
    }
    return sum;
  }

 private:
  std::vector<WeightedObjective> terms_;
};

std::vector<int> lastAndFirst(const HarmonicBalanceProblem& problem) { return {problem.model().nodeCount() - 1, 0}; }

std::shared_ptr<const DesignObjective> pathExample(const HarmonicBalanceProblem& problem, std::mt19937& random,
                                                   bool matchPlace) {
  std::uniform_real_distribution<double> entry(-0.2, 0.2);
  PathGoal goal;
  goal.matchPlace = matchPlace;
  goal.sharpness = 5;  // so that several phases count
  for (const int node : lastAndFirst(problem))
    goal.paths.push_back({node, Matrix::NullaryExpr(5, problem.model().dimension, [&] { return entry(random); })});
  return makePathObjective(std::move(goal));
}

std::vector<ObjectiveKind> withResonances(std::vector<ObjectiveKind> kinds) {
  for (ObjectiveKind& kind : resonanceObjectiveKinds()) kinds.push_back(std::move(kind));
  return kinds;
}

}  // namespace

std::shared_ptr<const DesignObjective> makeAmplitudeObjective(AmplitudeGoal goal) {
  return std::make_shared<AmplitudeObjective>(std::move(goal));
}

std::shared_ptr<const DesignObjective> makeParameterRegularization(std::vector<int> parameters, Vector reference) {
  return std::make_shared<ParameterRegularization>(std::move(parameters), std::move(reference));
}

std::shared_ptr<const DesignObjective> makeWeightedSum(std::vector<WeightedObjective> terms) {
  return std::make_shared<WeightedSum>(std::move(terms));
}

const std::vector<ObjectiveKind>& objectiveKinds() {
  using Problem = HarmonicBalanceProblem;
  static const std::vector<ObjectiveKind> kinds = {
      {"amplitude, target",
       [](const Problem& problem, std::mt19937&) {
         return makeAmplitudeObjective({lastAndFirst(problem), 0.7, {}});
       }},
      {"amplitude, largest",
       [](const Problem& problem, std::mt19937&) {
         return makeAmplitudeObjective({lastAndFirst(problem), std::nullopt, {}});
       }},
      {"amplitude, one axis",
       [](const Problem& problem, std::mt19937&) {
         return makeAmplitudeObjective({lastAndFirst(problem), std::nullopt, {1}});
       }},
      {"path", [](const Problem& problem, std::mt19937& random) { return pathExample(problem, random, false); }},
      {"path and its place",
       [](const Problem& problem, std::mt19937& random) { return pathExample(problem, random, true); }},
      {"regularization",
       [](const Problem&, std::mt19937&) { return makeParameterRegularization({0}, Vector::Constant(1, 0.3)); }},
      {"weighted sum", [](const Problem& problem, std::mt19937& random) {
         return makeWeightedSum({{0.3, makeAmplitudeObjective({{lastAndFirst(problem).front()}, 2.0, {}})},
                                 {2, pathExample(problem, random, true)},
                                 {0.5, makeParameterRegularization({0}, Vector::Constant(1, 2))}});
       }}};
  static const std::vector<ObjectiveKind> all = withResonances(kinds);
  return all;
}

}  // namespace pliant::harmonic
