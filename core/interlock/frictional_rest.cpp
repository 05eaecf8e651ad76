#include "core/interlock/frictional_rest.hpp"

#include <algorithm>
#include <string>

#include "core/interlock/friction_step.hpp"
#include "core/interlock/swept_contact.hpp"

namespace pliant::interlock {

namespace {

constexpr int mostIncrements = 300;
constexpr double creep = 1e-3;       // of the length by which steps are measured
constexpr double newContacts = 1.2;  // times the normal forces of the increment before

double normalForces(const std::vector<CellContactForce>& contacts) {
  double sum = 0;
  for (const CellContactForce& each : contacts) sum += each.force;
  return sum;
}

}  // namespace

CellEquilibrium restWithFriction(const CellContact& contact, const CellState& start, const EquilibriumOptions& options,
                                 double length, double strainLength,
                                 const std::function<std::unique_ptr<BarrierDescent>(const CellState&)>& make) {
  EquilibriumOptions tight = options, loose = withLooserGaps(options);
  tight.firstGap = std::min(options.firstGap, loose.finalGap);
  CellState state = start;
  std::vector<CellContactForce> contacts;
  int iterations = 0;
  bool isTight = false;
  for (int increment = 0; increment < mostIncrements; ++increment) {
    CellEquilibrium next;
    const auto run = [&](const CellState& touching, const std::vector<CellContactForce>& pushing) {
      const std::unique_ptr<BarrierDescent> search = make(state);
      const FrictionStep step(contact, state, touching, pushing,
                              {options.friction, creep * length, search->drivingForce() / length, strainLength});
      search->setFriction(&step);
      next = search->run(isTight ? tight : loose);
      iterations += next.iterations;
      next.iterations = iterations;
    };
    run(state, contacts);
    if (next.converged() && normalForces(next.contacts) > newContacts * normalForces(contacts)) {
      // Nothing held the contacts that came about: once more, with them.
      const CellEquilibrium first = next;
      run(first.state, first.contacts);
    }
    // Without contacts it is the drag that stopped it.
    const bool arrived = next.kind == RestKind::unlimited || (next.kind == RestKind::reached && !next.contacts.empty());
    if (!next.converged() || (arrived && isTight)) return next;
    const double moved =
        farthestMove(contact, state, next.state) + strainLength * (next.state.strain - state.strain).norm();
    if (arrived || moved < 2 * creep * length) {
      if (isTight) return next;
      isTight = true;
    }
    state = next.state;
    contacts = next.contacts;
    loose.firstGap = std::min(loose.firstGap, loose.finalGap);
  }
  CellEquilibrium result;
  result.state = state;
  result.contacts = contacts;
  result.iterations = iterations;
  result.termination = base::TerminationType::iterationLimit;
  result.message = "elements still slide after " + std::to_string(mostIncrements) + " increments";
  return result;
}

}  // namespace pliant::interlock
