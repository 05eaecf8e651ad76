#include "core/geometry/wire_body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unsupported/Eigen/BVH>

#include "core/base/error.hpp"
#include "core/geometry/triangle_intersection.hpp"

namespace pliant::geometry {

namespace {

using Eigen::Vector3d;
using Tree = Eigen::KdBVH<double, 3, int>;

/// So often is a mesh that cuts itself made anew of smaller cells, and so often smoothed.
constexpr int mostAttempts = 4, mostSmoothings = 8;

Vector3d directionOf(const Vector3d& vector) {
  const double length = vector.norm();
  return length > 0 ? Vector3d(vector / length) : Vector3d::UnitX();
}

/// Pieces and the shells of sockets: each is all places within some distance of a core.
class WireBody {
 public:
  WireBody(const std::vector<WirePiece>& pieces, const std::vector<BallSocket>& sockets, double fillet)
      : pieces_(pieces), sockets_(sockets), fillet_(fillet) {
    std::vector<int> indices;
    for (int i = 0; i < static_cast<int>(pieces.size() + sockets.size()); ++i) {
      indices.push_back(i);
      boxes_.push_back(boxOf(i));
      box_.extend(boxes_.back());
    }
    box_ = {box_.min() - Vector3d::Constant(fillet), box_.max() + Vector3d::Constant(fillet)};
    tree_ = Tree(indices.begin(), indices.end(), boxes_.begin(), boxes_.end());
  }

  const Eigen::AlignedBox3d& box() const { return box_; }

  SurfacePlace at(const Vector3d& place) const {
    Nearest nearest{*this, place};
    const double least = Eigen::BVMinimize(tree_, nearest);
    Near near{*this, place, least + fillet_, {}};
    Eigen::BVIntersect(tree_, near);
    std::sort(near.strands.begin(), near.strands.end(),
              [](const Strand& a, const Strand& b) { return a.distance < b.distance; });
    double distance = near.strands.front().distance;
    Vector3d slope = near.strands.front().slope;
    for (std::size_t i = 1; i < near.strands.size(); ++i) {
      const double overlap = std::max(fillet_ - std::abs(near.strands[i].distance - distance), 0.0);
      const double share = 0.5 * overlap / fillet_;  // of the farther one
      const bool farther = near.strands[i].distance > distance;
      slope += (farther ? share : 1 - share) * (near.strands[i].slope - slope);
      distance = std::min(distance, near.strands[i].distance) - 0.25 * overlap * overlap / fillet_;
    }
    // By the slope, which is less than 1 where two are blended.
    SurfacePlace result{distance, place - distance / std::max(slope.squaredNorm(), 0.1) * slope};
    for (const BallSocket& socket : sockets_) {
      const Vector3d arm = place - socket.centre;
      if (const double depth = socket.radius - arm.norm(); depth > result.distance)
        result = {depth, socket.centre + socket.radius * directionOf(arm)};
    }
    return result;
  }

 private:
  /// The nearest of a strand's pieces.
  struct Strand {
    int strand;
    double distance;
    Vector3d slope;  ///< of the distance
  };

  /// To the box of a piece: less than to what it holds, unless the place is inside.
  static double boundOf(const Eigen::AlignedBox3d& box, const Vector3d& place) {
    const double distance = box.exteriorDistance(place);
    return distance > 0 ? distance : -std::numeric_limits<double>::infinity();
  }

  struct Nearest {
    using Scalar = double;
    const WireBody& body;
    const Vector3d& place;

    double minimumOnVolume(const Eigen::AlignedBox3d& box) const { return boundOf(box, place); }
    double minimumOnObject(int index) const {
      const auto& [between, radius] = body.fromCore(index, place);
      return between.norm() - radius;
    }
  };

  /// Strands not farther than `within`.
  struct Near {
    const WireBody& body;
    const Vector3d& place;
    double within;
    std::vector<Strand> strands;

    bool intersectVolume(const Eigen::AlignedBox3d& box) const { return boundOf(box, place) <= within; }
    bool intersectObject(int index) {
      const auto& [between, radius] = body.fromCore(index, place);
      const double distance = between.norm() - radius;
      if (distance > within) return false;
      const int strand = body.strandOf(index);
      const auto known =
          std::find_if(strands.begin(), strands.end(), [&](const Strand& s) { return s.strand == strand; });
      if (known == strands.end())
        strands.push_back({strand, distance, directionOf(between)});
      else if (distance < known->distance)
        *known = {strand, distance, directionOf(between)};
      return false;
    }
  };

  /// Each socket is one of its own.
  int strandOf(int index) const {
    const int count = static_cast<int>(pieces_.size());
    return index < count ? pieces_[index].strand : count - 1 - index;
  }

  /// From the nearest place of a core to `place`, and how far the body reaches from there.
  std::pair<Vector3d, double> fromCore(int index, const Vector3d& place) const {
    if (index < static_cast<int>(pieces_.size())) {
      const WirePiece& piece = pieces_[index];
      const Vector3d axis = directionOf(piece.to - piece.from), arm = place - piece.from;
      const double length = (piece.to - piece.from).norm();
      Vector3d nearest = std::clamp(arm.dot(axis), 0.0, length) * axis;
      if (piece.halfWidth > 0 || piece.halfHeight > 0) {
        const Vector3d across = axis.cross(piece.widthDirection);
        nearest += std::clamp(arm.dot(piece.widthDirection), -piece.halfWidth, piece.halfWidth) * piece.widthDirection;
        nearest += std::clamp(arm.dot(across), -piece.halfHeight, piece.halfHeight) * across;
      }
      return {arm - nearest, piece.rounding};
    }
    const BallSocket& socket = sockets_[index - pieces_.size()];
    const Vector3d arm = place - socket.centre;
    const double middle = socket.radius + 0.5 * socket.wall;
    const double along = arm.dot(socket.opening);
    Vector3d aside = arm - along * socket.opening;
    const double away = aside.norm();
    if (std::atan2(away, along) >= socketOpening) return {arm - middle * directionOf(arm), 0.5 * socket.wall};
    aside = away > 0 ? Vector3d(aside / away) : Vector3d(socket.opening.unitOrthogonal());
    const Vector3d rim = middle * (std::cos(socketOpening) * socket.opening + std::sin(socketOpening) * aside);
    return {arm - rim, 0.5 * socket.wall};
  }

  Eigen::AlignedBox3d boxOf(int index) const {
    Eigen::AlignedBox3d box;
    double reach = 0;
    if (index < static_cast<int>(pieces_.size())) {
      const WirePiece& piece = pieces_[index];
      reach = piece.rounding + std::hypot(piece.halfWidth, piece.halfHeight);
      box.extend(piece.from).extend(piece.to);
    } else {
      const BallSocket& socket = sockets_[index - pieces_.size()];
      reach = socket.radius + socket.wall;
      box.extend(socket.centre);
    }
    return {box.min() - Vector3d::Constant(reach), box.max() + Vector3d::Constant(reach)};
  }

  const std::vector<WirePiece>& pieces_;
  const std::vector<BallSocket>& sockets_;
  const double fillet_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  Eigen::AlignedBox3d box_;
  Tree tree_;
};

/// Where wires part at an acute angle their walls can be nearer than a cell, and their triangles get mixed up: points
/// there go towards the middle of their neighbours. Whether no triangles cross in the end.
bool untangle(SurfaceMesh& mesh) {
  std::vector<std::vector<int>> neighbours;
  for (int pass = 0; pass <= mostSmoothings; ++pass) {
    const auto crossings = findIntersections(mesh.points, mesh.triangles);
    if (crossings.empty()) return true;
    if (neighbours.empty()) {
      neighbours.resize(static_cast<std::size_t>(mesh.points.cols()));
      for (const auto& [a, b, c] : mesh.triangles)  // each neighbour once, since each edge has two triangles
        neighbours[a].push_back(b), neighbours[b].push_back(c), neighbours[c].push_back(a);
    }
    std::set<int> moved;
    for (const auto& [edge, triangle] : crossings) {
      moved.insert(edge.begin(), edge.end());
      moved.insert(triangle.begin(), triangle.end());
    }
    for (const int point : std::set<int>(moved)) moved.insert(neighbours[point].begin(), neighbours[point].end());
    const Eigen::Matrix3Xd before = mesh.points;
    for (const int point : moved) {
      Vector3d middle = Vector3d::Zero();
      for (const int other : neighbours[point]) middle += before.col(other);
      mesh.points.col(point) = 0.5 * (before.col(point) + middle / static_cast<double>(neighbours[point].size()));
    }
  }
  return false;
}

}  // namespace

void findStrands(std::vector<WirePiece>& pieces) {
  struct End {
    std::size_t piece;
    Vector3d away;  ///< from the place, unit
  };
  std::map<std::array<double, 3>, std::vector<End>> places;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    pieces[i].strand = static_cast<int>(i);
    const Vector3d from = pieces[i].from, to = pieces[i].to, along = (to - from).normalized();
    places[{from[0], from[1], from[2]}].push_back({i, along});
    places[{to[0], to[1], to[2]}].push_back({i, -along});
  }
  for (auto& [place, ends] : places)
    while (ends.size() > 1) {
      double straightest = 1;
      std::size_t first = 0, second = 0;
      for (std::size_t i = 0; i < ends.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          if (const double cosine = ends[i].away.dot(ends[j].away); cosine < straightest)
            straightest = cosine, first = i, second = j;
      if (straightest > -0.5) break;
      const int kept = pieces[ends[second].piece].strand, old = pieces[ends[first].piece].strand;
      for (WirePiece& piece : pieces)
        if (piece.strand == old) piece.strand = kept;
      ends.erase(ends.begin() + static_cast<std::ptrdiff_t>(first));
      ends.erase(ends.begin() + static_cast<std::ptrdiff_t>(second));
    }
}

Vector3d openDirection(const std::vector<WirePiece>& pieces, const Vector3d& centre, double radius) {
  std::vector<Vector3d> wires;  // where they pass the ball's surface
  for (const WirePiece& piece : pieces) {
    const Vector3d from = piece.from - centre, along = piece.to - piece.from;
    // |from + s along| = radius
    const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - radius * radius;
    const double root = b * b - a * c;
    if (root < 0) continue;
    for (const double s : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a})
      if (s >= 0 && s <= 1) wires.push_back((from + s * along).normalized());
  }
  // The farthest direction is opposite to a single wire, in the middle of two, or as far from three: normal to their
  // triangle.
  std::vector<Vector3d> candidates{Vector3d::UnitZ(), Vector3d::UnitY(), Vector3d::UnitX()};
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& wire : wires) sum += wire;
  candidates.push_back(sum);
  for (const Vector3d& a : wires)
    for (const Vector3d& b : wires) {
      candidates.push_back(a.cross(b));
      for (const Vector3d& c : wires) candidates.push_back((b - a).cross(c - a));
    }
  Vector3d best = Vector3d::UnitZ();
  double bestCosine = 2;
  for (const Vector3d& candidate : candidates) {
    if (candidate.norm() < 1e-9) continue;
    for (const double sign : {1.0, -1.0}) {
      const Vector3d direction = sign * candidate.normalized();
      double cosine = -1;
      for (const Vector3d& wire : wires) cosine = std::max(cosine, direction.dot(wire));
      if (cosine < bestCosine - 1e-9) best = direction, bestCosine = cosine;
    }
  }
  return best;
}

std::optional<BodyMesh> meshWires(const std::vector<WirePiece>& pieces, const std::vector<BallSocket>& sockets,
                                  double tolerance, const base::ExecutionContext& context) {
  if (pieces.empty()) throw base::InputError("", "there is no wire");
  double smallestWire = std::numeric_limits<double>::infinity();
  for (const WirePiece& piece : pieces) smallestWire = std::min(smallestWire, piece.rounding);
  double smallest = smallestWire;
  for (const BallSocket& socket : sockets) smallest = std::min({smallest, 0.5 * socket.wall, socket.radius});
  if (!(smallest > 0 && tolerance > 0))
    throw base::InputError("", "the radii of wires and sockets and the tolerance must be above 0");
  const WireBody body(pieces, sockets, smallestWire);
  // Chords between the points of a cell's size are near the tolerance for the thinnest part.
  double cell = std::min(0.5 * smallest, std::sqrt(6 * smallest * tolerance));
  struct Cancelled {};
  const auto distance = [&](const Vector3d& place) {
    if (context.cancelRequested()) throw Cancelled{};
    return body.at(place);
  };
  try {
    for (int attempt = 1;; ++attempt, cell *= 0.7) {
      BodyMesh made = meshBody(distance, body.box(), cell, tolerance);
      if (untangle(made.mesh) || attempt == mostAttempts) return made;
    }
  } catch (const Cancelled&) {
    return std::nullopt;
  }
}

}  // namespace pliant::geometry
