#include "core/solvers/cone_program.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/cone_contradiction.hpp"
#include "core/solvers/cone_elements.hpp"
#include "core/solvers/cone_history.hpp"
#include "core/solvers/cone_objective.hpp"

namespace pliant::solvers {

namespace {

/// Fraction of the way to the boundary of the cones.
constexpr double stepFraction = 0.99;
/// The target of an iteration is the power of what the predictor would leave of the complementarity. Corrections reach
/// farther than the predictor, so it is higher than the usual 3.
constexpr double targetPower = 5;
constexpr double targetOfTolerance = 0.1;
/// The first target, by the objective over the number of bounds.
constexpr double coldBarrier = 10;
constexpr double warmBarrier = 3;
/// Corrections of one predictor of both kinds, and the step length with which nothing is left to gain by more of them.
constexpr int mostCorrections = 4;
constexpr int mostCentralisings = 3;
constexpr double longEnough = 0.95;
constexpr double smallestGain = 0.02;
constexpr double shortStep = 0.2;
/// So many steps so short in succession: the start was bad, or there is nothing that keeps the limits.
constexpr double stallingStep = 0.05;
constexpr int mostStalls = 3;
constexpr int mostRestarts = 2;  ///< with a larger barrier

constexpr double largestInertia = 1e8;

}  // namespace

struct ConeProgram::Implementation {
  Implementation(ConeConstraints given, ConeStiffness stiffness)
      : constraints(checked(std::move(given))),
        vertexOfNode(constraints.nodeCount, -1),
        vertexCount(numberVertices()),
        couplings(pairs(stiffness)),
        objective(constraints, vertexOfNode, std::move(stiffness), couplings),
        cholesky(vertexCount, couplings),
        elements(constraints, vertexOfNode, cholesky) {}

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

  std::vector<std::array<int, 2>> pairs(const ConeStiffness& stiffness) const {
    std::vector<std::array<int, 2>> list;
    for (const ConeElement& element : constraints.elements)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < a; ++b) {
          const int i = vertexOfNode[element.nodes[a]], j = vertexOfNode[element.nodes[b]];
          if (i >= 0 && j >= 0) list.push_back({i, j});
        }
    for (std::size_t s = 0; s < stiffness.rows.size(); ++s) {
      const int i = vertexOfNode[stiffness.rows[s] / 3], j = vertexOfNode[stiffness.columns[s] / 3];
      if (i >= 0 && j >= 0 && i != j && stiffness.rows[s] % 3 == 0 && stiffness.columns[s] % 3 == 0)
        list.push_back({i, j});
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

  /// Where fixed nodes have moved since the start, lets the others follow them smoothly (a harmonic displacement), lest
  /// the elements between be drawn out to many times their limit.
  void followFixedNodes(const Positions& start, double stiffness, Positions& x, Positions& displacement) {
    displacement = x - start;
    if (displacement.isZero(0)) return;
    Positions forces = Positions::Zero(3, constraints.nodeCount);
    cholesky.clear();
    elements.addLaplacian(stiffness, displacement, forces, cholesky);
    objective.addTo(cholesky, 1);
    if (cholesky.factorize()) {
      solve(-forces, displacement);
      x = start + displacement;
    }
    displacement.setZero();
  }

  ConeSolution solve(const Positions& candidate, const Positions& start, const ConeProgramOptions& options,
                     base::ExecutionContext& context);

  ConeConstraints constraints;
  std::vector<int> vertexOfNode;
  std::vector<int> nodeOfVertex;
  int vertexCount;
  std::vector<std::array<int, 2>> couplings;  ///< pairs of vertices
  ConeObjective objective;
  math::BlockCholesky cholesky;
  ConeElements elements;

  Eigen::VectorXd unknowns;
  ConeHistory history;
};

ConeSolution ConeProgram::Implementation::solve(const Positions& candidate, const Positions& start,
                                                const ConeProgramOptions& options, base::ExecutionContext& context) {
  const base::Stopwatch stopwatch;
  const int nodes = constraints.nodeCount;
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
    return solution;
  }

  const Eigen::Vector3d low = candidate.rowwise().minCoeff(), high = candidate.rowwise().maxCoeff();
  const double size = (high - low).norm(), totalMass = constraints.masses.sum();
  const double absoluteGap = options.absoluteGap * totalMass * size * size;
  Positions forces(3, nodes), predictorForces(3, nodes), correctedForces(3, nodes), dx = Positions::Zero(3, nodes);
  Positions keptDx = dx, gradient(3, nodes), right(3, nodes);
  followFixedNodes(start, totalMass * size * size, x, dx);
  const auto objectiveAt = [&](const Positions& at) {
    right = at - candidate;
    objective.multiply(right, gradient);
    return 0.5 * (right.array() * gradient.array()).sum();
  };

  // The objective is about that of the last problem, or far below the distance from here. One that is guessed too small
  // leads into corners.
  const double distance = std::max(objectiveAt(x), absoluteGap), last = history.lastObjective();
  const double expected = last > 0 ? std::clamp(last, 1e-4 * distance, distance) : distance;
  const std::optional<ConeHistory::Match> match =
      options.warmStart ? history.bestFor(elements, objective, x, candidate) : std::nullopt;
  if (match) elements.setMultipliers(*match->multipliers, match->factor);
  double barrier0 = (match ? warmBarrier : coldBarrier) * expected / std::max(1, elements.boundCount());
  elements.start(x, barrier0, match.has_value());
  const Positions x0 = x;
  const double stretch0 = elements.largestStretch(x0);
  int restarts = 0;

  const auto finish = [&](base::TerminationType termination, std::string message) {
    report.termination = termination;
    report.message = std::move(message);
    report.seconds = stopwatch.seconds();
    elements.report(solution);
    if (report.converged()) history.remember(elements.multipliers(), solution.objective);
    return solution;
  };

  int stalled = 0;
  for (int iteration = 0;; ++iteration) {
    forces.setZero();
    predictorForces.setZero();
    cholesky.clear();
    const ConeElements::Linearization at = elements.linearize(x, forces, predictorForces, cholesky);
    solution.objective = objectiveAt(x);
    right = gradient + forces;  // the residual
    double largestResidual = 0, largestGradient = 0;
    for (const int node : nodeOfVertex) {
      largestResidual = std::max(largestResidual, right.col(node).cwiseAbs().maxCoeff());
      largestGradient = std::max(largestGradient, gradient.col(node).cwiseAbs().maxCoeff());
    }
    // P - D, without the cancellation that computing D first would have.
    const double gap = 0.5 * objective.inverseNorm(right) + at.supportGap;
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
    for (objective.addTo(cholesky, inertia); !cholesky.factorize(); objective.addTo(cholesky, inertia)) {
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
      // What is far below the gap that is asked for would but cost digits.
      const double enough = targetOfTolerance * std::max(options.relativeGap * solution.objective, absoluteGap) /
                            std::max(1, elements.boundCount());
      target = std::max(std::pow(ratio, targetPower) * barrier, std::min(barrier, enough));
    }
    double best = 0;
    const auto tryDirection = [&] {
      right = -(gradient + correctedForces);
      solve(right, dx);
      const double step = std::min(1.0, stepFraction * elements.direct(dx));
      if (best > 0 && step < best + smallestGain) return false;
      best = step;
      keptDx = dx;
      elements.keepDirection();
      return best <= longEnough;
    };
    const auto tryCorrection = [&](double towards, double weight) {
      correctedForces.setZero();
      elements.correct(towards, weight, correctedForces);
      return tryDirection();
    };
    const auto tryCentralising = [&] {
      correctedForces.setZero();
      elements.centralise(target, std::min(1.0, 1.3 * best + 0.1), correctedForces);
      return tryDirection();
    };
    if (closed) {
      tryCorrection(target, 0);
    } else {
      for (int k = 0; k < mostCorrections && tryCorrection(target, 1); ++k) {
      }
      for (int k = 0; best <= longEnough && k < mostCentralisings && tryCentralising(); ++k) {
      }
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
      return explainFailure(constraints, candidate, start, x0, stretch0, options, context, std::move(solution));
    } else {
      return finish(base::TerminationType::failed, "The projection does not get on.");
    }
  }
}

ConeProgram::ConeProgram(ConeConstraints constraints, ConeStiffness stiffness)
    : implementation_(std::make_unique<Implementation>(std::move(constraints), std::move(stiffness))) {}
ConeProgram::~ConeProgram() = default;
ConeProgram::ConeProgram(ConeProgram&&) noexcept = default;

const ConeConstraints& ConeProgram::constraints() const { return implementation_->constraints; }

bool ConeProgram::setStiffness(const Eigen::VectorXd& entries, double inertia) {
  return implementation_->objective.setStiffness(entries, inertia);
}

ConeSolution ConeProgram::solve(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                const ConeProgramOptions& options, base::ExecutionContext& context) {
  return implementation_->solve(candidate, start, options, context);
}

}  // namespace pliant::solvers
