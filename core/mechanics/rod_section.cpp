#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"
#include "core/mechanics/rod.hpp"

namespace pliant::mechanics {

namespace {

/// Saint-Venant's torsion constant of a rectangle, a >= b:
/// J = a b³/3 (1 - 192/π⁵ (b/a) Σ tanh(nπa/2b)/n⁵ over odd n).
double rectangleTorsionConstant(double a, double b) {
  double sum = 0;
  for (int n = 1999; n >= 1; n -= 2) sum += std::tanh(n * M_PI * a / (2 * b)) / std::pow(n, 5);
  return a * b * b * b / 3 * (1 - 192 / std::pow(M_PI, 5) * (b / a) * sum);
}

}  // namespace

RodSection circularSection(double radius) { return tubularSection(radius, 0); }

RodSection tubularSection(double radius, double innerRadius) {
  requirePositive(radius, "a rod's radius");
  requireNotNegative(innerRadius, "a rod's inner radius");
  if (innerRadius >= radius) throw base::InputError("", "a rod's inner radius must be below its radius");
  RodSection section;
  section.area = M_PI * (radius * radius - innerRadius * innerRadius);
  section.bendingInertia1 = section.bendingInertia2 = M_PI / 4 * (std::pow(radius, 4) - std::pow(innerRadius, 4));
  section.torsionConstant = section.polarInertia = 2 * section.bendingInertia1;
  return section;
}

RodSection rectangularSection(double width, double height) {
  requirePositive(width, "a rod's width");
  requirePositive(height, "a rod's height");
  RodSection section;
  section.area = width * height;
  section.bendingInertia1 = width * std::pow(height, 3) / 12;
  section.bendingInertia2 = height * std::pow(width, 3) / 12;
  section.torsionConstant = rectangleTorsionConstant(std::max(width, height), std::min(width, height));
  section.polarInertia = section.bendingInertia1 + section.bendingInertia2;
  return section;
}

}  // namespace pliant::mechanics
