#pragma once

#include "core/base/growing_results.hpp"
#include "core/interlock/cell_equilibrium.hpp"

namespace pliant::interlock {

/// What a cell may do across the direction in which it is pulled.
enum class Lateral {
  free,       ///< stretch and shear as it likes
  principal,  ///< stretch as it likes; the direction stays a principal one (thesis 4.3.3)
  held,       ///< nothing: the strain across stays 0, or where it was
  biaxial     ///< stretch in proportion; the direction stays a principal one
};

/// Strain of the direction at `angle` [rad] from the first axis, relative: d·F·d - 1.
double strainAlong(const Eigen::Vector3d& strain, double angle);

/// Pulls on the strain of that direction, or pushes. `ratio`: of the strain across to that along, if biaxial.
StrainDrive uniaxialDrive(double angle, bool compress, Lateral lateral, double ratio = 0);
/// Along a ray of strain coordinates.
StrainDrive rayDrive(const Eigen::Vector3d& direction);

struct LimitOptions {
  Lateral lateral = Lateral::free;
  double ratio = 1;  ///< of the strain across to that along, if biaxial
  /// Structures are often symmetric, and then held near a saddle under compression: elements are moved at random first
  /// by about this times the smallest radius. 0: not at all, which does not keep the symmetry either.
  double perturbation = 0.01;
  unsigned seed = 1;
  /// Tries with different seeds, of which the farthest counts: for compression, where there are many ways to fold.
  int trials = 1;
};

/// The farthest strain of a direction that contact allows.
struct DirectionLimit {
  double angle = 0;   ///< [rad]
  double strain = 0;  ///< at the limit
  CellEquilibrium equilibrium;
};

/// Starts from rest.
DirectionLimit directionLimit(const CellSolver& solver, double angle, bool compress, const LimitOptions& options = {},
                              const base::ExecutionContext* context = nullptr);

/// Stretch and compression limits of one direction, and the free travel between them relative to the shortest length
/// (thesis 4.4.1): (ε_s - ε_c) / (1 + ε_c).
struct FreeTravel {
  DirectionLimit stretch, compression;
  double travel() const { return (stretch.strain - compression.strain) / (1 + compression.strain); }
};

/// One for each angle, computed in parallel; the same for any number of threads. Those not reached yet, or not before
/// cancellation, have the termination `cancelled`. `observe` sees what there is so far, see GrowingResults.
std::vector<FreeTravel> freeTravel(const CellSolver& solver, const std::vector<double>& angles,
                                   const LimitOptions& options, base::ExecutionContext& context,
                                   const base::GrowingResults<FreeTravel>::Observer& observe = {});

}  // namespace pliant::interlock
