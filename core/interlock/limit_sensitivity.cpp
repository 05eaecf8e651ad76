#include "core/interlock/limit_sensitivity.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/interlock/equilibrium_search.hpp"
#include "core/interlock/parameter_terms.hpp"

namespace pliant::interlock {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Newton's decrement over the barrier's weight at which a state counts as at rest, and that is aimed for.
constexpr double restDecrement = 1e-10, aimedDecrement = 1e-20;
/// Of the largest stiffness: less is none.
constexpr double softest = 1e-12;
constexpr int settlingIterations = 60, polishingIterations = 8;

/// The Newton system of a cell under a load and one barrier.
struct RestSystem {
  VectorXd gradient;  ///< by the unknowns
  VectorXd values;    ///< of the Hessian by the unknowns
  MatrixXd vectors;

  bool isSoft(Eigen::Index i) const { return std::abs(values[i]) <= softest * values.cwiseAbs().maxCoeff(); }
  /// H⁻¹ v, without what is soft.
  VectorXd solve(const VectorXd& v) const {
    VectorXd along = vectors.transpose() * v;
    for (Eigen::Index i = 0; i < along.size(); ++i) along[i] = isSoft(i) ? 0 : along[i] / values[i];
    return vectors * along;
  }
  bool isSaddle() const {
    for (Eigen::Index i = 0; i < values.size(); ++i)
      if (values[i] < 0 && !isSoft(i)) return true;
    return false;
  }
};

}  // namespace

LimitSensitivity limitSensitivity(const CellSolver& solver, const CellState& state, const StrainDrive& drive,
                                  std::span<const CellRate> rates, const CellContact::Barrier* barrier,
                                  const base::ExecutionContext* context) {
  const CellContact& contact = solver.contact();
  const UnitCell& cell = contact.cell();
  const double radius = cell.smallestRadius(), finalGap = solver.options().finalGap;
  LimitSensitivity result;
  const auto count = static_cast<Eigen::Index>(rates.size());
  result.slopes = result.envelope = VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
  result.state = state;
  result.value = drive.load.dot(state.strain);
  const MatrixXd basis = freeCoordinates(contact, drive, std::sqrt(std::abs(cell.lattice.determinant())));
  VectorXd load = VectorXd::Zero(contact.coordinateCount());
  load.tail<3>() = drive.load;
  const VectorXd pull = basis.transpose() * load;

  if (barrier) {
    result.barrier = *barrier;
  } else {
    result.barrier = {1, solver.options().rangeRatio * finalGap * radius, splitAtGap(finalGap * radius, radius)};
    VectorXd gradient;
    contact.energy(state, contact.nearParts(state, result.barrier.range), result.barrier, &gradient);
    const VectorXd push = basis.transpose() * gradient;
    result.barrier.weight = pull.dot(push) / push.squaredNorm();
    if (!(result.barrier.weight > 0) || !std::isfinite(result.barrier.weight)) return result;
  }

  std::vector<PartPair> pairs;
  const auto systemAt = [&](const CellState& at, RestSystem& system) {
    VectorXd gradient;
    MatrixXd hessian;
    pairs = contact.nearParts(at, result.barrier.range);
    if (!std::isfinite(contact.energy(at, pairs, result.barrier, &gradient, &hessian))) return false;
    system.gradient = basis.transpose() * gradient - pull;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(basis.transpose() * hessian * basis);
    system.values = eigen.eigenvalues();
    system.vectors = eigen.eigenvectors();
    return true;
  };

  result.state =
      EquilibriumSearch(solver, state, drive, context).settle(result.barrier, 1e-12, settlingIterations).state;
  RestSystem system;
  if (!systemAt(result.state, system)) return result;
  // Line searches end where the energy's rounding does; the gradient goes on.
  double decrement = std::abs(system.gradient.dot(system.solve(system.gradient)));
  for (int i = 0; i < polishingIterations && decrement > aimedDecrement * result.barrier.weight; ++i) {
    if (decrement > result.barrier.weight) break;
    const CellState next = moved(result.state, basis * system.solve(-system.gradient), 1);
    RestSystem nextSystem;
    if (!systemAt(next, nextSystem)) break;
    const double nextDecrement = std::abs(nextSystem.gradient.dot(nextSystem.solve(nextSystem.gradient)));
    if (!(nextDecrement < decrement)) break;
    result.state = next;
    system = nextSystem;
    decrement = nextDecrement;
  }
  result.value = drive.load.dot(result.state.strain);
  result.decrement = decrement / result.barrier.weight;
  pairs = contact.nearParts(result.state, result.barrier.range);
  const ParameterTerms terms = parameterTerms(contact, result.state, pairs, result.barrier, rates);
  result.envelope = -terms.ofEnergy;
  result.slopes = -(basis.transpose() * terms.ofGradient).transpose() * system.solve(pull);
  result.kind = result.decrement > restDecrement ? LimitSensitivity::Kind::unsettled
                : system.isSaddle()              ? LimitSensitivity::Kind::saddle
                                                 : LimitSensitivity::Kind::smooth;
  return result;
}

}  // namespace pliant::interlock
