#pragma once

#include <memory>
#include <vector>

#include "core/harmonic/calibration.hpp"
#include "core/harmonic/design_branch.hpp"

namespace pliant::harmonic {

/// All residuals of measured motions over variables that are the parameters' places between their bounds, 0 to 1, by
/// following the branch of motions at each driving frequency. Rows: one measured motion after another, as in MotionFit.
/// The Jacobian is projected off the estimated phases and places, see MotionComparison.
class CalibrationResiduals final : public solvers::ResidualFunction {
 public:
  /// All parameters of `problem`'s model are fitted.
  CalibrationResiduals(const HarmonicBalanceProblem& problem, std::vector<MeasuredMotion> measured,
                       const PeriodicMotionOptions& motion, base::ExecutionContext& context);

  /// Finds the motions of the first parameters: the report of one that was not found, or of the last.
  base::SolverReport begin();
  /// After begin(). Motions whose Jacobian was asked for are those to start others from.
  bool evaluate(const Vector& variables, Vector& residuals, Matrix* jacobian) override;

  /// Lengths of the last Jacobian's columns before they were projected.
  const Vector& columnScales() const { return scales_; }
  /// The design accepted last at the driving frequency of a measured motion, and how it fits.
  const DesignPoint& pointOf(std::size_t measured) const { return frequencies_[parts_[measured].frequency]->base; }
  MotionFit fitOf(std::size_t measured) const;
  /// Of one driving frequency.
  const DesignBranch& anyBranch() const { return *frequencies_.front()->branch; }
  int failures() const { return failures_; }
  int solves() const;

 private:
  struct Frequency {
    InverseDesignOptions options;
    std::unique_ptr<DesignBranch> branch;
    DesignPoint base;  ///< accepted last
    DesignPoint last;  ///< reached last
  };
  struct Part {
    MotionComparison comparison;
    std::size_t frequency;
    MotionFit fit;  ///< of the motion reached last
  };

  static Matrix coefficientsOf(const Part& part, const DesignPoint& point);
  bool linearize(Matrix& jacobian);

  std::vector<std::unique_ptr<Frequency>> frequencies_;
  std::vector<Part> parts_;
  Vector scales_;
  int failures_ = 0;
};

}  // namespace pliant::harmonic
