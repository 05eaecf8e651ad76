#pragma once

#include <limits>
#include <vector>

#include "core/math/block_cholesky.hpp"
#include "core/solvers/cone_program.hpp"
#include "core/solvers/symmetric_packet.hpp"

namespace pliant::solvers {

using Positions = Eigen::Matrix3Xd;

/// The primal-dual state of all bounds of a cone program, and what an interior-point iteration does with it: passes
/// over the elements, eight at a time.
///
/// Bound k of an element with F: ½ (T FᵀF T - I) + S = 0 with T = S_k^{-½}, a slack S and a multiplier Λ, both
/// symmetric positive definite 2 x 2, and ΛS = 0 at the optimum; a direction has v, s and λ instead: ½ (vᵀFᵀFv - 1) + s
/// = 0. Nesterov-Todd scaling with W Λ W = S, U = W⁻¹, G = W^½, V = GΛG. A step dx gives dF, E = sym(T Fᵀ dF T), and
///   dS = -r - h - E,  dΛ = -Λ + Y - U dS U,
/// with the residual r of the bound, h = ½ T dF̃ᵀdF̃ T and Y = G⁻¹XG⁻¹, ½ (VX + XV) = σμ I - sym((G⁻¹dS̃G⁻¹)(G dΛ̃ G)) of
/// the direction before (~), or h = 0 and Y = 0 in the predictor. Condensed onto positions,
///   K dx = -M (x - x̂) - Σ F (U (r + h) U + Y) w - Σ dF̃ dΛ̃ w,  K = M + Σ w (Λ ⊗ I) w + Eᵀ (U · U) E.
class ConeElements {
 public:
  ConeElements(const ConeConstraints& constraints, const std::vector<int>& vertexOfNode,
               const math::BlockCholesky& cholesky);

  /// Says where the blocks stand in another factorisation; what the bounds' state is stays.
  void locate(const std::vector<int>& vertexOfNode, const math::BlockCholesky& cholesky);

  int boundCount() const { return boundCount_; }  ///< the sum of their orders: 2 an ellipse, 1 a direction

  /// Adds Σ w (stiffness I) w to `cholesky`, and its product with x to `forces`.
  void addLaplacian(double stiffness, const Positions& x, Positions& forces, math::BlockCholesky& cholesky) const;

  /// Slacks start at least this large, where 1/2 is a bound that is not felt at all. More directions than an element
  /// has degrees of freedom want more room.
  struct StartingSlack {
    double ellipses = 0.001;
    double directions = 0.004;
  };
  /// S near what x leaves, but well inside; Λ = barrier S⁻¹, plus the multipliers there were if `keep`.
  void start(const Positions& x, double barrier, bool keep, const StartingSlack& least);
  void start(const Positions& x, double barrier, bool keep) { start(x, barrier, keep, StartingSlack()); }

  /// The multipliers Λ of all bounds, with the padding of the packets.
  struct Multipliers {
    std::vector<SymmetricPacket> ellipses;
    std::vector<Packet> directions;
  };
  Multipliers multipliers() const;
  void setMultipliers(const Multipliers& multipliers, double factor);
  /// Adds the Σ FΛw of such multipliers at x to `forces`, and returns what Linearization::supportGap says of them.
  double addForces(const Multipliers& multipliers, const Positions& x, Positions& forces) const;

  /// What is known at x with the present slacks and multipliers.
  struct Linearization {
    double complementarity = 0;  ///< Σ ⟨Λ, S⟩
    double residual = 0;         ///< largest entry of the r
    double largestStretch = 0;   ///< over all bounds
    /// Σ ‖F T Λ‖_* - ⟨F T Λ, F T⟩: how much more these forces could gain within the bounds than they do at x.
    double supportGap = 0;
  };
  /// Adds Σ FΛw to `forces` and Σ F (U r U) w to `predictorForces` (3 x nodes), and the elements' part of K to
  /// `cholesky`.
  Linearization linearize(const Positions& x, Positions& forces, Positions& predictorForces,
                          math::BlockCholesky& cholesky);

  /// The direction that belongs to dx, with the h and Y there are. Returns the longest step in which all S and Λ stay
  /// positive semidefinite.
  double direct(const Positions& dx);
  /// Σ ⟨Λ + α dΛ, S + α dS⟩.
  double complementarityAfter(double step) const;
  void clearCorrection();  ///< h = 0, Y = 0
  /// h and Y from the last direction, whose products count `weight` times (1, or 0: the direction does not matter);
  /// adds Σ F (U (r + h) U + Y) w + dF̃ dΛ̃ w to `forces`.
  void correct(double target, double weight, Positions& forces);
  /// Changes Y by what brings the products ΛS after a `step` along the last direction, which are to be `target`, back
  /// to within a factor of ten of it (Gondzio 1996); adds to `forces` as `correct` does.
  void centralise(double target, double step, Positions& forces);
  void keepDirection();
  void restoreDirection();
  void advance(double step);

  /// Over all bounds at x.
  double largestStretch(const Positions& x) const;
  /// Fills in all multipliers.
  void report(ConeSolution& solution) const;

 private:
  static constexpr int lanes = Packet::width;

  struct Group {  ///< eight elements with the same bounds
    int nodes[3][lanes];
    int element[lanes];  ///< -1: padding
    Packet weights[3][2];
    Packet mask;  ///< 1, or 0 for padding
    int bounds = 0;
    int firstEllipse = 0;
    int firstDirection = 0;
    Eigen::Index place[6][lanes];  ///< of blocks 00, 11, 22, 10, 20, 21; -1: of a fixed node
    int stride[6][lanes];
    bool transposed[6][lanes];
    MapPacket f, df, keptDf;
  };
  struct Ellipse {
    SymmetricPacket s, l, u, g, inverseG, v, r, h, y, ds, dl, keptDs, keptDl;
  };
  struct Direction {
    Packet s, l, r, h, y, ds, dl, keptDs, keptDl;
  };
  struct Bounds {
    std::vector<SymmetricPacket> scalings;  ///< T
    std::vector<std::array<double, 2>> directions;
  };

  MapPacket mapOf(const Group& group, const Positions& x) const;
  static void scatter(const Group& group, const Packet (&nodeForces)[3][3], Positions& forces);
  static void addForce(const Group& group, const MapPacket& f, const SymmetricPacket& y, Packet (&nodeForces)[3][3]);
  static void assemble(const Group& group, const SymmetricPacket& l, const Packet (&c)[6],
                       math::BlockCholesky& cholesky);

  std::vector<Group> groups_;
  std::vector<Ellipse> ellipses_;
  std::vector<Direction> directions_;
  std::vector<Bounds> bounds_;
  std::vector<int> ellipseOf_;    ///< per element: the first of its ellipses among all, and the end
  std::vector<int> directionOf_;  ///< the same for directions
  int boundCount_ = 0;
};

}  // namespace pliant::solvers
