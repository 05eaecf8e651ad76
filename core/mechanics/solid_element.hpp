#pragma once

#include "core/mechanics/element_energy.hpp"
#include "core/mechanics/element_material.hpp"

namespace pliant::mechanics {

/// A linear tetrahedron of St. Venant-Kirchhoff material:
///   E = V (λ/2 (tr ε)² + μ tr ε²),  ε = ½ (FᵀF - I) the Green strain, V the rest volume.
/// In the basis of the edges eₖ = xₖ - x₀ the strain's components are differences of the edges' metric,
///   γ = (½ Δ(e₁·e₁), Δ(e₂·e₁), ½ Δ(e₂·e₂), Δ(e₃·e₁), Δ(e₃·e₂), ½ Δ(e₃·e₃)),
/// packed by rows of a lower triangle (off-diagonal components twice, as engineers write them), so that
///   E = ½ γᵀ C γ  with a constant 6 x 6 matrix C [J/m⁴],
/// and with the stresses s = C γ, a symmetric 3 x 3 matrix, ∂E/∂eᵢ = Σⱼ sᵢⱼ eⱼ: the Hessian is its material part
/// (products of the edges) plus the stresses on the diagonals. The coordinates are those of the four corners.
struct SolidElement {
  static constexpr int coordinates = 12;
  static constexpr std::string_view name = "solid";

  std::array<double, 6> restMetric;  ///< eᵢ·eⱼ, packed [m²]
  std::array<double, 21> stiffness;  ///< C, packed lower triangle
  ElementMaterial material;

  template <class T>
  using Edges = std::array<std::array<T, 3>, 3>;
  template <class T>
  using Components = std::array<T, 6>;

  template <class T>
  T evaluate(const std::array<T, 12>& x, std::array<T, 12>* gradient, std::array<T, packedSize(12)>* hessian,
             const std::array<T, 12>* stressFrom = nullptr, const std::array<T, 12>* stressTo = nullptr) const {
    const Edges<T> e = edgesOf(x);
    Components<T> strain;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) strain[packedIndex(i, j)] = component(i, j, dot(e[i], e[j]));
    const Components<T> stress = stressOf(strain);
    if (gradient) fillGradient(e, stress, *gradient);
    if (hessian && stressFrom) {
      const Edges<T> f = edgesOf(*stressFrom), t = edgesOf(*stressTo);
      Components<T> expected;  // the strain linearised at f
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
          expected[packedIndex(i, j)] = component(i, j, dot(f[i], t[j]) + dot(t[i], f[j]) - dot(f[i], f[j]));
      fillHessian(e, stressOf(expected), *hessian);
    } else if (hessian) {
      fillHessian(e, stress, *hessian);
    }
    T energy = 0.0;
    for (int m = 0; m < 6; ++m) energy += 0.5 * stress[m] * strain[m];
    return energy;
  }

 private:
  template <class T>
  static Edges<T> edgesOf(const std::array<T, 12>& x) {
    Edges<T> e;
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis) e[k][axis] = x[3 * k + 3 + axis] - x[axis];
    return e;
  }

  template <class T>
  static T dot(const std::array<T, 3>& p, const std::array<T, 3>& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  }

  template <class T>
  T component(int i, int j, const T& metric) const {
    const T difference = metric - restMetric[packedIndex(i, j)];
    return i == j ? 0.5 * difference : difference;
  }

  static constexpr int symmetricIndex(int i, int j) { return i >= j ? packedIndex(i, j) : packedIndex(j, i); }

  template <class T>
  Components<T> stressOf(const Components<T>& strain) const {
    Components<T> stress;
    for (int m = 0; m < 6; ++m) {
      stress[m] = 0.0;
      for (int n = 0; n < 6; ++n) stress[m] += stiffness[symmetricIndex(m, n)] * strain[n];
    }
    return stress;
  }

  template <class T>
  static void fillGradient(const Edges<T>& e, const Components<T>& stress, std::array<T, 12>& gradient) {
    for (int axis = 0; axis < 3; ++axis) {
      T sum = 0.0;
      for (int i = 0; i < 3; ++i) {
        T g = 0.0;
        for (int j = 0; j < 3; ++j) g += stress[symmetricIndex(i, j)] * e[j][axis];
        gradient[3 * i + 3 + axis] = g;
        sum += g;
      }
      gradient[axis] = -sum;
    }
  }

  template <class T>
  void fillHessian(const Edges<T>& e, const Components<T>& stress, std::array<T, packedSize(12)>& hessian) const {
    // Blocks of edges i >= j: sᵢⱼ I + Σₖₗ C_(ik)(jl) eₖ eₗᵀ.
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j <= i; ++j)
        for (int b = 0; b < 3; ++b) {
          std::array<T, 3> u;
#pragma GCC unroll 3
          for (int k = 0; k < 3; ++k) {
            u[k] = 0.0;
#pragma GCC unroll 3
            for (int l = 0; l < 3; ++l)
              u[k] += stiffness[symmetricIndex(symmetricIndex(i, k), symmetricIndex(j, l))] * e[l][b];
          }
          for (int a = i == j ? b : 0; a < 3; ++a) {
            T h = u[0] * e[0][a] + u[1] * e[1][a] + u[2] * e[2][a];
            if (a == b) h += stress[packedIndex(i, j)];
            hessian[packedIndex(3 * i + 3 + a, 3 * j + 3 + b)] = h;
          }
        }
    // x₀ moves all edges backwards.
    for (int b = 0; b < 3; ++b) {
      std::array<T, 3> sum{0.0, 0.0, 0.0};
      for (int i = 0; i < 3; ++i)
        for (int a = 0; a < 3; ++a) {
          T h = 0.0;
          for (int j = 0; j < 3; ++j) h -= hessian[symmetricIndex(3 * i + 3 + a, 3 * j + 3 + b)];
          hessian[packedIndex(3 * i + 3 + a, b)] = h;
          sum[a] -= h;
        }
      for (int a = b; a < 3; ++a) hessian[packedIndex(a, b)] = sum[a];
    }
  }
};

}  // namespace pliant::mechanics
