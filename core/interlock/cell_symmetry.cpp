#include "core/interlock/cell_symmetry.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace pliant::interlock {

namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Of directions that count as one: far more than rounding, far less than the distance of neighbours.
constexpr double directionTolerance = 1e-7;

double distanceTo(const ClosedCurve& curve, const Vector3d& place) {
  constexpr int samples = 96;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < samples; ++i) {
    const double t = 2 * std::numbers::pi * i / samples;
    if (const double d = (curve.placeAt(t) - place).squaredNorm(); d < least) least = d, best = t;
  }
  for (int i = 0; i < 20; ++i) {
    const ClosedCurve::Point point = curve.at(best);
    const Vector3d apart = point.place - place;
    const double slope = apart.dot(point.tangent);
    const double curvature = point.tangent.squaredNorm() + apart.dot(point.second);
    if (!(curvature > 0)) break;
    best -= slope / curvature;
  }
  return std::min(std::sqrt(least), (curve.placeAt(best) - place).norm());
}

/// Whether the second curve is the first one, mapped.
bool isImage(const Matrix3d& map, const ClosedCurve& first, const ClosedCurve& second, double tolerance) {
  constexpr int samples = 48;
  const Matrix3d back = map.transpose();
  for (int i = 0; i < samples; ++i) {
    const double t = 2 * std::numbers::pi * i / samples;
    if (distanceTo(second, map * first.placeAt(t)) > tolerance) return false;
    if (distanceTo(first, back * second.placeAt(t)) > tolerance) return false;
  }
  return true;
}

/// For each column of `first`, mapped, the column of `second` at the same place; none if any has none.
std::optional<std::vector<int>> matched(const Matrix3d& map, const Matrix3Xd& first, const Matrix3Xd& second,
                                        double tolerance) {
  if (first.cols() != second.cols()) return std::nullopt;
  std::vector<int> match(static_cast<std::size_t>(first.cols()));
  for (Eigen::Index i = 0; i < first.cols(); ++i) {
    Eigen::Index nearest = 0;
    const double square = (second.colwise() - Vector3d(map * first.col(i))).colwise().squaredNorm().minCoeff(&nearest);
    if (square > tolerance * tolerance) return std::nullopt;
    match[i] = static_cast<int>(nearest);
  }
  return match;
}

template <std::size_t N>
std::vector<std::array<int, N>> sortedCorners(std::vector<std::array<int, N>> simplices) {
  for (auto& corners : simplices) std::sort(corners.begin(), corners.end());
  std::sort(simplices.begin(), simplices.end());
  return simplices;
}

/// Edges that belong to one triangle alone, sorted.
std::vector<std::array<int, 2>> rimOf(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::array<int, 2>, int> count;
  for (const auto& [a, b, c] : triangles)
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}})
      ++count[{std::min(from, to), std::max(from, to)}];
  std::vector<std::array<int, 2>> rim;
  for (const auto& [edge, triangleCount] : count)
    if (triangleCount == 1) rim.push_back(edge);
  return rim;
}

/// Whether all corners lie in one plane.
bool isFlat(const Matrix3Xd& corners, double tolerance) {
  if (corners.cols() == 0) return true;
  const Matrix3Xd apart = corners.colwise() - corners.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(apart * apart.transpose());
  return (axes.eigenvectors().col(0).transpose() * apart).cwiseAbs().maxCoeff() <= tolerance;
}

bool isImage(const Matrix3d& map, const SimplexSet& first, const SimplexSet& second, double tolerance) {
  const auto match = matched(map, first.corners, second.corners, tolerance);
  if (!match) return false;
  const auto renamed = [&](auto simplices) {
    for (auto& corners : simplices)
      for (int& corner : corners) corner = (*match)[corner];
    return simplices;
  };
  std::vector<int> points = first.points, others = second.points;
  for (int& point : points) point = (*match)[point];
  std::sort(points.begin(), points.end());
  std::sort(others.begin(), others.end());
  if (points != others || sortedCorners(renamed(first.segments)) != sortedCorners(second.segments)) return false;
  // Of a flat polygon it does not matter how it is cut into triangles.
  if (isFlat(first.corners, tolerance) && isFlat(second.corners, tolerance))
    return rimOf(renamed(first.triangles)) == rimOf(second.triangles);
  return sortedCorners(renamed(first.triangles)) == sortedCorners(second.triangles);
}

bool isImage(const Matrix3d& map, const DilatedPiece& first, const DilatedPiece& second, double tolerance) {
  if (std::abs(first.radius - second.radius) > tolerance || first.core.index() != second.core.index()) return false;
  return std::visit(
      [&](const auto& core) {
        return isImage(map, core, std::get<std::decay_t<decltype(core)>>(second.core), tolerance);
      },
      first.core);
}

/// Whether the second shape is the first one, mapped.
bool isImage(const Matrix3d& map, const ElementShape& first, const ElementShape& second, double tolerance) {
  if (first.pieces.size() != second.pieces.size()) return false;
  std::vector<bool> taken(second.pieces.size());
  for (const DilatedPiece& piece : first.pieces) {
    std::size_t other = 0;
    while (other < taken.size() && (taken[other] || !isImage(map, piece, second.pieces[other], tolerance))) ++other;
    if (other == taken.size()) return false;
    taken[other] = true;
  }
  return true;
}

class SymmetrySearch {
 public:
  SymmetrySearch(const UnitCell& cell, double tolerance)
      : cell_(cell), tolerance_(tolerance * std::sqrt(std::abs(cell.lattice.determinant()))) {}

  std::optional<CellSymmetry> find(const Matrix3d& linear) const {
    // The first element comes to lie on one of the others, which tells the translation.
    for (const InterlockingElement& other : cell_.elements) {
      CellSymmetry symmetry{linear, other.position - linear * cell_.elements.front().position, {}};
      if (addImages(symmetry)) return symmetry;
    }
    return std::nullopt;
  }

 private:
  bool addImages(CellSymmetry& symmetry) const {
    for (const InterlockingElement& element : cell_.elements) {
      const auto image = imageOf(symmetry, element);
      if (!image) return false;
      symmetry.images.push_back(*image);
    }
    return true;
  }

  std::optional<CellSymmetry::Image> imageOf(const CellSymmetry& symmetry, const InterlockingElement& element) const {
    const Vector3d place = symmetry.linear * element.position + symmetry.offset;
    for (int other = 0; other < static_cast<int>(cell_.elements.size()); ++other) {
      const InterlockingElement& target = cell_.elements[other];
      const Vector3d apart = place - target.position;
      const Vector2d shift = (cell_.lattice.inverse() * apart.head<2>()).array().round();
      const Vector2d left = apart.head<2>() - cell_.lattice * shift;
      if (left.norm() > tolerance_ || std::abs(apart[2]) > tolerance_) continue;
      const Matrix3d shape = target.rotation.transpose() * symmetry.linear * element.rotation;
      if (isImage(shape, cell_.shapes[element.shape], cell_.shapes[target.shape], tolerance_))
        return CellSymmetry::Image{other, {static_cast<int>(shift[0]), static_cast<int>(shift[1])}, shape};
    }
    return std::nullopt;
  }

  const UnitCell& cell_;
  const double tolerance_;  ///< [m]
};

/// Finds directions by their place.
class DirectionFinder {
 public:
  explicit DirectionFinder(const SphereMesh& mesh) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.directions.size(); ++i) cells_[cellOf(mesh.directions[i])] = static_cast<int>(i);
  }
  /// -1: there is none.
  int find(const Vector3d& direction) const {
    const std::array<long, 3> middle = cellOf(direction);
    for (long x = -1; x <= 1; ++x)
      for (long y = -1; y <= 1; ++y)
        for (long z = -1; z <= 1; ++z) {
          const auto found = cells_.find({middle[0] + x, middle[1] + y, middle[2] + z});
          if (found != cells_.end() && (mesh_.directions[found->second] - direction).norm() < directionTolerance)
            return found->second;
        }
    return -1;
  }

 private:
  static std::array<long, 3> cellOf(const Vector3d& direction) {
    const auto number = [](double x) { return std::lround(x / directionTolerance); };
    return {number(direction[0]), number(direction[1]), number(direction[2])};
  }

  const SphereMesh& mesh_;
  std::map<std::array<long, 3>, int> cells_;
};

}  // namespace

Matrix3d CellSymmetry::strainMap() const {
  const Matrix2d q = linear.topLeftCorner<2, 2>();
  Matrix3d map;
  for (int i = 0; i < 3; ++i) {
    const Matrix2d image = q * stretchBasis()[i] * q.transpose();
    map.col(i) << 0.5 * (image(0, 0) + image(1, 1)), 0.5 * (image(0, 0) - image(1, 1)), image(0, 1);
  }
  return map;
}

CellState CellSymmetry::mapped(const UnitCell& cell, const CellState& state) const {
  CellState result = state;
  result.strain = strainMap() * state.strain;
  const Matrix2d lattice = stretchOf(result.strain) * cell.lattice;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image& image = images[i];
    Vector3d place = linear * state.positions.col(static_cast<Eigen::Index>(i)) + offset;
    place.head<2>() -= lattice * Vector2d(image.shift[0], image.shift[1]);
    result.positions.col(image.element) = place;
    result.rotations[image.element] = linear * state.rotations[i] * image.shape.transpose();
  }
  return result;
}

std::vector<CellSymmetry> symmetriesOf(const UnitCell& cell, double tolerance) {
  std::vector<CellSymmetry> symmetries;
  const SymmetrySearch search(cell, tolerance);
  // Any that maps the lattice to itself has whole numbers here, and with short lattice vectors these are small.
  const std::array<int, 3> numbers{1, 0, -1};
  for (const int a : numbers)
    for (const int b : numbers)
      for (const int c : numbers)
        for (const int d : numbers) {
          Matrix2d whole;
          whole << a, b, c, d;
          const Matrix2d q = cell.lattice * whole * cell.lattice.inverse();
          if (!(q * q.transpose()).isIdentity(tolerance)) continue;
          for (const double side : {1.0, -1.0}) {
            Matrix3d linear = Matrix3d::Identity() * side;
            linear.topLeftCorner<2, 2>() = q;
            if (auto symmetry = search.find(linear)) symmetries.push_back(std::move(*symmetry));
          }
        }
  const auto isIdentity = [](const CellSymmetry& symmetry) { return symmetry.linear.isIdentity(1e-9); };
  std::stable_partition(symmetries.begin(), symmetries.end(), isIdentity);
  return symmetries;
}

DirectionOrbits orbitsOf(const SphereMesh& mesh, const std::vector<CellSymmetry>& symmetries) {
  DirectionOrbits orbits;
  orbits.representative.assign(mesh.directions.size(), -1);
  orbits.symmetry.assign(mesh.directions.size(), 0);
  const DirectionFinder finder(mesh);
  std::vector<Matrix3d> maps;
  for (const CellSymmetry& symmetry : symmetries) maps.push_back(symmetry.strainMap());
  for (int i = 0; i < static_cast<int>(mesh.directions.size()); ++i) {
    if (orbits.representative[i] >= 0) continue;
    orbits.representative[i] = i;
    ++orbits.count;
    for (std::size_t k = 0; k < maps.size(); ++k) {
      const int image = finder.find(maps[k] * mesh.directions[i]);
      if (image < 0 || orbits.representative[image] >= 0) continue;
      orbits.representative[image] = i;
      orbits.symmetry[image] = static_cast<int>(k);
    }
  }
  return orbits;
}

SphereMesh symmetricIcosphere(int subdivisions, const std::vector<CellSymmetry>& symmetries) {
  // Strain maps turn about the first axis, by multiples of 180 or of 120 degrees, or reflect there. The icosahedron has
  // an axis of either kind, in planes of reflection.
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  const Matrix3d upright = Eigen::Quaterniond::FromTwoVectors(Vector3d(1, 1, 1), Vector3d::UnitX()).toRotationMatrix();
  // Normal of a plane of reflection through (1, 1, 1): it becomes the third axis.
  const Vector3d normal = upright * Vector3d(golden, -1, -1 / golden);
  const auto aboutFirst = [](double angle) { return Eigen::AngleAxisd(angle, Vector3d::UnitX()).toRotationMatrix(); };
  const Matrix3d aligned = aboutFirst(0.5 * std::numbers::pi - std::atan2(normal[2], normal[1])) * upright;
  Matrix3d best = Matrix3d::Identity();
  int fewest = std::numeric_limits<int>::max();
  for (const Matrix3d& turn :
       {Matrix3d(Matrix3d::Identity()), aligned, Matrix3d(aboutFirst(0.5 * std::numbers::pi) * aligned)}) {
    SphereMesh turned = icosphere(1);
    for (Vector3d& direction : turned.directions) direction = turn * direction;
    if (const int count = orbitsOf(turned, symmetries).count; count < fewest) fewest = count, best = turn;
  }
  SphereMesh mesh = icosphere(subdivisions);
  if (!best.isIdentity())
    for (Vector3d& direction : mesh.directions) direction = best * direction;
  return mesh;
}

}  // namespace pliant::interlock
