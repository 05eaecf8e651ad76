#pragma once

#include <vtkRenderWindow.h>

#include <algorithm>
#include <cmath>

#include "ui/render/body_figure.hpp"
#include "ui/render/boundary_geometry.hpp"
#include "ui/render/bounds.hpp"
#include "ui/render/color_key.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/element_figure.hpp"
#include "ui/render/macro_marks.hpp"
#include "ui/render/macro_picture.hpp"
#include "ui/render/macro_view.hpp"
#include "ui/render/native_half.hpp"
#include "ui/render/sheet_primitive.hpp"
#include "ui/render/stage.hpp"

namespace pliant::render {

inline constexpr double captionRoom = 84;  // device-independent pixels
inline constexpr double shortestEdge = 7;  // the same; shorter ones would hide what they divide
inline constexpr const char* staleNotice = "inputs have changed since this was computed";

inline constexpr int materialColors = 4;

/// Told apart by the colour-blind (Okabe & Ito 2008): light blue, orange, bluish green, reddish purple.
inline Color materialColor(std::size_t material) {
  constexpr std::array<Color, materialColors> colors{
      {{0.34, 0.71, 0.91}, {0.90, 0.62, 0.0}, {0.0, 0.62, 0.45}, {0.80, 0.47, 0.65}}};
  return colors[material % colors.size()];
}

/// What a MacroView draws, and what of it is on show.
struct MacroView::Parts {
  Stage& stage;
  SheetPrimitive sheet;
  LinePrimitive edges{0.6};
  vtkNew<vtkPoints> edgePoints;
  vtkNew<vtkLookupTable> table;
  MacroMarks marks;
  ColorKey key;
  BodyFigure bodies;
  ElementFigure elements;
  std::shared_ptr<const scene::MacroResult> result;
  std::shared_ptr<const interlock::MacroSheet> drawn;  ///< whose triangles there are
  Bounds bounds;                                       ///< of all that has been reached
  std::size_t reached = 0;                             ///< frames in the bounds
  double edgeLength = 0;                               ///< mean, at rest [m]
  int frame = -1;
  MacroField field = MacroField::nearest;
  Picks picks = Picks::triangles;
  std::optional<int> selected;  ///< triangle
  std::vector<int> materials;   ///< of the triangles, while these are painted
  std::vector<std::string> materialNames;
  bool stale = false, wantsElements = false, wantsNative = true;
  std::unique_ptr<NativeHalf> half;

  explicit Parts(Stage& around) : stage(around) {
    stage.renderer()->AddActor(sheet.actor());
    stage.renderer()->AddActor(edges.actor());
    bodies.addTo(stage.renderer());
    elements.addTo(stage.renderer());
    marks.addTo(stage.renderer());
    key.addTo(stage.renderer());
    stage.legend().setTable(table);
    stage.onLayOut = [this] {
      chooseDetail();
      placeMarks();
      key.layOut();
    };
    stage.onTheme = [this] { applyTheme(); };
    stage.onField = [this] {
      show();
      applyTheme();
    };
    stage.onPixelRatio = [this] {
      edges.setPixelRatio(stage.pixelRatio());
      marks.setPixelRatio(stage.pixelRatio());
      key.setPixelRatio(stage.pixelRatio());
      if (half) half->setPixelRatio(stage.pixelRatio());
      stage.camera().setTopMargin(captionRoom * stage.pixelRatio());
    };
    stage.onAttach = [this] {
      if (half) half->attach(stage.window());
    };
    show();
    stage.setTheme(Theme::light);
  }

  bool isVisible() const { return result && result->state.positions.size() > 0; }
  const scene::MacroFrame* shownFrame() const {
    return result && frame >= 0 && frame < static_cast<int>(result->frames.size())
               ? result->frames[static_cast<std::size_t>(frame)].get()
               : nullptr;
  }
  Points positions() const {
    if (const scene::MacroFrame* shown = shownFrame()) return shown->positions;
    return result->state.positions.reshaped(3, result->sheet->mesh.points.cols());
  }
  bool showsNative() const { return isVisible() && wantsNative && result->native && result->native->patch; }
  /// Of the elements that are computed beside the sheet, under the loads on show.
  const interlock::CellState& nativeState() const {
    const scene::MacroFrame* now = shownFrame();
    return now && now->native ? *now->native : result->native->rest.state;
  }
  /// Without the colours of the sheet there is nothing on it that its elements would hide. Of several frames they have
  /// places in the last one alone.
  bool showsElements() const {
    const bool isAtEnd = !shownFrame() || shownFrame() == result->frames.back().get();
    return materials.empty() && result && result->placed && isAtEnd && (wantsElements || !stage.fieldVisible());
  }

  void show() {
    const bool visible = isVisible();
    divide();
    sheet.actor()->SetVisibility(visible && !showsElements());
    edges.actor()->VisibilityOff();  // until it is known how long they are seen
    elements.show(showsElements() ? result.get() : nullptr);
    marks.setVisible(visible);
    if (!visible) {
      bodies.setBodies({});
      drawn.reset();
      return;
    }
    if (result->sheet != drawn) showSheet();
    bounds.add(positions());
    for (; reached < result->frames.size(); ++reached) {
      const scene::MacroFrame& added = *result->frames[reached];
      bounds.add(added.positions);
      if (added.native) bounds.add(added.native->positions);
    }
    if (result->native) bounds.add(result->native->rest.state.positions);
    stage.camera().setReach(bounds.corners());
    showFrame();
  }

  /// What all frames of a study share.
  void showSheet() {
    drawn = result->sheet;
    sheet.setTopology(drawn->mesh.triangles);
    std::vector<std::array<int, 2>> segments;
    edgeLength = 0;
    for (const geometry::MeshEdge& edge : geometry::meshEdges(drawn->mesh.triangles)) {
      segments.push_back(edge.nodes);
      edgeLength += (drawn->mesh.points.col(edge.nodes[1]) - drawn->mesh.points.col(edge.nodes[0])).norm();
    }
    edgeLength /= static_cast<double>(segments.size());
    edgePoints->SetNumberOfPoints(drawn->mesh.points.cols());
    edges.setPoints(edgePoints);
    edges.setTopology(segments);
    bodies.setBodies(result->bodies);
    bounds = Bounds();
    reached = 0;
  }

  void showFrame() {
    const Points places = positions();
    sheet.setPoints(places);
    for (Eigen::Index i = 0; i < places.cols(); ++i) edgePoints->SetPoint(i, places.col(i).data());
    edgePoints->Modified();
    const scene::MacroFrame* now = shownFrame();
    bodies.setPoints(now ? Points(now->bodyPoints) : mechanics::bodyPointsAt(result->bodies, 0));
    showField();
    showNotice();
    showNative();
  }

  /// The window between the sheet and the elements.
  void divide() {
    if (half && showsNative() && half->patch() == result->native->patch) return;
    half.reset();
    if (!showsNative()) return;
    half = std::make_unique<NativeHalf>(stage, result->native->patch);
    half->setTheme(stage.theme(), stale);
  }

  void showNative() {
    if (!half) return;
    half->pose(nativeState());
    const scene::MacroFrame* now = shownFrame();
    const double mean = now && now->native ? now->nativeDistance : result->native->meanDistance;
    half->setCaption(nativeCaption(*result->native, mean));
  }

  void showNotice() {
    const scene::MacroFrame* now = isVisible() ? shownFrame() : nullptr;
    std::string notice = now ? macroFrameLine(*now, result->isMotion()) : "";
    if (stale && isVisible()) notice += std::string(notice.empty() ? "" : "\n") + staleNotice;
    stage.setNotice(notice, stage.colors().text);
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    const bool visible = isVisible();
    setColor(sheet.actor(), stale ? faded(colors.rest) : colors.rest);
    setColor(edges.actor(), colors.background);
    bodies.setColor(stale ? faded(colors.spring) : colors.spring);
    elements.setColors(colors);
    if (half) half->setTheme(stage.theme(), stale);
    marks.setColors(colors);
    std::vector<ColorKey::Entry> entries;
    if (visible && !result->clamped.empty()) entries.push_back({"●", "clamped", colors.link});
    if (visible && !result->loaded.empty()) entries.push_back({"●", "loads", colors.driven});
    if (visible && result->native) entries.push_back({"●", "elements", colors.prediction});
    for (std::size_t i = 0; showsMaterials() && i < materialNames.size(); ++i)
      entries.push_back({"■", materialNames[i], materialColor(i)});
    key.setEntries(std::move(entries), colors.text);
    showNotice();
    showField();
  }

  bool showsMaterials() const { return isVisible() && materials.size() == drawn->mesh.triangles.size(); }

  void showMaterials() {
    table->SetNumberOfTableValues(materialColors);
    table->SetTableRange(0, materialColors - 1);
    for (int i = 0; i < materialColors; ++i) {
      const Color color = materialColor(static_cast<std::size_t>(i));
      table->SetTableValue(i, color[0], color[1], color[2]);
    }
    Eigen::VectorXd numbers(static_cast<Eigen::Index>(materials.size()));
    for (std::size_t t = 0; t < materials.size(); ++t)
      numbers[static_cast<Eigen::Index>(t)] = materials[t] % materialColors;
    stage.setLegendVisible(false);
    sheet.setField(&numbers, table);
  }

  void showField() {
    if (showsMaterials()) return showMaterials();
    const bool visible = result && stage.fieldVisible() && result->state.stretchGauge.size() > 0 && !showsElements();
    setViridis(table, 0, 1, stale);
    stage.legend().setQuantity(field == MacroField::bending   ? "bending / limit\n1: at the limit"
                               : field == MacroField::stretch ? "stretch / limit\n1: at the limit"
                                                              : "nearness to limits\n1: at a limit",
                               Legend::Scale::plain, "");
    stage.legend().setRange(0, 1);
    stage.setLegendVisible(visible);
    if (!visible) {
      sheet.setField(nullptr, table);
      return;
    }
    const scene::MacroFrame* shown = shownFrame();
    const Eigen::VectorXd& stretch = shown ? shown->stretchGauge : result->state.stretchGauge;
    const Eigen::VectorXd& bending = shown ? shown->bendingGauge : result->state.bendingGauge;
    const Eigen::VectorXd values = field == MacroField::stretch   ? stretch
                                   : field == MacroField::bending ? bending
                                                                  : Eigen::VectorXd(stretch.cwiseMax(bending));
    sheet.setField(&values, table);
  }

  void chooseDetail() {
    const double length = edgeLength / stage.camera().pixelSize();
    edges.actor()->SetVisibility(isVisible() && !showsElements() && length > shortestEdge * stage.pixelRatio());
    if (!showsElements()) return;
    vtkRenderWindow* window = stage.renderer()->GetRenderWindow();
    elements.chooseDetail(stage.camera(), window && window->GetMultiSamples() <= 1);  // see View::setFineQuality
  }

  void placeMarks() {
    if (!isVisible()) return;
    const Points places = positions();
    std::optional<Eigen::Vector3d> ringed;
    if (selected && *selected < static_cast<int>(drawn->mesh.triangles.size()))
      ringed = places(Eigen::all, drawn->mesh.triangles[static_cast<std::size_t>(*selected)]).rowwise().mean();
    marks.place(stage.camera(), places(Eigen::all, result->clamped), places(Eigen::all, result->loaded),
                result->native ? Points(nativeState().positions) : Points(3, 0), ringed);
  }
};

}  // namespace pliant::render
