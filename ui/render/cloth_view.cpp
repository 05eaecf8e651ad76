#include "ui/render/cloth_view.hpp"

#include <vtkMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <limits>
#include <set>

#include "core/cloth/limit_envelope.hpp"
#include "ui/render/body_figure.hpp"
#include "ui/render/bounds.hpp"
#include "ui/render/color_map.hpp"
#include "ui/render/figure.hpp"
#include "ui/render/ring.hpp"
#include "ui/render/stage.hpp"

namespace pliant::render {
namespace {

constexpr double pinSize = 0.008, handSize = 0.012;      // of the model's extent
constexpr double flatness = 0.6;                         // of one horizontal extent by the other
constexpr double turnedAside = 0.12, tiltedDown = 0.06;  // of half a turn
constexpr std::size_t mostDirections = 400;
constexpr double violationShown = 0.02;  // of the range below the limit: less is not worth another scale

/// The stretch over limit of a triangle at rest that is nearest to its limit least: where the colours begin.
double ratioAtRest(const cloth::LimitedSheet& sheet) {
  double largest = 1;
  for (const cloth::StretchLimit& limit : sheet.limits) largest = std::max(largest, cloth::largestStretch(limit));
  return 1 / largest;
}

}  // namespace

struct ClothView::Parts {
  Stage& stage;
  vtkNew<vtkLookupTable> table;
  SheetPrimitive sheet;
  Figure figure{Figure::Kind::solved};  ///< all but the sheet
  BodyFigure bodies;
  LinePrimitive directions{1.5};
  MarkerPrimitive pins{MarkerPrimitive::Shape::cube};
  MarkerPrimitive handMarkers{MarkerPrimitive::Shape::sphere};
  LinePrimitive handLines{2.0};
  Ring selectionRing;

  std::shared_ptr<const cloth::ClothProblem> problem;
  std::vector<std::shared_ptr<const scene::ClothFrame>> frames;
  int frame = -1;
  FigureLayout layout;
  Bounds bounds;
  double mostRatio = 0, mostForce = 0;
  bool upIsY = false;
  bool stale = false;
  bool directionsVisible = false;
  ClothField field = ClothField::stretchRatio;
  std::optional<int> selected;
  Points positions;
  std::vector<Hand> hands;

  explicit Parts(Stage& around) : stage(around) {
    vtkRenderer* renderer = stage.renderer();
    renderer->AddActor(sheet.actor());
    figure.addTo(renderer);
    bodies.addTo(renderer);
    renderer->AddActor(directions.actor());
    renderer->AddActor(pins.actor());
    renderer->AddActor(handMarkers.actor());
    renderer->AddActor(handLines.actor());
    selectionRing.addTo(renderer);
    directions.actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -6);
    stage.legend().setTable(table);
    stage.onLayOut = [this] {
      selectionRing.setPlace(problem && selected ? stage.camera().pixelOf(positions.col(*selected)) : std::nullopt);
    };
    stage.onTheme = [this] { applyTheme(); };
    stage.onPixelRatio = [this] {
      figure.setPixelRatio(stage.pixelRatio());
      directions.setPixelRatio(stage.pixelRatio());
      handLines.setPixelRatio(stage.pixelRatio());
      selectionRing.setPixelRatio(stage.pixelRatio());
    };
    stage.onField = [this] { showField(); };
    showProblem();
    stage.setTheme(Theme::light);
  }

  const scene::ClothFrame* shownFrame() const {
    return frame >= 0 && frame < static_cast<int>(frames.size()) ? frames[static_cast<std::size_t>(frame)].get()
                                                                 : nullptr;
  }

  void applyTheme() {
    const Palette& colors = stage.colors();
    const auto shown = [this](const Color& color) { return stale ? faded(color) : color; };
    figure.setTheme(colors, stale);
    setColor(sheet.actor(), shown(colors.rest));
    bodies.setColor(shown(colors.spring));
    setColor(directions.actor(), {0.95, 0.95, 0.95});  // on viridis, in every theme
    setColor(pins.actor(), shown(colors.driven));
    for (vtkActor* actor : {handMarkers.actor(), handLines.actor()}) setColor(actor, colors.prediction);
    selectionRing.setColors(colors.text, colors.background);
    stage.setNotice(stale && shownFrame() ? "inputs have changed since this was solved" : "", colors.text);
    showField();
  }

  void showProblem() {
    layout = FigureLayout();
    std::vector<std::array<int, 3>> triangles;
    if (problem) {
      layout = FigureLayout(*problem->model);
      std::set<std::array<int, 3>> ofSheet;
      const auto sorted = [](std::array<int, 3> nodes) {
        std::sort(nodes.begin(), nodes.end());
        return nodes;
      };
      for (const cloth::SheetTriangle& triangle : problem->sheet.triangles) {
        triangles.push_back(triangle.nodes);
        ofSheet.insert(sorted(triangle.nodes));
      }
      std::erase_if(layout.triangles, [&](const auto& nodes) { return ofSheet.contains(sorted(nodes)); });
    }
    sheet.setTopology(triangles);
    figure.setLayout(layout);
    bodies.setBodies(problem ? problem->bodies : std::vector<cloth::Body>());
    bounds = Bounds();
    mostRatio = mostForce = 0;
    if (problem) {
      bounds.add(layout.rest);
      for (const cloth::Body& body : problem->bodies) bounds.add(body.points);
      figure.setMassRadii(layout, layout.massRadii(*problem->model));
      const mechanics::Vector& gravity = problem->model->gravity;
      upIsY = gravity.size() == 3 && -gravity[1] > std::abs(gravity[2]);
      stage.camera().setUpAxis(upIsY);
    }
    stage.camera().setReach(bounds.corners());
    showFrame();
  }

  void addFrame(const scene::ClothFrame& added) {
    bounds.add(added.positions);
    bounds.add(added.bodyPoints);
    if (added.stretchRatios.size() > 0) mostRatio = std::max(mostRatio, added.stretchRatios.maxCoeff());
    if (added.limitForces.size() > 0) mostForce = std::max(mostForce, added.limitForces.maxCoeff());
  }

  void showFrame() {
    figure.setVisible(problem != nullptr);
    sheet.actor()->SetVisibility(problem != nullptr);
    if (!problem) {
      positions.resize(3, 0);
      showField();
      return;
    }
    const scene::ClothFrame* shown = shownFrame();
    positions = shown ? shown->positions : layout.rest;
    mechanics::Vector coordinates = problem->model->restPositions;
    coordinates.head(positions.size()) = positions.reshaped();
    sheet.setPoints(positions);
    figure.setPose(layout.pose(coordinates));
    showPins(shown ? shown->time : 0);
    showHands();
    Points bodyPoints(3, 0);
    for (const cloth::Body& body : problem->bodies) {
      bodyPoints.conservativeResize(3, bodyPoints.cols() + body.points.cols());
      bodyPoints.rightCols(body.points.cols()) = body.points;
    }
    bodies.setPoints(shown && shown->bodyPoints.cols() == bodyPoints.cols() ? shown->bodyPoints : bodyPoints);
    showDirections();
    showField();
  }

  void showPins(double time) {
    std::vector<int> nodes;
    for (const cloth::Pin& pin : problem->pins)
      if (!pin.release || time < *pin.release) nodes.insert(nodes.end(), pin.nodes.begin(), pin.nodes.end());
    pins.setNodes(nodes, std::vector<double>(nodes.size(), pinSize * layout.size));
    pins.setPoints(positions);
  }

  void showHands() {
    std::vector<int> nodes;
    std::vector<std::array<int, 2>> lines;
    std::erase_if(hands, [this](const Hand& hand) { return hand.node < 0 || hand.node >= positions.cols(); });
    Points ends(3, 2 * static_cast<Eigen::Index>(hands.size()));
    for (const Hand& hand : hands) {
      const auto first = 2 * static_cast<int>(nodes.size());
      ends.col(first) = positions.col(hand.node);
      ends.col(first + 1) = hand.place;
      lines.push_back({first, first + 1});
      nodes.push_back(hand.node);
    }
    handMarkers.setNodes(nodes, std::vector<double>(nodes.size(), handSize * layout.size));
    handMarkers.setPoints(positions);
    vtkNew<vtkPoints> points;
    for (const auto& end : ends.colwise()) points->InsertNextPoint(end.data());
    handLines.setPoints(points);
    handLines.setTopology(lines);
  }

  void showDirections() {
    directions.actor()->SetVisibility(problem && directionsVisible);
    if (!problem || !directionsVisible) return;
    const auto& triangles = problem->sheet.triangles;
    const std::size_t stride = std::max<std::size_t>(1, triangles.size() / mostDirections);
    std::vector<Points> lines;
    for (std::size_t i = 0; i < triangles.size(); i += stride) {
      const cloth::SheetTriangle& triangle = triangles[i];
      Eigen::Vector3d along = Eigen::Vector3d::Zero(), middle = along;  // the first column of F
      double smallest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < 3; ++k) {
        along += positions.col(triangle.nodes[k]) * triangle.gradients[k][0];
        middle += positions.col(triangle.nodes[k]) / 3;
        const auto next = triangle.nodes[(k + 1) % 3];
        smallest = std::min(smallest, (positions.col(next) - positions.col(triangle.nodes[k])).norm());
      }
      const double half = 0.35 * smallest * std::sqrt(static_cast<double>(stride));
      Points line(3, 2);
      line << middle - half * along, middle + half * along;
      lines.push_back(std::move(line));
    }
    directions.setClosedCurves(lines, 0);
  }

  void showField() {
    const scene::ClothFrame* shown = shownFrame();
    const bool ratio = field == ClothField::stretchRatio;
    const Eigen::VectorXd* values = !shown ? nullptr : ratio ? &shown->stretchRatios : &shown->limitForces;
    const bool visible = values && stage.fieldVisible() && problem && !problem->sheet.limits.empty() &&
                         values->size() == static_cast<Eigen::Index>(problem->sheet.triangles.size());
    double low = 0, high = std::max(mostForce, 1e-300);
    if (ratio && problem) {
      low = ratioAtRest(problem->sheet);
      high = mostRatio > 1 + violationShown * (1 - low) ? mostRatio : 1;
      if (low > high - 1e-9) low = high - 1e-3;
    }
    setViridis(table, low, high, stale);
    Legend& legend = stage.legend();
    if (ratio)
      legend.setQuantity("stretch / limit\n1: at the limit", Legend::Scale::plain, "");
    else
      legend.setQuantity("limit force", Legend::Scale::plain, "J s²");
    legend.setRange(low, high);
    stage.setLegendVisible(visible);
    sheet.setField(visible ? values : nullptr, table);
  }
};

ClothView::ClothView() : parts_(std::make_unique<Parts>(stage())) {}

ClothView::~ClothView() { attach(nullptr); }

void ClothView::setProblem(std::shared_ptr<const cloth::ClothProblem> problem) {
  Parts& p = *parts_;
  if (p.problem == problem) return;
  p.problem = std::move(problem);
  p.frames.clear();
  p.frame = -1;
  p.selected.reset();
  p.stale = false;
  p.hands.clear();
  p.showProblem();
  p.applyTheme();
}

void ClothView::setFrames(std::vector<std::shared_ptr<const scene::ClothFrame>> frames) {
  Parts& p = *parts_;
  const bool grows = frames.size() >= p.frames.size() && std::equal(p.frames.begin(), p.frames.end(), frames.begin());
  std::size_t known = p.frames.size();
  const auto* before = p.shownFrame();
  p.frames = std::move(frames);
  if (!grows) {
    known = 0;
    p.mostRatio = p.mostForce = 0;
  }
  for (std::size_t i = known; i < p.frames.size(); ++i) p.addFrame(*p.frames[i]);
  p.stage.camera().setReach(p.bounds.corners());
  if (p.frame >= static_cast<int>(p.frames.size())) p.frame = static_cast<int>(p.frames.size()) - 1;
  if (p.shownFrame() != before)
    p.showFrame();
  else
    p.showField();
}

void ClothView::setFrame(int frame) {
  Parts& p = *parts_;
  if (frame < -1 || frame >= static_cast<int>(p.frames.size()) || frame == p.frame) return;
  p.frame = frame;
  p.showFrame();
}

void ClothView::faceFrame() {
  Parts& p = *parts_;
  Bounds shown;
  shown.add(p.positions);
  if (const scene::ClothFrame* frame = p.shownFrame()) shown.add(frame->bodyPoints);
  p.stage.camera().setReach(shown.corners());
  const Eigen::Vector3d extent = shown.high - shown.low;
  const double acrossX = extent.x(), acrossOther = p.upIsY ? extent.z() : extent.y();
  const bool broadAlongX = acrossOther < flatness * acrossX, broadAcrossX = acrossX < flatness * acrossOther;
  if (!broadAlongX && !broadAcrossX) {
    p.stage.camera().setAxisView(AxisView::isometric);
    return;
  }
  p.stage.camera().setAxisView(broadAcrossX ? AxisView::right : AxisView::front);
  p.stage.camera().orbit(turnedAside, tiltedDown);
  p.stage.camera().fit();
}

int ClothView::frame() const { return parts_->frame; }

void ClothView::setStale(bool stale) {
  if (parts_->stale == stale) return;
  parts_->stale = stale;
  parts_->applyTheme();
}

void ClothView::setField(ClothField field) {
  parts_->field = field;
  parts_->showField();
}

ClothField ClothView::field() const { return parts_->field; }

bool ClothView::directionsVisible() const { return parts_->directionsVisible; }

void ClothView::setDirectionsVisible(bool visible) {
  parts_->directionsVisible = visible;
  parts_->showDirections();
}

void ClothView::setSelectedNode(std::optional<int> node) {
  Parts& p = *parts_;
  if (node && (!p.problem || *node < 0 || *node >= p.positions.cols())) node.reset();
  p.selected = node;
}

std::optional<int> ClothView::selectedNode() const { return parts_->selected; }

void ClothView::setHands(std::vector<Hand> hands) {
  parts_->hands = std::move(hands);
  parts_->showHands();
}

Eigen::Vector3d ClothView::nodePosition(int node) const { return parts_->positions.col(node); }

std::optional<Eigen::Vector3d> ClothView::pointBeside(const Eigen::Vector3d& point, double x, double y) const {
  return stage().camera().pointBeside(point, x, y);
}

std::optional<int> ClothView::pickNode(double x, double y, double radius) const {
  if (!parts_->problem) return std::nullopt;
  return stage().camera().nearestPoint(parts_->positions, x, y, radius);
}

}  // namespace pliant::render
