#include "core/solvers/cone_contradiction.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

#include "core/base/stopwatch.hpp"
#include "core/solvers/cone_certificate.hpp"

namespace pliant::solvers {

namespace {

constexpr int mostAttempts = 40;  ///< to find by how much the limits would have to be looser

std::string percentText(double fraction) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g %%", 100 * fraction);
  return text;
}

/// The largest stretch in any direction that some bounds allow.
double largestStretch(const MetricBounds& bounds) {
  double stretch = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix2d& ellipse : bounds.ellipses)
    stretch = std::min(stretch, std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(ellipse).eigenvalues()[1]));
  for (std::size_t i = 0; i < bounds.directions.size(); ++i)
    for (std::size_t j = i + 1; j < bounds.directions.size(); ++j) {
      // ‖F‖ <= ‖F [v w]‖ ‖[v w]⁻¹‖ with ‖Fv‖, ‖Fw‖ <= 1.
      Eigen::Matrix2d pair;
      pair << bounds.directions[i], bounds.directions[j];
      if (std::abs(pair.determinant()) > 1e-12) stretch = std::min(stretch, std::sqrt(2) * pair.inverse().norm());
    }
  return stretch;
}

/// How far nodes can be from a fixed one.
struct Reach {
  int anchor = -1;      ///< a fixed node, -1: none hangs together with this node
  double distance = 0;  ///< [m]
};

/// Shortest paths over the elements' edges, each as long as its bounds allow (its rest length follows from the
/// weights).
std::vector<Reach> reaches(const ConeConstraints& constraints) {
  struct Edge {
    int node;
    double length;
  };
  std::vector<std::vector<Edge>> edges(constraints.nodeCount);
  for (const ConeElement& element : constraints.elements) {
    Eigen::Matrix2d weights;
    weights << element.weights[1], element.weights[2];
    const Eigen::Matrix2d rest = weights.transpose().inverse();  // columns: x_1 - x_0 and x_2 - x_0
    const double stretch = largestStretch(constraints.bounds[element.bounds]);
    const double lengths[3] = {rest.col(0).norm(), rest.col(1).norm(), (rest.col(0) - rest.col(1)).norm()};
    constexpr int ends[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    for (int k = 0; k < 3; ++k) {
      const int a = element.nodes[ends[k][0]], b = element.nodes[ends[k][1]];
      edges[a].push_back({b, stretch * lengths[k]});
      edges[b].push_back({a, stretch * lengths[k]});
    }
  }
  std::vector<Reach> result(constraints.nodeCount);
  using Entry = std::tuple<double, int, int>;  // distance, node, anchor
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (int node = 0; node < constraints.nodeCount; ++node)
    if (constraints.fixed[node]) queue.emplace(0, node, node);
  while (!queue.empty()) {
    const auto [distance, node, anchor] = queue.top();
    queue.pop();
    if (result[node].anchor >= 0) continue;
    result[node] = {anchor, distance};
    for (const Edge& edge : edges[node])
      if (result[edge.node].anchor < 0) queue.emplace(distance + edge.length, edge.node, anchor);
  }
  return result;
}

/// What keeps the limits is no farther than this, if anything does: nodes that hang on a fixed one are within their
/// reach of it, and the others may all lie in one place.
double largestObjective(const ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate) {
  const std::vector<Reach> reach = reaches(constraints);
  double moment = 0, sum = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  for (int node = 0; node < constraints.nodeCount; ++node) {
    const auto& [anchor, distance] = reach[node];
    const double mass = constraints.masses[node];
    if (anchor < 0) {
      moment += mass;
      first += mass * candidate.col(node);
    } else {
      const double offset = (candidate.col(node) - candidate.col(anchor)).norm() + distance;
      sum += 0.5 * mass * offset * offset;
    }
  }
  for (int node = 0; node < constraints.nodeCount; ++node)
    if (reach[node].anchor < 0)
      sum += 0.5 * constraints.masses[node] * (candidate.col(node) - first / moment).squaredNorm();
  return sum;
}

/// Who bears the largest of the forces that prove a contradiction is who contradicts whom.
void nameContradiction(const ConeConstraints& constraints, ConeSolution& solution) {
  const auto largestFirst = [](const Eigen::VectorXd& sizes) {
    std::vector<int> order(sizes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sizes[a] > sizes[b]; });
    const double least = 0.05 * sizes.maxCoeff();
    std::erase_if(order, [&](int i) { return sizes[i] <= least; });
    return order;
  };
  solution.conflictingElements = largestFirst(solution.multipliers.topRows(2).colwise().sum().transpose());
  Eigen::VectorXd pull = limitForces(constraints, solution).colwise().norm();
  for (int node = 0; node < constraints.nodeCount; ++node)
    if (!constraints.fixed[node]) pull[node] = 0;
  solution.conflictingNodes = largestFirst(pull);
}

}  // namespace

/// Limits that are all the looser by one factor are kept by something if the factor is large enough. Close to the
/// smallest such factor the multipliers grow until they prove, if it is above 1, that nothing keeps the limits. Whether
/// anything does is no matter of the candidate, so the start is projected in its place: a candidate that is stretched
/// evenly would keep looser limits without any multipliers.
ConeSolution explainFailure(const ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate,
                            const Eigen::Matrix3Xd& start, const Eigen::Matrix3Xd& followed, double followedStretch,
                            const ConeProgramOptions& options, base::ExecutionContext& context, ConeSolution failed) {
  const base::Stopwatch stopwatch;
  Eigen::Matrix3Xd held = start, feasible = followed;
  for (int node = 0; node < constraints.nodeCount; ++node)
    if (constraints.fixed[node]) held.col(node) = candidate.col(node);
  const double farthest = largestObjective(constraints, held);

  ConeProgramOptions relaxedOptions = options;
  relaxedOptions.explainFailure = false;
  relaxedOptions.warmStart = false;
  relaxedOptions.relativeGap = 1e-6;
  double possible = 1.01 * std::max(1.0, followedStretch), impossible = 1;
  for (int attempt = 0; attempt < mostAttempts && !context.cancelRequested(); ++attempt) {
    const double factor =
        attempt == 0 ? possible : 1 + std::sqrt((possible - 1) * std::max(impossible - 1, 1e-2 * (possible - 1)));
    ConeConstraints relaxed = constraints;
    for (MetricBounds& bounds : relaxed.bounds) {
      for (Eigen::Matrix2d& ellipse : bounds.ellipses) ellipse *= factor * factor;
      for (Eigen::Vector2d& direction : bounds.directions) direction /= factor;
    }
    ConeSolution solution = ConeProgram(std::move(relaxed)).solve(held, feasible, relaxedOptions, context);
    if (!solution.report.converged()) {
      impossible = factor;
      if (impossible >= possible * (1 - 1e-12)) break;
      continue;
    }
    possible = factor;
    feasible = solution.positions;
    solution.ellipseMultipliers /= factor * factor;
    solution.directionMultipliers /= factor * factor;
    if (provenDistance(constraints, held, solution) > farthest) {
      certify(constraints, candidate, solution);
      solution.report = failed.report;
      solution.report.termination = base::TerminationType::infeasible;
      solution.report.message =
          "The limits cannot be kept: fixed nodes are farther apart than the sheet may stretch; "
          "it would have to stretch " +
          percentText(impossible - 1) + " to " + percentText(possible - 1) + " farther.";
      solution.report.seconds += stopwatch.seconds();
      nameContradiction(constraints, solution);
      return solution;
    }
    if (possible - 1 < 1e-8) break;
  }
  failed.report.message = "The projection does not get on; the limits leave hardly any room between fixed nodes.";
  failed.report.seconds += stopwatch.seconds();
  return failed;
}

}  // namespace pliant::solvers
