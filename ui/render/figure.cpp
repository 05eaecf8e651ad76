#include "ui/render/figure.hpp"

#include <vtkMapper.h>
#include <vtkProperty.h>

#include "ui/render/color_map.hpp"

namespace pliant::render {
namespace {

// Sizes as fractions of the model's extent.
constexpr double drivenSize = 0.005, fixedSize = 0.006;
constexpr double hatchPeriod = 8;  // device-independent pixels

}  // namespace

Figure::Figure(Kind kind)
    : kind_(kind), outline_(kind == Kind::ghost ? 2.0 : 1.5), links_(kind == Kind::ghost ? 2.5 : 4.0), coils_(1.5) {
  surface_.setPoints(points_);
  outline_.setPoints(points_);
  links_.setPoints(points_);
  coils_.setPoints(points_);
  // Lines win over the surface that they lie on, and the ghost over the solved surface where the two coincide.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  for (LinePrimitive* lines : {&outline_, &links_, &coils_})
    lines->actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -4);
  if (kind == Kind::ghost) {
    surface_.actor()->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(-1, -2);
  } else {
    surface_.actor()->GetProperty()->EdgeVisibilityOn();
  }
  setPixelRatio(1.0);
}

std::vector<vtkActor*> Figure::actors() {
  if (kind_ == Kind::ghost)
    return {links_.actor(), coils_.actor(), surface_.actor(), outline_.actor(), masses_.actor()};
  return {surface_.actor(), outline_.actor(), links_.actor(), coils_.actor(),
          masses_.actor(),  driven_.actor(),  fixed_.actor()};
}

void Figure::addTo(vtkRenderer* renderer) {
  for (vtkActor* actor : actors()) renderer->AddActor(actor);
}

void Figure::setLayout(const FigureLayout& layout) {
  surface_.setTopology(layout.triangles);
  outline_.setTopology(layout.outline);
  links_.setTopology(layout.links);
  coils_.setTopology(layout.coils);
  const auto same = [](std::size_t count, double radius) { return std::vector<double>(count, radius); };
  driven_.setNodes(layout.drivenNodes, same(layout.drivenNodes.size(), drivenSize * layout.size));
  fixed_.setNodes(layout.fixedPoints, same(layout.fixedPoints.size(), fixedSize * layout.size));
}

void Figure::setMassRadii(const FigureLayout& layout, const std::vector<double>& radii) {
  masses_.setNodes(layout.massNodes, radii);
}

void Figure::setPose(const Points& pose) {
  points_->SetNumberOfPoints(pose.cols());
  for (Eigen::Index i = 0; i < pose.cols(); ++i) points_->SetPoint(i, pose.col(i).data());
  points_->Modified();
  for (MarkerPrimitive* markers : {&masses_, &driven_, &fixed_}) markers->setPoints(pose);
}

void Figure::setVisible(bool visible) {
  for (vtkActor* actor : actors()) actor->SetVisibility(visible);
}

void Figure::setTheme(const Palette& palette, bool stale) {
  const auto shown = [stale](const Color& color) { return stale ? faded(color) : color; };
  if (kind_ == Kind::ghost) {
    for (vtkActor* actor : actors()) setColor(actor, palette.prediction);
    return;
  }
  setColor(surface_.actor(), shown(palette.rest));
  surface_.actor()->GetProperty()->SetEdgeColor(palette.edge[0], palette.edge[1], palette.edge[2]);
  setColor(outline_.actor(), palette.outline);
  setColor(links_.actor(), shown(palette.link));
  setColor(coils_.actor(), shown(palette.spring));
  setColor(masses_.actor(), shown(palette.mass));
  setColor(driven_.actor(), shown(palette.driven));
  setColor(fixed_.actor(), palette.spring);
}

void Figure::setPixelRatio(double ratio) {
  outline_.setPixelRatio(ratio);
  links_.setPixelRatio(ratio);
  coils_.setPixelRatio(ratio);
  surface_.actor()->GetProperty()->SetLineWidth(static_cast<float>(ratio));
  if (kind_ == Kind::ghost)
    for (vtkActor* actor : {surface_.actor(), masses_.actor()}) setHatched(actor, hatchPeriod * ratio);
}

}  // namespace pliant::render
