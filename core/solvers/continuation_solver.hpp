#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"

namespace pliant::solvers {

/// One solution on a branch. The tangent (dx/ds, dλ/ds) has length 1 in the scaled measure of `ContinuationOptions`.
struct BranchPoint {
  Eigen::VectorXd x;
  double parameter = 0;  ///< λ
  Eigen::VectorXd direction;
  double parameterDirection = 0;
  double arcLength = 0;
  double residual = 0;    ///< ‖h‖ / residualScale
  double correction = 0;  ///< size of the last correction, in the scaled measure
  int iterations = 0;     ///< of the corrector
};

/// What is special about a point of a branch.
enum class BranchEvent {
  none,
  fold,     ///< λ turns back
  monitor,  ///< a monitor changes from positive to negative
};

/// h(x, λ) = 0, n equations in n + 1 unknowns.
class ContinuationProblem {
 public:
  virtual ~ContinuationProblem() = default;

  virtual Eigen::VectorXd residual(const Eigen::VectorXd& x, double parameter) = 0;
  /// What ‖h‖ is divided by before it is compared with the tolerance.
  virtual double residualScale(double parameter) = 0;
  /// Evaluates ∂h/∂x at a point, for multiply() and factorize(), and returns ∂h/∂λ.
  virtual Eigen::VectorXd linearize(const Eigen::VectorXd& x, double parameter) = 0;
  /// The same at a point that was predicted by linearisation at `from`: it lies about `step` times the direction of
  /// `from` away from it. Any matrix that is near ∂h/∂x of the solution predicted will do.
  virtual Eigen::VectorXd linearizePrediction(const Eigen::VectorXd& x, double parameter, const BranchPoint& /*from*/,
                                              double /*step*/) {
    return linearize(x, parameter);
  }
  /// ∂h/∂x, last linearised, times v.
  virtual Eigen::VectorXd multiply(const Eigen::VectorXd& v) = 0;
  /// Factorises ∂h/∂x as last linearised; false if it is singular.
  virtual bool factorize() = 0;
  /// (∂h/∂x)⁻¹ b with the factors that there are, which may belong to an earlier point.
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& b) = 0;
  /// Asked after each point: true if the branch is to end with it.
  virtual bool ends() { return false; }
  /// Functions along the branch whose changes from positive to negative are located as points.
  virtual Eigen::VectorXd monitors(const BranchPoint&) { return {}; }
};

struct ContinuationOptions {
  double lower = 0;  ///< the branch is followed while λ stays in [lower, upper]
  double upper = 1;
  double orientation = 1;  ///< sign of dλ/ds at the start
  /// Where the branch sets off (unscaled); if not empty, the start is corrected in the plane normal to it instead of at
  /// its λ, and `orientation` does not count.
  Eigen::VectorXd startDirection;
  double startParameterDirection = 0;
  double stateScale = 1;  ///< the arc length is measured in (x / stateScale, λ / parameterScale)
  double parameterScale = 1;
  double initialStep = 0.005;
  double minimumStep = 1e-6;
  double maximumStep = 1e100;
  double maximumParameterStep = 1e100;  ///< largest |Δλ| of a step
  double targetAngle = 0.17;            ///< by which the tangent should turn in a step [rad]
  double maximumAngle = 0.5;            ///< a step by which it turns more is rejected [rad]
  double tolerance = 1e-9;              ///< on the scaled residual
  double stepTolerance = 1e-10;         ///< a shorter (scaled) correction also counts as converged
  double roundingTolerance = 1e-7;      ///< as in NewtonOptions, in the scaled measure
  double locationTolerance = 1e-6;      ///< relative error of λ at located folds and monitors
  int maximumPoints = 2000;
};

/// Follows a branch by pseudo-arclength continuation: Hermite extrapolation (quintic) of the last three points and
/// their tangents as predictor, a corrector in the plane normal to it, steps of about equal turning of the tangent.
///
/// Factorisations dominate the cost, so the factors of an earlier point serve as long as corrections shrink quickly
/// with them; every residual is exact, so only the rate of convergence depends on them. Bordered systems are solved by
/// block elimination within these iterations, so ∂h/∂x may be nearly singular (at folds).
class ContinuationSolver {
 public:
  /// Called with each point in the order of the branch; `monitor` is the index of the monitor that vanishes there, or
  /// -1.
  using PointCallback = std::function<void(const BranchPoint&, BranchEvent, int monitor)>;

  ContinuationSolver(ContinuationProblem& problem, const ContinuationOptions& options);

  /// Follows the branch from the solution (x, λ) until λ leaves [lower, upper]; the last point lies exactly on the
  /// bound. A closed branch ends with a copy of its first point. The report has one record a point.
  base::SolverReport trace(const Eigen::VectorXd& x, double parameter, base::ExecutionContext& context,
                           const PointCallback& onPoint);

  /// For use while trace() calls `onPoint`, between points that it got: the solution at an arc length between those of
  /// two others of the branch; none if the corrector fails or is cancelled.
  std::optional<BranchPoint> solveBetween(const BranchPoint& from, const BranchPoint& to, double arcLength);
  /// Likewise: linearises and factorises at a point, exactly, and goes on with these factors; false if singular.
  bool factorizeAt(const BranchPoint& point);

 private:
  using Vector = Eigen::VectorXd;
  enum class Status { converged, failed, cancelled };

  /// In scaled variables y = (x / stateScale, λ / parameterScale).
  struct Point {
    Vector y;
    Vector tangent;
    double arcLength = 0;
    double residual = 0;
    double correction = 0;
    int iterations = 0;
    Vector monitors;
    double parameter() const { return y[y.size() - 1]; }
  };
  /// A tangent that only serves to predict need not be better than the prediction.
  static constexpr double predictingTangentTolerance = 1e-4;
  static constexpr double exactTangentTolerance = 1e-7;
  struct Event {
    Point point;
    BranchEvent kind;
    int monitor;
    bool end;
  };

  Status correct(Point& point, const Vector& normal, const Point* from, double step);
  Status findTangent(Point& point, const Vector& normal, double tolerance);
  Status solveAt(Point& point, const Vector& predicted, const Vector& normal, const Point* from, double step,
                 double tangentTolerance);
  Vector linearizeForetold(const Point& point, const Point* from, double step);
  bool refactorize(const Vector& y);
  Vector solveBordered(const Vector& f, double g, const Vector& normal);

  Status advance(const std::vector<Point>& history, double step, Point& to, double& growth);
  Status locateEvents(const Point& from, Point& to, std::vector<Event>& events);
  Status locate(const Point& from, const Point& to, const std::function<double(const Point&)>& function, Point& root);
  Status solveBetween(const Point& from, const Point& to, double arcLength, Point& point);
  Status locateBound(const Point& from, const Point& to, double bound, Point& end);
  Vector startNormal(Eigen::Index n) const;
  std::optional<Point> closingPoint(const Point& first, const Point& from, const Point& to) const;
  bool inRange(const Point& point) const;
  BranchPoint unscaled(const Point& point) const;
  Point scaled(const BranchPoint& point) const;

  ContinuationProblem& problem_;
  ContinuationOptions options_;
  base::ExecutionContext* context_ = nullptr;
  bool factorized_ = false;
  Vector factorPoint_;          ///< where the factors belong
  double reuseRadius_ = 0;      ///< factors serve for points this close
  double contractionRate_ = 0;  ///< of corrections, per distance from factorPoint_, as last observed
  Vector parameterDerivative_;  ///< ∂h/∂λ where last linearised
  Vector parameterColumn_;      ///< (∂h/∂x)⁻¹ ∂h/∂λ, scaled, with the factors that there are
};

}  // namespace pliant::solvers
