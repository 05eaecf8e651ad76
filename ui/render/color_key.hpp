#pragma once

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include <memory>
#include <string>
#include <vector>

#include "ui/render/theme.hpp"

namespace pliant::render {

/// What colours mean: lines of a sign and a name in the bottom right corner.
class ColorKey {
 public:
  struct Entry {
    std::string sign;  ///< such as "■"
    std::string name;
    Color color;
  };
  void addTo(vtkRenderer* renderer);
  void setEntries(std::vector<Entry> entries, const Color& text);
  void setPixelRatio(double ratio) { ratio_ = ratio; }
  /// Called when rendering begins.
  void layOut();

 private:
  struct Line {
    vtkNew<vtkTextActor> sign, name;
  };
  vtkRenderer* renderer_ = nullptr;
  double ratio_ = 1;
  std::vector<std::unique_ptr<Line>> lines_;
};

}  // namespace pliant::render
