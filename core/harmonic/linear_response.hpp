#pragma once

#include "core/harmonic/frequency_response.hpp"
#include "core/harmonic/linearization.hpp"

namespace pliant::harmonic {

/// The steady response of the model linearised about its static equilibrium (linear modal analysis with all modes,
/// Fig. 2.5), solved directly at each frequency: for the harmonic k of the loads f and of the driven nodes' motion x_d
///   (K - (kω)² M + ikω D) u_k = f_k - (K - (kω)² M + ikω D)_d x_d,k,   D = D_α M + D_β K.
class LinearResponse {
 public:
  /// `system` as linearised for `problem`, converged.
  LinearResponse(const HarmonicBalanceProblem& problem, Linearization system);

  /// Coefficients like those of `problem` [m]; empty if the dynamic stiffness is singular (no damping at a resonance).
  Vector solve(double omega);
  /// Of the last solve: the force left over, relative to forceScale.
  double residual() const { return residual_; }
  /// Harmonics k > 0 that anything drives.
  const std::vector<int>& drivenHarmonics() const { return drivenHarmonics_; }

 private:
  void assembleDynamicStiffness(double rate);

  const HarmonicBalanceProblem& problem_;
  Linearization system_;  ///< stiffness and mass with their joint pattern
  Matrix loads_;          ///< coefficients over the free coordinates, without what the equilibrium bears
  Matrix swing_;          ///< coefficients of all coordinates' prescribed departure from the equilibrium
  std::vector<int> drivenHarmonics_;
  Vector mean_;  ///< u_0
  SparseMatrix dynamic_;
  math::SparseFactorization factors_;
  double residual_ = 0;
};

struct LinearResponseOptions {
  double from = 0;  ///< [rad/s]; may be above `to`
  double to = 0;
  int points = 200;                 ///< evenly spaced; more are put around resonances
  double locationTolerance = 1e-6;  ///< relative error of the frequency of peaks
};

/// The response curve of the linearised model, as traceFrequencyResponse traces that of the model itself: points in the
/// order of frequency with the peaks of every probe's path length among them. Throws base::InputError as that does.
FrequencyResponse traceLinearResponse(const HarmonicBalanceProblem& problem, const LinearResponseOptions& options,
                                      base::ExecutionContext& context);

}  // namespace pliant::harmonic
