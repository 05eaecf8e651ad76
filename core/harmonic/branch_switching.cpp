#include "core/harmonic/branch_switching.hpp"

#include <random>

#include "core/harmonic/jacobian_solver.hpp"

namespace pliant::harmonic {

namespace {

constexpr int inverseIterations = 4;

/// The vector of length 1 that ∂h/∂z at (z, ω) comes closest to mapping to zero, by inverse iteration.
std::optional<Vector> kernelAt(const HarmonicBalanceProblem& problem, const Vector& z, double omega) {
  JacobianSolver solver(problem);
  Vector h;
  solver.linearize(z, omega, h, nullptr);
  if (!solver.factorize()) return std::nullopt;
  std::mt19937 random(11);
  Vector kernel(z.size());
  for (double& entry : kernel) entry = static_cast<double>(random()) / 4294967296.0 - 0.5;
  kernel.normalize();
  for (int iteration = 0; iteration < inverseIterations; ++iteration) {
    kernel = Vector(solver.solve(kernel)).normalized();
    if (!kernel.allFinite()) return std::nullopt;
  }
  return kernel;
}

}  // namespace

std::optional<Departure> departureFrom(const Crossing& crossing, double stateScale, double parameterScale) {
  const int periods = crossing.problem->drivePeriods() * (crossing.kind == PointKind::periodDoubling ? 2 : 1);
  Departure departure;
  departure.problem = periods == crossing.problem->drivePeriods()
                          ? crossing.problem
                          : std::make_shared<const HarmonicBalanceProblem>(crossing.problem->withDrivePeriods(periods));
  departure.z = crossing.problem->stretched(crossing.at.x, periods);
  departure.omega = crossing.at.parameter;
  const auto kernel = kernelAt(*departure.problem, departure.z, departure.omega);
  if (!kernel) return std::nullopt;
  const Eigen::Index n = departure.z.size();
  Vector tangent(n + 1);
  tangent << crossing.problem->stretched(crossing.at.direction, periods) / stateScale,
      crossing.at.parameterDirection / parameterScale;
  tangent.normalize();
  Vector direction(n + 1);
  direction << *kernel, 0;
  direction -= direction.dot(tangent) * tangent;
  direction.normalize();
  departure.direction = stateScale * direction.head(n);
  departure.parameterDirection = parameterScale * direction[n];
  return departure;
}

}  // namespace pliant::harmonic
