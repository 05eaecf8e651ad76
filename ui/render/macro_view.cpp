#include "ui/render/macro_view.hpp"

#include <vtkRenderWindow.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "ui/render/body_figure.hpp"
#include "ui/render/boundary_geometry.hpp"
#include "ui/render/bounds.hpp"
#include "ui/render/color_key.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/dot_overlay.hpp"
#include "ui/render/element_figure.hpp"
#include "ui/render/offscreen_target.hpp"
#include "ui/render/ring.hpp"
#include "ui/render/sheet_primitive.hpp"
#include "ui/render/stage.hpp"

namespace pliant::render {
namespace {

/// Of elements, of which software draws a few pictures a second.
constexpr long mostMovingTriangles = 300'000;
constexpr double captionRoom = 84;  // device-independent pixels

std::string numberText(double value) { return base::formatQuantity(value, {}); }

std::string millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f mm", 1e3 * metres);
  return text;
}

}  // namespace

struct MacroView::Parts {
  Stage& stage;
  SheetPrimitive sheet;
  LinePrimitive edges{0.6};
  vtkNew<vtkPoints> edgePoints;
  vtkNew<vtkLookupTable> table;
  DotOverlay clamps, loads, origins;
  Ring selectionRing;
  ColorKey key;
  BodyFigure bodies;
  ElementFigure elements;
  std::shared_ptr<const scene::MacroResult> result;
  int frame = -1;
  MacroField field = MacroField::nearest;
  Picks picks = Picks::triangles;
  std::optional<int> selected;  ///< triangle
  bool stale = false, wantsElements = false;

  explicit Parts(Stage& around) : stage(around) {
    stage.renderer()->AddActor(sheet.actor());
    stage.renderer()->AddActor(edges.actor());
    bodies.addTo(stage.renderer());
    elements.addTo(stage.renderer());
    clamps.addTo(stage.renderer());
    loads.addTo(stage.renderer());
    origins.addTo(stage.renderer());
    selectionRing.addTo(stage.renderer());
    key.addTo(stage.renderer());
    stage.legend().setTable(table);
    stage.onLayOut = [this] {
      chooseDetail();
      placeDots();
      placeRing();
      key.layOut();
    };
    stage.onTheme = [this] { applyTheme(); };
    stage.onField = [this] {
      show();
      applyTheme();
    };
    stage.onPixelRatio = [this] {
      edges.setPixelRatio(stage.pixelRatio());
      for (DotOverlay* dots : overlays()) dots->setPixelRatio(stage.pixelRatio());
      selectionRing.setPixelRatio(stage.pixelRatio());
      key.setPixelRatio(stage.pixelRatio());
      stage.camera().setTopMargin(captionRoom * stage.pixelRatio());
    };
    show();
    stage.setTheme(Theme::light);
  }

  std::array<DotOverlay*, 3> overlays() { return {&clamps, &loads, &origins}; }

  const scene::MacroFrame* shownFrame() const {
    return result && frame >= 0 && frame < static_cast<int>(result->frames.size())
               ? result->frames[static_cast<std::size_t>(frame)].get()
               : nullptr;
  }
  Points positions() const {
    if (const scene::MacroFrame* shown = shownFrame()) return shown->positions;
    return result->state.positions.reshaped(3, result->sheet->mesh.points.cols());
  }
  /// Without the colours of the sheet there is nothing on it that its elements would hide. Of a motion they have places
  /// in its last frame alone.
  bool showsElements() const {
    const bool isAtEnd = !shownFrame() || shownFrame() == result->frames.back().get();
    return result && result->placed && isAtEnd && (wantsElements || !stage.fieldVisible());
  }

  void show() {
    const bool visible = result && result->state.positions.size() > 0;
    for (vtkActor* actor : {sheet.actor(), edges.actor()}) actor->SetVisibility(visible && !showsElements());
    elements.show(showsElements() ? result.get() : nullptr);
    for (DotOverlay* dots : overlays()) dots->setVisible(visible);
    if (!visible) {
      bodies.setBodies({});
      return;
    }
    const geometry::SurfaceMesh& mesh = result->sheet->mesh;
    const Points places = positions();
    sheet.setTopology(mesh.triangles);
    sheet.setPoints(places);
    std::vector<std::array<int, 2>> segments;
    for (const geometry::MeshEdge& edge : geometry::meshEdges(mesh.triangles)) segments.push_back(edge.nodes);
    edgePoints->SetNumberOfPoints(places.cols());
    for (Eigen::Index i = 0; i < places.cols(); ++i) edgePoints->SetPoint(i, places.col(i).data());
    edges.setPoints(edgePoints);
    edges.setTopology(segments);
    bodies.setBodies(result->bodies);
    const scene::MacroFrame* now = shownFrame();
    bodies.setPoints(now ? Points(now->bodyPoints) : mechanics::bodyPointsAt(result->bodies, 0));
    Bounds bounds;
    bounds.add(places);
    for (const auto& each : result->frames) bounds.add(each->positions);
    if (result->native) bounds.add(result->native->rest.state.positions);
    stage.camera().setReach(bounds.corners());
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    const bool visible = result && result->state.positions.size() > 0;
    setColor(sheet.actor(), stale ? faded(colors.rest) : colors.rest);
    setColor(edges.actor(), colors.background);
    bodies.setColor(stale ? faded(colors.spring) : colors.spring);
    elements.setColors(colors);
    clamps.setColors(colors.link, colors.background);
    loads.setColors(colors.driven, colors.background);
    origins.setColors(colors.prediction, colors.background);
    selectionRing.setColors(colors.text, colors.background);
    std::vector<ColorKey::Entry> entries;
    if (visible && !result->clamped.empty()) entries.push_back({"●", "clamped", colors.link});
    if (visible && !result->loaded.empty()) entries.push_back({"●", "loads", colors.driven});
    if (visible && result->native) entries.push_back({"●", "elements", colors.prediction});
    key.setEntries(std::move(entries), colors.text);
    stage.setNotice(stale && visible ? "inputs have changed since this was computed" : "", colors.text);
    showField();
  }

  void showField() {
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

  /// While the camera moves many elements are too many for software: the sheet stands for them.
  void chooseDetail() {
    if (!showsElements()) return;
    vtkRenderWindow* window = stage.renderer()->GetRenderWindow();
    const bool moves = window && window->GetMultiSamples() <= 1;  // see View::setFineQuality
    const bool sheetInstead = moves && elements.triangleCount() > mostMovingTriangles;
    for (vtkActor* actor : {sheet.actor(), edges.actor()}) actor->SetVisibility(sheetInstead);
    elements.setVisible(!sheetInstead);
  }

  void placeDots() {
    if (!result || result->state.positions.size() == 0) return;
    const Points places = positions();
    put(places(Eigen::all, result->clamped), clamps);
    put(places(Eigen::all, result->loaded), loads);
    put(result->native ? Points(result->native->rest.state.positions) : Points(3, 0), origins);
  }

  void placeRing() {
    selectionRing.setPlace(std::nullopt);
    if (!result || !selected || *selected >= static_cast<int>(result->sheet->mesh.triangles.size())) return;
    const auto& corners = result->sheet->mesh.triangles[static_cast<std::size_t>(*selected)];
    selectionRing.setPlace(stage.camera().pixelOf(positions()(Eigen::all, corners).rowwise().mean()));
  }

  void put(const Points& places, DotOverlay& dots) const {
    Eigen::Matrix2Xd pixels(2, places.cols());
    Eigen::Index count = 0;
    for (Eigen::Index i = 0; i < places.cols(); ++i)
      if (const auto pixel = stage.camera().pixelOf(places.col(i))) pixels.col(count++) = *pixel;
    dots.setPlaces(pixels.leftCols(count));
  }
};

MacroView::MacroView() : parts_(std::make_unique<Parts>(stage())) {}

MacroView::~MacroView() { attach(nullptr); }

void MacroView::setResult(std::shared_ptr<const scene::MacroResult> result) {
  parts_->result = std::move(result);
  parts_->frame = parts_->result ? static_cast<int>(parts_->result->frames.size()) - 1 : -1;
  parts_->show();
  parts_->applyTheme();
}

const std::shared_ptr<const scene::MacroResult>& MacroView::result() const { return parts_->result; }

void MacroView::setField(MacroField field) {
  parts_->field = field;
  parts_->showField();
}

void MacroView::setFrame(int frame) {
  if (!parts_->result || frame < 0 || frame >= static_cast<int>(parts_->result->frames.size())) return;
  parts_->frame = frame;
  parts_->show();
  parts_->showField();
}

void MacroView::setElementsVisible(bool visible) {
  parts_->wantsElements = visible;
  parts_->show();
  parts_->applyTheme();
}

bool MacroView::elementsVisible() const { return parts_->showsElements(); }

void MacroView::setStale(bool stale) {
  if (parts_->stale == stale) return;
  parts_->stale = stale;
  parts_->applyTheme();
}

void MacroView::setPicks(Picks picks) { parts_->picks = picks; }

void MacroView::setSelectedTriangle(std::optional<int> triangle) { parts_->selected = triangle; }

std::optional<int> MacroView::pickNode(double x, double y, double radius) const {
  if (!parts_->result || parts_->result->state.positions.size() == 0) return std::nullopt;
  const Points places = parts_->positions();
  if (parts_->picks == Picks::nodes) return stage().camera().nearestPoint(places, x, y, radius);
  const auto beside = stage().camera().pointBeside(cameraPose().focus, x, y);
  if (!beside) return std::nullopt;
  const Eigen::Vector3d eye = cameraPose().position;
  const auto hit = firstHit(places, parts_->result->sheet->mesh.triangles, eye, *beside - eye);
  return hit ? std::optional(hit->triangle) : std::nullopt;
}

std::string macroCaption(const scene::MacroResult& result) {
  std::string text = result.provenance.study + ":  " + std::to_string(result.sheet->mesh.triangles.size()) +
                     " triangles,  stretch up to " + numberText(result.state.stretchGauge.maxCoeff()) +
                     " of its limits";
  if (result.state.bendingGauge.size() > 0 && result.state.bendingGauge.maxCoeff() > 0)
    text += ",  bending up to " + numberText(result.state.bendingGauge.maxCoeff());
  if (result.deflections.cols() > 0) {
    double largest = 0;
    for (Eigen::Index i = 0; i < result.deflections.cols(); ++i)
      largest = std::max(largest, result.deflections.col(i).norm());
    text += "\nloads moved by up to " + millimetres(largest);
  }
  if (result.placed) {
    const auto& [detail, before, check] = *result.placed;
    text += "\n" + std::to_string(detail.elements.size()) + " elements,  " + std::to_string(check.links) + " links" +
            (check.lostLinks + check.newLinks == 0 ? " as at rest" : ", NOT as at rest") + ",  none nearer than " +
            numberText(1e6 * check.smallestDistance) + " µm,  at most " + millimetres(detail.pulls.maxCoeff()) +
            " off the sheet";
  }
  if (result.isMotion() && !result.steps.empty())
    text += "\n" + std::to_string(result.steps.size()) + " steps to " +
            base::formatQuantity(result.steps.back().time, base::dimensions::time);
  if (result.native)
    text += std::string(result.deflections.cols() > 0 ? ",  " : "\n") + "elements " +
            millimetres(result.native->meanDistance) + " off the sheet (at most " +
            millimetres(result.native->largestDistance) + ")";
  return text;
}

Image drawMacro(const std::shared_ptr<const scene::MacroResult>& result, const PictureOptions& options,
                std::optional<double> time, bool elements) {
  OffscreenTarget target;
  target.setSize(options.width, options.height);
  MacroView view;
  view.attach(target.window());
  view.setResult(result);
  view.setElementsVisible(elements);
  if (time && !result->frames.empty()) {
    const auto later = [&](const auto& a, const auto& b) {
      return std::abs(a->time - *time) < std::abs(b->time - *time);
    };
    const auto nearest = std::min_element(result->frames.begin(), result->frames.end(), later);
    view.setFrame(static_cast<int>(nearest - result->frames.begin()));
  }
  view.setTheme(options.theme);
  view.setCaption(options.caption);
  view.setAxisView(options.view);
  Image image;
  target.render(image);
  return image;
}

}  // namespace pliant::render
