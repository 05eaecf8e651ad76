#include "ui/render/polar_scale.hpp"

#include <algorithm>
#include <cmath>

namespace pliant::render {

namespace {

constexpr int ringsAtMost = 6;
constexpr double middlePart = 0.12;  ///< of the radius, that negative values leave free

}  // namespace

void PolarScale::fit(double smallest, double largest) {
  const double low = std::min(0.0, smallest);
  double high = std::max(0.0, largest);
  if (!(high > low)) high = low + 1;
  const double decade = std::pow(10.0, std::floor(std::log10(high - low)));
  for (const double fraction : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    step_ = fraction * decade;
    if ((high - low) / step_ <= ringsAtMost) break;
  }
  outer_ = step_ * std::ceil(1.02 * high / step_ - 1e-9);
  inner_ = low < 0 ? low - middlePart / (1 - middlePart) * (outer_ - low) : 0;
  rings_.clear();
  for (double i = std::ceil(low / step_ - 1e-9); i * step_ <= outer_ + 1e-9 * step_; ++i)
    if (i * step_ > inner_ + 1e-9 * step_) rings_.push_back(i * step_);
}

int PolarScale::decimals() const { return std::max(0, static_cast<int>(std::ceil(-std::log10(step_) - 1e-9))); }

double PolarScale::fraction(double value) const { return std::max(0.0, (value - inner_) / (outer_ - inner_)); }

}  // namespace pliant::render
