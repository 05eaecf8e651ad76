#include "ui/render/cell_patch.hpp"

#include <Eigen/LU>
#include <cstdlib>
#include <utility>

namespace pliant::render {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {
constexpr std::size_t mostElements = 700;  // that are drawn
}

void CellPatch::setCell(std::shared_ptr<const interlock::UnitCell> cell) {
  cell_ = std::move(cell);
  if (!cell_) return;
  state_ = interlock::restState(*cell_);
  neighbours_ = 9 * cell_->elements.size() > mostElements ? 0 : 1;
}

Vector3d CellPatch::translation(const std::array<int, 2>& shift) const {
  Vector3d moved = Vector3d::Zero();
  moved.head<2>() = interlock::stretchOf(state_.strain) * cell_->lattice * Vector2d(shift[0], shift[1]);
  return moved;
}

Vector3d CellPatch::placeOf(int element, const std::array<int, 2>& shift, const Vector3d& arm) const {
  return state_.positions.col(element) + state_.rotations[static_cast<std::size_t>(element)] * arm + translation(shift);
}

std::vector<CellPick> CellPatch::handles() const {
  std::vector<CellPick> places;
  if (!cell_) return places;
  // The middle of the cell's elements, seen from the first, which stays.
  const interlock::CellState rest = interlock::restState(*cell_);
  const Vector3d middle = rest.positions.rowwise().mean() - rest.positions.col(0);
  const Vector2d begin = cell_->lattice.inverse() * middle.head<2>();
  const double half = neighbours_ + 0.5;
  for (const auto& [i, j] : {std::pair{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}) {
    CellPick handle;
    handle.handle = true;
    handle.grip.shift = begin + half * Vector2d(i, j);
    handle.place = state_.positions.col(0);
    handle.place.head<2>() += interlock::stretchOf(state_.strain) * cell_->lattice * handle.grip.shift;
    places.push_back(handle);
  }
  return places;
}

double CellPatch::extent() const {
  const std::vector<CellPick> all = handles();
  return all.empty() ? 1 : (all[4].place - all[0].place).norm();
}

std::vector<Vector3d> CellPatch::places(const std::vector<interlock::LiveContact>& contacts) const {
  std::vector<Vector3d> all;
  if (!cell_) return all;
  for (const interlock::LiveContact& contact : contacts)
    for (int i = -neighbours_; i <= neighbours_; ++i)
      for (int j = -neighbours_; j <= neighbours_; ++j)
        if (std::abs(i + contact.shift[0]) <= neighbours_ && std::abs(j + contact.shift[1]) <= neighbours_)
          all.push_back(contact.place + translation({i, j}));
  return all;
}

}  // namespace pliant::render
