#include "core/harmonic/time_integration.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/static_equilibrium.hpp"

namespace pliant::harmonic {

namespace {

using base::TerminationType;

/// Starts of periods that differ by more than this fraction of the swing are not extrapolated from.
constexpr double farthestExtrapolation = 0.05;
/// Of the swing, by which states are disturbed for the monodromy matrix.
constexpr double disturbance = 1e-4;

/// Anderson's extrapolation of a fixed-point iteration s -> g(s), of type II with a QR decomposition a step.
class Extrapolation {
 public:
  explicit Extrapolation(int depth) : depth_(static_cast<std::size_t>(depth)) {}

  /// The next s to try, from all s and g(s) seen so far.
  Vector next(const Vector& s, const Vector& image) {
    const Vector defect = image - s;
    if (previousDefect_.size() > 0) {
      defectChanges_.push_back(defect - previousDefect_);
      imageChanges_.push_back(image - previousImage_);
      if (defectChanges_.size() > depth_) {
        defectChanges_.pop_front();
        imageChanges_.pop_front();
      }
    }
    previousDefect_ = defect;
    previousImage_ = image;
    if (defectChanges_.empty()) return image;
    Matrix changes(s.size(), static_cast<Eigen::Index>(defectChanges_.size()));
    Vector result = image;
    for (std::size_t i = 0; i < defectChanges_.size(); ++i)
      changes.col(static_cast<Eigen::Index>(i)) = defectChanges_[i];
    const Vector weights = changes.colPivHouseholderQr().solve(defect);
    if (!weights.allFinite()) return image;
    for (std::size_t i = 0; i < imageChanges_.size(); ++i)
      result -= weights[static_cast<Eigen::Index>(i)] * imageChanges_[i];
    return result;
  }

 private:
  std::size_t depth_;
  std::deque<Vector> defectChanges_, imageChanges_;
  Vector previousDefect_, previousImage_;
};

class PeriodicIntegration {
 public:
  PeriodicIntegration(const HarmonicBalanceProblem& problem, double omega, const TimeIntegrationOptions& options,
                      base::ExecutionContext& context)
      : problem_(problem),
        model_(problem.model()),
        omega_(omega),
        options_(options),
        context_(context),
        newmark_(problem, omega, options.stepsPerPeriod) {}

  TimeIntegration run(const Vector& start) {
    const base::Stopwatch watch;
    result_.omega = omega_;
    result_.steps = options_.stepsPerPeriod;
    if (start.size() > 0)
      startAtMotion(start);
    else
      startAtRest();
    if (started_) integrate();
    result_.newtonIterations = newmark_.newtonIterations();
    result_.factorizations = newmark_.factorizations();
    result_.report.seconds = watch.seconds();
    return std::move(result_);
  }

 private:
  void startAtMotion(const Vector& z) {
    const auto at = [&](double tau) { return problem_.configurationAt(z, tau); };
    const Matrix rates = problem_.basis().derivative(
        Eigen::Map<const Matrix>(z.data(), problem_.basis().size(), model_.dofs.freeCount()));
    Vector velocities = Vector::Zero(model_.coordinateCount());
    velocities(model_.dofs.freeCoordinates) = omega_ * rates.transpose() * problem_.basis().valuesAt(0);
    newmark_.start(at(0), velocities);
    started_ = true;
  }

  /// The static equilibrium with drives and loads as they are at τ = 0; velocities are those of the equilibria that
  /// follow, as far as the stiffness is concerned: K_ff v_f = -K_fd v_d.
  void startAtRest() {
    const Vector rest = model_.restPositions(model_.dofs.freeCoordinates);
    const Vector held = model_.configuration(rest, 0);
    const solvers::StaticEquilibrium found =
        solvers::solveStaticEquilibrium(model_, problem_.assembler(), held, model_.externalForce(0), {}, context_);
    result_.report = found.report;
    result_.report.iterations.clear();
    if (!found.report.converged()) return;
    constexpr double step = 1e-4;  // in τ
    const auto gradientAt = [&](double tau) -> Vector {
      const Vector x = model_.configuration(found.positions(model_.dofs.freeCoordinates), tau);
      return problem_.assembler().gradient(x)(model_.dofs.freeCoordinates);
    };
    Vector velocities = Vector::Zero(model_.coordinateCount());
    if (math::SparseFactorization stiffness; stiffness.factorize(problem_.assembler().hessian(found.positions)))
      velocities(model_.dofs.freeCoordinates) =
          -omega_ * stiffness.solve((gradientAt(step) - gradientAt(-step)) / (2 * step)).col(0);
    newmark_.start(found.positions, velocities);
    started_ = true;
  }

  /// Free positions and velocities, both in metres.
  Vector state() const {
    const auto& free = model_.dofs.freeCoordinates;
    Vector s(2 * static_cast<Eigen::Index>(free.size()));
    s << newmark_.positions()(free), newmark_.velocities()(free) / omega_;
    return s;
  }
  void restartAt(const Vector& s) {
    const auto& free = model_.dofs.freeCoordinates;
    const auto count = static_cast<Eigen::Index>(free.size());
    Vector positions = newmark_.positions(), velocities = newmark_.velocities();
    positions(free) = s.head(count);
    velocities(free) = omega_ * s.tail(count);
    newmark_.start(positions, velocities);
  }

  bool integratePeriod(Matrix& positions) {
    positions.resize(options_.stepsPerPeriod, model_.coordinateCount());
    for (int i = 0; i < options_.stepsPerPeriod; ++i) {
      if (i % 64 == 0 && context_.cancelRequested()) {
        end(TerminationType::cancelled, "The time integration was cancelled.");
        return false;
      }
      positions.row(i) = newmark_.positions().transpose();
      if (!newmark_.advance()) {
        end(TerminationType::failed, "Newton's method failed at step " + std::to_string(i) + " of period " +
                                         std::to_string(result_.periods.size() + 1) +
                                         " of the time integration; take more steps a period.");
        return false;
      }
    }
    return true;
  }

  void integrate() {
    Extrapolation extrapolation(options_.acceleration);
    Matrix positions;
    bool extrapolated = false;
    for (int period = 0; period < options_.maximumPeriods; ++period) {
      const Vector before = state();
      if (!integratePeriod(positions)) return;
      const Vector after = state();
      PeriodRecord record;
      record.extrapolated = extrapolated;
      if (period > 0) record.difference = (positions - result_.positions).rowwise().norm().sum();
      const Eigen::RowVectorXd mean = positions.colwise().mean();
      result_.swing = std::sqrt((positions.rowwise() - mean).squaredNorm() / options_.stepsPerPeriod);
      result_.positions.swap(positions);
      result_.velocities = newmark_.velocities();
      result_.periods.push_back(record);
      const double allowed = options_.tolerance * std::max(result_.swing, 1e-300);
      const double meanDifference = record.difference / options_.stepsPerPeriod;
      result_.report.iterations.push_back({period + 1, meanDifference / std::max(result_.swing, 1e-300), 1, 0});
      char message[80];
      std::snprintf(message, sizeof message, "period %d, difference %.2g m", period + 1, record.difference);
      context_.reportProgress(static_cast<double>(period + 1) / options_.maximumPeriods, message);
      if (period > 0 && !extrapolated && meanDifference <= allowed) {
        if (options_.shooting && !findMultipliers(before)) return;
        return end(TerminationType::converged, {});
      }
      extrapolated = false;
      // Far from a periodic motion an extrapolated shape would not be one that the structure can take without stretch.
      // Close to the end the model goes on by itself, so that what is compared are two periods of one motion.
      const double defect = (after - before).norm();
      if (defect <= 0.5 * allowed || defect >= farthestExtrapolation * result_.swing) continue;
      if (options_.shooting) {
        const auto monodromy = monodromyAt(before);
        if (!monodromy) return;
        // Of massless coordinates the start is not determined: the least change.
        const Matrix defectRate = Matrix::Identity(before.size(), before.size()) - *monodromy;
        restartAt(before + defectRate.completeOrthogonalDecomposition().solve(after - before));
        extrapolated = true;
      } else if (options_.acceleration > 0) {
        restartAt(extrapolation.next(before, after));
        extrapolated = true;
      }
    }
    end(TerminationType::iterationLimit,
        "The motion was not periodic after " + std::to_string(options_.maximumPeriods) + " periods.");
  }

  /// d(state after a period) / d(state before it); none if it was cancelled or failed.
  std::optional<Matrix> monodromyAt(const Vector& s) {
    Matrix monodromy(s.size(), s.size()), positions;
    const double step = disturbance * std::max(result_.swing, 1e-300);
    for (Eigen::Index j = 0; j < s.size(); ++j) {
      Vector ends[2];
      for (const int side : {0, 1}) {
        Vector disturbed = s;
        disturbed[j] += side == 0 ? step : -step;
        restartAt(disturbed);
        if (!integratePeriod(positions)) return std::nullopt;
        ends[side] = state();
      }
      monodromy.col(j) = (ends[0] - ends[1]) / (2 * step);
    }
    return monodromy;
  }

  bool findMultipliers(const Vector& s) {
    const auto monodromy = monodromyAt(s);
    if (!monodromy) return false;
    const Eigen::VectorXcd values = monodromy->eigenvalues();
    result_.multipliers.assign(values.begin(), values.end());
    std::stable_sort(result_.multipliers.begin(), result_.multipliers.end(),
                     [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
    return true;
  }

  void end(TerminationType termination, std::string message) {
    result_.report.termination = termination;
    result_.report.message = std::move(message);
  }

  const HarmonicBalanceProblem& problem_;
  const Model& model_;
  double omega_;
  const TimeIntegrationOptions& options_;
  base::ExecutionContext& context_;
  NewmarkIntegration newmark_;
  bool started_ = false;
  TimeIntegration result_;
};

}  // namespace

TimeIntegration integrateToPeriodicity(const HarmonicBalanceProblem& problem, double omega,
                                       const TimeIntegrationOptions& options, base::ExecutionContext& context,
                                       const Vector& start) {
  if (options.stepsPerPeriod < 8)
    throw base::InputError(
        "", "a time integration needs at least 8 steps a period, found " + std::to_string(options.stepsPerPeriod));
  if (options.shooting && problem.model().dofs.freeCount() > mostShootingCoordinates)
    throw base::InputError("", "shooting is for models of at most " + std::to_string(mostShootingCoordinates) +
                                   " free coordinates, found " + std::to_string(problem.model().dofs.freeCount()));
  return PeriodicIntegration(problem, omega, options, context).run(start);
}

}  // namespace pliant::harmonic
