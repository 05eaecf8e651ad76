#include "ui/render/macro_view.hpp"

#include <cmath>

#include "ui/render/boundary_geometry.hpp"
#include "ui/render/macro_view_parts.hpp"

namespace pliant::render {

MacroView::MacroView() : parts_(std::make_unique<Parts>(stage())) {}

MacroView::~MacroView() { attach(nullptr); }

void MacroView::setResult(std::shared_ptr<const scene::MacroResult> result) {
  Parts& p = *parts_;
  if (result == p.result) return;
  const bool grows = p.result && result && result->sheet == p.result->sheet && p.frame >= 0;
  p.result = std::move(result);
  const int last = p.result ? static_cast<int>(p.result->frames.size()) - 1 : -1;
  p.frame = grows ? std::min(p.frame, last) : last;
  p.show();
  p.applyTheme();
}

const std::shared_ptr<const scene::MacroResult>& MacroView::result() const { return parts_->result; }

void MacroView::setField(MacroField field) {
  parts_->field = field;
  parts_->showField();
}

MacroField MacroView::field() const { return parts_->field; }

void MacroView::setFrame(int frame) {
  Parts& p = *parts_;
  if (!p.result || frame < 0 || frame >= static_cast<int>(p.result->frames.size()) || frame == p.frame) return;
  p.frame = frame;
  p.showFrame();
}

int MacroView::frame() const { return parts_->frame; }

geometry::SurfaceMesh MacroView::mesh() const {
  geometry::SurfaceMesh mesh = parts_->result->sheet->mesh;
  mesh.points = parts_->positions();
  return mesh;
}

void MacroView::setElementsVisible(bool visible) {
  parts_->wantsElements = visible;
  parts_->show();
  parts_->applyTheme();
}

void MacroView::setNativeVisible(bool visible) {
  if (visible == parts_->wantsNative) return;
  parts_->wantsNative = visible;
  parts_->show();
  parts_->applyTheme();
}

bool MacroView::nativeVisible() const { return parts_->half != nullptr; }

bool MacroView::elementsVisible() const { return parts_->showsElements(); }

void MacroView::setStale(bool stale) {
  if (parts_->stale == stale) return;
  parts_->stale = stale;
  parts_->applyTheme();
}

void MacroView::setPicks(Picks picks) { parts_->picks = picks; }

Eigen::Matrix2Xd MacroView::trianglePixels() const {
  const Parts& p = *parts_;
  if (!p.isVisible()) return {2, 0};
  const Points places = p.positions();
  const auto& triangles = p.drawn->mesh.triangles;
  const double height = p.stage.renderer()->GetSize()[1];
  Eigen::Matrix2Xd pixels(2, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto pixel = stage().camera().pixelOf(places(Eigen::all, triangles[t]).rowwise().mean());
    pixels.col(static_cast<Eigen::Index>(t)) =
        pixel ? Eigen::Vector2d(pixel->x(), height - pixel->y()) : Eigen::Vector2d::Constant(std::nan(""));
  }
  return pixels;
}

void MacroView::setMaterials(std::vector<int> materials, std::vector<std::string> names) {
  if (materials.empty() && parts_->materials.empty()) return;
  parts_->materials = std::move(materials);
  parts_->materialNames = std::move(names);
  parts_->show();
  parts_->applyTheme();
}

void MacroView::setSelectedTriangle(std::optional<int> triangle) { parts_->selected = triangle; }

std::optional<int> MacroView::selectedTriangle() const { return parts_->selected; }

std::optional<int> MacroView::pickNode(double x, double y, double radius) const {
  const Parts& p = *parts_;
  if (p.picks == Picks::triangles) return triangleAt(x, y);
  if (!p.isVisible() || x >= p.stage.renderer()->GetSize()[0]) return std::nullopt;
  return stage().camera().nearestPoint(p.positions(), x, y, radius);
}

std::optional<int> MacroView::triangleAt(double x, double y) const {
  const Parts& p = *parts_;
  if (!p.isVisible() || x >= p.stage.renderer()->GetSize()[0]) return std::nullopt;  // among elements beside it
  const auto beside = stage().camera().pointBeside(cameraPose().focus, x, y);
  if (!beside) return std::nullopt;
  const Eigen::Vector3d eye = cameraPose().position;
  const auto hit = firstHit(p.positions(), p.result->sheet->mesh.triangles, eye, *beside - eye);
  return hit ? std::optional(hit->triangle) : std::nullopt;
}

}  // namespace pliant::render
