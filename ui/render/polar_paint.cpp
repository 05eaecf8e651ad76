#include "ui/render/polar_paint.hpp"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkPen.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/cloth/limit_envelope.hpp"
#include "ui/render/round_numbers.hpp"
#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double restPlace = 0.34;  // of the radius
constexpr double leastExcess = 1e-3;
constexpr double room = 1.06;  // beyond the largest stretch
constexpr int curvePieces = 360;
constexpr double labelSize = 11;  // device-independent pixels, as all below
constexpr double sideRoom = 46, endRoom = 24;

std::array<unsigned char, 4> bytesOf(const Color& color, double opacity = 1) {
  const auto byte = [](double value) { return static_cast<unsigned char>(std::lround(255 * value)); };
  return {byte(color[0]), byte(color[1]), byte(color[2]), byte(opacity)};
}

class PolarPainter {
 public:
  PolarPainter(vtkContext2D& painter, const Rectangle& place, double largest, double pixelRatio, Theme theme)
      : painter_(painter), ratio_(pixelRatio), colors_(palette(theme)) {
    centre_ = Eigen::Vector2d(place.left + 0.5 * place.width, place.bottom + 0.5 * place.height);
    radius_ =
        std::max(8.0, std::min(0.5 * place.width - sideRoom * pixelRatio, 0.5 * place.height - endRoom * pixelRatio));
    const double excess = std::max(leastExcess, room * (largest - 1));
    outer_ = 1 + excess;
    inner_ = 1 - excess * restPlace / (1 - restPlace);
    for (const double ring : roundNumbers(1, outer_, 4))
      if (ring > 1 + 1e-12) rings_.push_back(ring);
  }

  void paintGrid() {
    brush({}, 0);
    pen(mixed(colors_.background, colors_.text, 0.18), 1);
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector2d end = at(pi * i / 4, outer_);
      painter_.DrawLine(static_cast<float>(centre_.x()), static_cast<float>(centre_.y()), static_cast<float>(end.x()),
                        static_cast<float>(end.y()));
    }
    for (const double ring : rings_) curve([ring](double) { return ring; });
    pen(mixed(colors_.background, colors_.text, 0.65), 1.2);
    curve([](double) { return 1.0; });
  }

  void paintLimit(const cloth::StretchLimit& limit, const cloth::LimitConstraints& constraints, const Color& color) {
    const auto stretch = [&](double angle) { return cloth::stretchAt(limit, angle); };
    brush(color, 0.12);
    // Filled as a fan around its first point, so that begins in the middle: the curve need not be convex.
    std::vector<float> points{static_cast<float>(centre_.x()), static_cast<float>(centre_.y())};
    for (const float coordinate : places(stretch)) points.push_back(coordinate);
    painter_.GetPen()->SetLineType(vtkPen::NO_PEN);
    painter_.DrawPolygon(points.data(), static_cast<int>(points.size() / 2));
    painter_.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    pen(color, 2.2);
    curve(stretch);
    if (!constraints.ellipses.empty()) return;
    brush(color, 1);
    for (const cloth::DirectionLimit& direction : constraints.directions)
      for (const double turn : {0.0, pi}) {
        const Eigen::Vector2d dot = at(direction.angle + turn, stretch(direction.angle));
        const auto radius = static_cast<float>(3 * ratio_);
        painter_.DrawEllipse(static_cast<float>(dot.x()), static_cast<float>(dot.y()), radius, radius);
      }
  }

  /// Numbers of the rings, each where the limits leave it most room.
  void paintLabels(const std::vector<cloth::StretchLimit>& limits) {
    const Color muted = mixed(colors_.background, colors_.text, 0.72);
    const double step = rings_.empty() ? 0.1 : rings_.front() - 1;
    const int decimals = std::max(2, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    const auto put = [&](double ring, const std::string& text) {
      double most = -1, chosen = 0;
      for (const double eighths : {-3, -5, 3, 5, -1, -7, 1, 7}) {
        const double angle = pi / 8 * eighths;
        double least = radius_;
        for (const cloth::StretchLimit& limit : limits)
          for (const double aside : {-0.15, 0.0, 0.15})
            least = std::min(least, std::abs(radiusOf(cloth::stretchAt(limit, angle + aside)) - radiusOf(ring)));
        if (least <= most + 1) continue;  // of nearly equal ones the first
        most = least;
        chosen = angle;
      }
      onPatch(at(chosen, ring), text, muted);
    };
    put(1, "rest");
    for (const double ring : rings_) {
      char text[32];
      std::snprintf(text, sizeof text, "%.*f", decimals, ring);
      put(ring, text);
    }
    const double gap = 5 * ratio_;
    paintText(painter_, at(0, outer_) + Eigen::Vector2d(gap, 0), {0, 0.5}, "warp", labelSize * ratio_, colors_.text);
    paintText(
        painter_, at(pi / 2, outer_) + Eigen::Vector2d(0, gap), {0.5, 0}, "weft", labelSize * ratio_, colors_.text);
  }

 private:
  double radiusOf(double stretch) const { return radius_ * std::max(0.0, (stretch - inner_) / (outer_ - inner_)); }

  Eigen::Vector2d at(double angle, double stretch) const {
    return centre_ + radiusOf(stretch) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }

  template <class Stretch>
  std::vector<float> places(const Stretch& stretch) const {
    std::vector<float> points;
    for (int i = 0; i <= curvePieces; ++i) {
      const double angle = 2 * pi * i / curvePieces;
      const Eigen::Vector2d place = at(angle, stretch(angle));
      points.push_back(static_cast<float>(place.x()));
      points.push_back(static_cast<float>(place.y()));
    }
    return points;
  }

  template <class Stretch>
  void curve(const Stretch& stretch) {
    std::vector<float> points = places(stretch);
    painter_.DrawPoly(points.data(), static_cast<int>(points.size() / 2));
  }

  void onPatch(const Eigen::Vector2d& place, const std::string& text, const Color& color) {
    const double halfHeight = 0.62 * labelSize * ratio_;
    const double halfWidth = 0.32 * labelSize * ratio_ * static_cast<double>(text.size()) + 2 * ratio_;
    painter_.GetPen()->SetLineType(vtkPen::NO_PEN);
    brush(colors_.background, 0.8);
    painter_.DrawRect(static_cast<float>(place.x() - halfWidth), static_cast<float>(place.y() - halfHeight),
                      static_cast<float>(2 * halfWidth), static_cast<float>(2 * halfHeight));
    painter_.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    paintText(painter_, place, {0.5, 0.5}, text, labelSize * ratio_, color);
  }

  void pen(const Color& color, double width) {
    const auto bytes = bytesOf(color);
    painter_.GetPen()->SetColor(bytes[0], bytes[1], bytes[2], bytes[3]);
    painter_.GetPen()->SetWidth(static_cast<float>(width * ratio_));
  }

  void brush(const Color& color, double opacity) {
    const auto bytes = bytesOf(color, opacity);
    painter_.GetBrush()->SetColor(bytes[0], bytes[1], bytes[2], bytes[3]);
  }

  vtkContext2D& painter_;
  double ratio_;
  const Palette& colors_;
  Eigen::Vector2d centre_;
  double radius_ = 1;             ///< [pixels]
  double inner_ = 0, outer_ = 2;  ///< stretches at the centre and at the edge
  std::vector<double> rings_;
};

}  // namespace

void paintText(vtkContext2D& painter, const Eigen::Vector2d& place, const Eigen::Vector2d& anchor,
               const std::string& text, double size, const Color& color) {
  setTextStyle(painter.GetTextProp(), static_cast<int>(std::lround(size)), color);
  painter.GetTextProp()->SetOpacity(1);
  painter.GetTextProp()->SetJustificationToLeft();
  painter.GetTextProp()->SetVerticalJustificationToBottom();
  float box[4];
  painter.ComputeStringBounds(text.c_str(), box);
  painter.DrawString(static_cast<float>(place.x() - anchor.x() * box[2]),
                     static_cast<float>(place.y() - anchor.y() * box[3]), text.c_str());
}

void paintPolar(vtkContext2D& painter, const Rectangle& place, const std::vector<cloth::StretchLimit>& limits,
                const std::vector<cloth::LimitConstraints>& constraints, double pixelRatio, Theme theme) {
  double largest = 1;
  for (const cloth::StretchLimit& limit : limits) largest = std::max(largest, cloth::largestStretch(limit));
  PolarPainter polar(painter, place, largest, pixelRatio, theme);
  polar.paintGrid();
  const Palette& colors = palette(theme);
  const std::array<Color, 4> lines{colors.mass, colors.prediction, colors.trajectory, colors.driven};
  for (std::size_t i = 0; i < limits.size(); ++i)
    polar.paintLimit(
        limits[i], i < constraints.size() ? constraints[i] : cloth::LimitConstraints(), lines[i % lines.size()]);
  polar.paintLabels(limits);
}

}  // namespace pliant::render
