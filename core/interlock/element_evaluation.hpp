#pragma once

#include <string>

#include "core/interlock/element_design.hpp"

namespace pliant::interlock {

/// What a design knows of one element.
struct ElementEvaluation {
  bool valid = false;
  std::string problem;  ///< one sentence if not valid
  Eigen::VectorXd limits;
  Eigen::MatrixXd slopes;  ///< of the limits, by the numbers; 0 where no rate is known
  int kinks = 0;
  double clearance = 0;       ///< [m]
  Eigen::VectorXd gaps;       ///< at rest, those that may come to count [m]
  Eigen::MatrixXd gapSlopes;  ///< by the numbers
};

/// Gaps at rest nearer than the clearance and four smallest radii, without any limits. Not valid if elements overlap,
/// or nothing can be built.
ElementEvaluation evaluateRest(const ElementDesignProblem& problem, const Eigen::VectorXd& values);
/// All of it; `barriers` are those under which limits are compared: each is filled when it is first needed.
ElementEvaluation evaluateElement(const ElementDesignProblem& problem, const Eigen::VectorXd& values,
                                  std::vector<CellContact::Barrier>& barriers, base::ExecutionContext& context);

}  // namespace pliant::interlock
