#pragma once

#include <limits>

#include "core/mechanics/element_energy.hpp"
#include "core/mechanics/element_material.hpp"

namespace pliant::mechanics {

/// A constant-strain triangle of St. Venant-Kirchhoff material in plane stress:
///   E = A h Y / (2 (1-ν²)) (ν (tr ε)² + (1-ν) tr ε²),  ε = ½ (FᵀF - I) the Green strain, A the rest area.
/// ε is linear in the metric a = (e₁·e₁, e₂·e₂, e₁·e₂) of the edges e₁ = x₁ - x₀ and e₂ = x₂ - x₀, so that
///   E = ½ (a - a₀)ᵀ Q (a - a₀)  with a constant 3 x 3 matrix Q [J/m⁴],
/// and the Hessian is its material part (products of e₁ and e₂) plus the stresses s = Q (a - a₀) on the diagonals.
/// The coordinates are those of the three corners.
template <int dimension>
struct MembraneElement {
  static constexpr int coordinates = 3 * dimension;
  static constexpr std::string_view name = "membrane";

  std::array<double, 3> restMetric;  ///< e₁·e₁, e₂·e₂, e₁·e₂ [m²]
  std::array<double, 6> stiffness;   ///< Q, packed lower triangle
  ElementMaterial material;

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian, const std::array<T, coordinates>* stressFrom = nullptr,
             const std::array<T, coordinates>* stressTo = nullptr) const {
    constexpr int n = dimension;
    std::array<T, n> e1, e2;
    T a11 = 0.0, a22 = 0.0, a12 = 0.0;
    for (int i = 0; i < n; ++i) {
      e1[i] = x[n + i] - x[i];
      e2[i] = x[2 * n + i] - x[i];
      a11 += e1[i] * e1[i];
      a22 += e2[i] * e2[i];
      a12 += e1[i] * e2[i];
    }
    a11 -= restMetric[0];
    a22 -= restMetric[1];
    a12 -= restMetric[2];
    const auto& [q11, q21, q22, q31, q32, q33] = stiffness;
    const T s1 = q11 * a11 + q21 * a22 + q31 * a12;
    const T s2 = q21 * a11 + q22 * a22 + q32 * a12;
    const T s3 = q31 * a11 + q32 * a22 + q33 * a12;
    if (gradient)
      for (int i = 0; i < n; ++i) {
        const T g1 = 2.0 * s1 * e1[i] + s3 * e2[i];
        const T g2 = 2.0 * s2 * e2[i] + s3 * e1[i];
        (*gradient)[i] = -(g1 + g2);
        (*gradient)[n + i] = g1;
        (*gradient)[2 * n + i] = g2;
      }
    if (hessian && stressFrom) {
      T b11 = 0.0, b22 = 0.0, b12 = 0.0;
      for (int i = 0; i < n; ++i) {
        const T f1 = (*stressFrom)[n + i] - (*stressFrom)[i];
        const T f2 = (*stressFrom)[2 * n + i] - (*stressFrom)[i];
        const T t1 = (*stressTo)[n + i] - (*stressTo)[i];
        const T t2 = (*stressTo)[2 * n + i] - (*stressTo)[i];
        b11 += f1 * (2.0 * t1 - f1);
        b22 += f2 * (2.0 * t2 - f2);
        b12 += f1 * t2 + t1 * f2 - f1 * f2;
      }
      b11 -= restMetric[0];
      b22 -= restMetric[1];
      b12 -= restMetric[2];
      fillHessian(e1, e2, q11 * b11 + q21 * b22 + q31 * b12, q21 * b11 + q22 * b22 + q32 * b12,
                  q31 * b11 + q32 * b22 + q33 * b12, *hessian);
    } else if (hessian) {
      fillHessian(e1, e2, s1, s2, s3, *hessian);
    }
    return 0.5 * (s1 * a11 + s2 * a22 + s3 * a12);
  }

  /// The Hessian with the tensile part of the stresses alone. In the triangle's own rest frame the stresses are
  /// S = R (2s₁, s₃; s₃, 2s₂) Rᵀ / (2A h), R the upper triangular matrix of the rest edges there (RᵀR is their metric).
  template <class T>
  void convexHessian(const std::array<T, coordinates>& x, std::array<T, packedSize(coordinates)>& hessian) const {
    using std::sqrt;
    constexpr int n = dimension;
    std::array<T, n> e1, e2;
    T a11 = -restMetric[0], a22 = -restMetric[1], a12 = -restMetric[2];
    for (int i = 0; i < n; ++i) {
      e1[i] = x[n + i] - x[i];
      e2[i] = x[2 * n + i] - x[i];
      a11 += e1[i] * e1[i];
      a22 += e2[i] * e2[i];
      a12 += e1[i] * e2[i];
    }
    const auto& [q11, q21, q22, q31, q32, q33] = stiffness;
    const T s11 = 2.0 * (q11 * a11 + q21 * a22 + q31 * a12);
    const T s22 = 2.0 * (q21 * a11 + q22 * a22 + q32 * a12);
    const T s12 = q31 * a11 + q32 * a22 + q33 * a12;
    const double r11 = std::sqrt(restMetric[0]), r12 = restMetric[2] / r11;
    const double r22 = std::sqrt(restMetric[1] - r12 * r12);
    T p11 = r11 * r11 * s11 + 2 * r11 * r12 * s12 + r12 * r12 * s22;
    T p12 = r22 * (r11 * s12 + r12 * s22), p22 = r22 * r22 * s22;
    // Eigenvalues mean ± radius; their positive parts belong to the same axes.
    const T mean = 0.5 * (p11 + p22), half = 0.5 * (p11 - p22);
    const T radius = sqrt(half * half + p12 * p12) + std::numeric_limits<double>::min();
    const auto positive = [](const T& value) { return 0.5 * (value + sqrt(value * value)); };
    const T larger = positive(mean + radius), smaller = positive(mean - radius);
    const T factor = (larger - smaller) / (2.0 * radius), rest = 0.5 * (larger + smaller) - factor * mean;
    p11 = factor * p11 + rest;
    p22 = factor * p22 + rest;
    p12 = factor * p12;
    const T t22 = p22 / (r22 * r22), t12 = (p12 / r22 - r12 * t22) / r11;
    const T t11 = (p11 - 2 * r11 * r12 * t12 - r12 * r12 * t22) / (r11 * r11);
    fillHessian(e1, e2, T(0.5 * t11), T(0.5 * t22), t12, hessian);
  }

 private:
  template <class T>
  void fillHessian(const std::array<T, dimension>& e1, const std::array<T, dimension>& e2, const T& s1, const T& s2,
                   const T& s3, std::array<T, packedSize(coordinates)>& hessian) const {
    constexpr int n = dimension;
    const auto& [q11, q21, q22, q31, q32, q33] = stiffness;
    // Blocks by e₁e₁, e₂e₂ (symmetric) and e₂e₁: rows u e₁ + v e₂ times the edges.
    for (int j = 0; j < n; ++j) {
      const T u11 = 4.0 * q11 * e1[j] + 2.0 * q31 * e2[j], v11 = 2.0 * q31 * e1[j] + q33 * e2[j];
      const T u22 = q33 * e1[j] + 2.0 * q32 * e2[j], v22 = 2.0 * q32 * e1[j] + 4.0 * q22 * e2[j];
      const T u21 = 2.0 * q31 * e1[j] + q33 * e2[j], v21 = 4.0 * q21 * e1[j] + 2.0 * q32 * e2[j];
      for (int i = 0; i < n; ++i) {
        T h21 = u21 * e1[i] + v21 * e2[i];  // d²E / de₂[i] de₁[j]
        if (i == j) h21 += s3;
        hessian[packedIndex(2 * n + i, n + j)] = h21;
        if (i < j) continue;
        T h11 = u11 * e1[i] + v11 * e2[i];
        T h22 = u22 * e1[i] + v22 * e2[i];
        if (i == j) {
          h11 += 2.0 * s1;
          h22 += 2.0 * s2;
        }
        hessian[packedIndex(n + i, n + j)] = h11;
        hessian[packedIndex(2 * n + i, 2 * n + j)] = h22;
      }
    }
    // x₀ moves both edges backwards.
    const auto symmetric = [&](int block, int i, int j) -> const T& {
      return hessian[i >= j ? packedIndex(block * n + i, block * n + j) : packedIndex(block * n + j, block * n + i)];
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const T h10 = -(symmetric(1, i, j) + hessian[packedIndex(2 * n + j, n + i)]);
        const T h20 = -(symmetric(2, i, j) + hessian[packedIndex(2 * n + i, n + j)]);
        hessian[packedIndex(n + i, j)] = h10;
        hessian[packedIndex(2 * n + i, j)] = h20;
      }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j)
        hessian[packedIndex(i, j)] = -(hessian[packedIndex(n + i, j)] + hessian[packedIndex(2 * n + i, j)]);
  }
};

}  // namespace pliant::mechanics
