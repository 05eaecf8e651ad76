#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "core/mechanics/shell.hpp"
#include "core/mechanics/solid.hpp"
#include "core/mechanics/stiffness_factor.hpp"

namespace pliant::mechanics {

/// What is told of an element: the von Mises stress of its Cauchy stress [Pa], or its largest principal stretch
/// minus 1.
enum class ElementMeasure { vonMises, principalStrain };

/// Stress, or strain, of a model's membranes, shells and solids, of what their energies say: a change of material,
/// thickness, rest shape or stiffness factor is a change of the energies.
///
/// With C = FᵀF and the strain ε = ½ (C - I) in a frame of the element at rest, S = λ tr ε I + 2μ ε (in plane stress λ
/// = Y ν / (1 - ν²), 2μ = Y / (1 + ν)) and the Cauchy stress σ = F S Fᵀ / J,
///   σ_Mises² = (3/2 tr (SC)² - 1/2 (tr SC)²) / J²,
/// J² = det C of a tetrahedron, and det C (1 + 2 ε₃₃), ε₃₃ = -λ/2μ tr ε, of a triangle, which thins as it is stretched.
///
/// A triangle that hinges bend has two surfaces with S ± 6 M / h², h the thickness and M its bending moments, which are
/// those of the hinges: nᵀ M n = (dE/dθ) / l at each edge of length l and normal n at rest, zero at an edge without a
/// hinge, as at a free border. That makes M the constant moments of Hellan (1967), Herrmann (1967) and Johnson (1973),
/// M = Σ (dE/dθ)ᵢ / lᵢ sym(tⱼ tₖᵀ) / (nᵢ·tⱼ nᵢ·tₖ), t the directions of the edges: what loads demand is there whatever
/// angles the mesh needs for it, so a cantilever has M y / I. What is approximate: hinges know no Poisson effect, so
/// where the shape rather than the load decides, as across a wide plate that is bent along its length, M lacks what ν
/// adds; beside a clamp across several cells single triangles are off by up to a fifth (test_element_stress); F is that
/// of the middle surface, with S at both surfaces, which neglects strains against 1. The strain of a surface is ε plus
/// that which 6 M / h² belongs to. A triangle without a free coordinate is not bent: what holds it in its shape is not
/// known, its free neighbour tells of the moment at a clamp.
class ElementStress {
 public:
  /// Of those elements of `model`, which is finished, whose corners are among `triangles` or `tetrahedra`, in any
  /// order.
  ElementStress(const Model& model, const Triangles& triangles, const Tetrahedra& tetrahedra, ElementMeasure measure);

  /// Places where it is told: two a triangle that bends (its surfaces), one an element otherwise.
  int count() const { return count_; }
  /// Which element a place belongs to.
  const std::vector<ElementPlace>& elements() const { return elements_; }

  /// At each place, for positions `x` of all coordinates [m].
  Vector values(const Vector& x) const;
  /// Adds Σ weight ∂value/∂x, like x; places of no weight cost nothing.
  void addGradient(const Vector& x, const Vector& weights, Vector& gradient) const;
  /// At each place, weight times the derivative of the value by the logarithm of the element's own stiffness, that of
  /// the hinges fixed.
  Vector byStiffness(const Vector& x, const Vector& weights) const;

 private:
  struct Hinge {
    std::array<int, 4> nodes;
    double stiffness;  ///< as of HingeElement
    double restAngle;
  };
  struct Side {
    int hinge;
    Eigen::Matrix2d stress;  ///< 6 M / h² for dE/dθ = 1 N m [1/m³]
  };
  template <int D>
  struct Body {
    std::array<int, D + 1> nodes;
    Eigen::Matrix<double, D, D> inverse;  ///< of the rest edges in a frame of the element [1/m]
    double lambda, twoMu;                 ///< [Pa]
    double thinning = 0;                  ///< -ε₃₃ / tr ε
    double thickness = 0;                 ///< h [m]
    std::vector<Side> sides;
    ElementPlace place;

    int placeCount() const { return sides.empty() ? 1 : 2; }
  };
  template <int D>
  using Square = Eigen::Matrix<double, D, D>;

  template <class Element, int D>
  void addBodies(const Energy& energy, int index, const std::vector<double>& scales,
                 const std::vector<std::array<int, D + 1>>& chosen, std::vector<Body<D>>& bodies) const;
  using TrianglesByCorners = std::multimap<std::array<int, 3>, std::size_t>;
  void addHinges(const Energy& energy, const TrianglesByCorners& triangles);
  void addSide(int hinge, const std::array<int, 3>& corners, Body<2>& body) const;
  template <int D>
  double measured(const Body<D>& body, const Square<D>& metric, const Square<D>& added, Square<D>* byMetric,
                  Square<D>* byAdded) const;
  /// dE/dθ of a hinge, and its derivative by its coordinates.
  static double momentOf(const Hinge& hinge, const Vector& x, std::array<double, 12>* gradient);
  /// F in a frame of the element, and what is added to S at the upper surface.
  template <int D>
  Eigen::Matrix<double, 3, D> deformation(const Body<D>& body, const Vector& x) const;
  template <int D>
  Square<D> bendingStress(const Body<D>& body, const Vector& x) const;
  template <int D>
  void addBodyGradient(const Body<D>& body, const Vector& x, const double* weights, Vector& gradient) const;

  int dimension_;
  ElementMeasure measure_;
  std::vector<Body<2>> triangles_;
  std::vector<Body<3>> tetrahedra_;
  std::vector<Hinge> hinges_;
  std::vector<ElementPlace> elements_;
  int count_ = 0;
};

}  // namespace pliant::mechanics
