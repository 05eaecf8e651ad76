#include "core/cloth/gauss_seidel.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"

namespace pliant::cloth {

namespace {

class GaussSeidelLimiter final : public StrainLimiter {
 public:
  GaussSeidelLimiter(const solvers::ConeConstraints& constraints, const ProjectionOptions& options)
      : constraints_(constraints), options_(options) {
    for (const solvers::MetricBounds& bounds : constraints.bounds) {
      scalings_.emplace_back();
      for (const Eigen::Matrix2d& ellipse : bounds.ellipses)
        scalings_.back().push_back(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(ellipse).operatorInverseSqrt());
    }
    mobilities_.resize(constraints.nodeCount);
    for (int node = 0; node < constraints.nodeCount; ++node)
      mobilities_[node] = constraints.fixed[node] ? 0 : 1 / constraints.masses[node];
  }

  std::string_view name() const override { return "gauss_seidel"; }

  solvers::ConeSolution project(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                base::ExecutionContext& context) override {
    static_cast<void>(start);  // it begins at the candidate
    if (candidate.cols() != constraints_.nodeCount || !candidate.allFinite())
      throw base::InputError("", "A projection needs a finite position for each of its " +
                                     std::to_string(constraints_.nodeCount) + " nodes.");
    const base::Stopwatch stopwatch;
    solvers::ConeSolution solution;
    solution.positions = candidate;
    base::SolverReport& report = solution.report;
    report.termination = base::TerminationType::iterationLimit;
    for (int sweep = 0; sweep <= options_.sweeps; ++sweep) {  // the last may find that nothing is left to do
      const double worst = this->sweep(solution.positions);   // before the corrections of this sweep
      if (sweep % recordEvery(sweep) == 0 || sweep == options_.sweeps || worst <= options_.violation)
        report.iterations.push_back({sweep, worst, 1, worst});
      if (worst <= options_.violation) {
        report.termination = base::TerminationType::converged;
        break;
      }
      if (context.cancelRequested()) {
        report.termination = base::TerminationType::cancelled;
        report.message = "The projection was cancelled.";
        break;
      }
    }
    solution.violation = worstViolation(solution.positions);
    if (report.termination == base::TerminationType::iterationLimit)
      report.message = "Gauss-Seidel still exceeds a limit by " + std::to_string(solution.violation) + " after " +
                       std::to_string(options_.sweeps) + " sweeps.";
    solution.objective = 0.5 * ((solution.positions - candidate).colwise().squaredNorm() * constraints_.masses).value();
    solution.bound = -std::numeric_limits<double>::infinity();
    report.seconds = stopwatch.seconds();
    return solution;
  }

 private:
  /// Every sweep at first, then every tenth, hundredth, ...
  static int recordEvery(int sweep) { return sweep < 100 ? 1 : sweep < 1000 ? 10 : 100; }

  /// Calls visit(c, squared stretch) for the combinations of the corners, Σ c_k x_k, that are too long: of an ellipse
  /// the direction in which it is exceeded most. `visit` may move the corners.
  template <class Visit>
  void forEachBound(const solvers::ConeElement& element, const Eigen::Matrix3Xd& x, const Visit& visit) const {
    const auto metric = [&] {
      Eigen::Matrix<double, 3, 2> f = x.col(element.nodes[0]) * element.weights[0].transpose();
      for (int k = 1; k < 3; ++k) f += x.col(element.nodes[k]) * element.weights[k].transpose();
      return Eigen::Matrix2d(f.transpose() * f);
    };
    const auto combine = [&](const Eigen::Vector2d& v) {
      return Eigen::Vector3d(element.weights[0].dot(v), element.weights[1].dot(v), element.weights[2].dot(v));
    };
    for (const Eigen::Matrix2d& scaling : scalings_[element.bounds]) {
      // Bringing back one direction turns the worst one; a few rounds settle it.
      for (int round = 0; round < 4; ++round) {
        const Eigen::Matrix2d c = scaling * metric() * scaling;
        const double half = (c(0, 0) - c(1, 1)) / 2, radius = std::hypot(half, c(0, 1));
        const double squared = (c(0, 0) + c(1, 1)) / 2 + radius;
        const Eigen::Vector2d direction =
            half > 0 ? Eigen::Vector2d(half + radius, c(0, 1)) : Eigen::Vector2d(c(0, 1), radius - half);
        const double norm = direction.norm();
        if (!visit(combine(scaling * (norm > 0 ? Eigen::Vector2d(direction / norm) : Eigen::Vector2d(1, 0))), squared))
          break;
      }
    }
    for (const Eigen::Vector2d& v : constraints_.bounds[element.bounds].directions)
      visit(combine(v), v.dot(metric() * v));
  }

  /// Corrects every triangle once and returns the largest violation met.
  double sweep(Eigen::Matrix3Xd& x) const {
    double worst = 0;
    for (const solvers::ConeElement& element : constraints_.elements)
      forEachBound(element, x, [&](const Eigen::Vector3d& c, double squared) {
        const double stretch = std::sqrt(squared);
        worst = std::max(worst, stretch - 1);
        if (stretch - 1 <= options_.violation) return false;
        double mobility = 0;
        for (int k = 0; k < 3; ++k) mobility += mobilities_[element.nodes[k]] * c[k] * c[k];
        if (!(mobility > 0)) return false;
        Eigen::Vector3d vector = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k) vector += c[k] * x.col(element.nodes[k]);
        vector *= (1 - 1 / stretch) / mobility;
        for (int k = 0; k < 3; ++k) x.col(element.nodes[k]) -= mobilities_[element.nodes[k]] * c[k] * vector;
        return true;
      });
    return worst;
  }

  double worstViolation(const Eigen::Matrix3Xd& x) const {
    double worst = 0;
    for (const solvers::ConeElement& element : constraints_.elements)
      forEachBound(element, x, [&](const Eigen::Vector3d&, double squared) {
        worst = std::max(worst, std::sqrt(squared) - 1);
        return false;
      });
    return worst;
  }

  const solvers::ConeConstraints constraints_;
  ProjectionOptions options_;
  std::vector<std::vector<Eigen::Matrix2d>> scalings_;
  Eigen::VectorXd mobilities_;  ///< 1 / mass, 0 of fixed nodes
};

}  // namespace

std::unique_ptr<StrainLimiter> makeGaussSeidelLimiter(const solvers::ConeConstraints& constraints,
                                                      const ProjectionOptions& options) {
  return std::make_unique<GaussSeidelLimiter>(constraints, options);
}

}  // namespace pliant::cloth
