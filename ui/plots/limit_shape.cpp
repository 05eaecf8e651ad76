#include "ui/plots/limit_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pliant::plots {

using cloth::DirectionLimit;
using cloth::StretchLimit;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double leastGap = pi / 180;  ///< between points of a curve
constexpr double sameAngle = 1e-9;
constexpr int pointsOfAnyLimit = 8;  ///< that a free curve takes of another limit
constexpr const char* belowRest =
    "A limit below 1 would forbid the rest shape itself, so the stretch stays at least 1.";

double halfTurnOf(double angle) {
  const double turned = angle - pi * std::floor(angle / pi);
  return turned >= pi - sameAngle ? 0 : turned;
}

double fullTurnOf(double angle) {
  const double turned = angle - 2 * pi * std::floor(angle / (2 * pi));
  return turned >= 2 * pi - sameAngle ? 0 : turned;
}

/// Into [0, π/2] by mirroring.
double quarterOf(double angle) {
  const double half = halfTurnOf(angle);
  return half > pi / 2 ? pi - half : half;
}

/// How far two directions are apart, in [0, π/2].
double apart(double a, double b) { return std::abs(std::remainder(a - b, pi)); }

bool onAxis(double angle) { return angle < sameAngle || angle > pi / 2 - sameAngle; }

/// Whether each point has a partner in the mirror.
bool isMirrored(const std::vector<DirectionLimit>& points) {
  return std::all_of(points.begin(), points.end(), [&](const DirectionLimit& point) {
    return std::any_of(points.begin(), points.end(), [&](const DirectionLimit& other) {
      return apart(other.angle, -point.angle) < 1e-6 && std::abs(other.stretch - point.stretch) < 1e-9;
    });
  });
}

void sortByAngle(std::vector<DirectionLimit>& points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.angle < b.angle; });
}

/// One half of points that mirror one another.
std::vector<DirectionLimit> firstQuarter(const std::vector<DirectionLimit>& points) {
  std::vector<DirectionLimit> quarter, otherQuarter;
  for (const DirectionLimit& point : points) {
    const double half = halfTurnOf(point.angle);
    (half > pi / 2 + sameAngle ? otherQuarter : quarter).push_back({quarterOf(half), point.stretch});
  }
  if (quarter.empty()) quarter = std::move(otherQuarter);
  sortByAngle(quarter);
  return quarter;
}

}  // namespace

LimitShape::LimitShape(const StretchLimit& limit) { setLimit(limit, true); }

StretchLimit LimitShape::limit() const {
  if (kind_ == LimitKind::isotropic) return cloth::IsotropicLimit{handles_[0].stretch};
  if (kind_ == LimitKind::orthotropic)
    return cloth::OrthotropicLimit{handles_[0].stretch, handles_[1].stretch, handles_[0].angle};
  std::vector<DirectionLimit> points = handles_;
  if (symmetry_ == LimitSymmetry::mirrored)
    for (const DirectionLimit& handle : handles_)
      if (!onAxis(handle.angle)) points.push_back({pi - handle.angle, handle.stretch});
  return cloth::LimitCurve(std::move(points));
}

std::vector<HandlePlace> LimitShape::places() const {
  std::vector<HandlePlace> places;
  const auto add = [&](int handle, double turn, bool reflected, double own) {
    places.push_back({handle, fullTurnOf(reflected ? turn - own : turn + own), turn, reflected});
  };
  for (int i = 0; i < handleCount(); ++i) {
    const double own = handles_[i].angle;
    for (const double turn : {0.0, pi}) add(i, turn, false, own);
    if (kind_ == LimitKind::free && symmetry_ == LimitSymmetry::mirrored && !onAxis(own))
      for (const double turn : {pi, 2 * pi}) add(i, turn, true, own);
  }
  if (kind_ == LimitKind::orthotropic) add(rotationHandle, 0, false, handles_[0].angle);
  return places;
}

void LimitShape::setLimit(const StretchLimit& limit, bool infer) {
  if (const auto* isotropic = std::get_if<cloth::IsotropicLimit>(&limit)) {
    kind_ = LimitKind::isotropic;
    handles_ = {{0, isotropic->stretch}};
  } else if (const auto* orthotropic = std::get_if<cloth::OrthotropicLimit>(&limit)) {
    kind_ = LimitKind::orthotropic;
    const double angle = halfTurnOf(orthotropic->angle);
    handles_ = {{angle, orthotropic->first}, {halfTurnOf(angle + pi / 2), orthotropic->second}};
  } else {
    kind_ = LimitKind::free;
    handles_ = std::get<cloth::LimitCurve>(limit).points();
    const bool mirrored = isMirrored(handles_) && (infer || symmetry_ == LimitSymmetry::mirrored);
    symmetry_ = mirrored ? LimitSymmetry::mirrored : LimitSymmetry::none;
    if (mirrored) handles_ = firstQuarter(handles_);
  }
}

void LimitShape::setKind(LimitKind kind) {
  if (kind == kind_) return;
  const StretchLimit before = limit();
  if (kind == LimitKind::isotropic) {
    setLimit(cloth::IsotropicLimit{cloth::smallestStretch(before)});
  } else if (kind == LimitKind::orthotropic) {
    setLimit(cloth::OrthotropicLimit{cloth::stretchAt(before, 0), cloth::stretchAt(before, pi / 2), 0});
  } else {
    std::vector<DirectionLimit> points;
    for (int i = 0; i < pointsOfAnyLimit; ++i) {
      const double angle = pi * i / pointsOfAnyLimit;
      points.push_back({angle, cloth::stretchAt(before, angle)});
    }
    setLimit(cloth::LimitCurve(std::move(points)), true);
  }
}

void LimitShape::setSymmetry(LimitSymmetry symmetry) {
  if (symmetry == symmetry_ || kind_ != LimitKind::free) return;
  if (symmetry == LimitSymmetry::none) {
    const StretchLimit whole = limit();
    symmetry_ = symmetry;
    handles_ = std::get<cloth::LimitCurve>(whole).points();
    return;
  }
  symmetry_ = symmetry;
  handles_ = firstQuarter(handles_);
}

double LimitShape::ownAngle(double angle) const {
  const bool mirrored = kind_ == LimitKind::free && symmetry_ == LimitSymmetry::mirrored;
  return mirrored ? quarterOf(angle) : halfTurnOf(angle);
}

bool LimitShape::tooNear(double angle, int except) const {
  for (int i = 0; i < handleCount(); ++i)
    if (i != except && apart(handles_[i].angle, angle) < leastGap * (1 - 1e-6)) return true;
  const bool mirrored = symmetry_ == LimitSymmetry::mirrored;
  return mirrored && !onAxis(angle) && apart(angle, -angle) < leastGap * (1 - 1e-6);
}

std::string LimitShape::drag(int handle, const DirectionLimit& place) {
  if (handle == rotationHandle) {
    if (kind_ != LimitKind::orthotropic) return {};
    handles_[0].angle = halfTurnOf(place.angle);
    handles_[1].angle = halfTurnOf(place.angle + pi / 2);
    return {};
  }
  DirectionLimit& moved = handles_.at(handle);
  moved.stretch = std::max(1.0, place.stretch);
  const std::string sentence = place.stretch < 1 ? belowRest : "";
  if (kind_ != LimitKind::free) return sentence;
  if (symmetry_ == LimitSymmetry::mirrored) {
    const double low = handle == 0 ? 0 : handles_[handle - 1].angle + leastGap;
    const double high = handle + 1 == handleCount() ? pi / 2 : handles_[handle + 1].angle - leastGap;
    if (low > high) return sentence;
    double angle = std::clamp(moved.angle + std::remainder(place.angle - moved.angle, pi), low, high);
    // Beside an axis its mirror image would be too near: it lies on the axis.
    if (angle < leastGap / 2) angle = 0;
    if (angle > pi / 2 - leastGap / 2) angle = pi / 2;
    moved.angle = angle;
  } else {
    double change = std::remainder(place.angle - moved.angle, pi);
    if (handleCount() > 1) {
      const auto gapTo = [&](int other, int sign) {
        const double gap = halfTurnOf(sign * (handles_[(other + handleCount()) % handleCount()].angle - moved.angle));
        return std::max(0.0, (gap > 0 ? gap : pi) - leastGap);
      };
      change = std::clamp(change, -gapTo(handle - 1, -1), gapTo(handle + 1, 1));
    }
    moved.angle = halfTurnOf(moved.angle + change);
  }
  return sentence;
}

std::string LimitShape::put(int handle, const DirectionLimit& place) {
  if (!std::isfinite(place.angle) || !std::isfinite(place.stretch)) return "This is not a finite number.";
  if (place.stretch < 1) return belowRest;
  if (kind_ == LimitKind::isotropic) {
    handles_[0].stretch = place.stretch;
    return {};
  }
  const double angle = ownAngle(place.angle);
  if (kind_ == LimitKind::orthotropic) {
    handles_.at(handle) = {angle, place.stretch};
    handles_.at(1 - handle).angle = halfTurnOf(angle + pi / 2);
    return {};
  }
  if (tooNear(angle, handle)) return "Another point of the curve has this direction; they need 1° between them.";
  handles_.at(handle) = {angle, place.stretch};
  sortByAngle(handles_);
  return {};
}

std::string LimitShape::add(double angle) {
  if (kind_ != LimitKind::free) return "Points can be added to a free curve only.";
  const double own = ownAngle(angle);
  if (tooNear(own, -1)) return "Another point of the curve has this direction; they need 1° between them.";
  handles_.push_back({own, cloth::stretchAt(limit(), own)});
  sortByAngle(handles_);
  return {};
}

std::string LimitShape::remove(int handle) {
  if (kind_ != LimitKind::free) return "Points can be deleted from a free curve only.";
  if (handleCount() == 1) return "The last point of a curve stays.";
  handles_.erase(handles_.begin() + handle);
  return {};
}

int LimitShape::sort(int handle) {
  if (kind_ != LimitKind::free || handle < 0) return handle;
  const double angle = handles_.at(handle).angle;
  sortByAngle(handles_);
  return nearestHandle(angle);
}

int LimitShape::nearestHandle(double angle) const {
  const double own = ownAngle(angle);
  const auto nearest = std::min_element(handles_.begin(), handles_.end(), [&](const auto& a, const auto& b) {
    return apart(a.angle, own) < apart(b.angle, own);
  });
  return static_cast<int>(nearest - handles_.begin());
}

bool sameLimit(const StretchLimit& a, const StretchLimit& b) {
  if (a.index() != b.index()) return false;
  if (const auto* isotropic = std::get_if<cloth::IsotropicLimit>(&a))
    return isotropic->stretch == std::get<cloth::IsotropicLimit>(b).stretch;
  if (const auto* orthotropic = std::get_if<cloth::OrthotropicLimit>(&a)) {
    const auto& other = std::get<cloth::OrthotropicLimit>(b);
    return orthotropic->first == other.first && orthotropic->second == other.second &&
           orthotropic->angle == other.angle;
  }
  const auto &points = std::get<cloth::LimitCurve>(a).points(), &others = std::get<cloth::LimitCurve>(b).points();
  return std::equal(points.begin(), points.end(), others.begin(), others.end(), [](const auto& p, const auto& q) {
    // Angles pass through degrees on their way to the scene and back.
    return p.stretch == q.stretch && std::abs(p.angle - q.angle) < 1e-12;
  });
}

const std::vector<LimitPreset>& limitPresets() {
  const auto curve = [](std::initializer_list<std::array<double, 2>> degreesAndStretches) {
    std::vector<DirectionLimit> points;
    for (const auto& [degrees, stretch] : degreesAndStretches) points.push_back({degrees * pi / 180, stretch});
    return cloth::LimitCurve(std::move(points));
  };
  static const std::vector<LimitPreset> presets{
      {"Isotropic", "The same in every direction", cloth::IsotropicLimit{1.05}},
      {"Woven", "Stiff along both yarns, loose along the bias (illustrative)",
       curve(
           {{0, 1.02}, {22.5, 1.08}, {45, 1.17}, {67.5, 1.09}, {90, 1.03}, {112.5, 1.09}, {135, 1.17}, {157.5, 1.08}})},
      {"Twill", "A weave with a diagonal: one bias is looser than the other (illustrative)",
       curve({{0, 1.02}, {25, 1.08}, {50, 1.19}, {70, 1.12}, {90, 1.04}, {115, 1.07}, {140, 1.10}, {160, 1.05}})},
      {"Knit", "Loops give way, across the wales more than along them (illustrative)",
       curve({{0, 1.60}, {30, 1.52}, {60, 1.36}, {90, 1.28}, {120, 1.36}, {150, 1.52}})},
      {"Chainmail", "Rings that turn before they lock: four lobes (illustrative)",
       curve({{0, 1.10}, {20, 1.16}, {45, 1.32}, {70, 1.16}, {90, 1.10}, {110, 1.16}, {135, 1.32}, {160, 1.16}})}};
  return presets;
}

}  // namespace pliant::plots
