#pragma once

#include "core/base/execution_context.hpp"
#include "core/solvers/cone_program.hpp"

namespace pliant::solvers {

/// Why the projection of `candidate` from `start` failed: looks for proof that nothing keeps the limits. `followed`:
/// the start after its fixed nodes went where the candidate has them and took the others along, stretched to
/// `followedStretch` times the limits. Returns `failed` with a message, or, with proof, an "infeasible" solution that
/// names the elements and fixed nodes that contradict each other (see ConeSolution).
ConeSolution explainFailure(const ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate,
                            const Eigen::Matrix3Xd& start, const Eigen::Matrix3Xd& followed, double followedStretch,
                            const ConeProgramOptions& options, base::ExecutionContext& context, ConeSolution failed);

}  // namespace pliant::solvers
