#include "core/interlock/element_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/interlock/holding_contacts.hpp"
#include "core/interlock/limit_sensitivity.hpp"
#include "core/interlock/parameter_terms.hpp"
#include "core/math/parallel.hpp"

namespace pliant::interlock {

namespace {

using Eigen::VectorXd;

/// Of the smallest radius: gaps at rest that are larger than the clearance by more have no part in a step.
constexpr double watchedGap = 4;
constexpr std::size_t mostGaps = 60;

/// One rate a number; where there is none, or the number is locked, an empty one.
struct Rates {
  std::vector<CellRate> known;
  std::vector<Eigen::Index> columns;
};

Rates ratesOf(const ElementDesignProblem& problem, const VectorXd& values) {
  std::vector<std::optional<CellRate>> all(static_cast<std::size_t>(values.size()));
  math::parallelFor(static_cast<int>(values.size()), [&](int i) {
    if (problem.lower[i] < problem.upper[i])
      all[static_cast<std::size_t>(i)] = rateOf(problem.build, values, i, problem.steps[i]);
  });
  Rates rates;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i]) continue;
    rates.known.push_back(std::move(*all[i]));
    rates.columns.push_back(static_cast<Eigen::Index>(i));
  }
  return rates;
}

void measureRest(const ElementDesignProblem& problem, const CellContact& contact, const Rates& rates,
                 Eigen::Index count, ElementEvaluation& result) {
  const double radius = contact.cell().smallestRadius(), range = problem.clearance + watchedGap * radius;
  auto near = distinctContacts(holdingContacts(contact, restState(contact.cell()), range), radius);
  result.clearance = near.empty() ? range : near.front().gap;
  if (near.size() > mostGaps) near.resize(mostGaps);
  result.gaps.resize(static_cast<Eigen::Index>(near.size()));
  result.gapSlopes.setZero(result.gaps.size(), count);
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    result.gaps[row] = near[i].gap;
    const VectorXd slopes = gapRateAtRest(contact, near[i].pair, rates.known);
    for (std::size_t k = 0; k < rates.columns.size(); ++k)
      result.gapSlopes(row, rates.columns[k]) = slopes[static_cast<Eigen::Index>(k)];
  }
}

/// The farthest of some tries.
CellEquilibrium farthestRest(const ElementDesignProblem& problem, const CellSolver& solver, const StrainDrive& drive,
                             base::ExecutionContext& context) {
  const CellState rest = restState(solver.contact().cell());
  CellEquilibrium best;
  for (int trial = 0; trial < std::max(1, problem.trials); ++trial) {
    const unsigned seed = problem.seed + static_cast<unsigned>(trial);
    const CellState start = problem.perturbation > 0 ? solver.perturbed(rest, problem.perturbation, seed) : rest;
    CellEquilibrium next = solver.solve(start, drive, &context);
    const bool farther = drive.load.dot(next.state.strain) > drive.load.dot(best.state.strain);
    if (trial == 0 || (next.converged() && (farther || !best.converged()))) best = std::move(next);
  }
  return best;
}

}  // namespace

ElementEvaluation evaluateRest(const ElementDesignProblem& problem, const VectorXd& values) {
  ElementEvaluation result;
  try {
    const CellContact contact(problem.build(values));
    checkCellGeometry(contact.cell());
    if (!(contact.smallestGap(restState(contact.cell()), contact.cell().smallestRadius()) > 0)) {
      result.problem = "elements overlap at rest";
      return result;
    }
    measureRest(problem, contact, ratesOf(problem, values), values.size(), result);
    result.valid = true;
  } catch (const base::InputError& error) {
    result.problem = error.problem();
  }
  return result;
}

ElementEvaluation evaluateElement(const ElementDesignProblem& problem, const VectorXd& values,
                                  std::vector<CellContact::Barrier>& barriers, base::ExecutionContext& context) {
  ElementEvaluation result;
  try {
    const UnitCell cell = problem.build(values);
    checkCell(cell);
    const CellSolver solver(cell, problem.equilibrium);
    const Rates rates = ratesOf(problem, values);
    measureRest(problem, solver.contact(), rates, values.size(), result);
    const std::size_t count = problem.goals.size();
    barriers.resize(count, {0, 0, 1});
    result.limits.setConstant(static_cast<Eigen::Index>(count), std::numeric_limits<double>::quiet_NaN());
    result.slopes.setZero(static_cast<Eigen::Index>(count), values.size());
    std::vector<std::string> problems(count);
    std::vector<int> kinks(count, 0);
    math::parallelFor(static_cast<int>(count), [&](int i) {
      const auto index = static_cast<std::size_t>(i);
      if (context.cancelRequested()) {
        problems[index] = "cancelled";
        return;
      }
      const LimitGoal& goal = problem.goals[index];
      const CellEquilibrium rest = farthestRest(problem, solver, goal.drive, context);
      if (!rest.converged()) {
        problems[index] = "limit " + std::to_string(i) + " was not found: " + rest.message;
        return;
      }
      if (rest.kind != RestKind::locked) {
        if (goal.kind == LimitGoal::Kind::atLeast)
          result.limits[i] = std::numeric_limits<double>::infinity();
        else
          problems[index] = "nothing limits the deformation of limit " + std::to_string(i);
        return;
      }
      CellContact::Barrier& barrier = barriers[index];
      const LimitSensitivity own = limitSensitivity(
          solver, rest.state, goal.drive, rates.known, barrier.range > 0 ? &barrier : nullptr, &context);
      const bool settled = own.kind != LimitSensitivity::Kind::unsettled;
      if (!(barrier.range > 0) && settled) barrier = own.barrier;
      result.limits[i] = settled ? own.value : goal.drive.load.dot(rest.state.strain);
      if (own.kind != LimitSensitivity::Kind::smooth) kinks[index] = 1;
      // Where nothing settles the contacts' forces still tell how the optimum changes.
      const VectorXd& slopes = settled ? own.slopes : own.envelope;
      for (std::size_t k = 0; k < rates.columns.size(); ++k) {
        const double slope = slopes[static_cast<Eigen::Index>(k)];
        result.slopes(i, rates.columns[k]) = std::isfinite(slope) ? slope : 0;
      }
    });
    for (const int kink : kinks) result.kinks += kink;
    for (const std::string& each : problems)
      if (!each.empty()) {
        result.problem = each;
        return result;
      }
    result.valid = true;
  } catch (const base::InputError& error) {
    result.problem = error.problem();
  }
  return result;
}

}  // namespace pliant::interlock
