#pragma once

#include "ui/render/theme.hpp"

class vtkTextProperty;

namespace pliant::render {

/// DejaVu Sans (VTK's own font has no Greek letters and draws brackets as parentheses) where it is installed.
/// `size` in points of 1/72 inch: device-independent pixels.
void setTextStyle(vtkTextProperty* property, int size, const Color& color);

}  // namespace pliant::render
