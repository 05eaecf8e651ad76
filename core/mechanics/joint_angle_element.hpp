#pragma once

#include <algorithm>

#include "core/mechanics/element_energy.hpp"
#include "core/mechanics/hinge_element.hpp"

namespace pliant::mechanics {

/// A torsion spring in the plane: E = ½ k (θ - φ)², with θ the angle by which the link from x₁ (the joint) to x₂ has
/// turned counter-clockwise against the link from x₁ to x₀ since rest, within half a turn. φ = 0, or, if `driven`, the
/// scalar coordinate behind the three nodes over `scalarLength`: a servo of the stiffness k.
/// With u = x₀ - x₁, v = x₂ - x₁ and J the quarter turn: ∂θ/∂v = Jv/|v|², θ_vv = -(v (Jv)ᵀ + Jv vᵀ)/|v|⁴, θ_uv = 0,
/// the same with the opposite sign for u, and x₁ moves both backwards.
template <bool driven>
struct JointAngleElement {
  static constexpr int coordinates = driven ? 7 : 6;
  static constexpr std::string_view name = driven ? "servo" : "torsion_spring";

  double stiffness;         ///< k [N m]
  double restCosine;        ///< of the angle from u to v at rest
  double restSine;          ///<
  double scalarLength = 1;  ///< [m]

  template <class T>
  T evaluate(const std::array<T, coordinates>& x, std::array<T, coordinates>* gradient,
             std::array<T, packedSize(coordinates)>* hessian) const {
    using std::atan2;
    const std::array<T, 2> u = {x[0] - x[2], x[1] - x[3]}, v = {x[4] - x[2], x[5] - x[3]};
    const T cross = u[0] * v[1] - u[1] * v[0], dot = u[0] * v[0] + u[1] * v[1];
    T deviation = atan2(restCosine * cross - restSine * dot, restCosine * dot + restSine * cross);
    if constexpr (driven) deviation -= (1 / scalarLength) * x[6];
    const T moment = stiffness * deviation;
    if (gradient || hessian) {
      const T inverseU = 1.0 / (u[0] * u[0] + u[1] * u[1]), inverseV = 1.0 / (v[0] * v[0] + v[1] * v[1]);
      // ∂θ by the coordinates, the scalar's included.
      std::array<T, coordinates> slope;
      slope[0] = inverseU * u[1];
      slope[1] = -(inverseU * u[0]);
      slope[4] = -(inverseV * v[1]);
      slope[5] = inverseV * v[0];
      slope[2] = -(slope[0] + slope[4]);
      slope[3] = -(slope[1] + slope[5]);
      if constexpr (driven) slope[6] = -1 / scalarLength;
      if (gradient)
        for (int i = 0; i < coordinates; ++i) (*gradient)[i] = moment * slope[i];
      if (hessian) {
        for (int i = 0; i < coordinates; ++i)
          for (int j = 0; j <= i; ++j) (*hessian)[packedIndex(i, j)] = stiffness * slope[i] * slope[j];
        addCurvature(moment * inverseU * inverseU, u, 0, *hessian);
        addCurvature(-(moment * inverseV * inverseV), v, 4, *hessian);
      }
    }
    return 0.5 * moment * deviation;
  }

 private:
  /// Adds factor (w (Jw)ᵀ + Jw wᵀ) for the vector w from the joint to the node at coordinate `at`.
  template <class T>
  static void addCurvature(const T& factor, const std::array<T, 2>& w, int at,
                           std::array<T, packedSize(coordinates)>& hessian) {
    const T diagonal = -2.0 * factor * w[0] * w[1], mixed = factor * (w[0] * w[0] - w[1] * w[1]);
    const auto add = [&](int row, int column, const T& value) {
      hessian[row >= column ? packedIndex(row, column) : packedIndex(column, row)] += value;
    };
    for (const int node : {at, 2}) {
      add(node, node, diagonal);
      add(node + 1, node, mixed);
      add(node + 1, node + 1, -diagonal);
    }
    add(at, 2, -diagonal);
    add(at + 1, 3, diagonal);
    add(at, 3, -mixed);
    add(at + 1, 2, -mixed);
  }
};

/// A servo in space about an axis through two joints x₀ and x₁: a HingeElement of the links' joints x₂ and x₃ whose
/// rest angle is θ₀ + φ, with φ the scalar coordinate behind the four nodes over `scalarLength`.
struct AxisServoElement {
  static constexpr int coordinates = 13;
  static constexpr std::string_view name = "servo";

  HingeElement hinge;   ///< with half the servo's stiffness
  double scalarLength;  ///< [m]

  template <class T>
  T evaluate(const std::array<T, 13>& x, std::array<T, 13>* gradient, std::array<T, packedSize(13)>* hessian) const {
    std::array<T, 12> nodes, nodeGradient;
    std::array<T, packedSize(12)> nodeHessian;
    HingeElement::RestAngleDerivative<T> byAngle;
    std::copy_n(x.begin(), 12, nodes.begin());
    const T restAngle = hinge.restAngle + (1 / scalarLength) * x[12];
    const T energy = hinge.evaluateAgainst(
        restAngle, nodes, gradient ? &nodeGradient : nullptr, hessian ? &nodeHessian : nullptr, &byAngle);
    if (gradient) {
      std::copy_n(nodeGradient.begin(), 12, gradient->begin());
      (*gradient)[12] = (-1 / scalarLength) * byAngle.moment;
    }
    if (hessian) {
      std::copy_n(nodeHessian.begin(), packedSize(12), hessian->begin());
      for (int i = 0; i < 12; ++i) (*hessian)[packedIndex(12, i)] = (-1 / scalarLength) * byAngle.mixed[i];
      (*hessian)[packedIndex(12, 12)] = 2 * hinge.stiffness / (scalarLength * scalarLength);
    }
    return energy;
  }
};

}  // namespace pliant::mechanics
