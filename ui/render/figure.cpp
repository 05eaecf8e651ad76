#include "ui/render/figure.hpp"

#include <vtkMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/surface_mesh.hpp"
#include "core/mechanics/mechanism.hpp"
#include "ui/render/color_map.hpp"

namespace pliant::render {
namespace {

// Sizes as fractions of the model's extent.
constexpr double largestMass = 0.024, smallestMass = 0.008, drivenSize = 0.005, fixedSize = 0.006;
constexpr double hatchPeriod = 8;  // device-independent pixels

/// Σ of the point masses on each node [kg].
std::vector<double> nodeMasses(const mechanics::Model& model, double (*massOf)(const mechanics::PointMass&)) {
  std::vector<double> masses(model.nodeCount(), 0.0);
  for (const mechanics::PointMass& mass : model.pointMasses)
    for (const int node : mass.nodes) masses[node] += massOf(mass);
  return masses;
}

double extentOf(const Points& points) {
  return points.cols() > 0 ? (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm() : 0.0;
}

double presentMass(const mechanics::PointMass& mass) { return mass.mass; }

double largestMassOf(const mechanics::PointMass& mass) {
  return std::isfinite(mass.maximum) ? std::max(mass.mass, mass.maximum) : mass.mass;
}

}  // namespace

FigureLayout::FigureLayout(const mechanics::Model& model)
    : dimension(model.dimension), rest(toPoints(model.restPositions, model.nodeCount(), model.dimension)) {
  std::vector<mechanics::Tether> tethers;
  for (const mechanics::DisplayPart& part : model.parts) {
    triangles.insert(triangles.end(), part.triangles.begin(), part.triangles.end());
    springs.insert(springs.end(), part.segments.begin(), part.segments.end());
    for (const mechanics::Tether& tether : part.tethers) tethers.push_back(tether);
  }
  for (const geometry::MeshEdge& edge : geometry::meshEdges(triangles))
    if (edge.triangles[0] < 0 || edge.triangles[1] < 0) outline.push_back(edge.nodes);

  const int nodes = model.nodeCount();
  for (int node = 0; node < nodes; ++node) {
    bool locked = !model.lockedCoordinates.empty();
    for (int axis = 0; locked && axis < dimension; ++axis) locked = model.lockedCoordinates[node * dimension + axis];
    if (locked) fixedPoints.push_back(node);
  }
  anchors.resize(3, static_cast<Eigen::Index>(tethers.size()));
  for (std::size_t i = 0; i < tethers.size(); ++i) {
    const int fixedEnd = nodes + static_cast<int>(i);
    anchors.col(static_cast<Eigen::Index>(i)) = toPoints(tethers[i].anchor, 1, dimension);
    springs.push_back({tethers[i].node, fixedEnd});
    fixedPoints.push_back(fixedEnd);
  }
  for (const mechanics::DisplayPart& part : model.parts)
    for (const auto& ends : part.attachedSprings) {
      const int first = nodes + static_cast<int>(tethers.size() + attachments.size());
      attachments.insert(attachments.end(), ends.begin(), ends.end());
      springs.push_back({first, first + 1});
    }
  const Points atRest = pose(model.restPositions);
  restExtent_ = extentOf(atRest);
  setReach(atRest);
  drivenNodes = model.drivenNodes();
  for (const mechanics::PointMass& mass : model.pointMasses)
    massNodes.insert(massNodes.end(), mass.nodes.begin(), mass.nodes.end());
  std::sort(massNodes.begin(), massNodes.end());
  massNodes.erase(std::unique(massNodes.begin(), massNodes.end()), massNodes.end());
  for (const mechanics::Probe& probe : model.probes) probeNodes.push_back(probe.node);

  const std::vector<double> largest = nodeMasses(model, largestMassOf);
  if (!largest.empty()) referenceMass_ = std::max(*std::max_element(largest.begin(), largest.end()), 1e-300);
}

void FigureLayout::setReach(const Points& reach) {
  const double extent = restExtent_ > 0 ? restExtent_ : 2.0 * extentOf(reach);
  size = extent > 0 ? extent : 1.0;
}

Points FigureLayout::pose(const Eigen::VectorXd& positions) const {
  const Eigen::Index attached = rest.cols() + anchors.cols();
  Points result(3, attached + static_cast<Eigen::Index>(attachments.size()));
  result.leftCols(attached) << toPoints(positions, static_cast<int>(rest.cols()), dimension), anchors;
  for (std::size_t i = 0; i < attachments.size(); ++i)
    result.col(attached + static_cast<Eigen::Index>(i)) =
        toPoints(mechanics::positionOf(attachments[i], dimension, positions), 1, dimension);
  return result;
}

std::vector<double> FigureLayout::massRadii(const mechanics::Model& model) const {
  const std::vector<double> masses = nodeMasses(model, presentMass);
  std::vector<double> radii;
  for (const int node : massNodes)
    radii.push_back(size * std::max(smallestMass, largestMass * std::cbrt(masses[node] / referenceMass_)));
  return radii;
}

Figure::Figure(Kind kind)
    : kind_(kind), outline_(kind == Kind::ghost ? 2.0 : 1.5), springs_(kind == Kind::ghost ? 1.5 : 2.0) {
  surface_.setPoints(points_);
  outline_.setPoints(points_);
  springs_.setPoints(points_);
  // Lines win over the surface that they lie on, and the ghost over the solved surface where the two coincide.
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  for (LinePrimitive* lines : {&outline_, &springs_})
    lines->actor()->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -4);
  if (kind == Kind::ghost) {
    surface_.actor()->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(-1, -2);
  } else {
    surface_.actor()->GetProperty()->EdgeVisibilityOn();
  }
  setPixelRatio(1.0);
}

std::vector<vtkActor*> Figure::actors() {
  if (kind_ == Kind::ghost) return {springs_.actor(), surface_.actor(), outline_.actor(), masses_.actor()};
  return {surface_.actor(), outline_.actor(), springs_.actor(), masses_.actor(), driven_.actor(), fixed_.actor()};
}

void Figure::addTo(vtkRenderer* renderer) {
  for (vtkActor* actor : actors()) renderer->AddActor(actor);
}

void Figure::setLayout(const FigureLayout& layout) {
  surface_.setTopology(layout.triangles);
  outline_.setTopology(layout.outline);
  springs_.setTopology(layout.springs);
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
  setColor(springs_.actor(), shown(palette.spring));
  setColor(masses_.actor(), shown(palette.mass));
  setColor(driven_.actor(), shown(palette.driven));
  setColor(fixed_.actor(), palette.spring);
}

void Figure::setPixelRatio(double ratio) {
  outline_.setPixelRatio(ratio);
  springs_.setPixelRatio(ratio);
  surface_.actor()->GetProperty()->SetLineWidth(static_cast<float>(ratio));
  if (kind_ == Kind::ghost)
    for (vtkActor* actor : {surface_.actor(), masses_.actor()}) setHatched(actor, hatchPeriod * ratio);
}

}  // namespace pliant::render
