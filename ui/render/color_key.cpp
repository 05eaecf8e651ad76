#include "ui/render/color_key.hpp"

#include <vtkTextProperty.h>

#include <algorithm>

#include "ui/render/vtk_text.hpp"

namespace pliant::render {

namespace {
constexpr double margin = 16, lineHeight = 20, signWidth = 18;  // device-independent pixels
}

void ColorKey::addTo(vtkRenderer* renderer) { renderer_ = renderer; }

void ColorKey::setEntries(std::vector<Entry> entries, const Color& text) {
  for (const auto& line : lines_)
    for (vtkTextActor* actor : {line->sign.Get(), line->name.Get()}) renderer_->RemoveActor2D(actor);
  lines_.clear();
  for (const Entry& entry : entries) {
    const auto& line = lines_.emplace_back(std::make_unique<Line>());
    line->sign->SetInput(entry.sign.c_str());
    line->name->SetInput(entry.name.c_str());
    setTextStyle(line->sign->GetTextProperty(), 14, entry.color);
    setTextStyle(line->name->GetTextProperty(), 12, text);
    for (vtkTextActor* actor : {line->sign.Get(), line->name.Get()}) renderer_->AddActor2D(actor);
  }
}

void ColorKey::layOut() {
  double widest = 0;
  for (const auto& line : lines_) {
    double size[2] = {0, 0};
    line->name->GetSize(renderer_, size);
    widest = std::max(widest, size[0]);
  }
  const double left = renderer_->GetSize()[0] - margin * ratio_ - widest;
  double bottom = (margin + lineHeight * (static_cast<double>(lines_.size()) - 1)) * ratio_;
  for (const auto& line : lines_) {
    line->sign->SetPosition(left - signWidth * ratio_, bottom);
    line->name->SetPosition(left, bottom);
    bottom -= lineHeight * ratio_;
  }
}

}  // namespace pliant::render
