#include "core/cloth/contact_projection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/cone_certificate.hpp"
#include "core/solvers/cone_elements.hpp"

namespace pliant::cloth {

using base::TerminationType;
using Positions = Eigen::Matrix3Xd;

namespace {

constexpr double barrierReduction = 0.2;
constexpr double firstBarrier = 1;  ///< times the objective over the number of bounds
/// Newton's method moves on to the next barrier when what is left to gain is this part of what one bound costs: only
/// then is every one of them where this barrier wants it.
constexpr double centred = 0.1;
constexpr double finallyCentred = 1e-6;
constexpr double smallestSlack = 1e-9;
constexpr double largestInertia = 1e20;
constexpr int mostNewtonSteps = 60;  ///< for one barrier
constexpr int mostMoves = 200;       ///< of bodies and held nodes, each as far as nothing is in the way
constexpr double leastMove = 1e-6;   ///< a shorter one counts as stuck
constexpr int mostStuck = 10;
constexpr int stepsBetweenMoves = 20;  ///< with which the sheet gets out of the way
constexpr double armijo = 1e-4;
constexpr double drownedGain = 1e-12;  ///< of the value

}  // namespace

struct ContactProjection::Implementation {
  Implementation(solvers::ConeConstraints given, std::shared_ptr<mechanics::ContactBarrier> barrier)
      : constraints(std::move(given)), contact(std::move(barrier)), vertexOfNode(constraints.nodeCount, -1) {
    for (int node = 0; node < constraints.nodeCount; ++node)
      if (!constraints.fixed[node]) {
        vertexOfNode[node] = static_cast<int>(nodeOfVertex.size());
        nodeOfVertex.push_back(node);
      }
    for (const solvers::ConeElement& element : constraints.elements)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < a; ++b) addPair(element.nodes[a], element.nodes[b]);
  }

  /// True if it is new.
  bool addPair(int a, int b) {
    const int p = vertexOfNode[a], q = vertexOfNode[b];
    return p >= 0 && q >= 0 && p != q && pairs.insert({std::max(p, q), std::min(p, q)}).second;
  }

  /// The contacts' blocks at the last update, with room for them in the factors.
  void layOut() {
    blocks.clear();
    contact->addHessian(blocks);
    bool grown = !cholesky.has_value();
    for (const mechanics::ContactBlock& block : blocks) grown |= addPair(block.row, block.column);
    if (!grown) return;
    cholesky.emplace(
        static_cast<int>(nodeOfVertex.size()), std::vector<std::array<int, 2>>(pairs.begin(), pairs.end()));
    elements.emplace(constraints, vertexOfNode, *cholesky);
  }

  Positions withBodies(const Positions& x) const {
    Positions all(3, x.cols() + bodies.cols());
    all << x, bodies;
    return all;
  }

  double distance(const Positions& x) const {
    return 0.5 * ((x - *candidate).colwise().squaredNorm() * constraints.masses).value();
  }

  /// The function that Newton's method minimises; infinite where it must not go. Updates the contacts.
  double value(const Positions& x, double barrier) {
    const double logarithms = elements->centre(x, barrier);
    if (!std::isfinite(logarithms)) return std::numeric_limits<double>::infinity();
    contact->update(withBodies(x));
    return distance(x) + contact->value() * scale - barrier * logarithms;
  }

  /// The Hessian with `inertia` times the masses, and the limits' forces.
  bool factorize(const Positions& x, double inertia, Positions& forces) {
    Positions ignored = Positions::Zero(3, x.cols());
    forces.setZero();
    cholesky->clear();
    elements->linearize(x, forces, ignored, *cholesky);
    double* values = cholesky->values();
    for (const mechanics::ContactBlock& block : blocks) {
      const int p = vertexOfNode[block.row], q = vertexOfNode[block.column];
      if (p < 0 || q < 0) continue;
      const auto place = cholesky->place(p, q);
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          values[place.offset + Eigen::Index{j} * place.stride + i] +=
              scale * (place.transposed ? block.entry(j, i) : block.entry(i, j));
    }
    for (std::size_t v = 0; v < nodeOfVertex.size(); ++v) {
      const auto place = cholesky->place(static_cast<int>(v), static_cast<int>(v));
      for (int i = 0; i < 3; ++i)
        values[place.offset + Eigen::Index{i} * (place.stride + 1)] += inertia * constraints.masses[nodeOfVertex[v]];
    }
    return cholesky->factorize();
  }

  /// One Newton step with line search from `x`, whose value is `energy`. Returns half the squared decrement (0 if
  /// it drowns in rounding), or nothing if no step lowers the value.
  std::optional<double> newtonStep(Positions& x, double barrier, double& energy) {
    layOut();
    elements->centre(x, barrier);
    const Eigen::Index nodes = constraints.nodeCount;
    Positions forces(3, nodes), push = Positions::Zero(3, nodes);
    // Very near to a limit the barrier is so stiff that the matrix loses its small eigenvalues to rounding; more
    // inertia keeps them, and the step still leads away from the limit.
    double inertia = 1;
    while (!factorize(x, inertia, forces)) {
      inertia *= 1e3;
      if (inertia > largestInertia) return std::nullopt;
    }
    contact->addGradient(push);
    Eigen::VectorXd unknowns(3 * static_cast<Eigen::Index>(nodeOfVertex.size()));
    Positions gradient = (x - *candidate) * constraints.masses.asDiagonal();
    gradient += forces + scale * push;
    for (std::size_t v = 0; v < nodeOfVertex.size(); ++v)
      unknowns.segment<3>(3 * static_cast<Eigen::Index>(v)) = -gradient.col(nodeOfVertex[v]);
    const Eigen::VectorXd right = unknowns;
    cholesky->solve(unknowns);
    const double decrement = right.dot(unknowns);
    Positions dx = Positions::Zero(3, nodes);
    for (std::size_t v = 0; v < nodeOfVertex.size(); ++v)
      dx.col(nodeOfVertex[v]) = unknowns.segment<3>(3 * static_cast<Eigen::Index>(v));
    Positions motion = Positions::Zero(3, nodes + bodies.cols());
    motion.leftCols(nodes) = dx;
    double step = contact->largestStep(withBodies(x), motion);
    for (int attempt = 0; attempt < 40; ++attempt, step *= 0.5) {
      const Positions trial = x + step * dx;
      const double trialEnergy = value(trial, barrier);
      if (trialEnergy <= energy - armijo * step * decrement) {
        x = trial;
        energy = trialEnergy;
        return 0.5 * decrement;
      }
    }
    // What is left to gain may drown in the rounding of the value.
    const bool drowned = decrement <= drownedGain * std::abs(energy);
    energy = value(x, barrier);  // and the contacts as they are at x
    return drowned ? std::optional<double>(0) : std::nullopt;
  }

  /// Moves bodies and held nodes on, and the sheet out of their way. False if they get stuck.
  bool moveKinematic(Positions& x, const Positions& bodiesTo, double barrier, base::ExecutionContext& context) {
    int stuck = 0;
    for (int move = 0; move < mostMoves; ++move) {
      const Eigen::Index nodes = constraints.nodeCount;
      Positions motion = Positions::Zero(3, nodes + bodies.cols());
      for (int node = 0; node < constraints.nodeCount; ++node)
        if (constraints.fixed[node]) motion.col(node) = candidate->col(node) - x.col(node);
      motion.rightCols(bodies.cols()) = bodiesTo - bodies;
      if (motion.isZero(0)) return true;
      if (context.cancelRequested()) return false;
      // Half of what is possible: from very small gaps Newton's method comes back only by a factor of two a step.
      double step = contact->largestStep(withBodies(x), motion);
      if (step < 1) step *= 0.5;
      while (step > leastMove && !std::isfinite(elements->centre(x + step * motion.leftCols(nodes), barrier)))
        step *= 0.5;
      if (step <= leastMove) {
        if (++stuck > mostStuck) return false;  // the sheet does not get out of the way any more
      } else if (step == 1) {
        for (int node = 0; node < constraints.nodeCount; ++node)
          if (constraints.fixed[node]) x.col(node) = candidate->col(node);
        bodies = bodiesTo;
      } else {
        x += step * motion.leftCols(nodes);
        bodies += step * motion.rightCols(bodies.cols());
      }
      double energy = value(x, barrier);
      for (int k = 0; k < stepsBetweenMoves; ++k) {
        const std::optional<double> decrement = newtonStep(x, barrier, energy);
        if (!decrement || *decrement <= centred * barrier) break;
      }
    }
    return false;
  }

  const solvers::ConeConstraints constraints;
  std::shared_ptr<mechanics::ContactBarrier> contact;
  std::vector<int> vertexOfNode, nodeOfVertex;
  std::set<std::array<int, 2>> pairs;
  std::optional<math::BlockCholesky> cholesky;
  std::optional<solvers::ConeElements> elements;
  std::vector<mechanics::ContactBlock> blocks;
  const Positions* candidate = nullptr;
  Positions bodies;
  double scale = 1;  ///< of the contact energy: 1 / rate²
};

ContactProjection::ContactProjection(solvers::ConeConstraints constraints,
                                     std::shared_ptr<mechanics::ContactBarrier> contact)
    : implementation_(std::make_unique<Implementation>(std::move(constraints), std::move(contact))) {}
ContactProjection::~ContactProjection() = default;

solvers::ConeSolution ContactProjection::project(const Positions& candidate, const Positions& start,
                                                 const ContactMotion& motion, double rate,
                                                 const solvers::ConeProgramOptions& options,
                                                 base::ExecutionContext& context, Positions* reached) {
  const base::Stopwatch stopwatch;
  Implementation& own = *implementation_;
  solvers::ConeSolution solution;
  base::SolverReport& report = solution.report;
  own.candidate = &candidate;
  own.bodies = motion.bodiesFrom;
  own.scale = 1 / (rate * rate);
  Positions& x = solution.positions;
  x = start;
  own.contact->update(own.withBodies(x));
  own.layOut();
  if (!std::isfinite(own.elements->centre(x, 1)))
    throw base::InputError("", "A projection with contact must start inside the stretch limits.");
  if (!std::isfinite(own.contact->value()))
    throw base::InputError("", "A projection with contact must start without contact.");

  // What each bound may cost at first: a part of what the projection is about.
  const int bounds = std::max(1, own.elements->boundCount());
  const double size = (candidate.rowwise().maxCoeff() - candidate.rowwise().minCoeff()).norm();
  const double least = options.absoluteGap * own.constraints.masses.sum() * size * size;
  double barrier = std::max(firstBarrier * own.distance(x), least) / bounds;
  const auto finish = [&](TerminationType termination, const char* message) {
    // The contact forces as they are make a convex problem, of which this is the solution.
    own.contact->update(own.withBodies(x));
    own.elements->centre(x, barrier);
    own.elements->report(solution);
    Positions push = Positions::Zero(3, x.cols());
    own.contact->addGradient(push);
    for (int node = 0; node < own.constraints.nodeCount; ++node)
      push.col(node) *= own.constraints.fixed[node] ? 0 : own.scale / own.constraints.masses[node];
    solvers::certify(own.constraints, candidate - push, solution);
    const double gap = solution.gap();  // of that problem; the objective is reported of this one
    solution.objective = own.distance(x);
    solution.bound = solution.objective - gap;
    report.termination = termination;
    report.message = message;
    report.seconds = stopwatch.seconds();
    if (reached) *reached = own.bodies;
    return solution;
  };

  if (!own.moveKinematic(x, motion.bodiesTo, barrier, context)) {
    if (context.cancelRequested()) return finish(TerminationType::cancelled, "The projection was cancelled.");
    return finish(TerminationType::failed,
                  "A body or a held node cannot get on without breaking a stretch limit or going through the cloth.");
  }
  // The candidate may be its own projection.
  Positions ahead = Positions::Zero(3, x.cols() + own.bodies.cols());
  ahead.leftCols(x.cols()) = candidate - x;
  if (std::isfinite(own.elements->centre(candidate, barrier)) &&
      own.contact->largestStep(own.withBodies(x), ahead) == 1) {
    own.contact->update(own.withBodies(candidate));
    if (own.contact->value() == 0) {
      x = candidate;
      barrier = 0;
      report.iterations.push_back({});
      return finish(TerminationType::converged, "");
    }
  }
  int iteration = 0;
  while (true) {
    // Nearer to the limits the next step could not start: the barrier's Hessian would lose all digits.
    const bool last = barrier * bounds <= std::max(options.relativeGap * own.distance(x), least) ||
                      own.elements->smallestSlack() < smallestSlack;
    const double enough = (last ? finallyCentred : centred) * barrier;
    double energy = own.value(x, barrier);
    bool reachedEnough = false;
    for (int k = 0; k < mostNewtonSteps && !reachedEnough; ++k) {
      if (context.cancelRequested()) return finish(TerminationType::cancelled, "The projection was cancelled.");
      const std::optional<double> decrement = own.newtonStep(x, barrier, energy);
      report.iterations.push_back({iteration++, barrier * bounds / std::max(own.distance(x), least), 1, 0});
      if (!decrement) break;
      reachedEnough = *decrement <= enough;
    }
    // Where all bounds are centred, they cost `barrier` each.
    if (last) {
      // What decides is the certificate; beside the bounds' costs it counts the forces that are not balanced.
      finish(TerminationType::converged, "");
      if (std::abs(solution.gap()) > 2 * std::max(options.relativeGap * solution.objective, least)) {
        report.termination = TerminationType::iterationLimit;
        report.message = "The projection keeps limits and contact, but it is not as near to the candidate as asked.";
      }
      return solution;
    }
    if (iteration >= 20 * options.maximumIterations)
      return finish(TerminationType::iterationLimit, "The projection with contact did not converge.");
    barrier *= barrierReduction;
  }
}

}  // namespace pliant::cloth
