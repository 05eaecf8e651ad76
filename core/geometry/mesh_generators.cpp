#include "core/geometry/mesh_generators.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "core/base/error.hpp"

namespace pliant::geometry {

namespace {

constexpr double largestCellCount = 2e6;

void requireLength(double value, const std::string& what) {
  if (std::isfinite(value) && value > 0) return;
  std::ostringstream sentence;
  sentence << what << " must be a finite length above 0, but is " << value;
  throw base::InputError("", sentence.str());
}

void requireCells(int count, const std::string& what) {
  if (count < 1) throw base::InputError("", what + " must be at least 1, but is " + std::to_string(count));
}

void requireFewCells(double count) {
  if (count > largestCellCount)
    throw base::InputError("", "a generated mesh may have at most 2 million cells, but " +
                                   std::to_string(static_cast<long long>(count)) + " are asked for");
}

/// Part of an infinite lattice: cells of two triangles with alternating diagonals, points made where cells need them.
class LatticeMesh {
 public:
  /// `place(i, j)` is the position of lattice point (i, j).
  explicit LatticeMesh(std::function<Eigen::Vector3d(int, int)> place) : place_(std::move(place)) {}

  int node(int i, int j) {
    const auto [found, isNew] = nodes_.try_emplace({i, j}, static_cast<int>(nodes_.size()));
    if (isNew) points_.push_back(place_(i, j));
    return found->second;
  }

  void addCells(int iBegin, int iEnd, int jBegin, int jEnd) {
    for (int i = iBegin; i < iEnd; ++i)
      for (int j = jBegin; j < jEnd; ++j) {
        const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
        if ((i + j) % 2 == 0)
          triangles_.insert(triangles_.end(), {{a, b, c}, {a, c, d}});
        else
          triangles_.insert(triangles_.end(), {{a, b, d}, {b, c, d}});
      }
  }

  std::vector<int> column(int i, int jBegin, int jEnd) {
    std::vector<int> group;
    for (int j = jBegin; j <= jEnd; ++j) group.push_back(node(i, j));
    return group;
  }

  std::vector<int> row(int j, int iBegin, int iEnd) {
    std::vector<int> group;
    for (int i = iBegin; i <= iEnd; ++i) group.push_back(node(i, j));
    return group;
  }

  SurfaceMesh finish(std::map<std::string, std::vector<int>> groups) const {
    SurfaceMesh mesh;
    mesh.points.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t n = 0; n < points_.size(); ++n) mesh.points.col(static_cast<Eigen::Index>(n)) = points_[n];
    mesh.triangles = triangles_;
    mesh.groups = std::move(groups);
    return mesh;
  }

 private:
  std::function<Eigen::Vector3d(int, int)> place_;
  std::map<std::pair<int, int>, int> nodes_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 3>> triangles_;
};

/// Where the lattice lines j = 0 .. lines-1 of the fork's upper half (y > 0) cross a lattice column; counted from the
/// middle of the fork. `inner` cells reach from the middle to y = `middle`, `outer` cells from there to y = `edge`.
double placeLine(double j, double inner, double middle, double outer, double edge) {
  return j <= inner ? middle * j / inner : middle + (edge - middle) * (j - inner) / outer;
}

}  // namespace

SurfaceMesh makeGrid(double length, double width, int lengthCells, int widthCells) {
  requireLength(length, "the length");
  requireLength(width, "the width");
  requireCells(lengthCells, "the number of cells along the length");
  requireCells(widthCells, "the number of cells along the width");
  requireFewCells(static_cast<double>(lengthCells) * widthCells);
  LatticeMesh lattice([&](int i, int j) {
    return Eigen::Vector3d(
        length * (static_cast<double>(i) / lengthCells), width * (static_cast<double>(j) / widthCells - 0.5), 0);
  });
  lattice.addCells(0, lengthCells, 0, widthCells);
  return lattice.finish({{"start", lattice.column(0, 0, widthCells)},
                         {"end", lattice.column(lengthCells, 0, widthCells)},
                         {"right", lattice.row(0, 0, lengthCells)},
                         {"left", lattice.row(widthCells, 0, lengthCells)}});
}

SurfaceMesh makeStrip(double length, double width, int lengthCells, int widthCells) {
  SurfaceMesh mesh = makeGrid(length, width, lengthCells, widthCells);
  mesh.groups.erase("left");
  mesh.groups.erase("right");
  return mesh;
}

SurfaceMesh makeFork(const ForkShape& shape) {
  requireLength(shape.handleLength, "the handle's length");
  requireLength(shape.prongLength, "the prongs' length");
  requireLength(shape.width, "the fork's width");
  requireLength(shape.spacing, "the prongs' spacing");
  requireCells(shape.handleCells, "the number of cells along the handle");
  requireCells(shape.prongCells, "the number of cells along a prong");
  requireCells(shape.widthCells, "the number of cells along the fork's width");

  const int widthCells = shape.widthCells;
  const double cell = shape.width / widthCells;
  const double gap = shape.spacing - shape.width;
  // The handle leaves the middle of the crossbar's lattice, so the gap has as many cells as the width, or an even
  // number more or less.
  const int parity = widthCells % 2;
  const double wanted = std::clamp((gap / cell - parity) / 2, 0.0, 1e6);
  const int gapCells = std::max(2 * static_cast<int>(std::lround(wanted)) + parity, 2 - parity);
  if (gap < 0.5 * cell * gapCells)
    throw base::InputError("", "the prongs' spacing must leave a gap of at least half a cell for each of the " +
                                   std::to_string(gapCells) + " cells between the prongs");
  requireFewCells(static_cast<double>(widthCells) *
                  (shape.handleCells + 2.0 * shape.prongCells + 2.0 * widthCells + gapCells));

  const int lines = 2 * widthCells + gapCells;  // cells across the crossbar
  const int handleBegin = (lines - widthCells) / 2;
  const int barBegin = shape.handleCells, barEnd = barBegin + widthCells, tip = barEnd + shape.prongCells;
  const double edge = 0.5 * (shape.spacing + shape.width);
  LatticeMesh lattice([&](int i, int j) {
    const double fromMiddle = j - 0.5 * lines, side = fromMiddle < 0 ? -1 : 1, distance = std::abs(fromMiddle);
    const double atHandle = placeLine(distance, 0.5 * widthCells, 0.5 * shape.width, 0.5 * (lines - widthCells), edge);
    const double atProngs = placeLine(distance, 0.5 * gapCells, 0.5 * gap, widthCells, edge);
    const double acrossBar = std::clamp(static_cast<double>(i - barBegin) / widthCells, 0.0, 1.0);
    const double x = i <= barBegin ? shape.handleLength * i / shape.handleCells
                     : i <= barEnd
                         ? shape.handleLength + cell * (i - barBegin)
                         : shape.handleLength + shape.width + shape.prongLength * (i - barEnd) / shape.prongCells;
    return Eigen::Vector3d(x, side * ((1 - acrossBar) * atHandle + acrossBar * atProngs), 0);
  });
  lattice.addCells(0, barBegin, handleBegin, handleBegin + widthCells);
  lattice.addCells(barBegin, barEnd, 0, lines);
  lattice.addCells(barEnd, tip, 0, widthCells);
  lattice.addCells(barEnd, tip, lines - widthCells, lines);
  return lattice.finish({{"base", lattice.column(0, handleBegin, handleBegin + widthCells)},
                         {"right_tip", lattice.column(tip, 0, widthCells)},
                         {"left_tip", lattice.column(tip, lines - widthCells, lines)}});
}

}  // namespace pliant::geometry
