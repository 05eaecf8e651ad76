#pragma once

#include <cmath>

#include "core/mechanics/element_energy.hpp"

/// Rotations of rigid cross-sections from their rest state as quaternions (real part first) with derivatives, and the
/// energy of the rotation between two of them. Products of the rotations' derivatives with quaternions replace the
/// usual matrices of directors: the directors enter through the stiffness alone.
namespace pliant::mechanics {

template <class T>
using Quaternion = std::array<T, 4>;

template <class T>
T dot(const Quaternion<T>& p, const Quaternion<T>& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
}

template <class T>
Quaternion<T> product(const Quaternion<T>& p, const Quaternion<T>& q) {
  return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
          p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

/// conj(p) q
template <class T>
Quaternion<T> relative(const Quaternion<T>& p, const Quaternion<T>& q) {
  return {p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3], p[0] * q[1] - p[1] * q[0] - p[2] * q[3] + p[3] * q[2],
          p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1], p[0] * q[3] - p[1] * q[2] + p[2] * q[1] - p[3] * q[0]};
}

/// p conj(q)
template <class T>
Quaternion<T> quotient(const Quaternion<T>& p, const Quaternion<T>& q) {
  return product(p, {q[0], -q[1], -q[2], -q[3]});
}

/// Keeps denominators from zero where an edge has turned by exactly 180° or two sections by exactly 360°: energies are
/// finite there. Relative to 1.
inline constexpr double rotationGuard = 1e-12;

/// How an edge and the cross-section that it carries have turned from rest: the smallest rotation that brings the rest
/// tangent onto the edge, after a turn by `twist` about the rest tangent. As a quaternion that is
///   p ~ (cos ψ (l + c), sin ψ (u + l T) + cos ψ T × u),  ψ = twist/2, l = |u|, c = T·u,
/// where only the direction of p counts: p and its derivatives are given times one number that makes |p| = 1 here.
/// Singular where u = -l T.
template <class T>
struct EdgeRotation {
  static constexpr int size = 4;  ///< derivatives by u (3) and ψ

  Quaternion<T> p;
  std::array<Quaternion<T>, size> columns;  ///< ∂p
  std::array<T, size> normal;               ///< pᵀ∂p

  /// `restTangent` of length 1; lengths of the edge below about 1e-9 `restLength` count as that.
  EdgeRotation(const std::array<T, 3>& u, const T& halfTwist, const std::array<double, 3>& restTangent,
               double restLength)
      : tangent_(restTangent) {
    using math::sineAndCosine;
    using std::sqrt;
    constexpr double guard = 1 + rotationGuard;
    sineAndCosine(halfTwist, sine_, cosine_);
    const T along = tangent_[0] * u[0] + tangent_[1] * u[1] + tangent_[2] * u[2];
    const T squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
    const T length = sqrt(squared + 1e-18 * restLength * restLength);
    const T guarded = guard * length, sum = guarded + along;
    inverseLength_ = 1.0 / length;
    turned_ = {tangent_[1] * u[2] - tangent_[2] * u[1], tangent_[2] * u[0] - tangent_[0] * u[2],
               tangent_[0] * u[1] - tangent_[1] * u[0]};
    std::array<T, 3> bisector;
    for (int i = 0; i < 3; ++i) bisector[i] = u[i] + tangent_[i] * guarded;
    const T squaredNorm = sum * sum + turned_[0] * turned_[0] + turned_[1] * turned_[1] + turned_[2] * turned_[2];
    scale_ = 1.0 / sqrt(squaredNorm);
    scaledSine_ = sine_ * scale_;
    scaledCosine_ = cosine_ * scale_;
    p = {scaledCosine_ * sum, scaledSine_ * bisector[0] + scaledCosine_ * turned_[0],
         scaledSine_ * bisector[1] + scaledCosine_ * turned_[1],
         scaledSine_ * bisector[2] + scaledCosine_ * turned_[2]};
    columns[3] = {-(scaledSine_ * sum), scaledCosine_ * bisector[0] - scaledSine_ * turned_[0],
                  scaledCosine_ * bisector[1] - scaledSine_ * turned_[1],
                  scaledCosine_ * bisector[2] - scaledSine_ * turned_[2]};
    normal[3] = 0.0;
    const T square = scale_ * scale_;
    for (int j = 0; j < 3; ++j) {
      direction_[j] = guard * (u[j] * inverseLength_);  // ∂(guarded length)
      sum_[j] = direction_[j] + tangent_[j];
      const T stretched = scaledSine_ * direction_[j];
      columns[j][0] = scaledCosine_ * sum_[j];
      for (int k = 0; k < 3; ++k) columns[j][1 + k] = tangent_[k] * stretched;
      columns[j][1 + j] += scaledSine_;
      const int next = (j + 1) % 3, last = (j + 2) % 3;
      columns[j][1 + next] += tangent_[last] * scaledCosine_;
      columns[j][1 + last] -= tangent_[next] * scaledCosine_;
      normal[j] = square * (sum * sum_[j] + u[j] - tangent_[j] * along);
    }
  }

  /// The packed lower triangle of Σ_k slope[k] ∂²p[k] + tension (∂pᵀ∂p - normal normalᵀ), where slope·p = 0.
  std::array<T, packedSize(size)> secondDerivative(const Quaternion<T>& slope, const T& tension) const {
    std::array<T, packedSize(size)> result;
    const T alongSlope = tangent_[0] * slope[1] + tangent_[1] * slope[2] + tangent_[2] * slope[3];
    const T bend = (1 + rotationGuard) * inverseLength_ * (scaledCosine_ * slope[0] + scaledSine_ * alongSlope);
    const T square = scale_ * scale_ * tension;
    const T bendInverse = (1 / (1 + rotationGuard) / (1 + rotationGuard)) * bend;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) {
        // |∂p|² over u: I + d dᵀ + d Tᵀ + T dᵀ; ∂²(guarded length) = (I - d dᵀ)/l but for the guard.
        result[packedIndex(i, j)] = square * (sum_[i] * sum_[j]) - tension * (normal[i] * normal[j]) -
                                    bendInverse * (direction_[i] * direction_[j]) -
                                    (tangent_[i] * tangent_[j]) * square;
      }
      result[packedIndex(i, i)] += square + bend;
      const int next = (i + 1) % 3, last = (i + 2) % 3;
      const T crossed = slope[1 + next] * tangent_[last] - slope[1 + last] * tangent_[next];  // (slope × T)
      result[packedIndex(3, i)] = scaledCosine_ * (slope[1 + i] + alongSlope * direction_[i]) -
                                  scaledSine_ * (slope[0] * sum_[i] + crossed) - square * turned_[i];
    }
    result[packedIndex(3, 3)] = tension;
    return result;
  }

 private:
  std::array<double, 3> tangent_;  ///< T
  T sine_, cosine_, scaledSine_, scaledCosine_, scale_, inverseLength_;
  std::array<T, 3> turned_;     ///< T × u
  std::array<T, 3> direction_;  ///< u / l, guarded
  std::array<T, 3> sum_;        ///< u / l + T
};

/// How a rigid frame has turned from rest: p = (1 - s², 2 s)/(1 + s²) for the modified Rodrigues vector s (the axis
/// times the tangent of a quarter of the angle), below 360°.
template <class T>
struct FrameRotation {
  static constexpr int size = 3;  ///< derivatives by s

  Quaternion<T> p;
  std::array<Quaternion<T>, size> columns;
  std::array<T, size> normal;

  explicit FrameRotation(const std::array<T, 3>& s) {
    const T squared = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
    scale_ = 1.0 / (1.0 + squared);
    p = {(1.0 - squared) * scale_, 2.0 * scale_ * s[0], 2.0 * scale_ * s[1], 2.0 * scale_ * s[2]};
    for (int j = 0; j < 3; ++j) {
      columns[j] = {-p[1 + j], 0.0, 0.0, 0.0};
      columns[j][1 + j] = 2.0 * scale_;
      normal[j] = p[1 + j];
    }
  }

  /// See EdgeRotation: ∂pᵀ∂p is 4 (I + s sᵀ)/(1 + s²)² and normal is 2 s/(1 + s²), so that a multiple of I remains.
  std::array<T, packedSize(size)> secondDerivative(const Quaternion<T>& slope, const T& tension) const {
    const T zero = 0.0, diagonal = 4.0 * scale_ * scale_ * tension - 2.0 * scale_ * slope[0];
    return {diagonal, zero, diagonal, zero, zero, diagonal};
  }

 private:
  T scale_;
};

/// The energy ½ (ρ - ρ₀)ᵀ K (ρ - ρ₀) of the rotation conj(a.p) b.p by which b has turned more than a, with ρ four times
/// its modified Rodrigues vector: the axis times 4 tan(angle/4), in the rest state's coordinates. It is the angle to
/// second order (2 % too large at 60°) and grows beyond all bounds towards 360°.
struct RotationSpring {
  std::array<double, 6> stiffness;  ///< K, packed lower triangle [N m]
  std::array<double, 3> natural;    ///< ρ₀

  /// Derivatives by a's variables, then b's. The derivatives of p may bear any factor that p itself bears, since the
  /// energy depends on the directions of a.p and b.p alone; with N = |a.p| |b.p| (1 here) it is
  ///   ρ = 4 Im q/(N + Re q), q = conj(a.p) b.p.
  template <class T, class A, class B>
  T evaluate(const A& a, const B& b, std::array<T, A::size + B::size>* gradient,
             std::array<T, packedSize(A::size + B::size)>* hessian) const {
    constexpr double guard = 1 + rotationGuard;
    const Quaternion<T> q = relative(a.p, b.p);
    const T inverse = 1.0 / (guard + q[0]);
    const std::array<T, 3> strain = {4.0 * inverse * q[1], 4.0 * inverse * q[2], 4.0 * inverse * q[3]};
    const std::array<T, 3> excess = {strain[0] - natural[0], strain[1] - natural[1], strain[2] - natural[2]};
    const std::array<T, 3> moment = stiff(excess);
    if (gradient || hessian) {
      const T work = moment[0] * strain[0] + moment[1] * strain[1] + moment[2] * strain[2];
      const Quaternion<T> weight = {
          -(inverse * work), 4.0 * inverse * moment[0], 4.0 * inverse * moment[1], 4.0 * inverse * moment[2]};
      const T tension = guard * weight[0];
      Quaternion<T> slopeA = quotient(b.p, weight), slopeB = product(a.p, weight);
      for (int k = 0; k < 4; ++k) {
        slopeA[k] += tension * a.p[k];
        slopeB[k] += tension * b.p[k];
      }
      std::array<T, A::size + B::size> slope;
      for (int v = 0; v < A::size; ++v) slope[v] = dot(a.columns[v], slopeA);
      for (int v = 0; v < B::size; ++v) slope[A::size + v] = dot(b.columns[v], slopeB);
      if (gradient) *gradient = slope;
      if (hessian) {
        fillStrainPart(a, b, strain, inverse, slope, *hessian);
        addRotationPart(a, b, weight, tension, slopeA, slopeB, *hessian);
      }
    }
    return 0.5 * (moment[0] * excess[0] + moment[1] * excess[1] + moment[2] * excess[2]);
  }

 private:
  template <class T>
  std::array<T, 3> stiff(const std::array<T, 3>& v) const {
    const auto& [k00, k10, k11, k20, k21, k22] = stiffness;
    return {k00 * v[0] + k10 * v[1] + k20 * v[2], k10 * v[0] + k11 * v[1] + k21 * v[2],
            k20 * v[0] + k21 * v[1] + k22 * v[2]};
  }

  /// ∂ρᵀ K ∂ρ, and the part of the second derivative of ρ that the denominator's change brings.
  template <class T, class A, class B, std::size_t n, std::size_t packed>
  void fillStrainPart(const A& a, const B& b, const std::array<T, 3>& strain, const T& inverse,
                      const std::array<T, n>& slope, std::array<T, packed>& hessian) const {
    std::array<std::array<T, 3>, n> strainChange, momentChange;
    std::array<T, n> change;  // of the denominator, relative
    const auto fill = [&](int v, const Quaternion<T>& turn, const T& normal) {
      change[v] = inverse * ((1 + rotationGuard) * normal + turn[0]);
      for (int k = 0; k < 3; ++k) strainChange[v][k] = 4.0 * inverse * turn[1 + k] - strain[k] * change[v];
      momentChange[v] = stiff(strainChange[v]);
    };
#pragma GCC unroll 4
    for (int v = 0; v < A::size; ++v) fill(v, relative(a.columns[v], b.p), a.normal[v]);
#pragma GCC unroll 4
    for (int v = 0; v < B::size; ++v) fill(A::size + v, relative(a.p, b.columns[v]), b.normal[v]);
#pragma GCC unroll 8
    for (int v = 0; v < static_cast<int>(n); ++v)
#pragma GCC unroll 8
      for (int w = 0; w <= v; ++w)
        hessian[packedIndex(v, w)] = strainChange[v][0] * momentChange[w][0] + strainChange[v][1] * momentChange[w][1] +
                                     strainChange[v][2] * momentChange[w][2] -
                                     (slope[v] * change[w] + change[v] * slope[w]);
  }

  /// What the second derivatives of p, N and q bring.
  template <class T, class A, class B, std::size_t packed>
  void addRotationPart(const A& a, const B& b, const Quaternion<T>& weight, const T& tension,
                       const Quaternion<T>& slopeA, const Quaternion<T>& slopeB, std::array<T, packed>& hessian) const {
    const auto second = a.secondDerivative(slopeA, tension);
    for (int i = 0; i < packedSize(A::size); ++i) hessian[i] += second[i];
    const auto secondB = b.secondDerivative(slopeB, tension);
    for (int v = 0; v < B::size; ++v)
      for (int w = 0; w <= v; ++w) hessian[packedIndex(A::size + v, A::size + w)] += secondB[packedIndex(v, w)];
#pragma GCC unroll 4
    for (int w = 0; w < A::size; ++w) {
      const Quaternion<T> weighted = product(a.columns[w], weight);
#pragma GCC unroll 4
      for (int v = 0; v < B::size; ++v)
        hessian[packedIndex(A::size + v, w)] += dot(weighted, b.columns[v]) + tension * (a.normal[w] * b.normal[v]);
    }
  }
};

}  // namespace pliant::mechanics
