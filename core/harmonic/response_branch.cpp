#include "core/harmonic/response_branch.hpp"

#include "core/harmonic/amplitude.hpp"

namespace pliant::harmonic {

Vector ResponseBranch::linearize(const Vector& z, double omega) {
  Vector h, frequencyDerivative;
  solver_.linearize(z, omega, h, &frequencyDerivative);
  return frequencyDerivative;
}

Vector ResponseBranch::linearizePrediction(const Vector& z, double omega, const solvers::BranchPoint& from,
                                           double step) {
  const StressSource stresses{from.x, from.x + step * from.direction};
  Vector h, frequencyDerivative;
  solver_.linearize(z, omega, h, &frequencyDerivative, &stresses);
  return frequencyDerivative;
}

Vector ResponseBranch::monitors(const solvers::BranchPoint& point) {
  const auto& probes = problem_.model().probes;
  if (probes.empty()) return Vector::Constant(1, problem_.oscillation(point.x).dot(point.direction));
  Vector rates(static_cast<Eigen::Index>(probes.size()));
  for (std::size_t p = 0; p < probes.size(); ++p)
    rates[static_cast<Eigen::Index>(p)] = pathLengthGradient(problem_, point.x, probes[p].node).dot(point.direction);
  return rates;
}

}  // namespace pliant::harmonic
