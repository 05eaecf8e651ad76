#include "core/solvers/cone_program.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/cone_elements.hpp"

namespace pliant::solvers {

namespace {

/// Fraction of the way to the boundary of the cones.
constexpr double stepFraction = 0.99;
/// Corrections of one predictor, and the step length with which nothing is left to gain by more of them.
constexpr int mostCorrections = 4;
constexpr double longEnough = 0.95;
constexpr double smallestGain = 0.02;

/// How far from a fixed node an element reaches at most: its bounds, times its rest edges (the inverse of its weights).
double longestEdge(const ConeElement& element, const MetricBounds& bounds) {
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
  Eigen::Matrix2d weights;
  weights << element.weights[1], element.weights[2];
  const Eigen::Matrix2d edges = weights.transpose().inverse();  // columns: x_k - x_0 at rest
  return stretch * std::max({edges.row(0).norm(), edges.row(1).norm(), (edges.row(0) - edges.row(1)).norm()});
}

}  // namespace

struct ConeProgram::Implementation {
  explicit Implementation(ConeConstraints given)
      : constraints(checked(std::move(given))),
        vertexOfNode(constraints.nodeCount, -1),
        vertexCount(numberVertices()),
        cholesky(vertexCount, pairs()),
        elements(constraints, vertexOfNode, cholesky) {
    for (const ConeElement& element : constraints.elements)
      reach += longestEdge(element, constraints.bounds[element.bounds]);
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

  ConeSolution solve(const Positions& candidate, const Positions& start, const ConeProgramOptions& options,
                     base::ExecutionContext& context);
  void explainContradiction(const Positions& forces, ConeSolution& solution) const;

  ConeConstraints constraints;
  std::vector<int> vertexOfNode;
  std::vector<int> nodeOfVertex;
  int vertexCount;
  math::BlockCholesky cholesky;
  ConeElements elements;
  std::vector<math::BlockCholesky::Place> diagonal;  ///< per vertex
  double reach = 0;                                  ///< no node is farther from a fixed node it hangs on [m]
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
  // Whatever keeps the limits is no farther than this from the candidate, if anything does.
  const double farthest = 0.5 * totalMass * (size + reach) * (size + reach);
  const auto objectiveAt = [&](const Positions& at) {
    return 0.5 * ((at - candidate).colwise().squaredNorm() * masses).value();
  };

  const double barrier0 = 10 * std::max(lastObjective > 0 ? lastObjective : objectiveAt(x), absoluteGap) /
                          std::max(1, elements.boundCount());
  const bool warm = options.warmStart && hasMultipliers;
  elements.start(x, warm ? barrier0 / 10 : barrier0, warm);

  Positions forces(3, nodes), predictorForces(3, nodes), correctedForces(3, nodes), dx = Positions::Zero(3, nodes);
  Positions keptDx = dx, gradient(3, nodes), right(3, nodes);
  const auto finish = [&](base::TerminationType termination, std::string message) {
    report.termination = termination;
    report.message = std::move(message);
    report.seconds = stopwatch.seconds();
    elements.report(solution);
    hasMultipliers = report.converged();
    if (report.converged()) lastObjective = solution.objective;
    return solution;
  };

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
    const double wantedGap = std::max(options.relativeGap * solution.objective, absoluteGap);
    if (std::abs(gap) <= wantedGap && solution.violation <= options.violation)
      return finish(base::TerminationType::converged, "");
    if (!std::isfinite(gap))
      return finish(base::TerminationType::failed, "The projection met a number that is not finite.");
    if (solution.bound > farthest) {
      explainContradiction(forces, solution);
      return finish(base::TerminationType::infeasible,
                    "The limits cannot be kept: fixed nodes are farther apart than the sheet may stretch.");
    }
    if (context.cancelRequested()) return finish(base::TerminationType::cancelled, "The projection was cancelled.");
    if (iteration >= options.maximumIterations)
      return finish(base::TerminationType::iterationLimit,
                    "The projection did not converge in " + std::to_string(iteration) + " iterations.");

    double* values = cholesky.values();
    for (std::size_t v = 0; v < nodeOfVertex.size(); ++v)
      for (int i = 0; i < 3; ++i)
        values[diagonal[v].offset + Eigen::Index{i} * (diagonal[v].stride + 1)] += masses[nodeOfVertex[v]];
    if (!cholesky.factorize())
      return finish(base::TerminationType::failed, "The projection's linear system is singular to working precision.");

    elements.clearCorrection();
    right = -(gradient + predictorForces);
    solve(right, dx);
    double step = std::min(1.0, stepFraction * elements.direct(dx));
    const double ratio = elements.complementarityAfter(step) / at.complementarity;
    const double target = ratio * ratio * ratio * at.complementarity / elements.boundCount();
    double best = 0;
    for (int correction = 0; correction < mostCorrections; ++correction) {
      correctedForces.setZero();
      elements.correct(target, correctedForces);
      right = -(gradient + correctedForces);
      solve(right, dx);
      step = std::min(1.0, stepFraction * elements.direct(dx));
      if (correction > 0 && step < best + smallestGain) break;
      best = step;
      keptDx = dx;
      elements.keepDirection();
      if (best > longEnough) break;
    }
    elements.restoreDirection();
    x += best * keptDx;
    elements.advance(best);
    report.iterations.back().stepLength = best;
  }
}

/// Forces between fixed nodes that balance at every free node and gain more than the limits allow prove that nothing
/// keeps them; who bears the largest of these forces is who contradicts whom.
void ConeProgram::Implementation::explainContradiction(const Positions& forces, ConeSolution& solution) const {
  elements.report(solution);
  const auto largestFirst = [](const Eigen::VectorXd& sizes) {
    std::vector<int> order(sizes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return sizes[a] > sizes[b]; });
    const double least = 0.01 * sizes.maxCoeff();
    std::erase_if(order, [&](int i) { return sizes[i] <= least; });
    return order;
  };
  solution.conflictingElements = largestFirst(solution.multipliers.topRows(2).colwise().sum().transpose());
  Eigen::VectorXd pull = forces.colwise().norm();
  for (const int node : nodeOfVertex) pull[node] = 0;
  solution.conflictingNodes = largestFirst(pull);
}

ConeProgram::ConeProgram(ConeConstraints constraints)
    : implementation_(std::make_unique<Implementation>(std::move(constraints))) {}
ConeProgram::~ConeProgram() = default;
ConeProgram::ConeProgram(ConeProgram&&) noexcept = default;
const ConeConstraints& ConeProgram::constraints() const { return implementation_->constraints; }
void ConeProgram::reset() {
  implementation_->hasMultipliers = false;
  implementation_->lastObjective = 0;
}

ConeSolution ConeProgram::solve(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                const ConeProgramOptions& options, base::ExecutionContext& context) {
  return implementation_->solve(candidate, start, options, context);
}

}  // namespace pliant::solvers
