#include "ui/render/axes_box.hpp"

#include <vtkMapper.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/render/round_numbers.hpp"
#include "ui/render/vtk_text.hpp"

namespace pliant::render {
namespace {

constexpr double room = 0.1;  // of the range, on each side
constexpr int ticksWanted = 6;
constexpr double tickLength = 0.025;  // of the box's diagonal
constexpr double numberGap = 9;       // device-independent pixels from the end of the tick
constexpr double nameGap = 44;
constexpr int numberSize = 12, nameSize = 13;

/// Pairs of points that are lines.
void setLines(LinePrimitive& lines, const std::vector<Eigen::Vector3d>& ends) {
  vtkNew<vtkPoints> points;
  std::vector<std::array<int, 2>> segments;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    points->InsertNextPoint(ends[i].data());
    if (i % 2 == 1) segments.push_back({static_cast<int>(i) - 1, static_cast<int>(i)});
  }
  lines.setPoints(points);
  lines.setTopology(segments);
}

std::string numberText(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(value) < 1e-9 * step ? 0.0 : value);
  return *text == '-' ? "−" + std::string(text + 1) : text;
}

}  // namespace

void AxesBox::addTo(vtkRenderer* renderer) {
  for (LinePrimitive* lines : {&grid_, &frame_}) renderer->AddActor(lines->actor());
  for (auto& axis : numbers_)
    for (auto& number : axis) renderer->AddActor2D(number);
  for (auto& name : names_) renderer->AddActor2D(name);
  placeWalls();
}

void AxesBox::setRange(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const std::array<std::string, 3>& names,
                       double factor) {
  const Eigen::Vector3d span = (high - low).cwiseMax(0.05 * (high - low).maxCoeff()).cwiseMax(1e-9);
  const Eigen::Vector3d middle = 0.5 * (low + high);
  low_ = middle - (0.5 + room) * span;
  high_ = middle + (0.5 + room) * span;
  // One step for all axes: they have one scale, and squares of the grid are squares.
  const std::vector<double> longest = roundNumbers(0, factor * (high_ - low_).maxCoeff(), ticksWanted);
  const double step = longest.size() > 1 ? longest[1] - longest[0] : 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto index = static_cast<std::size_t>(axis);
    ticks_[index].clear();
    for (double i = std::ceil(factor * low_[axis] / step); i * step <= factor * high_[axis]; ++i)
      if (ticks_[index].size() < mostTicks) ticks_[index].push_back(i * step / factor);
    for (std::size_t i = 0; i < ticks_[index].size(); ++i)
      numbers_[index][i]->SetInput(numberText(factor * ticks_[index][i], step).c_str());
    names_[index]->SetInput(names[index].c_str());
  }
  placeWalls();
}

void AxesBox::setVisible(bool visible) {
  visible_ = visible;
  for (LinePrimitive* lines : {&grid_, &frame_}) lines->actor()->SetVisibility(visible);
  for (auto& axis : numbers_)
    for (auto& number : axis) number->SetVisibility(false);  // layOut shows those that there are
  for (auto& name : names_) name->SetVisibility(false);
}

void AxesBox::setTheme(const Palette& palette) {
  setColor(grid_.actor(), mixed(palette.background, palette.text, 0.16));
  setColor(frame_.actor(), mixed(palette.background, palette.text, 0.55));
  for (auto& axis : numbers_)
    for (auto& number : axis)
      setTextStyle(number->GetTextProperty(), numberSize, mixed(palette.background, palette.text, 0.8));
  for (auto& name : names_) setTextStyle(name->GetTextProperty(), nameSize, palette.text);
}

void AxesBox::setPixelRatio(double ratio) {
  ratio_ = ratio;
  grid_.setPixelRatio(ratio);
  frame_.setPixelRatio(ratio);
}

void AxesBox::placeWalls() {
  std::vector<Eigen::Vector3d> grid, frame;
  const double tick = tickLength * (high_ - low_).norm();
  for (int across = 0; across < 3; ++across) {
    for (const int along : {(across + 1) % 3, (across + 2) % 3}) {
      const int other = 3 - across - along;
      // Lines along `along` on this wall, one at each tick of the other axis, to beyond the rim in front.
      Eigen::Vector3d from = low_, to = high_;
      from[across] = to[across] = wall(across);
      const bool high = wallIsHigh(along);
      for (const double place : ticks_[static_cast<std::size_t>(other)]) {
        from[other] = to[other] = place;
        from[along] = low_[along] - (high ? tick : 0);
        to[along] = high_[along] + (high ? 0 : tick);
        grid.insert(grid.end(), {from, to});
      }
      from[along] = low_[along];
      to[along] = high_[along];
      for (const double rim : {low_[other], high_[other]}) {
        from[other] = to[other] = rim;
        frame.insert(frame.end(), {from, to});
      }
    }
  }
  setLines(grid_, grid);
  setLines(frame_, frame);
}

void AxesBox::layOut(const CameraControl& camera) {
  if (!visible_) return;
  const Eigen::Vector3d eye = camera.pose().position;
  std::array<bool, 3> high;
  for (int axis = 0; axis < 3; ++axis)
    high[static_cast<std::size_t>(axis)] = eye[axis] < 0.5 * (low_[axis] + high_[axis]);
  if (high != wallIsHigh_) {
    wallIsHigh_ = high;
    placeWalls();
  }
  for (int axis = 0; axis < 3; ++axis) placeLabels(axis, camera);
}

void AxesBox::placeLabels(int axis, const CameraControl& camera) {
  const auto index = static_cast<std::size_t>(axis);
  const int second = (axis + 1) % 3, third = (axis + 2) % 3;
  const auto middleOf = [&](bool secondHigh, bool thirdHigh) {
    Eigen::Vector3d place = 0.5 * (low_ + high_);
    place[second] = secondHigh ? high_[second] : low_[second];
    place[third] = thirdHigh ? high_[third] : low_[third];
    return place;
  };
  // Of the edges along the axis those are at the rim of the picture that belong to one wall alone: where one of their
  // two sides is a wall. The lower one is taken, of the upright axis the left one.
  struct Edge {
    Eigen::Vector3d middle, outward;  ///< off the wall
    Eigen::Vector2d pixel;
  };
  std::optional<Edge> chosen;
  for (const bool onSecond : {true, false}) {
    Edge edge;
    const int off = onSecond ? third : second;
    edge.middle =
        onSecond ? middleOf(wallIsHigh(second), !wallIsHigh(third)) : middleOf(!wallIsHigh(second), wallIsHigh(third));
    edge.outward = Eigen::Vector3d::Zero();
    edge.outward[off] = (wallIsHigh(off) ? -1 : 1) * tickLength * (high_ - low_).norm();
    const auto pixel = camera.pixelOf(edge.middle);
    if (!pixel) continue;
    edge.pixel = *pixel;
    const bool better =
        !chosen || (axis == 2 ? edge.pixel.x() < chosen->pixel.x() : edge.pixel.y() < chosen->pixel.y());
    if (better) chosen = edge;
  }
  for (auto& number : numbers_[index]) number->SetVisibility(false);
  names_[index]->SetVisibility(false);
  if (!chosen) return;
  Eigen::Vector3d low = chosen->middle, high = low;
  low[axis] = low_[axis];
  high[axis] = high_[axis];
  const auto first = camera.pixelOf(low), last = camera.pixelOf(high),
             end = camera.pixelOf(chosen->middle + chosen->outward), centre = camera.pixelOf(0.5 * (low_ + high_));
  // An axis that is looked along has no room for numbers.
  if (!first || !last || !end || !centre || (*last - *first).norm() < 40 * ratio_) return;
  // Off the edge at right angles, to the outside.
  const Eigen::Vector2d along = (*last - *first).normalized();
  Eigen::Vector2d outward(along.y(), -along.x());
  if (outward.dot(chosen->pixel - *centre) < 0) outward = -outward;
  const auto put = [&](vtkTextActor* text, const Eigen::Vector2d& place) {
    vtkTextProperty* style = text->GetTextProperty();
    style->SetJustification(outward.x() > 0.35    ? VTK_TEXT_LEFT
                            : outward.x() < -0.35 ? VTK_TEXT_RIGHT
                                                  : VTK_TEXT_CENTERED);
    style->SetVerticalJustification(outward.y() > 0.35    ? VTK_TEXT_BOTTOM
                                    : outward.y() < -0.35 ? VTK_TEXT_TOP
                                                          : VTK_TEXT_CENTERED);
    text->SetPosition(place.x(), place.y());
    text->SetVisibility(true);
  };
  for (std::size_t i = 0; i < ticks_[index].size(); ++i) {
    Eigen::Vector3d place = chosen->middle + chosen->outward;
    place[axis] = ticks_[index][i];
    if (const auto pixel = camera.pixelOf(place))
      put(numbers_[index][i], *pixel + numberGap * ratio_ * (outward.y() < -0.35 ? 0.5 : 1) * outward);
  }
  // Beside the numbers; of the upright axis above its end, where it cannot be cut off.
  const bool upright = std::abs(along.y()) > 0.8;
  if (upright) {
    outward = {0, 1};
    put(names_[index], (along.y() > 0 ? *last : *first) + Eigen::Vector2d(0, 6 * ratio_));
  } else {
    put(names_[index], *end + nameGap * ratio_ * outward);
  }
}

}  // namespace pliant::render
