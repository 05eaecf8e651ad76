#include "core/interlock/cell_equilibrium.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/interlock/equilibrium_search.hpp"
#include "core/interlock/frictional_rest.hpp"
#include "core/interlock/swept_contact.hpp"

namespace pliant::interlock {

using base::TerminationType;
using Eigen::VectorXd;

EquilibriumOptions withLooserGaps(EquilibriumOptions options) {
  options.finalGap = std::max(options.finalGap, 1e-2);
  return options;
}

CellSolver::CellSolver(const UnitCell& cell, const EquilibriumOptions& options)
    : contact_(cell),
      options_(options),
      linkFinder_(contact_),
      links_(linkFinder_.linksAt(restState(cell)).value_or(std::vector<Link>{})),
      radius_(cell.smallestRadius()),
      latticeScale_(std::sqrt(std::abs(cell.lattice.determinant()))) {}

CellEquilibrium CellSolver::solve(const CellState& start, const StrainDrive& drive,
                                  const base::ExecutionContext* context) const {
  CellEquilibrium result;
  const auto fail = [&](const std::string& message) {
    result.state = start;
    result.termination = TerminationType::failed;
    result.message = message;
    return result;
  };
  if (!(contact_.smallestGap(start, radius_) > 0)) return fail("elements overlap in the state to start from");
  if (linkFinder_.linksAt(start) != links_)
    return fail("elements are not linked in the state to start from as at rest");
  if (options_.friction > 0) {
    StrainDrive rest = drive;
    result = restWithFriction(contact_, start, options_, radius_, latticeScale_, [&](const CellState& state) {
      rest.farthest = drive.farthest - drive.load.dot(state.strain - start.strain);
      return std::make_unique<EquilibriumSearch>(*this, state, rest, context);
    });
  } else {
    result = EquilibriumSearch(*this, start, drive, context).run(options_);
  }
  if (linkFinder_.linksAt(result.state) != links_) return fail("a linking number changed on the way");
  return result;
}

CellState CellSolver::relaxed(const CellState& state) const {
  StrainDrive drive;
  drive.directions.resize(3, 0);
  return EquilibriumSearch(*this, state, drive, nullptr).relax(options_);
}

CellState perturbedState(const CellContact& contact, const CellState& state, double radius, double amplitude,
                         unsigned seed, const std::function<CellState(const VectorXd&, double)>& move) {
  std::mt19937 random(seed);
  VectorXd velocity = VectorXd::Zero(contact.coordinateCount());
  for (Eigen::Index i = 0; i < velocity.size() - 3; ++i) {
    const int element = static_cast<int>(i / 6);
    const double scale = i % 6 < 3 ? radius : radius / contact.partsOf(element).reach();
    velocity[i] = scale * (2 * (random() / 4294967296.0) - 1);
  }
  const double reach = 2 * radius, gap = contact.smallestGap(state, reach);
  for (double step = amplitude; step > 1e-9 * amplitude; step *= 0.5) {
    CellState next = move(velocity, step);
    // Far less than what could take one element through another.
    const bool near = contact.hasThinPieces() ? 2 * farthestMove(contact, state, next) < gap : step <= 0.1;
    if (near && contact.smallestGap(next, reach) >= 0.5 * gap) return next;
  }
  return state;
}

CellState CellSolver::perturbed(const CellState& state, double amplitude, unsigned seed) const {
  return perturbedState(contact_, state, radius_, amplitude, seed,
                        [&](const VectorXd& velocity, double step) { return moved(state, velocity, step); });
}

}  // namespace pliant::interlock
