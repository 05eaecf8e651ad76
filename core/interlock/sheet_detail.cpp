#include "core/interlock/sheet_detail.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/interlock/detail_search.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double mostDetailElements = 1e6;

/// The bounding box of the sheet in the material, as a polygon whose middle is where patchInside puts the origin of the
/// material.
Eigen::Matrix2Xd boxAround(const geometry::SurfaceMesh& sheet, const Eigen::Rotation2Dd& toMaterial,
                           const Vector2d& centre) {
  Eigen::Matrix2Xd corners = (toMaterial.toRotationMatrix() * sheet.points.topRows<2>()).colwise() + centre;
  const Vector2d half = corners.cwiseAbs().rowwise().maxCoeff() * (1 + 1e-6);
  return rectangleOutline(2 * half[0], 2 * half[1]);
}

}  // namespace

SheetDetailer::SheetDetailer(const UnitCell& cell, geometry::SurfaceMesh sheet, double angle, const Vector2d& centre,
                             const DetailOptions& options, const DetailMaterials& materials)
    : cell_(cell), options_(options), shape_(std::move(sheet)), radius_(std::numeric_limits<double>::infinity()) {
  if (!cell.isPeriodic()) throw base::InputError("", "The elements of a sheet are those of a material that repeats.");
  for (const ElementShape& shape : cell.shapes) {
    double& smallest = radii_.emplace_back(std::numeric_limits<double>::infinity());
    for (const DilatedPiece& piece : shape.pieces) smallest = std::min(smallest, piece.radius);
    if (!(smallest > 0))
      throw base::InputError("", "Elements with pieces that have no radius cannot be placed on a sheet.");
    radius_ = std::min(radius_, smallest);
    parts_.emplace_back(shape, 0.262);
  }
  const Eigen::Rotation2Dd toSheet(angle);
  const CellState rest = restState(cell);
  const double area = std::abs(cell.lattice.determinant());
  const Vector2d extent =
      shape_.mesh().points.topRows<2>().rowwise().maxCoeff() - shape_.mesh().points.topRows<2>().rowwise().minCoeff();
  if (extent.prod() / area * static_cast<double>(cell.elements.size()) > mostDetailElements)
    throw base::InputError("", "The sheet would have more than a million elements.");
  const FabricPatch all = patchInside(cell, rest, boxAround(shape_.mesh(), toSheet.inverse(), centre));
  const int elementsOfMaterial = static_cast<int>(cell.elements.size()) / materials.count;
  std::vector<PatchElement> inside;
  for (const PatchElement& element : all.elements) {
    const Vector2d place = toSheet * Vector2d(placeOf(cell, rest, element).head<2>() - centre);
    const std::optional<SheetShape::Place> at = shape_.placeOf(place);
    if (!at) continue;
    const int material =
        materials.ofTriangle.empty() ? 0 : materials.ofTriangle[static_cast<std::size_t>(at->triangle)];
    if (element.element / elementsOfMaterial == material) inside.push_back(element);
  }
  if (inside.empty()) throw base::InputError("", "No element of the material is in the sheet.");
  const FabricPatch patch = linkedPatch(cell, std::move(inside));
  elements_ = patch.elements;
  leftOut_ = patch.leftOut;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = toSheet.toRotationMatrix();
  for (const PatchElement& element : elements_) {
    const Vector3d place = placeOf(cell, rest, element);
    places_.push_back(*shape_.placeOf(toSheet * Vector2d(place.head<2>() - centre)));
    heights_.push_back(place.z());
    turned_.push_back(turn * rest.rotations[static_cast<std::size_t>(element.element)]);
  }
}

SheetDetail SheetDetailer::follow(const std::vector<Eigen::Matrix3Xd>& path, base::ExecutionContext& context) const {
  if (path.empty()) throw base::InputError("", "A path of the sheet needs a start.");
  for (const Eigen::Matrix3Xd& positions : path)
    if (positions.cols() != shape_.mesh().points.cols() || !positions.allFinite())
      throw base::InputError("", "A place on the path of the sheet is not one of this sheet.");
  return DetailSearch(*this, path).run(context);
}

}  // namespace pliant::interlock
