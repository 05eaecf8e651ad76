#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/scene/boundary_surface.hpp"
#include "ui/render/view.hpp"

namespace pliant::render {

/// How a boundary is shown.
struct BoundaryStyle {
  std::string quantity = "distance";  ///< that colours the surface; one that it does not have: none
  double opacity = 1;
  bool shadows = true;           ///< its projections on the walls
  bool states = false;           ///< a dot at each limit
  std::optional<int> sliceAxis;  ///< cut by the plane where this coordinate is `slicePosition`
  double slicePosition = 0;      ///< coordinate
};

/// Boundaries as in thesis Fig. 4.4: the surface of limits in its coordinates, of Green strain or of curvature, in a
/// box with scales, its shadows on three walls, the rest state, a slice, and another boundary over it. Where no limit
/// is known yet the surface is grey.
class BoundaryView final : public View {
 public:
  BoundaryView();
  ~BoundaryView() override;

  /// Null: an empty view.
  void setSurface(std::shared_ptr<const scene::BoundarySurface> surface);
  /// Drawn transparent over the first, in one colour; null: none.
  void setCompared(std::shared_ptr<const scene::BoundarySurface> surface);
  void setStyle(const BoundaryStyle& style);
  const BoundaryStyle& style() const;
  /// Greys the surface: inputs have changed since.
  void setStale(bool stale);
  /// Marks limits: the one that is examined, and the one under the pointer.
  void setSelected(std::optional<int> state);
  void setHovered(std::optional<int> state);
  std::optional<int> selected() const;
  /// Dots in the space, such as those of the triangles of a sheet, and one of them with a ring.
  void setInside(const Eigen::Matrix3Xd& places, std::optional<int> ringed);

  /// The range of a coordinate that both surfaces and the rest state take; (0, 0) of none.
  std::array<double, 2> range(int axis) const;
  /// Where a limit is seen, in pixels from the top left.
  std::optional<Eigen::Vector2d> pixelOf(int state) const;
  /// The known limit next to where the surface is hit by what is seen at this pixel; beside the surface none, whatever
  /// the radius.
  std::optional<int> pickNode(double x, double y, double radius) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
