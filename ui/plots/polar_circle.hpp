#pragma once

#include <QPointF>
#include <cmath>
#include <numbers>

#include "ui/render/polar_scale.hpp"

namespace pliant::plots {

/// The scale of a polar plot with its circle on the screen [pixels].
class PolarCircle : public render::PolarScale {
 public:
  void setCircle(const QPointF& centre, double radius) {
    centre_ = centre;
    radius_ = radius;
  }
  QPointF centre() const { return centre_; }
  double radius() const { return radius_; }
  double radiusOf(double value) const { return radius_ * fraction(value); }
  QPointF point(double angle, double value) const {
    return centre_ + radiusOf(value) * QPointF(std::cos(angle), -std::sin(angle));
  }
  /// In [0, 2π), counterclockwise from the right.
  double angleAt(const QPointF& place) const {
    const double angle = std::atan2(centre_.y() - place.y(), place.x() - centre_.x());
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
  }

 private:
  QPointF centre_;
  double radius_ = 100;
};

}  // namespace pliant::plots
