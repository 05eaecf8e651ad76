#pragma once

#include <Eigen/Eigenvalues>

#include "core/mechanics/admissible_strain_set.hpp"
#include "core/mechanics/element_energy.hpp"
#include "core/mechanics/hinge_element.hpp"
#include "core/mechanics/strain_limits.hpp"

namespace pliant::mechanics {

/// A symmetric matrix without its negative eigenvalues.
template <int n>
Eigen::Matrix<double, n, n> positivePart(const Eigen::Matrix<double, n, n>& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> eigen(matrix);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() * eigen.eigenvectors().transpose();
}

/// ψ of strain limits and its derivatives; infinite where a barrier has no value.
StrainFunction limitPotential(const AdmissibleStrainSet& set, const StrainLimitFunction& function,
                              const Eigen::Vector3d& strain, bool withDerivatives = true);

/// What both kinds of elements do to be evaluated for several configurations at once: one after the other.
/// `Derived` has evaluateOne of doubles, whose Hessian may be asked for without what makes it indefinite: negative
/// eigenvalues of ψ'', compressive stresses, and the curvature of angles.
template <class Derived, int count>
struct StrainLimitElement {
  static constexpr int coordinates = count;
  template <class T>
  using Gradient = std::array<T, count>;
  template <class T>
  using Hessian = std::array<T, packedSize(count)>;

  std::shared_ptr<const AdmissibleStrainSet> set;
  StrainLimitFunction function;
  double area = 0;  ///< [m²]

  double evaluate(const Gradient<double>& x, Gradient<double>* gradient, Hessian<double>* hessian) const {
    return own().evaluateOne(x, gradient, hessian, false);
  }
  void convexHessian(const Gradient<double>& x, Hessian<double>& hessian) const {
    own().evaluateOne(x, nullptr, &hessian, true);
  }

  math::Packet evaluate(const Gradient<math::Packet>& x, Gradient<math::Packet>* gradient,
                        Hessian<math::Packet>* hessian) const {
    return evaluateLanes(x, gradient, hessian, false);
  }
  void convexHessian(const Gradient<math::Packet>& x, Hessian<math::Packet>& hessian) const {
    evaluateLanes(x, nullptr, &hessian, true);
  }

 private:
  math::Packet evaluateLanes(const Gradient<math::Packet>& x, Gradient<math::Packet>* gradient,
                             Hessian<math::Packet>* hessian, bool convex) const {
    constexpr int width = math::Packet::width;
    alignas(64) double values[width], gradients[count][width], hessians[packedSize(count)][width];
    for (int lane = 0; lane < width; ++lane) {
      Gradient<double> at, slope;
      Hessian<double> second;
      for (int i = 0; i < count; ++i) at[i] = x[i][lane];
      values[lane] = own().evaluateOne(at, gradient ? &slope : nullptr, hessian ? &second : nullptr, convex);
      for (int i = 0; gradient && i < count; ++i) gradients[i][lane] = slope[i];
      for (int i = 0; hessian && i < packedSize(count); ++i) hessians[i][lane] = second[i];
    }
    for (int i = 0; gradient && i < count; ++i) math::load(gradients[i], (*gradient)[i]);
    for (int i = 0; hessian && i < packedSize(count); ++i) math::load(hessians[i], (*hessian)[i]);
    math::Packet value;
    math::load(values, value);
    return value;
  }

  const Derived& own() const { return static_cast<const Derived&>(*this); }
};

/// area ψ(s) of the Green strain of a triangle, s = L (a - a₀) with the metric a of its edges as in MembraneElement.
struct StretchLimitElement : StrainLimitElement<StretchLimitElement, 9> {
  static constexpr std::string_view name = "stretch_limit";

  Eigen::Vector3d restMetric;
  Eigen::Matrix3d strainOfMetric;  ///< L [1/m²]
  Eigen::Matrix2d restEdges;       ///< from corner 0, in columns [m]

  Eigen::Vector3d strain(const std::array<double, 9>& x) const;
  double evaluateOne(const std::array<double, 9>& x, std::array<double, 9>* gradient,
                     std::array<double, packedSize(9)>* hessian, bool convex) const;
};

/// area ψ(Λ) of the curvature Λ of a triangle in the rest metric, a linear function of the angles θ_i between it and
/// its neighbours (HingeElement, whose θ is positive where the neighbour hangs back from the triangle's normal); Λ is
/// positive where the sheet curves towards the normal. On lattices it is that of Gingold et al. 2004 (thesis 4.3.4),
///   Λ = -Σ_i θ_i / (2 A l_i) t_i ⊗ t_i
/// over edges of length l_i with the outward normal t_i in the plane, |t_i| = l_i. On other meshes that formula does
/// not converge, so it is the curvature of the quadratic through the six corners, to first order in the angles, which
/// is the same on lattices; Gingold's is left for triangles that lack a neighbour and for six corners nearly on a
/// conic, where there is no such quadratic. Corners: those of the triangle, then the neighbours' corners opposite edge
/// i, which lies opposite corner i; where there is no neighbour θ_i = 0, and corner i stands in its place.
struct CurvatureLimitElement : StrainLimitElement<CurvatureLimitElement, 18> {
  static constexpr std::string_view name = "curvature_limit";

  std::array<bool, 3> hasNeighbour{};
  Eigen::Matrix3d curvatureOfAngles;  ///< columns: Λ of each θ_i [1/m]

  Eigen::Vector3d curvature(const std::array<double, 18>& x) const;
  double evaluateOne(const std::array<double, 18>& x, std::array<double, 18>* gradient,
                     std::array<double, packedSize(18)>* hessian, bool convex) const;
};

}  // namespace pliant::mechanics
