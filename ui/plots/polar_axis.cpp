#include "ui/plots/polar_axis.hpp"

#include <algorithm>
#include <cmath>

#include "ui/plots/plot_style.hpp"

namespace pliant::plots {

namespace {

constexpr double restPlace = 0.34;  ///< of the radius
constexpr double leastExcess = 1e-3;
constexpr int ringsAtMost = 4;

}  // namespace

void PolarAxis::fit(double largest) {
  const double excess = roundedUp(std::max(leastExcess, 1.06 * (largest - 1)));
  outer_ = 1 + excess;
  inner_ = 1 - excess * restPlace / (1 - restPlace);
  const double decade = std::pow(10.0, std::floor(std::log10(excess)));
  double step = decade;
  for (const double fraction : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    step = fraction * decade;
    if (excess / step <= ringsAtMost + 1e-9) break;
  }
  rings_.clear();
  for (int i = 1; i * step <= excess * (1 + 1e-9); ++i) rings_.push_back(1 + i * step);
}

bool PolarAxis::refit(double largest) {
  const double used = (largest - 1) / (outer_ - 1);
  if (used <= 1 && (used >= 0.35 || outer_ - 1 <= leastExcess * 1.01)) return false;
  const double before = outer_;
  fit(largest);
  return outer_ != before;
}

double PolarAxis::radiusOf(double stretch) const {
  return radius_ * std::max(0.0, (stretch - inner_) / (outer_ - inner_));
}

QPointF PolarAxis::point(double angle, double stretch) const {
  const double r = radiusOf(stretch);
  return centre_ + QPointF(r * std::cos(angle), -r * std::sin(angle));
}

double PolarAxis::stretchAt(const QPointF& place) const {
  const QPointF d = place - centre_;
  return inner_ + std::hypot(d.x(), d.y()) / radius_ * (outer_ - inner_);
}

double PolarAxis::angleAt(const QPointF& place) const {
  const QPointF d = place - centre_;
  return std::atan2(-d.y(), d.x());
}

QString stretchText(double stretch, bool percent, int decimals) {
  if (!percent) return QString::number(stretch, 'f', decimals);
  const double value = 100 * (stretch - 1);
  const QString digits = QString::number(std::abs(value), 'f', std::max(0, decimals - 2));
  return QStringLiteral("%1%2 %").arg(value < 0 ? QStringLiteral("−") : QStringLiteral("+"), digits);
}

}  // namespace pliant::plots
