#pragma once

#include "core/mechanics/element_energy.hpp"

namespace pliant::mechanics {

/// Bending over one interior edge: E = stiffness (θ - θ₀)², θ the dihedral angle (0 where flat).
/// Corners: x₀ and x₁ on the edge, x₂ and x₃ opposite it. With e = x₁ - x₀, u = x₂ - x₀, v = x₃ - x₀:
///   n₁ = e × u, n₂ = v × e, θ = atan2(-|e| n₁·v, n₁·n₂).
/// Derivatives (the angle's Hessian of Tamstorf & Grinspun 2013, derived anew in this form): in each of the two
/// triangles let α = u·e/|e|² be the foot of the height on the edge, h the height, a = n/(|n|h) the unit normal over h,
/// b = (u - αe)/h² the unit vector along the height over h, and P = abᵀ + baᵀ. With ε = e/|e|², in the coordinates (e,
/// u, v),
///   ∂θ/∂u = -a₁, ∂θ/∂v = -a₂, ∂θ/∂e = α₁a₁ + α₂a₂,
///   θ_uu = P₁, θ_vv = P₂, θ_uv = 0, θ_ue = εa₁ᵀ - α₁P₁, θ_ve = εa₂ᵀ - α₂P₂,
///   θ_ee = Σ α²P - α(εaᵀ + aεᵀ) + (h/|e|)² abᵀ  (symmetric, summed over both triangles),
/// and x₀ moves all three backwards.
struct HingeElement {
  static constexpr int coordinates = 12;
  static constexpr std::string_view name = "hinge_bending";

  double stiffness;  ///< [J]
  double restAngle;  ///< θ₀ [rad]

  template <class T>
  T evaluate(const std::array<T, 12>& x, std::array<T, 12>* gradient, std::array<T, packedSize(12)>* hessian) const {
    return evaluateAgainst<T>(restAngle, x, gradient, hessian, nullptr);
  }

  /// 2 stiffness ∇θ ∇θᵀ: the Hessian without that of the angle, which is indefinite.
  template <class T>
  void convexHessian(const std::array<T, 12>& x, std::array<T, packedSize(12)>& hessian) const {
    std::array<T, 12> gradient;
    RestAngleDerivative<T> derivative;
    evaluateAgainst<T>(restAngle, x, &gradient, nullptr, &derivative);  // mixed = 2 stiffness ∇θ
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j <= i; ++j)
        hessian[packedIndex(i, j)] = derivative.mixed[i] * derivative.mixed[j] * (0.5 / stiffness);
  }

  /// Minus the derivatives of E by θ₀ and by θ₀ and x.
  template <class T>
  struct RestAngleDerivative {
    T moment;
    std::array<T, 12> mixed;
  };

  /// The same with another rest angle; outputs that are null are not computed.
  template <class T>
  T evaluateAgainst(const T& zeroAngle, const std::array<T, 12>& x, std::array<T, 12>* gradient,
                    std::array<T, packedSize(12)>* hessian, RestAngleDerivative<T>* byRestAngle) const {
    using std::sqrt;
    std::array<T, 3> e, u, v;
    for (int i = 0; i < 3; ++i) {
      e[i] = x[3 + i] - x[i];
      u[i] = x[6 + i] - x[i];
      v[i] = x[9 + i] - x[i];
    }
    const std::array<T, 3> n1 = cross(e, u), n2 = cross(v, e);
    const T squaredLength = dot(e, e), length = sqrt(squaredLength);
    const T deviation = angle(-(length * dot(n1, v)), dot(n1, n2)) - zeroAngle;
    const T moment = (2.0 * stiffness) * deviation;  // dE/dθ
    if (gradient || hessian || byRestAngle) {
      const T inverse = 1.0 / squaredLength;
      const Side<T> one(e, u, n1, squaredLength, length, inverse);
      const Side<T> two(e, v, n2, squaredLength, length, inverse);
      if (gradient) fillGradient(moment, one, two, *gradient);
      if (byRestAngle) {
        byRestAngle->moment = moment;
        fillGradient(T(2.0 * stiffness), one, two, byRestAngle->mixed);
      }
      if (hessian) {
        std::array<T, 3> epsilon;
        for (int i = 0; i < 3; ++i) epsilon[i] = (moment * inverse) * e[i];
        fillHessian(moment, epsilon, one, two, *hessian);
      }
    }
    return stiffness * deviation * deviation;
  }

 private:
  /// α, a, b and (h/|e|)² of the triangle of e and `other`, with the normal n.
  template <class T>
  struct Side {
    T alpha, squaredRatio;
    std::array<T, 3> a, b;

    Side(const std::array<T, 3>& e, const std::array<T, 3>& other, const std::array<T, 3>& n, const T& squaredLength,
         const T& length, const T& inverseSquaredLength) {
      const T squaredNormal = dot(n, n), inverse = 1.0 / squaredNormal;
      const T scaleA = length * inverse, scaleB = squaredLength * inverse;  // scaleB = 1/h²
      alpha = dot(other, e) * inverseSquaredLength;
      squaredRatio = squaredNormal * inverseSquaredLength * inverseSquaredLength;
      for (int i = 0; i < 3; ++i) {
        a[i] = n[i] * scaleA;
        b[i] = (other[i] - alpha * e[i]) * scaleB;
      }
    }
  };

  template <class T>
  static std::array<T, 3> cross(const std::array<T, 3>& p, const std::array<T, 3>& q) {
    return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  }

  template <class T>
  static T dot(const std::array<T, 3>& p, const std::array<T, 3>& q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  }

  template <class T>
  static T angle(const T& sine, const T& cosine) {
    using std::atan2;
    return atan2(sine, cosine);
  }

  template <class T>
  static void fillGradient(const T& moment, const Side<T>& one, const Side<T>& two, std::array<T, 12>& gradient) {
    for (int i = 0; i < 3; ++i) {
      const T g2 = -(moment * one.a[i]), g3 = -(moment * two.a[i]);
      const T g1 = -(one.alpha * g2 + two.alpha * g3);
      gradient[i] = -(g1 + g2 + g3);
      gradient[3 + i] = g1;
      gradient[6 + i] = g2;
      gradient[9 + i] = g3;
    }
  }

  /// `epsilon` carries the moment as a factor.
  template <class T>
  void fillHessian(const T& moment, const std::array<T, 3>& epsilon, const Side<T>& one, const Side<T>& two,
                   std::array<T, packedSize(12)>& h) const {
    using Square = std::array<std::array<T, 3>, 3>;
    const T ratio1 = moment * one.squaredRatio, ratio2 = moment * two.squaredRatio;
    std::array<T, 3> c1, c2, ka2, edge;
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      c1[i] = stiffness * one.a[i] + moment * one.b[i];  // a cᵀ + c aᵀ = 2 stiffness a aᵀ + moment P
      c2[i] = stiffness * two.a[i] + moment * two.b[i];
      ka2[i] = (2.0 * stiffness) * two.a[i];
      edge[i] = one.alpha * one.a[i] + two.alpha * two.a[i];
    }
    // Blocks of the corners opposite the edge.
    Square uu, vv, vu;
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) {
        vu[i][j] = h[packedIndex(9 + i, 6 + j)] = ka2[i] * one.a[j];
        if (j > i) continue;
        uu[i][j] = uu[j][i] = h[packedIndex(6 + i, 6 + j)] = one.a[i] * c1[j] + c1[i] * one.a[j];
        vv[i][j] = vv[j][i] = h[packedIndex(9 + i, 9 + j)] = two.a[i] * c2[j] + c2[i] * two.a[j];
      }
    // Blocks of the edge; those of its first corner are minus the sums of the others.
    Square ee, ue, ve;
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) {
        const T footU = -(one.alpha * uu[i][j] + two.alpha * vu[j][i]);
        const T footV = -(two.alpha * vv[i][j] + one.alpha * vu[i][j]);
        ue[i][j] = h[packedIndex(6 + i, 3 + j)] = footU + epsilon[i] * one.a[j];
        ve[i][j] = h[packedIndex(9 + i, 3 + j)] = footV + epsilon[i] * two.a[j];
        if (j > i) continue;
        const T bent = ratio1 * (one.a[i] * one.b[j]) + ratio2 * (two.a[i] * two.b[j]);
        ee[i][j] = ee[j][i] = h[packedIndex(3 + i, 3 + j)] =
            bent - (one.alpha * footU + two.alpha * footV) - (epsilon[i] * edge[j] + edge[i] * epsilon[j]);
      }
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j < 3; ++j) {
        h[packedIndex(3 + i, j)] = -(ee[i][j] + ue[j][i] + ve[j][i]);
        h[packedIndex(6 + i, j)] = -(ue[i][j] + uu[i][j] + vu[j][i]);
        h[packedIndex(9 + i, j)] = -(ve[i][j] + vu[i][j] + vv[i][j]);
      }
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int j = 0; j <= i; ++j)
        h[packedIndex(i, j)] = -(h[packedIndex(3 + i, j)] + h[packedIndex(6 + i, j)] + h[packedIndex(9 + i, j)]);
  }
};

}  // namespace pliant::mechanics
