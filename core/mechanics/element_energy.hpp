#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "core/mechanics/energy.hpp"

namespace pliant::mechanics {

/// Makes an `Energy` of many elements of one kind. `Element` holds an element's rest data and has
///   static constexpr int coordinates;               // d
///   static constexpr std::string_view name;
///   template <class T> T evaluate(const std::array<T, d>& x, std::array<T, d>* gradient,
///                                 std::array<T, d(d+1)/2>* hessian) const;
/// (or with two more arguments, `const std::array<T, d>* stressFrom, const std::array<T, d>* stressTo`: see
/// ElasticAssembler::StressSource; both may be null)
/// and, if part of its Hessian can be left out to make it positive semidefinite,
///   template <class T> void convexHessian(const std::array<T, d>& x, std::array<T, d(d+1)/2>& hessian) const;
/// and, if it stands for a constraint, `double violation(const std::array<double, d>& x) const`, relative. `evaluate`
/// returns the element's energy and overwrites the derivatives that are asked for (Hessian packed by rows of
/// the lower triangle). Adding a kind of energy is writing such a struct.
template <class Element>
class ElementEnergy final : public Energy {
 public:
  static constexpr int d = Element::coordinates;

  /// `coordinates[e]` are the global coordinate indices of element e.
  ElementEnergy(std::vector<Element> elements, std::vector<std::array<int, d>> coordinates)
      : elements_(std::move(elements)), coordinates_(std::move(coordinates)) {}

  std::string_view name() const override { return Element::name; }
  int elementCount() const override { return static_cast<int>(elements_.size()); }
  std::span<const int> elementCoordinates(int element) const override { return coordinates_[element]; }
  const std::vector<Element>& elements() const { return elements_; }

  void accumulate(const EvaluationBlock<double>& block) const override { accumulateAll(block); }
  void accumulate(const EvaluationBlock<math::Packet>& block) const override { accumulateAll(block); }

  std::optional<double> constraintViolation(const double* x) const override {
    if constexpr (requires(const Element& element, std::array<double, d> at) { element.violation(at); }) {
      double largest = 0;
      for (std::size_t e = 0; e < elements_.size(); ++e) {
        std::array<double, d> at;
        for (int i = 0; i < d; ++i) at[i] = x[coordinates_[e][i]];
        largest = std::max(largest, elements_[e].violation(at));
      }
      return largest;
    } else {
      return Energy::constraintViolation(x);
    }
  }

 private:
  template <class T>
  T evaluateElement(std::size_t e, const EvaluationBlock<T>& block, const std::array<T, d>& x,
                    std::array<T, d>* gradient, std::array<T, packedSize(d)>* hessian) const {
    const Element& element = elements_[e];
    if constexpr (requires { element.convexHessian(x, *hessian); }) {
      if (block.convex && hessian) {
        const T value = element.evaluate(x, gradient, static_cast<std::array<T, packedSize(d)>*>(nullptr));
        element.convexHessian(x, *hessian);
        return value;
      }
    }
    if constexpr (requires { element.evaluate(x, gradient, hessian, &x, &x); }) {
      if (block.stressFrom) {
        std::array<T, d> from, to;
        for (int i = 0; i < d; ++i) {
          math::load(block.stressFrom + coordinates_[e][i] * block.stride, from[i]);
          math::load(block.stressTo + coordinates_[e][i] * block.stride, to[i]);
        }
        return element.evaluate(x, gradient, hessian, &from, &to);
      }
    }
    return element.evaluate(x, gradient, hessian);
  }

  template <class T>
  void accumulateAll(const EvaluationBlock<T>& block) const {
    std::array<T, d> x, gradient;
    std::array<T, packedSize(d)> hessian;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const auto& coordinates = coordinates_[e];
      for (int i = 0; i < d; ++i) math::load(block.x + coordinates[i] * block.stride, x[i]);
      const T value =
          evaluateElement(e, block, x, block.gradient ? &gradient : nullptr, block.hessian ? &hessian : nullptr);
      if (block.value) math::addTo(block.value, value);
      if (block.gradient)
        for (int i = 0; i < d; ++i) math::addTo(block.gradient + coordinates[i] * block.stride, gradient[i]);
      if (block.hessian) {
        const int* entries = block.entries + e * packedSize(d);
        for (int s = 0; s < packedSize(d); ++s)
          if (entries[s] >= 0) math::addTo(block.hessian + entries[s] * block.stride, hessian[s]);
      }
    }
  }

  std::vector<Element> elements_;
  std::vector<std::array<int, d>> coordinates_;
};

}  // namespace pliant::mechanics
