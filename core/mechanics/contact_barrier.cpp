#include "core/mechanics/contact_barrier.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/base/error.hpp"
#include "core/geometry/continuous_collision.hpp"
#include "core/geometry/triangle_intersection.hpp"
#include "core/math/parallel.hpp"
#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

namespace {

using Eigen::Matrix3Xd;
using geometry::SimplexPair;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int pairsOfChunk = 512;
/// Pairs that use up less of their gap in a step are not followed.
constexpr double keptAside = 0.8;

/// What body(i, items) appends for i = 0 .. count-1, in that order.
template <class Item, class Body>
std::vector<Item> gatherInChunks(std::size_t count, const Body& body) {
  const int chunks = static_cast<int>((count + pairsOfChunk - 1) / pairsOfChunk);
  std::vector<std::vector<Item>> parts(chunks);
  math::parallelFor(chunks, [&](int chunk) {
    const std::size_t begin = std::size_t(chunk) * pairsOfChunk, end = std::min(count, begin + pairsOfChunk);
    for (std::size_t i = begin; i < end; ++i) body(i, parts[chunk]);
  });
  std::size_t size = 0;
  for (const auto& part : parts) size += part.size();
  std::vector<Item> items;
  items.reserve(size);
  for (auto& part : parts) items.insert(items.end(), part.begin(), part.end());
  return items;
}

/// body(i) for i = 0 .. count-1, in any order.
template <class Body>
void forEachInChunks(std::size_t count, const Body& body) {
  const int chunks = static_cast<int>((count + pairsOfChunk - 1) / pairsOfChunk);
  math::parallelFor(chunks, [&](int chunk) {
    const std::size_t begin = std::size_t(chunk) * pairsOfChunk, end = std::min(count, begin + pairsOfChunk);
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// The smallest of limit and body(i, smallest so far); only the result depends on no order if body does so.
template <class Body>
double smallestInChunks(std::size_t count, double limit, const Body& body) {
  const int chunks = static_cast<int>((count + pairsOfChunk - 1) / pairsOfChunk);
  std::vector<double> smallest(chunks, limit);
  math::parallelFor(chunks, [&](int chunk) {
    const std::size_t begin = std::size_t(chunk) * pairsOfChunk, end = std::min(count, begin + pairsOfChunk);
    for (std::size_t i = begin; i < end; ++i) smallest[chunk] = std::min(smallest[chunk], body(i, smallest[chunk]));
  });
  for (const double value : smallest) limit = std::min(limit, value);
  return limit;
}

}  // namespace

ContactBarrier::ContactBarrier(ContactGeometry geometry, Matrix3Xd restPositions, const ContactOptions& options)
    : primitives_(std::move(geometry)), restPositions_(std::move(restPositions)), options_(options) {
  requirePositive(options_.range, "the range of contact");
  requirePositive(options_.stiffness, "the stiffness of contact");
  requireNotNegative(options_.separation, "the separation of surfaces");
  if (restPositions_.cols() != primitives_.geometry().nodeCount())
    throw base::InputError("", "there are " + std::to_string(restPositions_.cols()) + " positions, but " +
                                   std::to_string(primitives_.geometry().nodeCount()) + " nodes that may touch");
  if (!restPositions_.allFinite()) throw base::InputError("", "a position of a node that may touch is not finite");
}

geometry::Corners ContactBarrier::cornersOf(const ContactPair& pair, const Matrix3Xd& x) const {
  geometry::Corners corners = geometry::Corners::Zero();
  for (int i = 0; i < geometry::cornerCount(pair.kind); ++i) corners.col(i) = x.col(pair.nodes[i]);
  return corners;
}

double ContactBarrier::gapOf(const ContactPair& pair, const geometry::ClosestPoints& closest) const {
  return std::sqrt(closest.squaredDistance) - primitives_.radiiOf(pair) - options_.separation;
}

void ContactBarrier::requireFree(const Matrix3Xd& x) const {
  const ContactGeometry& geometry = primitives_.geometry();
  for (const auto& [edge, triangle] : geometry::findIntersections(x, geometry.triangles, geometry.edges)) {
    if (geometry.bodies[edge[0]] != 0 && geometry.bodies[triangle[0]] != 0) continue;
    ContactPair pair{SimplexPair::pointTriangle, {0, triangle[0], triangle[1], triangle[2]}};
    const std::string both = nameOf(pair);
    throw base::InputError("", "the edge between nodes " + std::to_string(edge[0]) + " and " + std::to_string(edge[1]) +
                                   " crosses" + both.substr(both.find(" and ") + 4) +
                                   ", but surfaces must be apart at the start");
  }
  for (const ContactPair& pair : primitives_.nearPairs(x, x, options_.separation)) {
    const auto closest = geometry::closestPoints(pair.kind, cornersOf(pair, x));
    if (gapOf(pair, closest) > 0) continue;
    std::ostringstream sentence;
    sentence << nameOf(pair) << " are " << std::sqrt(closest.squaredDistance)
             << " m apart at the start, but their radii "
             << "and the separation need more than " << primitives_.radiiOf(pair) + options_.separation << " m";
    throw base::InputError("", sentence.str());
  }
}

double ContactBarrier::reachOf(const ContactPair& pair, const Eigen::VectorXd& distances) {
  double first = 0, second = 0;
  for (int i = 0; i < geometry::cornerCount(pair.kind); ++i) {
    double& own = i < geometry::firstCornerCount(pair.kind) ? first : second;
    own = std::max(own, distances[pair.nodes[i]]);
  }
  return first + second;
}

void ContactBarrier::findCandidates(const Matrix3Xd& x) {
  assert(x.cols() == restPositions_.cols());
  // Found with a margin, they stay valid until two nodes together have moved farther than that.
  const double margin = options_.range;
  if (candidatesAt_.cols() == x.cols() && (x - candidatesAt_).colwise().norm().maxCoeff() <= 0.5 * margin) return;
  std::vector<ContactPair> pairs = primitives_.nearPairs(x, x, options_.separation + options_.range + margin);
  // So that sums do not depend on where the candidates were found.
  std::sort(pairs.begin(), pairs.end());
  candidates_.resize(pairs.size());
  forEachInChunks(pairs.size(), [&](std::size_t i) {
    const double gap = gapOf(pairs[i], geometry::closestPoints(pairs[i].kind, cornersOf(pairs[i], x)));
    candidates_[i] = {pairs[i], gap, gap};
  });
  candidatesAt_ = x;
}

void ContactBarrier::update(const Matrix3Xd& x) {
  active_.clear();
  finite_ = x.allFinite();
  updatedAt_ = x;
  if (!finite_ || x.cols() == 0) return;
  findCandidates(x);
  const Eigen::VectorXd moved = (x - candidatesAt_).colwise().norm();
  active_ = gatherInChunks<ActivePair>(candidates_.size(), [&](std::size_t i, std::vector<ActivePair>& active) {
    auto& [pair, gapWhereFound, least] = candidates_[i];
    least = gapWhereFound - reachOf(pair, moved);
    if (least >= options_.range) return;
    const geometry::Corners corners = cornersOf(pair, x);
    const auto closest = geometry::closestPoints(pair.kind, corners);
    const double gap = least = gapOf(pair, closest);
    if (!(gap < options_.range)) return;
    const bool edges = pair.kind == SimplexPair::edgeEdge;
    const double scale = edges ? geometry::edgeMollifierScale(cornersOf(pair, restPositions_)) : 0;
    active.push_back({pair, {corners, closest, gap, options_.stiffness, options_.range, scale}});
  });
}

double ContactBarrier::value() const {
  double sum = finite_ ? 0 : infinity;
  for (const ActivePair& active : active_) sum += active.element.gap > 0 ? active.element.value() : infinity;
  return sum;
}

void ContactBarrier::addGradient(Matrix3Xd& gradient) const {
  for (const auto& [pair, element] : active_) {
    if (!(element.gap > 0)) continue;
    const geometry::CornerVector corners = element.gradient();
    for (int i = 0; i < geometry::cornerCount(pair.kind); ++i)
      if (pair.nodes[i] < primitives_.deformableCount()) gradient.col(pair.nodes[i]) += corners.segment<3>(3 * i);
  }
}

void ContactBarrier::addHessian(std::vector<ContactBlock>& blocks, double convexity) const {
  const auto added = gatherInChunks<ContactBlock>(active_.size(), [&](std::size_t k, std::vector<ContactBlock>& part) {
    const auto& [pair, element] = active_[k];
    if (!(element.gap > 0)) return;
    const geometry::CornerMatrix hessian = element.hessian(convexity);
    for (int i = 0; i < geometry::cornerCount(pair.kind); ++i)
      for (int j = 0; j < geometry::cornerCount(pair.kind); ++j) {
        const int row = pair.nodes[i], column = pair.nodes[j];
        if (row < column || row >= primitives_.deformableCount()) continue;
        const Eigen::Matrix3d entry = hessian.block<3, 3>(3 * i, 3 * j);
        if (!entry.isZero(0)) part.push_back({row, column, entry});  // corners outside the region have none
      }
  });
  blocks.insert(blocks.end(), added.begin(), added.end());
}

std::vector<std::array<int, 2>> ContactBarrier::coupledNodes(double margin) const {
  std::vector<std::array<int, 2>> couples;
  for (const auto& [pair, gapWhereFound, gap] : candidates_) {
    if (gap >= options_.range + margin) continue;
    for (int i = 0; i < geometry::cornerCount(pair.kind); ++i)
      for (int j = 0; j < i; ++j)
        if (std::max(pair.nodes[i], pair.nodes[j]) < primitives_.deformableCount())
          couples.push_back({pair.nodes[i], pair.nodes[j]});
  }
  return couples;
}

std::vector<Contact> ContactBarrier::contacts() const {
  std::vector<Contact> contacts;
  contacts.reserve(active_.size());
  for (const auto& [pair, element] : active_) {
    const Eigen::Vector3d sum = element.corners * element.closest.weights.cwiseAbs();
    const bool apart = element.gap > 0;
    contacts.push_back({pair, element.gap, apart ? element.force() : Eigen::Vector3d(0, 0, 0), 0.5 * sum});
  }
  return contacts;
}

double ContactBarrier::largestStep(const Matrix3Xd& x, const Matrix3Xd& dx) const {
  assert(x.cols() == restPositions_.cols() && dx.cols() == x.cols());
  if (!x.allFinite() || !dx.allFinite()) return 0;
  const auto fractionOf = [&](const ContactPair& pair, double smallest) {
    return geometry::safeFraction(pair.kind, cornersOf(pair, x), cornersOf(pair, dx),
                                  primitives_.radiiOf(pair) + options_.separation, smallest, 0.1 * options_.range);
  };
  // Whatever is no candidate has a gap of twice the range at least where these were found.
  const auto farthest = [&](const Matrix3Xd& at) { return (at - candidatesAt_).colwise().norm().maxCoeff(); };
  const bool updatedHere = x.cols() > 0 && updatedAt_.cols() == x.cols() && updatedAt_ == x;
  if (!updatedHere || farthest(x + dx) > options_.range) {
    const auto pairs = primitives_.nearPairs(x, x + dx, options_.separation);
    return smallestInChunks(
        pairs.size(), 1, [&](std::size_t i, double smallest) { return fractionOf(pairs[i], smallest); });
  }
  const Eigen::VectorXd steps = dx.colwise().norm();
  return smallestInChunks(candidates_.size(), 1, [&](std::size_t i, double smallest) {
    const auto& [pair, gapWhereFound, gap] = candidates_[i];
    return reachOf(pair, steps) < keptAside * gap ? 1.0 : fractionOf(pair, smallest);
  });
}

double ContactBarrier::smallestGap(const Matrix3Xd& x) const {
  assert(x.cols() == restPositions_.cols());
  if (!x.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  if (x.cols() == 0) return infinity;
  const double extent = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  // A gap that was found tells how far to look for one that is smaller.
  for (double reach = options_.range;; reach *= 4) {
    const auto pairs = primitives_.nearPairs(x, x, options_.separation + reach);
    const double smallest = smallestInChunks(pairs.size(), infinity, [&](std::size_t i, double) {
      return gapOf(pairs[i], geometry::closestPoints(pairs[i].kind, cornersOf(pairs[i], x)));
    });
    if (smallest <= reach || reach > extent) return smallest;
    if (smallest < infinity) reach = 0.25 * smallest * (1 + 1e-12);
  }
}

}  // namespace pliant::mechanics
