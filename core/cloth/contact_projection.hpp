#pragma once

#include <memory>

#include "core/mechanics/contact_barrier.hpp"
#include "core/solvers/cone_program.hpp"

namespace pliant::cloth {

/// Where bodies and held nodes are to move while the sheet is projected.
struct ContactMotion {
  Eigen::Matrix3Xd bodiesFrom, bodiesTo;  ///< 3 x points of the bodies [m]
};

/// The relative gap that steps ask for: the optimum is a local one, and a barrier comes less near than a cone program.
inline constexpr double contactRelativeGap = 1e-5;

/// Projects positions onto stretch limits without letting the sheet through a body or itself: the minimum of
///   ½ ‖x - x̂‖²_M + (contact energy) / rate²   subject to the limits,
/// x̂ the candidate of a step with this rate (see StepTerms). Contact makes the problem nonconvex, so this is a local
/// minimum near the start; but the start keeps the limits and is free of contact, every step of Newton's method
/// (a log-det barrier for the limits, continuous collision detection for contact) stays so, and so does the answer,
/// wherever the method stops. The certificate is that of the projection of x̂ - M⁻¹∇(contact energy) / rate²: with the
/// contact forces as they are, nothing that keeps the limits is nearer. Its gap stands in the solution as the
/// difference between objective ½ ‖x - x̂‖²_M and bound.
class ContactProjection {
 public:
  /// Nodes of `contact` are those of the constraints, followed by the bodies' points.
  ContactProjection(solvers::ConeConstraints constraints, std::shared_ptr<mechanics::ContactBarrier> contact);
  ~ContactProjection();

  /// `start`: positions inside the limits and free of contact with the bodies where `motion` has them at first; held
  /// nodes and bodies move from there to where the candidate and `motion` have them, together with the sheet. `rate`
  /// [1/s]. If they cannot get there, the report says "failed" and what is returned is how far they got; `reached`
  /// (if not null) takes where the bodies are then. Throws
  /// base::InputError if the start is not as said.
  solvers::ConeSolution project(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                const ContactMotion& motion, double rate, const solvers::ConeProgramOptions& options,
                                base::ExecutionContext& context, Eigen::Matrix3Xd* reached = nullptr);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace pliant::cloth
