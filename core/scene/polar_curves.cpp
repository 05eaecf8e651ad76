#include "core/scene/polar_curves.hpp"

#include <limits>
#include <utility>

namespace pliant::scene {

PolarCurves freeTravelCurves(const FreeTravelResult& result) {
  PolarCurves all{result.provenance.study, "%", 100, 3, {}};
  PolarCurve stretch{"stretch", {}, {}, {}, true, false}, compression = stretch, travel = stretch;
  compression.name = "compression";
  travel.name = "free travel";
  const auto isLimit = [](const interlock::DirectionLimit& limit) {
    return limit.equilibrium.converged() && limit.equilibrium.kind != interlock::RestKind::unlimited;
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const interlock::FreeTravel& direction : result.directions) {
    const bool up = isLimit(direction.stretch), down = isLimit(direction.compression);
    const double first = direction.stretch.equilibrium.remaining, second = direction.compression.equilibrium.remaining;
    const double shortest = 1 + direction.compression.strain;
    const auto add = [&](PolarCurve& curve, bool known, double value, double uncertain) {
      curve.angles.push_back(direction.stretch.angle);
      curve.values.push_back(known ? value : none);
      curve.uncertain.push_back(known ? uncertain : none);
    };
    add(stretch, up, direction.stretch.strain, first);
    add(compression, down, direction.compression.strain, second);
    // Of (s - c) / (1 + c), to first order.
    add(travel, up && down, direction.travel(),
        first / shortest + second * (1 + direction.stretch.strain) / (shortest * shortest));
  }
  all.curves = {stretch, compression, travel};
  return all;
}

PolarCurves curvatureLimitCurves(const CurvatureLimitsResult& result) {
  PolarCurves all{result.provenance.study, "1/m", 1, 2, {}};
  const double none = std::numeric_limits<double>::quiet_NaN();
  all.note = "bent down: −k is shown";
  for (const auto& [side, member] :
       {std::pair{"up", &interlock::BendingLimits::up}, std::pair{"down", &interlock::BendingLimits::down}}) {
    const double sign = member == &interlock::BendingLimits::up ? 1 : -1;
    PolarCurve along{std::string("bent ") + side, {}, {}, {}, true, false};
    PolarCurve across{std::string("across, bent ") + side, {}, {}, {}, true, true};
    along.width = across.width = sign > 0 ? 1.8 : 0.8;
    for (const interlock::BendingLimits& direction : result.directions) {
      const interlock::BendingLimit& limit = direction.*member;
      const bool locked = limit.kind == interlock::BendingKind::locked;
      for (PolarCurve* curve : {&along, &across}) curve->angles.push_back(limit.angle);
      along.values.push_back(locked ? sign * limit.curvature : none);
      along.uncertain.push_back(locked ? limit.equilibrium.remaining : none);
      across.values.push_back(locked ? sign * limit.orthogonal : none);
    }
    all.curves.push_back(along);
    all.curves.push_back(across);
  }
  return all;
}

}  // namespace pliant::scene
