#include "core/interlock/cell_rate.hpp"

#include <array>
#include <span>

#include "core/base/error.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Weights of f(x + k step) - f(x - k step), k = 1, 2, 3, over the step.
constexpr std::array<double, 3> sixthOrder = {45.0 / 60, -9.0 / 60, 1.0 / 60};

bool haveSameParts(const ElementParts& a, const ElementParts& b) {
  if (a.parts().size() != b.parts().size() || a.curves().size() != b.curves().size() ||
      a.corners().cols() != b.corners().cols())
    return false;
  for (std::size_t i = 0; i < a.parts().size(); ++i) {
    const Part &x = a.parts()[i], &y = b.parts()[i];
    if (x.kind != y.kind || x.piece != y.piece || x.curve != y.curve || x.corners != y.corners) return false;
  }
  for (std::size_t i = 0; i < a.curves().size(); ++i) {
    const auto &x = a.curves()[i].harmonics(), &y = b.curves()[i].harmonics();
    if (x.size() != y.size()) return false;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (x[k].order != y[k].order) return false;
  }
  return true;
}

bool haveSameParts(const CellContact& a, const CellContact& b) {
  const std::size_t count = a.cell().elements.size();
  if (count != b.cell().elements.size() || a.cell().shapes.size() != b.cell().shapes.size()) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (a.cell().elements[i].shape != b.cell().elements[i].shape ||
        !haveSameParts(a.partsOf(static_cast<int>(i)), b.partsOf(static_cast<int>(i))))
      return false;
  return true;
}

/// Cells at steps to either side, and their weights.
struct Stencil {
  std::vector<CellContact> cells;
  std::vector<double> weights;

  /// Σ weight · value of what `get` makes of each cell.
  template <typename Get>
  auto difference(Get&& get) const {
    auto sum = (weights[0] * get(cells[0])).eval();
    for (std::size_t i = 1; i < cells.size(); ++i) sum += weights[i] * get(cells[i]);
    return sum;
  }
};

/// Any element with that shape.
int elementOf(const UnitCell& cell, int shape) {
  for (std::size_t i = 0; i < cell.elements.size(); ++i)
    if (cell.elements[i].shape == shape) return static_cast<int>(i);
  return -1;
}

/// A number of all parts of an element.
VectorXd numbersOf(const CellContact& contact, int element, double Part::*number) {
  const auto& list = contact.partsOf(element).parts();
  VectorXd numbers(static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) numbers[static_cast<Eigen::Index>(i)] = list[i].*number;
  return numbers;
}

PartsRate partsRate(const Stencil& stencil, const Stencil& close, int element) {
  const ElementParts& parts = stencil.cells[0].partsOf(element);
  PartsRate rate;
  for (std::size_t i = 0; i < parts.curves().size(); ++i) {
    const auto curveOf = [&](const CellContact& contact) -> const ClosedCurve& {
      return contact.partsOf(element).curves()[i];
    };
    std::vector<ClosedCurve::Harmonic> harmonics;
    for (std::size_t k = 0; k < parts.curves()[i].harmonics().size(); ++k)
      harmonics.push_back({parts.curves()[i].harmonics()[k].order,
                           stencil.difference([&](const auto& c) { return curveOf(c).harmonics()[k].cosine; }),
                           stencil.difference([&](const auto& c) { return curveOf(c).harmonics()[k].sine; })});
    rate.curves.emplace_back(stencil.difference([&](const auto& c) { return curveOf(c).centre(); }), harmonics);
  }
  rate.corners = stencil.difference([&](const auto& c) { return c.partsOf(element).corners(); });
  rate.radii = stencil.difference([&](const auto& c) { return numbersOf(c, element, &Part::radius); });
  rate.begins = close.difference([&](const auto& c) { return numbersOf(c, element, &Part::begin); });
  rate.ends = close.difference([&](const auto& c) { return numbersOf(c, element, &Part::end); });
  return rate;
}

CellRate rateFrom(const Stencil& stencil, const Stencil& close, const UnitCell& cell) {
  CellRate rate;
  const int shapes = static_cast<int>(cell.shapes.size());
  for (int i = 0; i < shapes; ++i) {
    const int element = elementOf(cell, i);
    rate.shapes.push_back(element < 0 ? PartsRate{} : partsRate(stencil, close, element));
  }
  rate.lattice = stencil.difference([](const auto& c) { return c.cell().lattice; });
  const auto count = static_cast<Eigen::Index>(cell.elements.size());
  rate.positions.resize(3, count);
  rate.turns.resize(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    rate.positions.col(i) = stencil.difference([&](const auto& c) { return c.cell().elements[index].position; });
    const Eigen::Matrix3d spin = stencil.difference([&](const auto& c) { return c.cell().elements[index].rotation; }) *
                                 cell.elements[index].rotation.transpose();
    rate.turns.col(i) = 0.5 * Vector3d(spin(2, 1) - spin(1, 2), spin(0, 2) - spin(2, 0), spin(1, 0) - spin(0, 1));
  }
  for (std::size_t i = 0; i < stencil.cells.size(); ++i)
    rate.radius += stencil.weights[i] * stencil.cells[i].cell().smallestRadius();
  return rate;
}

/// The cells at so many steps to either side; none if they fall into other parts than `here`, or cannot be built.
std::optional<Stencil> stencilAt(const CellFunction& build, const VectorXd& values, int index, double step,
                                 std::span<const double> weights, const CellContact& here) {
  Stencil stencil;
  for (std::size_t k = 0; k < weights.size(); ++k)
    for (const int side : {1, -1}) {
      VectorXd shifted = values;
      shifted[index] += side * (static_cast<double>(k) + 1) * step;
      try {
        stencil.cells.emplace_back(build(shifted));
      } catch (const base::InputError&) {
        return std::nullopt;
      }
      if (!haveSameParts(here, stencil.cells.back())) return std::nullopt;
      stencil.weights.push_back(side * weights[k] / step);
    }
  return stencil;
}

}  // namespace

std::optional<CellRate> rateOf(const CellFunction& build, const VectorXd& values, int index, double step) {
  const CellContact here(build(values));
  // A thousandth of the step keeps nine digits.
  for (const double size : {step, 0.1 * step, 0.01 * step, 1e-3 * step}) {
    const auto stencil = stencilAt(build, values, index, size, sixthOrder, here);
    if (!stencil) continue;
    // Where curves are cut they are measured by samples, between which the derivative jumps a little.
    constexpr std::array<double, 1> secondOrder = {0.5};
    const auto close = stencilAt(build, values, index, 1e-3 * step, secondOrder, here);
    if (close) return rateFrom(*stencil, *close, here.cell());
  }
  return std::nullopt;
}

}  // namespace pliant::interlock
