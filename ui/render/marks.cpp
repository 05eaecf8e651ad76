#include "ui/render/marks.hpp"

#include <vtkShaderProperty.h>

#include <numeric>
#include <string>

namespace pliant::render {
namespace {

constexpr double rim = 4;  // device-independent pixels, on both sides together

Points columnsOf(const std::vector<Eigen::Vector3d>& places) {
  Points points(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = places[i];
  return points;
}

void setDepth(vtkActor* actor, const std::string& depth) {
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Light::Impl", true, "//VTK::Light::Impl\n  gl_FragDepth = " + depth + ";\n", false);
}

std::vector<int> numbersUpTo(std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

void seeThrough(vtkActor* actor, double share) { setDepth(actor, std::to_string(share) + " * gl_FragCoord.z"); }

void seeBehind(vtkActor* actor, double share) {
  setDepth(actor, "1.0 - " + std::to_string(share) + " * (1.0 - gl_FragCoord.z)");
}

void Balls::show(const std::vector<Eigen::Vector3d>& places, double radius) {
  markers_.setNodes(numbersUpTo(places.size()), std::vector<double>(places.size(), radius));
  markers_.setPoints(columnsOf(places));
  markers_.actor()->SetVisibility(!places.empty());
}

Marks::Marks(double diameter) : rims_(diameter + rim), dots_(diameter) {
  seeThrough(rims_.actor(), 0.02);
  seeThrough(dots_.actor(), 0.01);
}

void Marks::setColors(const Color& dot, const Color& around) {
  setColor(dots_.actor(), dot);
  setColor(rims_.actor(), around);
}

void Marks::setPixelRatio(double ratio) {
  for (DotPrimitive* each : {&rims_, &dots_}) each->setPixelRatio(ratio);
}

void Marks::show(const std::vector<Eigen::Vector3d>& places) {
  for (DotPrimitive* each : {&rims_, &dots_}) {
    each->setNodes(numbersUpTo(places.size()));
    each->setPoints(columnsOf(places));
    each->actor()->SetVisibility(!places.empty());
  }
}

}  // namespace pliant::render
