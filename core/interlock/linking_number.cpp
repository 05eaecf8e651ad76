#include "core/interlock/linking_number.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/interlock/handle_cycles.hpp"

namespace pliant::interlock {

namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

Matrix3Xd polygonInWire(const ClosedCurve& curve, double radius) {
  // A chord over the parameter h strays by at most h²/8 |c''|; a fifth of the radius keeps it inside.
  const double step = std::sqrt(8 * 0.2 * radius / curve.secondDerivativeBound());
  const int count = std::max(8, static_cast<int>(std::ceil(2 * std::numbers::pi / step)));
  Matrix3Xd corners(3, count);
  for (int i = 0; i < count; ++i) corners.col(i) = curve.placeAt(2 * std::numbers::pi * i / count);
  return corners;
}

/// The loops that the segments of a closed set form.
std::vector<Matrix3Xd> loopsOf(const SimplexSet& set) {
  std::map<int, std::vector<int>> neighbours;
  for (const auto& [from, to] : set.segments) {
    neighbours[from].push_back(to);
    neighbours[to].push_back(from);
  }
  std::vector<Matrix3Xd> loops;
  std::map<int, bool> seen;
  for (const auto& [from, to] : set.segments) {
    std::vector<int> chain;
    for (int before = from, at = from, next = to; !seen[at];) {
      seen[at] = true;
      chain.push_back(at);
      if (chain.size() > 1) next = neighbours[at][0] == before ? neighbours[at][1] : neighbours[at][0];
      before = at;
      at = next;
    }
    if (chain.empty()) continue;
    Matrix3Xd corners(3, static_cast<Eigen::Index>(chain.size()));
    for (std::size_t i = 0; i < chain.size(); ++i)
      corners.col(static_cast<Eigen::Index>(i)) = set.corners.col(chain[i]);
    loops.push_back(corners);
  }
  return loops;
}

Ball ballAround(const Matrix3Xd& corners) {
  const Vector3d centre = corners.rowwise().mean();
  return {centre, (corners.colwise() - centre).colwise().norm().maxCoeff()};
}

/// Signed crossings of each polygon over the other, seen along the third axis; nothing if rounding could decide. A
/// crossing counts 1 if the lower strand goes to the left of the upper one, else -1.
std::optional<std::array<int, 2>> crossings(const Matrix3Xd& a, const Matrix3Xd& b) {
  const double tiny = 1e-12 * (a.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff());
  const auto area = [](const Vector3d& p, const Vector3d& q, const Vector3d& r) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  std::array<int, 2> over{};
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    const Vector3d p = a.col(i), q = a.col((i + 1) % a.cols());
    const double tinyArea = tiny * (q - p).norm();
    for (Eigen::Index j = 0; j < b.cols(); ++j) {
      const Vector3d r = b.col(j), s = b.col((j + 1) % b.cols());
      if (std::max(r[0], s[0]) < std::min(p[0], q[0]) || std::max(p[0], q[0]) < std::min(r[0], s[0])) continue;
      if (std::max(r[1], s[1]) < std::min(p[1], q[1]) || std::max(p[1], q[1]) < std::min(r[1], s[1])) continue;
      const double pqr = area(p, q, r), pqs = area(p, q, s), rsp = area(r, s, p), rsq = area(r, s, q);
      const double small = tinyArea + tiny * (s - r).norm();
      // A zero area matters only where the other polygon's segment comes as far.
      const bool apart = (pqr > small && pqs > small) || (pqr < -small && pqs < -small) ||
                         (rsp > small && rsq > small) || (rsp < -small && rsq < -small);
      if (apart) continue;
      if (std::min({std::abs(pqr), std::abs(pqs), std::abs(rsp), std::abs(rsq)}) <= small) return std::nullopt;
      const double heightA = p[2] + rsp / (rsp - rsq) * (q[2] - p[2]);
      const double heightB = r[2] + pqr / (pqr - pqs) * (s[2] - r[2]);
      if (std::abs(heightA - heightB) <= tiny) return std::nullopt;
      const bool aOver = heightA > heightB;
      const int turn = pqs > pqr ? 1 : -1;  // whether b goes to the left of a
      over[aOver ? 0 : 1] += aOver ? turn : -turn;
    }
  }
  return over;
}

}  // namespace

std::optional<int> linkingNumber(const Matrix3Xd& first, const Matrix3Xd& second) {
  for (int attempt = 0; attempt < 8; ++attempt) {
    // Directions without any relation to those of regular structures.
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(0.531 + 0.117 * attempt, 0.413, -0.287 - 0.171 * attempt, 0.679).normalized();
    const Eigen::Matrix3d rotation = turn.toRotationMatrix();
    const auto over = crossings(rotation * first, rotation * second);
    if (!over) continue;
    if ((*over)[0] != (*over)[1]) return std::nullopt;
    return (*over)[0];
  }
  return std::nullopt;
}

std::vector<ElementLoop> loopsOfShape(const ElementShape& shape) {
  std::vector<ElementLoop> loops;
  for (std::size_t i = 0; i < shape.pieces.size(); ++i) {
    const auto& [core, radius] = shape.pieces[i];
    std::vector<Cycle> cycles;
    if (const auto* curve = std::get_if<ClosedCurve>(&core))
      cycles = {{polygonInWire(*curve, radius)}};
    else if (isClosedMesh(shape.pieces[i]))
      cycles = handleCycles({std::get<SimplexSet>(core).corners, std::get<SimplexSet>(core).triangles, {}, {}});
    else if (std::get<SimplexSet>(core).closed)
      cycles = {loopsOf(std::get<SimplexSet>(core))};
    for (std::size_t handle = 0; handle < cycles.size(); ++handle)
      for (const Matrix3Xd& polygon : cycles[handle])
        loops.push_back({static_cast<int>(i), static_cast<int>(handle), polygon, ballAround(polygon)});
  }
  return loops;
}

LinkFinder::LinkFinder(const CellContact& contact) : contact_(contact) {
  for (const ElementShape& shape : contact.cell().shapes) loops_.push_back(loopsOfShape(shape));
}

std::optional<std::vector<Link>> LinkFinder::linksAt(const CellState& state) const {
  std::map<Link, int> numbers;
  const auto& elements = contact_.cell().elements;
  for (const auto& [a, b, shift] : contact_.nearElements(state, 0)) {
    const Vector3d offset = contact_.offsetOf(state, a, b, shift);
    for (const ElementLoop& loopA : loops_[elements[a].shape])
      for (const ElementLoop& loopB : loops_[elements[b].shape]) {
        const Vector3d between =
            state.rotations[a] * loopA.ball.centre + offset - state.rotations[b] * loopB.ball.centre;
        if (between.norm() > loopA.ball.radius + loopB.ball.radius) continue;
        const Matrix3Xd polygonA = (state.rotations[a] * loopA.corners).colwise() + offset;
        const auto number = linkingNumber(polygonA, state.rotations[b] * loopB.corners);
        if (!number) return std::nullopt;
        if (*number != 0)
          numbers[canonical({a, loopA.piece, b, loopB.piece, shift, 0, loopA.handle, loopB.handle})] += *number;
      }
  }
  std::vector<Link> links;
  for (const auto& [place, number] : numbers) {
    if (number == 0) continue;
    links.push_back(place);
    links.back().number = number;
  }
  return links;
}

}  // namespace pliant::interlock
