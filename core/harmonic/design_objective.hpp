#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/harmonic/harmonic_balance_problem.hpp"

namespace pliant::harmonic {

/// A goal and its derivatives at one motion.
struct ObjectiveValue {
  double value = 0;
  /// ∂f by the Fourier coefficients of every coordinate's position, the driven and locked ones included:
  /// (2H+1) x coordinates.
  Matrix byCoefficients;
  Vector byParameters;  ///< ∂f/∂p of `Model::parameters`, the motion fixed
};

/// What a design is to achieve: a function f(z(p), p) of the motion and the design parameters, to be minimised.
class DesignObjective {
 public:
  virtual ~DesignObjective() = default;
  virtual ObjectiveValue evaluate(const HarmonicBalanceProblem& problem, const Vector& z) const = 0;
};

/// The path lengths A of some nodes (2.3.14).
struct AmplitudeGoal {
  std::vector<int> nodes;
  /// [m]; f = Σ (A - target)² (2.4.8). Without one, amplitudes are maximised: f = -Σ A.
  std::optional<double> target;
  /// Only motion along these axes counts (0: x, 1: y, 2: z); along all if empty.
  std::vector<int> axes;
};
std::shared_ptr<const DesignObjective> makeAmplitudeObjective(AmplitudeGoal goal);

/// A closed path that a node is to run along.
struct TargetPath {
  int node = 0;
  Matrix coefficients;  ///< as from nodeCoefficients, with any number of harmonics [m]
};

/// Trajectory matching in frequency space. The squared distance between the coefficients of motion and target,
/// f_Dist(φ) = Σ (s - ŝ)² + (c - ĉ)² (2.4.6), the target begun earlier by φ, is evaluated at N phases, common to all
/// nodes, and f is their smooth minimum Σ f_Dist e^(-α f_Dist) / Σ e^(-α f_Dist) (2.4.7).
struct PathGoal {
  std::vector<TargetPath> paths;
  bool matchPlace = false;  ///< adds 2 ‖c₀ - ĉ₀‖² to f_Dist, which is then twice the mean squared distance
  double sharpness = 1000;  ///< α times the target's own Σ ŝ² + ĉ²
  int phases = 256;         ///< N
};
std::shared_ptr<const DesignObjective> makePathObjective(PathGoal goal);

/// Fourier coefficients of the closed path through these points (dimension x n), run through at even steps of time:
/// (2H+1) x dimension.
Matrix pathCoefficients(const Matrix& points, int harmonics);

/// How far a motion is off target paths.
struct PathDistance {
  double phase = 0;                    ///< φ at which they agree best, in [0, 2π)
  double rootMeanSquare = 0;           ///< distance over a period and all nodes there [m]
  double relative = 0;                 ///< to the targets' own from their mean places
  std::vector<double> relativeOfPath;  ///< the same for each path, at the common phase
};
PathDistance pathDistance(const HarmonicBalanceProblem& problem, const Vector& z, const PathGoal& goal);

/// Σ ((p - reference) / (maximum - minimum))² over parameters, by index in `Model::parameters`: keeps a design near
/// another.
std::shared_ptr<const DesignObjective> makeParameterRegularization(std::vector<int> parameters, Vector reference);

struct WeightedObjective {
  double weight = 1;
  std::shared_ptr<const DesignObjective> objective;
};
std::shared_ptr<const DesignObjective> makeWeightedSum(std::vector<WeightedObjective> terms);

/// Every kind of objective, each with a random example for a problem with at least two nodes, so that one test checks
/// the gradients of all of them.
struct ObjectiveKind {
  std::string name;
  std::function<std::shared_ptr<const DesignObjective>(const HarmonicBalanceProblem&, std::mt19937&)> example;
};
const std::vector<ObjectiveKind>& objectiveKinds();

}  // namespace pliant::harmonic
