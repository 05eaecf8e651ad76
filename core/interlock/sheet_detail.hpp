#pragma once

#include <string>

#include "core/base/execution_context.hpp"
#include "core/base/solver_report.hpp"
#include "core/interlock/fabric_patch.hpp"
#include "core/interlock/sheet_shape.hpp"

namespace pliant::interlock {

/// Lengths in units of the smallest radius r of all wires.
struct DetailOptions {
  double range = 0.3;          ///< of the barrier
  double weight = 1e-2;        ///< of the barrier against the pull ½ (distance from the target / r)²
  double turnPull = 0.05;      ///< of the pull on the turn, ½ turnPull angle²
  int sweeps = 2;              ///< over all elements after each step along the path
  int finalSweeps = 200;       ///< at its end, at most
  double tolerance = 1e-2;     ///< no element moves farther in the last sweep
  double smallestStep = 1e-3;  ///< of the way between two places of the path
};

/// The elements of a sheet on its deformed shape.
struct SheetDetail {
  base::TerminationType termination = base::TerminationType::failed;
  std::string message;                 ///< one sentence if not converged
  std::vector<PatchElement> elements;  ///< of the lattice, sorted
  int leftOut = 0;                     ///< in the sheet, but not linked to those
  CellState state;                     ///< of the elements: positions and rotations
  double reached = 0;                  ///< of the path; 1 is its end
  Eigen::VectorXd pulls;               ///< how far elements are from where the sheet wants them [m]
  Eigen::VectorXd turns;               ///< the same of their turns [rad]
  double smallestGap = 0;              ///< between elements, exact, or the barrier's range if that is less [m]
  double lastMove = 0;                 ///< of the farthest element in the last sweep [m]
  int steps = 0, sweeps = 0;
  long jams = 0;  ///< elements that were carried along with neighbours, over all steps
  double seconds = 0;
};

/// Of the triangles of a sheet of several materials, see sharedLattice.
struct DetailMaterials {
  std::vector<int> ofTriangle;  ///< empty: the first
  int count = 1;
};

/// Places the elements of a material where its sheet leads them, so that they neither meet nor lose a link. They follow
/// the sheet along a path from a flat, undeformed start, where they are as in the material at rest.
///
/// A step along the path carries each element as the sheet around it moves (SheetShape), and the sweeps after it let
/// elements one by one come nearer to where the sheet wants them, by Newton's method under contact, with a barrier. In
/// either no element passes through another one: a pair moves relatively to each other by less than twice the sum of
/// its smallest radii, and there is a gap at both ends, see CellSolver. Pairs that would lose too much of their gap in
/// a step are carried as one, with the mean motion of all that hang together by such pairs; where that does not help
/// either the step is halved.
class SheetDetailer {
 public:
  /// `angle` is that of the material's first axis in the sheet [rad]; `centre` where the sheet's origin is in the
  /// material [m]; of a sharedLattice `materials` say which of its materials is where.
  /// Throws base::InputError (location empty) for a sheet with no element in it, or of elements with pieces without a
  /// radius.
  SheetDetailer(const UnitCell& cell, geometry::SurfaceMesh sheet, double angle, const Eigen::Vector2d& centre,
                const DetailOptions& options = {}, const DetailMaterials& materials = {});

  /// `path`: positions of the sheet's nodes, the first flat and as long as at rest, one at least.
  SheetDetail follow(const std::vector<Eigen::Matrix3Xd>& path, base::ExecutionContext& context) const;

  const std::vector<PatchElement>& elements() const { return elements_; }
  const UnitCell& cell() const { return cell_; }

 private:
  friend class DetailSearch;
  UnitCell cell_;
  DetailOptions options_;
  SheetShape shape_;
  std::vector<ElementParts> parts_;  ///< by shape
  std::vector<double> radii_;        ///< the smallest, by shape [m]
  double radius_ = 0;                ///< of all
  std::vector<PatchElement> elements_;
  std::vector<SheetShape::Place> places_;  ///< of the elements' origins in the sheet
  std::vector<double> heights_;            ///< above it [m]
  std::vector<Eigen::Matrix3d> turned_;    ///< of the elements on the flat sheet
  int leftOut_ = 0;
};

}  // namespace pliant::interlock
