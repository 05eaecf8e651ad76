#include "core/solvers/cone_program.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <queue>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/cone_certificate.hpp"
#include "core/solvers/cone_elements.hpp"

namespace pliant::solvers {

namespace {

/// Fraction of the way to the boundary of the cones.
constexpr double stepFraction = 0.99;
/// Corrections of one predictor, and the step length with which nothing is left to gain by more of them.
constexpr int mostCorrections = 4;
constexpr double longEnough = 0.95;
constexpr double smallestGain = 0.02;
constexpr double shortStep = 0.2;
/// So many steps so short in succession: the start was bad, or there is nothing that keeps the limits.
constexpr double stallingStep = 0.05;
constexpr int mostStalls = 3;
constexpr int mostRestarts = 2;  ///< with a larger barrier

constexpr double largestInertia = 1e8;
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

}  // namespace

struct ConeProgram::Implementation {
  explicit Implementation(ConeConstraints given)
      : constraints(checked(std::move(given))),
        vertexOfNode(constraints.nodeCount, -1),
        vertexCount(numberVertices()),
        cholesky(vertexCount, pairs()),
        elements(constraints, vertexOfNode, cholesky),
        reach(reaches(constraints)) {
    for (const int vertex : nodeOfVertex)
      diagonal.push_back(cholesky.place(vertexOfNode[vertex], vertexOfNode[vertex]));
  }

  static ConeConstraints checked(ConeConstraints given) {
    for (int node = 0; node < given.nodeCount; ++node)
      if (!(given.masses[node] > 0) || !std::isfinite(given.masses[node]))
        throw base::InputError(
            "", "Node " + std::to_string(node) + " has no mass; a projection needs one above 0 on every node.");
    for (const MetricBounds& bounds : given.bounds)
      for (const Eigen::Matrix2d& ellipse : bounds.ellipses)
        if (!(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(ellipse).eigenvalues()[0] > 0))
          throw base::InputError("", "A stretch limit must be above 0 in every direction.");
    for (const ConeElement& element : given.elements)
      for (const int node : element.nodes)
        if (node < 0 || node >= given.nodeCount)
          throw base::InputError("", "A limited triangle names node " + std::to_string(node) + ", but there are " +
                                         std::to_string(given.nodeCount) + ".");
    return given;
  }

  int numberVertices() {
    for (int node = 0; node < constraints.nodeCount; ++node)
      if (!constraints.fixed[node]) {
        vertexOfNode[node] = static_cast<int>(nodeOfVertex.size());
        nodeOfVertex.push_back(node);
      }
    return static_cast<int>(nodeOfVertex.size());
  }

  std::vector<std::array<int, 2>> pairs() const {
    std::vector<std::array<int, 2>> list;
    for (const ConeElement& element : constraints.elements)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < a; ++b) {
          const int i = vertexOfNode[element.nodes[a]], j = vertexOfNode[element.nodes[b]];
          if (i >= 0 && j >= 0) list.push_back({i, j});
        }
    return list;
  }

  /// What `residual` and K dx = right say, over the free nodes.
  void solve(const Positions& right, Positions& dx) {
    for (std::size_t v = 0; v < nodeOfVertex.size(); ++v)
      unknowns.segment<3>(3 * static_cast<Eigen::Index>(v)) = right.col(nodeOfVertex[v]);
    cholesky.solve(unknowns);
    for (std::size_t v = 0; v < nodeOfVertex.size(); ++v)
      dx.col(nodeOfVertex[v]) = unknowns.segment<3>(3 * static_cast<Eigen::Index>(v));
  }

  /// What keeps the limits is no farther than this, if anything does: nodes that hang on a fixed one are within their
  /// reach of it, and the others may all lie in one place.
  double largestObjective(const Positions& candidate) const {
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

  void addMasses(double inertia) {
    double* values = cholesky.values();
    for (std::size_t v = 0; v < nodeOfVertex.size(); ++v)
      for (int i = 0; i < 3; ++i)
        values[diagonal[v].offset + Eigen::Index{i} * (diagonal[v].stride + 1)] += constraints.masses[nodeOfVertex[v]];
  }

  /// Where fixed nodes have moved since the start, lets the others follow them smoothly (a harmonic displacement), lest
  /// the elements between be drawn out to many times their limit.
  void followFixedNodes(const Positions& start, double stiffness, Positions& x, Positions& displacement) {
    displacement = x - start;
    if (displacement.isZero(0)) return;
    Positions forces = Positions::Zero(3, constraints.nodeCount);
    cholesky.clear();
    elements.addLaplacian(stiffness, displacement, forces, cholesky);
    addMasses(1);
    if (cholesky.factorize()) {
      solve(-forces, displacement);
      x = start + displacement;
    }
    displacement.setZero();
  }

  ConeSolution solve(const Positions& candidate, const Positions& start, const ConeProgramOptions& options,
                     base::ExecutionContext& context);
  ConeSolution explain(const Positions& candidate, const Positions& start, const ConeProgramOptions& options,
                       base::ExecutionContext& context, ConeSolution failed);
  void nameContradiction(ConeSolution& solution) const;

  ConeConstraints constraints;
  std::vector<int> vertexOfNode;
  std::vector<int> nodeOfVertex;
  int vertexCount;
  math::BlockCholesky cholesky;
  ConeElements elements;
  std::vector<Reach> reach;                          ///< per node
  std::vector<math::BlockCholesky::Place> diagonal;  ///< per vertex

  Eigen::VectorXd unknowns;
  bool hasMultipliers = false;
  double lastObjective = 0;
};

ConeSolution ConeProgram::Implementation::solve(const Positions& candidate, const Positions& start,
                                                const ConeProgramOptions& options, base::ExecutionContext& context) {
  const base::Stopwatch stopwatch;
  const int nodes = constraints.nodeCount;
  const Eigen::VectorXd& masses = constraints.masses;
  if (candidate.cols() != nodes || start.cols() != nodes || !candidate.allFinite() || !start.allFinite())
    throw base::InputError(
        "", "A projection needs a finite position for each of its " + std::to_string(nodes) + " nodes.");
  ConeSolution solution;
  base::SolverReport& report = solution.report;
  Positions& x = solution.positions;
  x = start;
  for (int node = 0; node < nodes; ++node)
    if (constraints.fixed[node]) x.col(node) = candidate.col(node);
  unknowns.resize(3 * static_cast<Eigen::Index>(nodeOfVertex.size()));

  if (elements.largestStretch(candidate) <= 1) {  // the candidate is its own projection
    x = candidate;
    elements.report(solution);  // for the sizes
    solution.multipliers.setZero();
    solution.ellipseMultipliers.setZero();
    solution.directionMultipliers.setZero();
    report.termination = base::TerminationType::converged;
    report.iterations.push_back({});
    report.seconds = stopwatch.seconds();
    hasMultipliers = false;
    return solution;
  }

  const Eigen::Vector3d low = candidate.rowwise().minCoeff(), high = candidate.rowwise().maxCoeff();
  const double size = (high - low).norm(), totalMass = masses.sum();
  const double absoluteGap = options.absoluteGap * totalMass * size * size;
  const auto objectiveAt = [&](const Positions& at) {
    return 0.5 * ((at - candidate).colwise().squaredNorm() * masses).value();
  };

  Positions forces(3, nodes), predictorForces(3, nodes), correctedForces(3, nodes), dx = Positions::Zero(3, nodes);
  Positions keptDx = dx, gradient(3, nodes), right(3, nodes);
  followFixedNodes(start, totalMass * size * size, x, dx);

  // The objective is about that of the last problem, or far below the distance from here. One that is guessed too small
  // leads into corners.
  const double distance = std::max(objectiveAt(x), absoluteGap);
  const double expected = lastObjective > 0 ? std::clamp(lastObjective, 1e-4 * distance, distance) : distance;
  const bool warm = options.warmStart && hasMultipliers;
  double barrier0 =
      (warm ? 1 : 10) * expected / std::max<double>(1, 2 * static_cast<double>(constraints.elements.size()));
  elements.start(x, barrier0, warm);
  const Positions x0 = x;
  int restarts = 0;

  const auto finish = [&](base::TerminationType termination, std::string message) {
    report.termination = termination;
    report.message = std::move(message);
    report.seconds = stopwatch.seconds();
    elements.report(solution);
    hasMultipliers = report.converged();
    if (report.converged()) lastObjective = solution.objective;
    return solution;
  };

  int stalled = 0;
  for (int iteration = 0;; ++iteration) {
    forces.setZero();
    predictorForces.setZero();
    cholesky.clear();
    const ConeElements::Linearization at = elements.linearize(x, forces, predictorForces, cholesky);
    gradient = (x - candidate) * masses.asDiagonal();
    double squaredResidual = 0, largestResidual = 0, largestGradient = 0;
    for (const int node : nodeOfVertex) {
      const Eigen::Vector3d residual = gradient.col(node) + forces.col(node);
      squaredResidual += residual.squaredNorm() / masses[node];
      largestResidual = std::max(largestResidual, residual.cwiseAbs().maxCoeff());
      largestGradient = std::max(largestGradient, gradient.col(node).cwiseAbs().maxCoeff());
    }
    // P - D, without the cancellation that computing D first would have.
    const double gap = 0.5 * squaredResidual + at.supportGap;
    solution.objective = objectiveAt(x);
    solution.bound = solution.objective - gap;
    solution.violation = std::max(0.0, at.largestStretch - 1);
    solution.dualResidual = largestGradient > 0 ? largestResidual / largestGradient : 0;
    solution.complementarity = solution.objective > 0 ? at.complementarity / solution.objective : 0;
    report.iterations.push_back({iteration, solution.relativeGap(), 0, solution.violation});
    const bool optimal =
        (std::abs(gap) <= options.relativeGap * solution.objective && solution.dualResidual <= options.relativeGap) ||
        std::abs(gap) <= absoluteGap;
    if (optimal && solution.violation <= options.violation) return finish(base::TerminationType::converged, "");
    if (!std::isfinite(gap))
      return finish(base::TerminationType::failed, "The projection met a number that is not finite.");
    if (context.cancelRequested()) return finish(base::TerminationType::cancelled, "The projection was cancelled.");
    if (iteration >= options.maximumIterations)
      return finish(base::TerminationType::iterationLimit,
                    "The projection did not converge in " + std::to_string(iteration) + " iterations.");

    // Very near to the optimum the matrix may lose its small eigenvalues to rounding; more inertia keeps them.
    double inertia = 1;
    for (addMasses(inertia); !cholesky.factorize(); addMasses(inertia)) {
      inertia *= 100;
      if (inertia > largestInertia)
        return finish(
            base::TerminationType::failed, "The projection's linear system is singular to working precision.");
      forces.setZero();
      predictorForces.setZero();
      cholesky.clear();
      elements.linearize(x, forces, predictorForces, cholesky);
    }

    elements.clearCorrection();
    const double barrier = at.complementarity / elements.boundCount();
    // Where the gap is closed and only the residual is left, a smaller barrier would but cost digits.
    const bool closed = std::abs(gap) <= options.relativeGap * solution.objective;
    double target = barrier;
    if (!closed) {
      right = -(gradient + predictorForces);
      solve(right, dx);
      const double affine = std::min(1.0, stepFraction * elements.direct(dx));
      const double ratio = elements.complementarityAfter(affine) / at.complementarity;
      target = ratio * ratio * ratio * barrier;
    }
    double best = 0;
    const auto tryCorrection = [&](double towards, double weight) {
      correctedForces.setZero();
      elements.correct(towards, weight, correctedForces);
      right = -(gradient + correctedForces);
      solve(right, dx);
      const double step = std::min(1.0, stepFraction * elements.direct(dx));
      if (best > 0 && step < best + smallestGain) return false;
      best = step;
      keptDx = dx;
      elements.keepDirection();
      return best <= longEnough;
    };
    if (closed) tryCorrection(target, 0);
    for (int correction = 0; !closed && correction < mostCorrections && tryCorrection(target, 1); ++correction) {
    }
    // Products of whole steps mislead where the step is short.
    if (best < shortStep) tryCorrection(0.3 * barrier, 0);
    elements.restoreDirection();
    x += best * keptDx;
    elements.advance(best);
    report.iterations.back().stepLength = best;
    stalled = best < stallingStep ? stalled + 1 : 0;
    if (stalled < mostStalls) continue;
    stalled = 0;
    if (restarts++ < mostRestarts) {
      x = x0;
      barrier0 *= 1e3;
      elements.start(x, barrier0, false);
    } else if (options.explainFailure) {
      finish(base::TerminationType::failed, "");
      return explain(candidate, start, options, context, std::move(solution));
    } else {
      return finish(base::TerminationType::failed, "The projection does not get on.");
    }
  }
}

/// Limits that are all the looser by one factor are kept by something if the factor is large enough. Close to the
/// smallest such factor the multipliers grow until they prove, if it is above 1, that nothing keeps the limits. Whether
/// anything does is no matter of the candidate, so the start is projected in its place: a candidate that is stretched
/// evenly would keep looser limits without any multipliers.
ConeSolution ConeProgram::Implementation::explain(const Positions& candidate, const Positions& start,
                                                  const ConeProgramOptions& options, base::ExecutionContext& context,
                                                  ConeSolution failed) {
  const base::Stopwatch stopwatch;
  Positions held = start, feasible, displacement(3, constraints.nodeCount);
  for (int node = 0; node < constraints.nodeCount; ++node)
    if (constraints.fixed[node]) held.col(node) = candidate.col(node);
  feasible = held;
  const double farthest = largestObjective(held);
  const double size = (held.rowwise().maxCoeff() - held.rowwise().minCoeff()).norm();
  followFixedNodes(start, constraints.masses.sum() * size * size, feasible, displacement);

  ConeProgramOptions relaxedOptions = options;
  relaxedOptions.explainFailure = false;
  relaxedOptions.warmStart = false;
  relaxedOptions.relativeGap = 1e-6;
  double possible = 1.01 * std::max(1.0, elements.largestStretch(feasible)), impossible = 1;
  for (int attempt = 0; attempt < mostAttempts && !context.cancelRequested(); ++attempt) {
    const double factor =
        attempt == 0 ? possible : 1 + std::sqrt((possible - 1) * std::max(impossible - 1, 1e-2 * (possible - 1)));
    ConeConstraints relaxed = constraints;
    for (MetricBounds& bounds : relaxed.bounds) {
      for (Eigen::Matrix2d& ellipse : bounds.ellipses) ellipse *= factor * factor;
      for (Eigen::Vector2d& direction : bounds.directions) direction /= factor;
    }
    ConeSolution solution = Implementation(std::move(relaxed)).solve(held, feasible, relaxedOptions, context);
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
      nameContradiction(solution);
      return solution;
    }
    if (possible - 1 < 1e-8) break;
  }
  failed.report.message = "The projection does not get on; the limits leave hardly any room between fixed nodes.";
  failed.report.seconds += stopwatch.seconds();
  return failed;
}

/// Who bears the largest of the forces that prove a contradiction is who contradicts whom.
void ConeProgram::Implementation::nameContradiction(ConeSolution& solution) const {
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
  for (const int node : nodeOfVertex) pull[node] = 0;
  solution.conflictingNodes = largestFirst(pull);
}

ConeProgram::ConeProgram(ConeConstraints constraints)
    : implementation_(std::make_unique<Implementation>(std::move(constraints))) {}
ConeProgram::~ConeProgram() = default;
ConeProgram::ConeProgram(ConeProgram&&) noexcept = default;

ConeSolution ConeProgram::solve(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                const ConeProgramOptions& options, base::ExecutionContext& context) {
  return implementation_->solve(candidate, start, options, context);
}

}  // namespace pliant::solvers
