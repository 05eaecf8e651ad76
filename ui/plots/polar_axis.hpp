#pragma once

#include <QPointF>
#include <QString>
#include <vector>

namespace pliant::plots {

/// How stretches lie on the radius of a polar plot. The rest shape's ring, stretch 1, has a fixed place, and what is
/// above it the larger part of the radius, so that 1.00 and 1.05 are told apart at a glance.
class PolarAxis {
 public:
  PolarAxis() { fit(1.1); }

  /// Shows stretches up to the next round number above `largest`.
  void fit(double largest);
  /// Fits anew only if `largest` leaves the axis or uses little of it; returns whether it did.
  bool refit(double largest);
  double outer() const { return outer_; }
  double inner() const { return inner_; }
  /// Round stretches above 1 up to the outer end.
  const std::vector<double>& rings() const { return rings_; }

  void setCircle(const QPointF& centre, double radius) {
    centre_ = centre;
    radius_ = radius;
  }
  QPointF centre() const { return centre_; }
  double radius() const { return radius_; }
  /// In pixels; 0 at and below the inner end.
  double radiusOf(double stretch) const;
  QPointF point(double angle, double stretch) const;
  double stretchAt(const QPointF& place) const;
  /// The directions in which the rings carry their numbers, the rest shape's ring first.
  void setLabelAngles(std::vector<double> angles) { labelAngles_ = std::move(angles); }
  double labelAngle(std::size_t ring) const { return ring < labelAngles_.size() ? labelAngles_[ring] : 0; }
  /// In [-π, π], counterclockwise from the right.
  double angleAt(const QPointF& place) const;

 private:
  double inner_ = 0.9, outer_ = 1.1;
  std::vector<double> rings_;
  QPointF centre_;
  double radius_ = 100;
  std::vector<double> labelAngles_;
};

/// "1.05" or "+5 %", with the digits that neighbouring rings need.
QString stretchText(double stretch, bool percent, int decimals);

}  // namespace pliant::plots
