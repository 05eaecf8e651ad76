#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/math/sparse_factorization.hpp"
#include "core/mechanics/energy.hpp"
#include "core/mechanics/periodic_signal.hpp"

namespace pliant::mechanics {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using math::SparseMatrix;

/// A mass [kg] put on each of some nodes; a design parameter with bounds.
struct PointMass {
  std::string name;
  std::vector<int> nodes;
  double mass = 0;
  double minimum = 0;
  double maximum = 0;
};

/// force(θ) = direction * signal(θ) [N] on each of some nodes. `direction` is used as given (not normalised).
struct HarmonicForce {
  std::string name;
  std::vector<int> nodes;
  Vector direction;  ///< size: dimension
  PeriodicSignal signal;
};

/// Some coordinates as a function of a signal of the phases θ, eliminated exactly from the unknowns.
class PrescribedMotion {
 public:
  virtual ~PrescribedMotion() = default;
  virtual const std::vector<int>& coordinates() const = 0;
  virtual const PeriodicSignal& signal() const = 0;
  /// Values of these coordinates [m], which rest at `rest` (both of the size of coordinates()), for a value of the
  /// signal.
  virtual Vector place(const Vector& rest, double signalValue) const = 0;
  /// Their values at θ.
  Vector values(const Vector& rest, math::Phases phases) const { return place(rest, signal()(phases)); }
};

/// A node whose trajectory and amplitude are reported.
struct Probe {
  std::string name;
  int node = 0;
};

/// A point that moves with some nodes (or a fixed place): constant + Σ (weight x + turnedWeight Jx) of their positions
/// x, with J the quarter turn counter-clockwise in 2 dimensions.
struct AttachmentPoint {
  struct Term {
    int node;
    double weight;
    double turnedWeight;
    bool operator==(const Term&) const = default;
  };
  std::vector<Term> terms;
  Vector constant;  ///< size dimension [m]

  bool operator==(const AttachmentPoint& other) const { return terms == other.terms && constant == other.constant; }
};

/// Where the coordinates of one geometry of the scene stand, less nodes sewn to one before it, and what to draw of it.
struct DisplayPart {
  std::string name;
  int firstNode = 0;
  int nodeCount = 0;
  std::vector<std::array<int, 3>> triangles;            ///< global node indices
  std::vector<std::array<int, 4>> tetrahedra;           ///< global node indices; not drawn, but they have strains
  std::vector<std::array<int, 2>> segments;             ///< links and rods, global node indices
  std::vector<std::array<AttachmentPoint, 2>> springs;  ///< from end to end
  std::vector<std::array<AttachmentPoint, 2>> arms;     ///< what is rigid between a link and a spring's end beside it
};

/// Which coordinates are unknown.
struct DofMap {
  std::vector<int> freeIndex;        ///< per coordinate: index among the unknowns, or -1
  std::vector<int> freeCoordinates;  ///< per unknown: its coordinate
  int freeCount() const { return static_cast<int>(freeCoordinates.size()); }
};

class DesignParameter;

/// A discrete mechanical system M ẍ + D ẋ + ∇E(x) = f(θ), D = massDamping M + stiffnessDamping ∇²E(x).
/// Constant once built; copying it is cheap (energies are shared), so a changed parameter is a changed copy.
///
/// Its coordinates are the positions of the nodes (coordinate node * dimension + axis), followed by `scalarCount`
/// scalar coordinates, such as the twist of a rod's edge or the angle of a servo. Those are in metres as well, an angle
/// times a length of the energy's choice, so that the norm of a configuration means something.
struct Model {
  int dimension = 3;
  int scalarCount = 0;
  Vector restPositions;  ///< of all coordinates [m]
  std::vector<std::shared_ptr<const Energy>> energies;
  std::shared_ptr<const SparseMatrix> elementMass;  ///< of the elements, square over all coordinates [kg]
  std::vector<PointMass> pointMasses;
  double massDamping = 0;       ///< D_α [1/s]
  double stiffnessDamping = 0;  ///< D_β [s]
  Vector gravity;               ///< size: dimension [m/s²]
  std::vector<HarmonicForce> forces;
  std::vector<std::shared_ptr<const PrescribedMotion>> drives;
  std::vector<char> lockedCoordinates;  ///< per coordinate: 1 if it keeps its rest value
  std::vector<Probe> probes;
  std::vector<DisplayPart> parts;
  std::vector<std::shared_ptr<const DesignParameter>> parameters;
  std::vector<double> familyValues;  ///< of the parameters that makeFamilyParameter makes
  DofMap dofs;                       ///< set by finish()

  int nodeCount() const { return (coordinateCount() - scalarCount) / dimension; }
  int coordinateCount() const { return static_cast<int>(restPositions.size()); }

  /// Appends scalar coordinates that rest at 0 and returns the first one's index. To be called before the sizes of
  /// `elementMass` are settled.
  int addScalars(int count);

  /// Computes `dofs` and checks sizes. Throws base::InputError if no coordinate is free or one is driven twice.
  void finish();

  /// M with the point masses, square over all coordinates [kg].
  SparseMatrix massMatrix() const;
  /// External forces on all coordinates at θ [N], gravity included.
  Vector externalForce(math::Phases phases) const;
  /// All coordinates at θ with the free ones taken from `free` (size freeCount) [m].
  Vector configuration(const Vector& free, math::Phases phases) const;
  /// Whether a drive or load has a term of the second driving frequency.
  bool hasSecondFrequency() const;
  /// The nodes of which a coordinate is driven, ascending.
  std::vector<int> drivenNodes() const;
};

}  // namespace pliant::mechanics
