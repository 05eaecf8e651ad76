#include "ui/render/polar_curves_picture.hpp"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "ui/render/offscreen_target.hpp"
#include "ui/render/polar_paint.hpp"
#include "ui/render/polar_scale.hpp"

namespace pliant::render {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double titleSize = 15, labelSize = 12;  // device-independent pixels, as all below
constexpr double sideRoom = 48, headRoom = 64, lineHeight = 20;

class CurvesItem final : public vtkContextItem {
 public:
  static CurvesItem* New();
  vtkTypeMacro(CurvesItem, vtkContextItem)

      std::function<void(vtkContext2D&)> paint;
  bool Paint(vtkContext2D* painter) override {
    paint(*painter);
    return true;
  }
};
vtkStandardNewMacro(CurvesItem);

class CurvesPainter {
 public:
  CurvesPainter(vtkContext2D& painter, const Rectangle& place, const scene::PolarCurves& plot, double ratio,
                Theme theme)
      : painter_(painter), place_(place), plot_(plot), ratio_(ratio), colors_(palette(theme)) {
    double low = 0, high = 0;
    for (const scene::PolarCurve& curve : plot.curves)
      for (const double value : curve.values)
        if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    scale_.fit(plot.factor * low, plot.factor * high);
    const double foot = (legendLines() + 1) * lineHeight * ratio;
    const double tall = place.height - headRoom * ratio - foot;
    centre_ = {place.left + 0.5 * place.width, place.bottom + foot + 0.5 * tall};
    radius_ = std::max(8.0, std::min(0.5 * place.width - sideRoom * ratio, 0.5 * tall - 0.5 * lineHeight * ratio));
  }

  void paint() {
    paintText(painter_, {place_.left + 0.5 * place_.width, place_.bottom + place_.height - 18 * ratio_}, {0.5, 0.5},
              plot_.title, titleSize * ratio_, colors_.text);
    painter_.GetBrush()->SetOpacity(0);
    for (int i = 0; i < 12; ++i) {
      pen(mixed(colors_.background, colors_.text, 0.16), 1);
      const Eigen::Vector2d end = at(pi * i / 6, scale_.outer());
      painter_.DrawLine(static_cast<float>(centre_.x()), static_cast<float>(centre_.y()), static_cast<float>(end.x()),
                        static_cast<float>(end.y()));
      const Eigen::Vector2d outward(std::cos(pi * i / 6), std::sin(pi * i / 6));
      paintText(painter_, end + 6 * ratio_ * outward, 0.5 * (Eigen::Vector2d::Ones() - outward),
                std::to_string(30 * i) + "°", labelSize * ratio_, mixed(colors_.background, colors_.text, 0.75));
    }
    for (const double ring : scale_.rings()) {
      pen(mixed(colors_.background, colors_.text, scale_.isZero(ring) ? 0.65 : 0.16), scale_.isZero(ring) ? 1.4 : 1);
      std::vector<float> points;
      for (int i = 0; i <= 180; ++i) add(points, at(pi * i / 90, ring));
      painter_.DrawPoly(points.data(), static_cast<int>(points.size() / 2));
    }
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) paintCurve(plot_.curves[i], colorOf(i));
    paintRingLabels();
    double y = place_.bottom + (legendLines() - 0.2) * lineHeight * ratio_;
    const double left = place_.left + 0.5 * place_.width - 60 * ratio_;
    for (std::size_t i = 0; i < plot_.curves.size(); ++i) {
      pen(colorOf(i), 2.4 * plot_.curves[i].width);
      painter_.GetPen()->SetLineType(plot_.curves[i].dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
      painter_.DrawLine(static_cast<float>(left), static_cast<float>(y), static_cast<float>(left + 22 * ratio_),
                        static_cast<float>(y));
      paintText(painter_, {left + 30 * ratio_, y}, {0, 0.5}, plot_.curves[i].name, labelSize * ratio_, colors_.text);
      y -= lineHeight * ratio_;
    }
    painter_.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    paintText(painter_, {left + 30 * ratio_, y}, {0, 0.5}, plot_.note, labelSize * ratio_,
              mixed(colors_.background, colors_.text, 0.75));
  }

 private:
  double legendLines() const { return static_cast<double>(plot_.curves.size()) + (plot_.note.empty() ? 0 : 1); }

  Color colorOf(std::size_t curve) const {
    const std::array<Color, 4> all{
        colors_.mass, mixed(colors_.driven, colors_.text, 0.25), colors_.trajectory, colors_.prediction};
    return all[curve % all.size()];
  }

  Eigen::Vector2d at(double angle, double value) const {
    return centre_ + radius_ * scale_.fraction(value) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }

  static void add(std::vector<float>& points, const Eigen::Vector2d& place) {
    points.push_back(static_cast<float>(place.x()));
    points.push_back(static_cast<float>(place.y()));
  }

  void paintCurve(const scene::PolarCurve& curve, const Color& color) {
    pen(color, 2.4 * curve.width);
    painter_.GetPen()->SetLineType(curve.dashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
    std::vector<float> points, dots;  // a value without neighbours is a dot
    const auto end = [&] {
      if (points.size() > 2) painter_.DrawPoly(points.data(), static_cast<int>(points.size() / 2));
      if (points.size() == 2) dots.insert(dots.end(), points.begin(), points.end());
      points.clear();
    };
    const auto put = [&](double angle, double value) {
      if (std::isfinite(value))
        add(points, at(angle, plot_.factor * value));
      else
        end();
    };
    for (const double turn : {0.0, pi})
      for (std::size_t k = 0; k < curve.angles.size() && (turn == 0 || curve.halfTurn); ++k)
        put(curve.angles[k] + turn, curve.values[k]);
    if (!curve.angles.empty()) put(curve.angles.front(), curve.values.front());
    end();
    painter_.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    if (dots.empty()) return;
    pen(color, 6);
    painter_.DrawPoints(dots.data(), static_cast<int>(dots.size() / 2));
  }

  void paintRingLabels() {
    double last = -1e9;
    for (const double ring : scale_.rings()) {
      const double radius = radius_ * scale_.fraction(ring);
      if (radius - last < 1.1 * labelSize * ratio_) continue;
      last = radius;
      char text[48];
      std::snprintf(text, sizeof text, "%s%.*f%s%s", ring < 0 && !scale_.isZero(ring) ? "−" : "", scale_.decimals(),
                    std::abs(ring), ring == scale_.rings().back() && !plot_.unit.empty() ? " " : "",
                    ring == scale_.rings().back() ? plot_.unit.c_str() : "");
      paintText(painter_, at(5 * pi / 12, ring), {0.5, 0.5}, text, labelSize * ratio_,
                mixed(colors_.background, colors_.text, 0.75));
    }
  }

  void pen(const Color& color, double width) {
    painter_.GetPen()->SetColorF(color[0], color[1], color[2], 1);
    painter_.GetPen()->SetWidth(static_cast<float>(width * ratio_));
  }

  vtkContext2D& painter_;
  Rectangle place_;
  const scene::PolarCurves& plot_;
  double ratio_;
  const Palette& colors_;
  PolarScale scale_;
  Eigen::Vector2d centre_;
  double radius_ = 1;
};

}  // namespace

Image drawPolarCurves(const std::vector<scene::PolarCurves>& plots, int width, int height, Theme theme) {
  const Palette& colors = palette(theme);
  const double each = static_cast<double>(width) / static_cast<double>(std::max<std::size_t>(1, plots.size()));
  const double ratio = std::clamp(std::min(each / 440, height / 480.0), 0.5, 8.0);
  OffscreenTarget target;
  target.setSize(width, height);
  Image picture;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(colors.background.data());
  target.window()->SetDPI(72);
  target.window()->SetMultiSamples(8);
  target.window()->AddRenderer(renderer);
  vtkNew<vtkContextActor> actor;
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  vtkNew<CurvesItem> item;
  item->paint = [&](vtkContext2D& painter) {
    for (std::size_t i = 0; i < plots.size(); ++i)
      CurvesPainter(
          painter, {each * static_cast<double>(i), 0, each, static_cast<double>(height)}, plots[i], ratio, theme)
          .paint();
  };
  actor->GetScene()->AddItem(item);
  target.render(picture);
  target.window()->RemoveRenderer(renderer);
  return picture;
}

}  // namespace pliant::render
