#include "core/interlock/patch_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/interlock/frictional_rest.hpp"
#include "core/interlock/patch_search.hpp"

namespace pliant::interlock {

namespace {

/// Newton's decrement over the barrier's weight below which elements count as centred between increments.
constexpr double centredBelow = 0.1;
/// What a patch that was locked, and then centred, must gain to be tried again, over what it had.
constexpr double leastProgress = 0.01;

}  // namespace

std::vector<PointLoad> weightsOf(const UnitCell& patch, double density, const Eigen::Vector3d& gravity) {
  std::vector<BodyMass> masses;
  for (const ElementShape& shape : patch.shapes) masses.push_back(bodyMass(shape));
  std::vector<PointLoad> loads;
  for (std::size_t i = 0; i < patch.elements.size(); ++i) {
    const BodyMass& mass = masses[patch.elements[i].shape];
    loads.push_back({static_cast<int>(i), density * mass.volume * gravity, mass.centre});
  }
  return loads;
}

PatchSolver::PatchSolver(const UnitCell& patch, const EquilibriumOptions& options)
    : contact_(patch),
      options_(options),
      linkFinder_(contact_),
      links_(linkFinder_.linksAt(restState(patch)).value_or(std::vector<Link>{})),
      radius_(patch.smallestRadius()),
      extent_(0) {
  for (const InterlockingElement& element : patch.elements) extent_ = std::max(extent_, element.position.norm());
}

CellEquilibrium PatchSolver::checked(const CellState& start, const std::function<CellEquilibrium()>& run) const {
  CellEquilibrium result;
  const auto fail = [&](const std::string& message) {
    result.state = start;
    result.termination = base::TerminationType::failed;
    result.message = message;
    return result;
  };
  if (!(contact_.smallestGap(start, radius_) > 0)) return fail("elements overlap in the state to start from");
  if (linkFinder_.linksAt(start) != links_)
    return fail("elements are not linked in the state to start from as at rest");
  result = run();
  if (linkFinder_.linksAt(result.state) != links_) return fail("a linking number changed on the way");
  return result;
}

CellEquilibrium PatchSolver::solve(const CellState& start, const PatchLoads& loads,
                                   const base::ExecutionContext* context) const {
  const int count = static_cast<int>(patch().elements.size());
  const auto check = [&](int element) {
    if (element < 0 || element >= count)
      throw base::InputError("", "element " + std::to_string(element) +
                                     " is to be loaded or clamped, but the patch has " + std::to_string(count));
  };
  for (const PointLoad& load : loads.forces) check(load.element);
  for (const int element : loads.clamped) check(element);
  return checked(start, [&] {
    if (options_.friction == 0) return PatchSearch(*this, start, loads, context).run(options_);
    return restWithFriction(contact_, start, options_, radius_, extent_, [&](const CellState& state) {
      return std::make_unique<PatchSearch>(*this, state, loads, context);
    });
  });
}

CellEquilibrium PatchSolver::bend(const CellState& start, const StrainDrive& drive,
                                  const base::ExecutionContext* context) const {
  return bendInSteps(start, drive, 0, context);
}

CellEquilibrium PatchSolver::bendInSteps(const CellState& start, const StrainDrive& drive, double increment,
                                         const base::ExecutionContext* context) const {
  return checked(start, [&] {
    EquilibriumOptions options = options_, loose = options_;
    CellState state = start;
    StrainDrive rest;  // of the way
    int iterations = 0;
    const auto remaining = [&] {
      rest = drive;
      rest.farthest -= drive.load.dot(state.strain - start.strain);
      return rest.farthest;
    };
    if (increment > 0) {
      loose.finalGap = std::max(loose.firstGap, loose.finalGap);
      StrainDrive still;
      still.directions.resize(3, 0);
      const auto travelled = [&] { return drive.load.dot(state.strain - start.strain); };
      double lockedAt = -std::numeric_limits<double>::infinity();
      while (true) {
        state = PatchSearch(*this, state, still, context).relax(loose, centredBelow);
        const double outermost = state.positions.topRows<2>().colwise().norm().maxCoeff();
        const double step = drive.load.norm() * 2 * increment * radius_ / (outermost * outermost);
        if (remaining() <= step) break;
        rest.farthest = step;
        CellEquilibrium next = PatchSearch(*this, state, rest, context).run(loose);
        iterations += next.iterations;
        if (!next.converged() || next.kind == RestKind::unlimited) {
          next.iterations = iterations;
          return next;
        }
        state = next.state;
        if (next.kind == RestKind::reached) continue;
        // Centred once more it may go on, if it only was jammed.
        if (travelled() <= lockedAt + leastProgress * std::abs(lockedAt)) {
          options.firstGap = std::min(options.firstGap, 0.01);  // about what is left
          break;
        }
        lockedAt = travelled();
      }
    }
    remaining();
    CellEquilibrium result = PatchSearch(*this, state, rest, context).run(options);
    result.iterations += iterations;
    return result;
  });
}

CellState PatchSolver::relaxed(const CellState& state) const {
  StrainDrive drive;
  drive.directions.resize(3, 0);
  return PatchSearch(*this, state, drive, nullptr).relax(options_);
}

CellState PatchSolver::perturbed(const CellState& state, double amplitude, unsigned seed) const {
  const PatchSearch search(*this, state, StrainDrive{}, nullptr);
  return perturbedState(contact_, state, radius_, amplitude, seed, [&](Eigen::VectorXd velocity, double step) {
    // Neither the mean origin moves nor the patch as a whole turns about its axis.
    const auto count = static_cast<Eigen::Index>(patch().elements.size());
    Eigen::Vector2d mean = Eigen::Vector2d::Zero(), place;
    double moment = 0, inertia = 0;
    for (Eigen::Index i = 0; i < count; ++i) mean += velocity.segment<2>(6 * i) / static_cast<double>(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      velocity.segment<2>(6 * i) -= mean;
      place = patch().elements[i].position.head<2>();
      moment += place.x() * velocity[6 * i + 1] - place.y() * velocity[6 * i];
      inertia += place.squaredNorm();
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      place = patch().elements[i].position.head<2>();
      velocity.segment<2>(6 * i) -= moment / inertia * Eigen::Vector2d(-place.y(), place.x());
    }
    return search.advanced(state, velocity, step);
  });
}

}  // namespace pliant::interlock
