#pragma once

#include <vtkFloatArray.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <memory>
#include <vector>

#include "core/scene/macro_result.hpp"
#include "ui/render/body_glyphs.hpp"
#include "ui/render/camera_control.hpp"
#include "ui/render/theme.hpp"

namespace pliant::render {

/// The placed elements of a sheet: instances of one surface for each shape. How fine it is depends on how many are in
/// view, so that a picture has so many triangles at most as software draws in about a second; while the camera moves
/// as it draws in a moment, and if they are more still each is a dot.
class ElementFigure {
 public:
  ElementFigure();
  void addTo(vtkRenderer* renderer);
  /// Null: none.
  void show(const scene::MacroResult* result);
  void setColors(const Palette& colors);
  /// For the next picture.
  void chooseDetail(const CameraControl& camera, bool moves);

 private:
  static constexpr std::size_t levelCount = 3;
  /// Elements of one shape.
  struct Shape {
    std::array<BodyGlyphs, levelCount> glyphs;        ///< from fine to coarse
    std::array<std::size_t, levelCount> triangles{};  ///< of one element
    std::vector<Eigen::Index> members;
  };
  void pose(Shape& shape, std::size_t level, const std::vector<char>* seen);
  /// Of all elements, or those that are seen.
  std::size_t triangleCount(std::size_t level, const std::vector<char>* seen) const;
  Color colorOf(Eigen::Index element) const;
  void setDots();

  vtkRenderer* renderer_ = nullptr;
  std::vector<std::unique_ptr<Shape>> shapes_;
  const scene::MacroResult* shown_ = nullptr;
  std::vector<int> tints_;  ///< of all elements
  Palette colors_{};
  std::array<bool, levelCount> whole_{};  ///< the glyphs have all elements, with the present colours
  double spacing_ = 0;                    ///< of elements [m]
  vtkNew<vtkPoints> dotPlaces_;
  vtkNew<vtkFloatArray> dotNormals_;
  vtkNew<vtkUnsignedCharArray> dotColors_;
  vtkNew<vtkPolyData> dots_;
  vtkNew<vtkPolyDataMapper> dotMapper_;
  vtkNew<vtkActor> dotActor_;
};

}  // namespace pliant::render
