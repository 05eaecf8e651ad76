#include "ui/render/drape_figure.hpp"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "ui/render/cloth_view.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/offscreen_target.hpp"
#include "ui/render/polar_paint.hpp"

namespace pliant::render {
namespace {

constexpr int mostColumns = 4;
constexpr double titleHeight = 40, footHeight = 40, titleSize = 15, footSize = 12;  // device-independent pixels
constexpr double columnWidth = 340, columnHeight = 620;                             // that the sizes of text suit
constexpr double polarShare = 0.46;                                                 // of what is below the title

class PaintedItem final : public vtkContextItem {
 public:
  static PaintedItem* New();
  vtkTypeMacro(PaintedItem, vtkContextItem)

      std::function<void(vtkContext2D&)> paint;
  bool Paint(vtkContext2D* painter) override {
    paint(*painter);
    return true;
  }
};
vtkStandardNewMacro(PaintedItem);

/// Where the parts of a column stand.
struct Column {
  Rectangle title, polar, drape;
};

Column columnAt(std::size_t index, const DrapeGrid& grid, int width, int height, double ratio) {
  const int row = static_cast<int>(index) / grid.columns, column = static_cast<int>(index) % grid.columns;
  const double each = static_cast<double>(width) / grid.columns;
  const double tall = (height - footHeight * ratio) / grid.rows;
  const double top = height - row * tall, left = column * each;
  const double below = tall - titleHeight * ratio, polar = polarShare * below;
  // Whole pixels: pictures of drapes are put there.
  const double drapeTop = std::round(top - titleHeight * ratio - polar), drapeBottom = std::round(top - tall);
  return {{left, top - titleHeight * ratio, each, titleHeight * ratio},
          {left, drapeTop, each, polar},
          {std::round(left), drapeBottom, std::round(left + each) - std::round(left), drapeTop - drapeBottom}};
}

/// A strip of the colours of a sheet, with what its ends mean.
void paintKey(vtkContext2D& painter, int width, double ratio, const Palette& colors) {
  constexpr int pieces = 64;
  const double strip = 120 * ratio, tall = 10 * ratio, middle = 0.5 * footHeight * ratio;
  vtkNew<vtkLookupTable> table;
  setViridis(table, 0, 1, false);
  painter.GetPen()->SetLineType(vtkPen::NO_PEN);
  const double left = 0.5 * (width - strip);
  for (int i = 0; i < pieces; ++i) {
    double color[3];
    table->GetColor((i + 0.5) / pieces, color);
    painter.GetBrush()->SetColorF(color[0], color[1], color[2], 1);
    painter.DrawRect(static_cast<float>(left + strip * i / pieces), static_cast<float>(middle - 0.5 * tall),
                     static_cast<float>(strip / pieces + 0.5), static_cast<float>(tall));
  }
  painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
  paintText(painter, {left - 8 * ratio, middle}, {1, 0.5}, "unstretched", footSize * ratio, colors.text);
  paintText(painter, {left + strip + 8 * ratio, middle}, {0, 0.5}, "at its limit", footSize * ratio, colors.text);
}

Image drawSheet(OffscreenTarget& target, const Drape& drape, const Rectangle& place, double ratio, Theme theme) {
  target.setSize(static_cast<int>(place.width), static_cast<int>(place.height));
  Image image;
  ClothView view;
  view.attach(target.window());
  view.setPixelRatio(ratio);
  view.setTheme(theme);
  view.setProblem(drape.problem);
  view.setFrameless(true);
  if (drape.frame) {
    view.setFrames({drape.frame});
    view.setFrame(0);
  }
  view.faceFrame();
  target.render(image);
  return image;
}

void put(const Image& piece, const Rectangle& place, Image& picture) {
  const auto left = static_cast<std::size_t>(place.left);
  const auto top = static_cast<std::size_t>(picture.height - static_cast<int>(place.bottom) - piece.height);
  for (int y = 0; y < piece.height; ++y)
    std::memcpy(
        &picture.pixels[4 * ((top + static_cast<std::size_t>(y)) * static_cast<std::size_t>(picture.width) + left)],
        &piece.pixels[4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(piece.width)],
        4 * static_cast<std::size_t>(piece.width));
}

}  // namespace

DrapeGrid drapeGrid(std::size_t count) {
  const int columns = std::clamp(static_cast<int>(count), 1, mostColumns);
  return {columns, std::max(1, (static_cast<int>(count) + columns - 1) / columns)};
}

double fittingPixelRatio(std::size_t count, int width, int height) {
  const DrapeGrid grid = drapeGrid(count);
  return std::clamp(std::min(width / (columnWidth * grid.columns), height / (columnHeight * grid.rows)), 0.5, 8.0);
}

Image drawDrapes(const std::vector<Drape>& drapes, int width, int height, double pixelRatio, Theme theme) {
  const Palette& colors = palette(theme);
  const DrapeGrid grid = drapeGrid(drapes.size());
  OffscreenTarget target;
  target.setSize(width, height);
  Image picture;
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(colors.background.data());
    target.window()->SetDPI(72);
    target.window()->SetMultiSamples(8);
    target.window()->AddRenderer(renderer);
    vtkNew<vtkContextActor> actor;
    renderer->AddActor(actor);
    actor->GetScene()->SetRenderer(renderer);
    vtkNew<PaintedItem> item;
    item->paint = [&](vtkContext2D& painter) {
      for (std::size_t i = 0; i < drapes.size(); ++i) {
        const Column column = columnAt(i, grid, width, height, pixelRatio);
        paintText(painter,
                  {column.title.left + 0.5 * column.title.width, column.title.bottom + 0.5 * column.title.height},
                  {0.5, 0.5}, drapes[i].title, titleSize * pixelRatio, colors.text);
        if (!drapes[i].problem) continue;
        const cloth::LimitedSheet& sheet = drapes[i].problem->sheet;
        paintPolar(painter, column.polar, sheet.limits, sheet.constraints, pixelRatio, theme);
      }
      paintKey(painter, width, pixelRatio, colors);
    };
    actor->GetScene()->AddItem(item);
    target.render(picture);
    target.window()->RemoveRenderer(renderer);
  }
  for (std::size_t i = 0; i < drapes.size(); ++i) {
    const Rectangle place = columnAt(i, grid, width, height, pixelRatio).drape;
    if (!drapes[i].problem || place.width < 1 || place.height < 1) continue;
    put(drawSheet(target, drapes[i], place, pixelRatio, theme), place, picture);
  }
  return picture;
}

}  // namespace pliant::render
