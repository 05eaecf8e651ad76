#include "core/base/solver_report.hpp"

namespace pliant::base {

std::string_view toString(TerminationType termination) {
  switch (termination) {
    case TerminationType::converged: return "converged";
    case TerminationType::iterationLimit: return "iteration limit";
    case TerminationType::infeasible: return "infeasible";
    case TerminationType::cancelled: return "cancelled";
    case TerminationType::failed: return "failed";
  }
  return "failed";
}

}  // namespace pliant::base
