#include "core/solvers/constrained_minimizer.hpp"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

#include "core/base/stopwatch.hpp"
#include "core/solvers/bounded_least_squares.hpp"

namespace pliant::solvers {

namespace {

using base::TerminationType;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double violationOf(const VectorXd& constraints, const ConstrainedBounds& bounds) {
  if (constraints.size() == 0) return 0;
  return std::max(
      0.0, (bounds.constraintLower - constraints).cwiseMax(constraints - bounds.constraintUpper).maxCoeff());
}

/// A point that was met.
struct Met {
  VectorXd x;
  ConstrainedValue value;
  double violation = 0;
};

class DesignProgram final : public Ipopt::TNLP {
 public:
  DesignProgram(ConstrainedFunction& function, VectorXd start, const ConstrainedBounds& bounds,
                const ConstrainedOptions& options, base::ExecutionContext& context,
                const std::function<void(const ConstrainedIterate&)>& onIterate)
      : function_(function),
        start_(std::move(start)),
        bounds_(bounds),
        options_(options),
        context_(context),
        onIterate_(onIterate) {}

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& jacobian, Ipopt::Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<int>(start_.size());
    m = static_cast<int>(bounds_.constraintLower.size());
    jacobian = n * m;
    hessian = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Ipopt::Index n, double* lower, double* upper, Ipopt::Index m, double* constraintLower,
                       double* constraintUpper) override {
    constexpr double infinite = 2e19;  // what Ipopt takes for infinity
    Eigen::Map<VectorXd>(lower, n) = bounds_.lower.cwiseMax(-infinite);
    Eigen::Map<VectorXd>(upper, n) = bounds_.upper.cwiseMin(infinite);
    Eigen::Map<VectorXd>(constraintLower, m) = bounds_.constraintLower.cwiseMax(-infinite);
    Eigen::Map<VectorXd>(constraintUpper, m) = bounds_.constraintUpper.cwiseMin(infinite);
    return true;
  }

  bool get_starting_point(Ipopt::Index n, bool, double* x, bool, double*, double*, Ipopt::Index, bool,
                          double*) override {
    Eigen::Map<VectorXd>(x, n) = start_;
    return true;
  }

  bool eval_f(Ipopt::Index n, const double* x, bool, double& value) override {
    if (!at(n, x, false)) return false;
    value = last_.value.objective;
    return true;
  }
  bool eval_grad_f(Ipopt::Index n, const double* x, bool, double* gradient) override {
    if (!at(n, x, true)) return false;
    Eigen::Map<VectorXd>(gradient, n) = last_.value.gradient;
    return true;
  }
  bool eval_g(Ipopt::Index n, const double* x, bool, Ipopt::Index m, double* constraints) override {
    if (!at(n, x, false)) return false;
    Eigen::Map<VectorXd>(constraints, m) = last_.value.constraints;
    return true;
  }
  bool eval_jac_g(Ipopt::Index n, const double* x, bool, Ipopt::Index m, Ipopt::Index, Ipopt::Index* rows,
                  Ipopt::Index* columns, double* values) override {
    if (!values) {
      for (int i = 0; i < n * m; ++i) {
        rows[i] = i % m;
        columns[i] = i / m;
      }
      return true;
    }
    if (!at(n, x, true)) return false;
    Eigen::Map<MatrixXd>(values, m, n) = last_.value.jacobian;
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode mode, Ipopt::Index iteration, double, double, double dual, double,
                             double, double, double step, double, Ipopt::Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    if (context_.cancelRequested() || thrown_) return false;
    // Derivatives are taken at iterates alone; in Ipopt's restoration phase they belong to another problem.
    if (mode == Ipopt::RegularMode && last_.value.gradient.size() > 0) {
      report.iterations.push_back({iteration, dual, step, last_.violation});
      if (onIterate_) onIterate_({iteration, last_.x, last_.value, last_.violation, step, evaluations});
    }
    context_.reportProgress(static_cast<double>(iteration) / options_.maximumIterations);
    return !context_.cancelRequested();
  }

  void finalize_solution(Ipopt::SolverReturn status, Ipopt::Index n, const double* x, const double*, const double*,
                         Ipopt::Index, const double*, const double*, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    switch (status) {
      case Ipopt::SUCCESS:
        if (at(n, x, false) && last_.violation <= options_.constraintTolerance) best_ = last_;
        return finish(TerminationType::converged, "");
      case Ipopt::STOP_AT_ACCEPTABLE_POINT:
        return finish(TerminationType::iterationLimit, "Ipopt could not come nearer than what it calls acceptable.");
      case Ipopt::MAXITER_EXCEEDED:
        return finish(TerminationType::iterationLimit, "The iteration limit was reached before a minimum.");
      case Ipopt::LOCAL_INFEASIBILITY:
        return finish(TerminationType::infeasible, "No design nearby keeps the constraints better than this one.");
      case Ipopt::USER_REQUESTED_STOP: return finish(TerminationType::cancelled, "The minimisation was cancelled.");
      default:
        return finish(TerminationType::failed, context_.cancelRequested()
                                                   ? "The minimisation was cancelled."
                                                   : "Ipopt found no step to a better point (status " +
                                                         std::to_string(static_cast<int>(status)) + ").");
    }
  }

  const Met& best() const { return best_; }
  std::exception_ptr thrown() const { return thrown_; }

  base::SolverReport report;
  int evaluations = 0;

 private:
  void finish(TerminationType termination, std::string message) {
    report.termination = context_.cancelRequested() ? TerminationType::cancelled : termination;
    report.message = std::move(message);
  }

  /// Makes `last_` the point at `x`.
  bool at(Ipopt::Index n, const double* x, bool withDerivatives) {
    const VectorXd point = Eigen::Map<const VectorXd>(x, n).cwiseMax(bounds_.lower).cwiseMin(bounds_.upper);
    if (last_.x.size() > 0 && point == last_.x && (!withDerivatives || last_.value.gradient.size() > 0)) return true;
    if (context_.cancelRequested() || thrown_) return false;
    std::optional<ConstrainedValue> value;
    try {
      if (last_.x.size() == 0 || point != last_.x) ++evaluations;
      value = function_.evaluate(point, withDerivatives);
    } catch (...) {  // not through Ipopt
      thrown_ = std::current_exception();
    }
    if (!value || !std::isfinite(value->objective) || !value->constraints.allFinite() || !value->gradient.allFinite() ||
        !value->jacobian.allFinite())
      return false;
    last_ = {point, std::move(*value), 0};
    last_.violation = violationOf(last_.value.constraints, bounds_);
    if (best_.x.size() > 0 && best_.x == last_.x ? withDerivatives : isBetter(last_, best_)) best_ = last_;
    return true;
  }

  bool isBetter(const Met& one, const Met& other) const {
    if (other.x.size() == 0) return true;
    const double tolerance = options_.constraintTolerance;
    if (one.violation > tolerance || other.violation > tolerance) return one.violation < other.violation;
    return one.value.objective < other.value.objective;
  }

  ConstrainedFunction& function_;
  VectorXd start_;
  const ConstrainedBounds& bounds_;
  const ConstrainedOptions& options_;
  base::ExecutionContext& context_;
  const std::function<void(const ConstrainedIterate&)>& onIterate_;
  Met last_, best_;
  std::exception_ptr thrown_;
};

}  // namespace

Optimality optimalityOf(const ConstrainedValue& at, const VectorXd& x, const ConstrainedBounds& bounds,
                        double activeTolerance) {
  const Index n = x.size(), m = at.constraints.size();
  // Columns of A in ‖∇f + A y‖ with their signs: one for each bound that is met.
  std::vector<VectorXd> columns;
  std::vector<std::pair<Index, double>> ofConstraint;  // which constraint, and the sign of its multiplier
  for (Index j = 0; j < m; ++j)
    for (const double sign : {1.0, -1.0}) {
      const double slack =
          sign > 0 ? bounds.constraintUpper[j] - at.constraints[j] : at.constraints[j] - bounds.constraintLower[j];
      if (slack > activeTolerance) continue;
      columns.emplace_back(sign * at.jacobian.row(j).transpose());
      ofConstraint.emplace_back(j, sign);
    }
  for (Index i = 0; i < n; ++i)
    for (const double sign : {1.0, -1.0}) {
      const double slack = sign > 0 ? bounds.upper[i] - x[i] : x[i] - bounds.lower[i];
      if (slack <= activeTolerance) columns.emplace_back(sign * VectorXd::Unit(n, i));
    }
  Optimality result;
  result.violation = violationOf(at.constraints, bounds);
  result.multipliers = VectorXd::Zero(m);
  VectorXd rest = at.gradient;
  if (const auto count = static_cast<Index>(columns.size()); count > 0) {
    // Columns may depend on one another, as those of an equation do: a little weight on the multipliers decides.
    constexpr double weight = 1e-9;
    MatrixXd a = MatrixXd::Zero(n + count, count);
    VectorXd lengths(count);
    for (Index k = 0; k < count; ++k) {
      const double length = columns[static_cast<std::size_t>(k)].norm();
      lengths[k] = length > 0 ? length : 1;
      a.col(k).head(n) = columns[static_cast<std::size_t>(k)] / lengths[k];
      a(n + k, k) = weight;
    }
    VectorXd right = VectorXd::Zero(n + count);
    right.head(n) = -at.gradient;
    const VectorXd y = leastSquaresWithinBounds(
        a, right, VectorXd::Zero(count), VectorXd::Constant(count, std::numeric_limits<double>::max()));
    rest += a.topRows(n) * y;
    for (std::size_t k = 0; k < ofConstraint.size(); ++k)
      result.multipliers[ofConstraint[k].first] +=
          ofConstraint[k].second * y[static_cast<Index>(k)] / lengths[static_cast<Index>(k)];
  }
  const double size = at.gradient.cwiseAbs().maxCoeff();
  result.stationarity = size > 0 ? rest.cwiseAbs().maxCoeff() / size : 0;
  return result;
}

ConstrainedSolution minimizeWithConstraints(ConstrainedFunction& function, const VectorXd& start,
                                            const ConstrainedBounds& bounds, const ConstrainedOptions& options,
                                            base::ExecutionContext& context,
                                            const std::function<void(const ConstrainedIterate&)>& onIterate) {
  if (bounds.lower.size() != start.size() || bounds.upper.size() != start.size() ||
      bounds.constraintLower.size() != bounds.constraintUpper.size())
    throw std::invalid_argument("bounds that do not fit the variables");
  const base::Stopwatch watch;
  const Ipopt::SmartPtr<DesignProgram> program =
      new DesignProgram(function, start, bounds, options, context, onIterate);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
  application->Options()->SetIntegerValue("print_level", 0);
  application->Options()->SetStringValue("sb", "yes");
  application->Options()->SetStringValue("hessian_approximation", "limited-memory");
  application->Options()->SetIntegerValue("limited_memory_max_history", 10);
  application->Options()->SetIntegerValue("max_iter", options.maximumIterations);
  application->Options()->SetNumericValue("tol", options.tolerance);
  application->Options()->SetNumericValue("constr_viol_tol", options.constraintTolerance);
  application->Options()->SetNumericValue("bound_relax_factor", 0);  // there are no designs beyond bounds
  ConstrainedSolution solution;
  if (application->Initialize("") == Ipopt::Solve_Succeeded) application->OptimizeTNLP(program);
  if (program->thrown()) std::rethrow_exception(program->thrown());
  solution.report = program->report;
  solution.evaluations = program->evaluations;
  if (const Met& best = program->best(); best.x.size() > 0) {
    solution.x = best.x;
    solution.value = best.value;
    if (best.value.gradient.size() == 0) {
      // Met on the way alone. Its neighbours are known, so it is found again, unless the run was cancelled.
      const auto again = context.cancelRequested() ? std::nullopt : function.evaluate(best.x, true);
      if (again) solution.value = *again;
    }
    if (solution.value.gradient.size() > 0)
      solution.optimality = optimalityOf(solution.value, solution.x, bounds);
    else
      solution.optimality.violation = best.violation;
  }
  solution.report.seconds = watch.seconds();
  return solution;
}

}  // namespace pliant::solvers
