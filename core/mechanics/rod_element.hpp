#pragma once

#include "core/mechanics/relative_rotation.hpp"

namespace pliant::mechanics {

/// A rod's edge against stretch: E = ½ k (|x₁ - x₀| - restLength)².
struct RodStretchElement {
  static constexpr int coordinates = 6;
  static constexpr std::string_view name = "rod_stretch";

  double stiffness;   ///< k = Young's modulus * area / restLength [N/m]
  double restLength;  ///< [m]

  template <class T>
  T evaluate(const std::array<T, 6>& x, std::array<T, 6>* gradient, std::array<T, packedSize(6)>* hessian,
             const std::array<T, 6>* stressFrom = nullptr, const std::array<T, 6>* stressTo = nullptr) const {
    std::array<T, 3> direction;
    const T length = measure(x, direction);
    const T force = stiffness * (length - restLength);
    if (gradient)
      for (int i = 0; i < 3; ++i) {
        (*gradient)[3 + i] = force * direction[i];
        (*gradient)[i] = -(*gradient)[3 + i];
      }
    if (hessian) {
      T stress = force;
      if (stressFrom) {
        std::array<T, 3> from;
        T expected = measure(*stressFrom, from);
        for (int i = 0; i < 3; ++i)
          expected += from[i] * ((*stressTo)[3 + i] - (*stressTo)[i] - (*stressFrom)[3 + i] + (*stressFrom)[i]);
        stress = stiffness * (expected - restLength);
      }
      const T ratio = stress / length, along = stiffness - ratio;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          T entry = along * direction[i] * direction[j];
          if (i == j) entry += ratio;
          (*hessian)[packedIndex(3 + i, j)] = -entry;
          if (j <= i) (*hessian)[packedIndex(i, j)] = (*hessian)[packedIndex(3 + i, 3 + j)] = entry;
        }
    }
    return 0.5 * force * (length - restLength);
  }

 private:
  /// A length of zero counts as 1e-9 of the rest length, so that nothing is divided by zero.
  template <class T>
  T measure(const std::array<T, 6>& x, std::array<T, 3>& direction) const {
    using std::sqrt;
    T squared = 1e-18 * restLength * restLength;
    for (int i = 0; i < 3; ++i) {
      direction[i] = x[3 + i] - x[i];
      squared += direction[i] * direction[i];
    }
    const T length = sqrt(squared), inverse = 1.0 / length;
    for (int i = 0; i < 3; ++i) direction[i] *= inverse;
    return length;
  }
};

/// What a rotation spring needs to know of an edge. The sign of `halfAngle` is that of the edge's own direction, from
/// which its twist counts, relative to the direction in which the element walks along it.
struct RodEdge {
  std::array<double, 3> restTangent;  ///< in the direction in which the element walks
  double restLength;                  ///< [m]
  double halfAngle;                   ///< half the twist angle over the twist coordinate, signed [1/m]
};

/// Bending and twist where two edges meet: coordinates are the far end of the first, the shared node, the far end of
/// the second, and the twists of both.
struct RodBendElement {
  static constexpr int coordinates = 11;
  static constexpr std::string_view name = "rod_bending";

  RodEdge first, second;
  RotationSpring spring;

  template <class T>
  T evaluate(const std::array<T, 11>& x, std::array<T, 11>* gradient, std::array<T, packedSize(11)>* hessian) const {
    std::array<T, 3> u, v;
    for (int i = 0; i < 3; ++i) {
      u[i] = x[3 + i] - x[i];
      v[i] = x[6 + i] - x[3 + i];
    }
    const EdgeRotation<T> a(u, first.halfAngle * x[9], first.restTangent, first.restLength);
    const EdgeRotation<T> b(v, second.halfAngle * x[10], second.restTangent, second.restLength);
    std::array<T, 8> g;
    std::array<T, packedSize(8)> h;
    const T energy = spring.evaluate<T>(a, b, gradient ? &g : nullptr, hessian ? &h : nullptr);
    if (gradient) {
      for (int i = 0; i < 3; ++i) {
        (*gradient)[i] = -g[i];
        (*gradient)[3 + i] = g[i] - g[4 + i];
        (*gradient)[6 + i] = g[4 + i];
      }
      (*gradient)[9] = first.halfAngle * g[3];
      (*gradient)[10] = second.halfAngle * g[7];
    }
    if (hessian) fillHessian(h, *hessian);
    return energy;
  }

 private:
  /// From (u, ψ, v, χ) to the coordinates, with u = x₁ - x₀ and v = x₂ - x₁.
  template <class T>
  void fillHessian(const std::array<T, packedSize(8)>& h, std::array<T, packedSize(11)>& out) const {
    const double half[] = {first.halfAngle, second.halfAngle};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const T& uu = h[i >= j ? packedIndex(i, j) : packedIndex(j, i)];
        const T& vv = h[i >= j ? packedIndex(4 + i, 4 + j) : packedIndex(4 + j, 4 + i)];
        const T &vu = h[packedIndex(4 + i, j)], &uv = h[packedIndex(4 + j, i)];
        out[packedIndex(3 + i, j)] = vu - uu;
        out[packedIndex(6 + i, j)] = -vu;
        out[packedIndex(6 + i, 3 + j)] = vu - vv;
        if (j > i) continue;
        out[packedIndex(i, j)] = uu;
        out[packedIndex(3 + i, 3 + j)] = uu + vv - vu - uv;
        out[packedIndex(6 + i, 6 + j)] = vv;
      }
      const T* const byU[] = {&h[packedIndex(3, i)], &h[packedIndex(7, i)]};
      const T* const byV[] = {&h[packedIndex(4 + i, 3)], &h[packedIndex(7, 4 + i)]};
      for (int edge = 0; edge < 2; ++edge) {
        out[packedIndex(9 + edge, i)] = -half[edge] * *byU[edge];
        out[packedIndex(9 + edge, 3 + i)] = half[edge] * (*byU[edge] - *byV[edge]);
        out[packedIndex(9 + edge, 6 + i)] = half[edge] * *byV[edge];
      }
    }
    out[packedIndex(9, 9)] = half[0] * half[0] * h[packedIndex(3, 3)];
    out[packedIndex(10, 9)] = half[1] * half[0] * h[packedIndex(7, 3)];
    out[packedIndex(10, 10)] = half[1] * half[1] * h[packedIndex(7, 7)];
  }
};

/// Bending and twist of the half of an edge that is next to a node with a frame: coordinates are the node, the edge's
/// other end, the edge's twist and the frame's rotation (three times a length over 4 the modified Rodrigues vector).
struct RodJointElement {
  static constexpr int coordinates = 10;
  static constexpr std::string_view name = "rod_joint";

  RodEdge edge;
  double quarterAngle;  ///< the frame's modified Rodrigues vector over its coordinates [1/m]
  RotationSpring spring;

  template <class T>
  T evaluate(const std::array<T, 10>& x, std::array<T, 10>* gradient, std::array<T, packedSize(10)>* hessian) const {
    std::array<T, 3> u, s;
    for (int i = 0; i < 3; ++i) {
      u[i] = x[3 + i] - x[i];
      s[i] = quarterAngle * x[7 + i];
    }
    const EdgeRotation<T> turned(u, edge.halfAngle * x[6], edge.restTangent, edge.restLength);
    const FrameRotation<T> frame(s);
    std::array<T, 7> g;
    std::array<T, packedSize(7)> h;
    const T energy = spring.evaluate<T>(turned, frame, gradient ? &g : nullptr, hessian ? &h : nullptr);
    if (gradient) {
      for (int i = 0; i < 3; ++i) {
        (*gradient)[i] = -g[i];
        (*gradient)[3 + i] = g[i];
        (*gradient)[7 + i] = quarterAngle * g[4 + i];
      }
      (*gradient)[6] = edge.halfAngle * g[3];
    }
    if (hessian) fillHessian(h, *hessian);
    return energy;
  }

 private:
  /// From (u, ψ, s) to the coordinates, with u = x₁ - x₀.
  template <class T>
  void fillHessian(const std::array<T, packedSize(7)>& h, std::array<T, packedSize(10)>& out) const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const T& uu = h[i >= j ? packedIndex(i, j) : packedIndex(j, i)];
        out[packedIndex(3 + i, j)] = -uu;
        if (j <= i) out[packedIndex(i, j)] = out[packedIndex(3 + i, 3 + j)] = uu;
      }
    for (int row = 3; row < 7; ++row) {
      const double scale = row == 3 ? edge.halfAngle : quarterAngle;
      for (int j = 0; j < 3; ++j) {
        const T entry = scale * h[packedIndex(row, j)];
        out[packedIndex(3 + row, j)] = -entry;
        out[packedIndex(3 + row, 3 + j)] = entry;
      }
      for (int j = 3; j <= row; ++j)
        out[packedIndex(3 + row, 3 + j)] = (scale * (j == 3 ? edge.halfAngle : quarterAngle)) * h[packedIndex(row, j)];
    }
  }
};

}  // namespace pliant::mechanics
