#pragma once

#include <functional>
#include <optional>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/math/block_cholesky.hpp"
#include "core/mechanics/contact_barrier.hpp"
#include "core/mechanics/contact_friction.hpp"
#include "core/mechanics/elastic_assembler.hpp"

namespace pliant::solvers {

struct EnergyMinimizerOptions {
  double tolerance = 1e-9;  ///< on the force that is left over, relative to the largest of those that balance
  /// Where rounding leaves more than that, a last step this short, relative to the size of the model, counts as well.
  double stepTolerance = 1e-9;
  int maximumIterations = 500;
  /// Gets the start and what each step leads to.
  std::function<void(const mechanics::Vector&)> visit = {};
};

/// Minimises Σ weight E(x) + ½ Σ inertia (x - target)² - force·x over the nodes that are not held, in 3 dimensions, by
/// Newton's method with line search. Where the exact Hessian is not positive definite it takes the convex one (see
/// mechanics::HessianKind) for some steps, and where that is not enough adds to its diagonal. Energies may be infinite
/// (barriers): such places are not stepped to. The analysis of the linear system is kept between solves. With contact
/// its barrier is one of the terms, steps end before anything meets, and contacts that the linear system has no room
/// for are foreseen anew.
class EnergyMinimizer {
 public:
  /// All terms are of one model, or of models with the same coordinates, three a node and all free.
  struct Term {
    std::shared_ptr<const mechanics::ElasticAssembler> energy;
    double weight = 1;
  };
  EnergyMinimizer(std::vector<Term> terms, std::vector<char> heldNodes);

  void setWeight(int term, double weight) { terms_[static_cast<std::size_t>(term)].weight = weight; }

  /// The model's nodes are those of the barrier that can be deformed; `bodyPoints` (3 x others) [m] follow. Null: none.
  void setContact(std::shared_ptr<mechanics::ContactBarrier> contact, Eigen::Matrix3Xd bodyPoints);
  /// Of the same contact, as one more term; null: none.
  void setFriction(std::shared_ptr<const mechanics::ContactFriction> friction) { friction_ = std::move(friction); }

  struct Surroundings {
    mechanics::Vector force;            ///< on all coordinates [N]
    mechanics::Vector inertia, target;  ///< per coordinate [N/m], [m]; both empty: none
  };
  /// From `x`, whose held nodes stay where they are, and whose energy must be finite. The report's residual is what the
  /// tolerance bounds.
  base::SolverReport minimize(mechanics::Vector& x, const Surroundings& surroundings,
                              const EnergyMinimizerOptions& options, base::ExecutionContext& context);

  double value(const mechanics::Vector& x, const Surroundings& surroundings) const;
  /// `largest`, if not null: the largest component of any term's, of forces without inertia.
  mechanics::Vector gradient(const mechanics::Vector& x, const Surroundings& surroundings,
                             double* largest = nullptr) const;

 private:
  /// Analyses the linear system, with room for the contacts there are and may soon be.
  void analyse();
  bool hasRoomForContacts() const;
  /// Of a step from x, the part before anything meets.
  double freeFraction(const mechanics::Vector& x, const mechanics::Vector& step) const;
  Eigen::Matrix3Xd withBodies(const mechanics::Vector& x) const;
  /// The Hessian at x with `shift` times its mean diagonal added to it; false if it is not positive definite.
  bool factorizeAt(const mechanics::Vector& x, const Surroundings& surroundings, mechanics::HessianKind kind,
                   double shift);
  /// The same of the entries last evaluated.
  bool factorize(const Surroundings& surroundings, double shift);

  std::vector<Term> terms_;
  std::vector<char> held_;
  std::vector<int> free_;                         ///< nodes
  std::vector<int> vertex_;                       ///< per node its place in free_, -1: held
  std::vector<std::array<int, 2>> pairs_;         ///< of vertices that terms couple
  std::vector<std::array<int, 2>> contactPairs_;  ///< of vertices that contacts may couple, sorted
  std::shared_ptr<mechanics::ContactBarrier> contact_;
  std::shared_ptr<const mechanics::ContactFriction> friction_;
  Eigen::Matrix3Xd bodyPoints_;
  std::vector<mechanics::ContactBlock> blocks_;  ///< of contacts and friction, at the x last assembled
  std::optional<math::BlockCholesky> cholesky_;
  std::vector<std::vector<Eigen::Index>> slots_;        ///< per term and entry of its assembler; -1: held
  std::vector<std::array<Eigen::Index, 3>> diagonals_;  ///< of each free node
  std::vector<mechanics::Vector> entries_;              ///< per term, at the x last assembled
};

}  // namespace pliant::solvers
