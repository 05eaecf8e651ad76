#include "core/scene/boundary_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/error.hpp"
#include "core/geometry/surface_mesh.hpp"
#include "core/scene/csv_table.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using Eigen::Index;
using Eigen::Vector3d;

namespace {

using QuantityKind = BoundaryQuantity::Kind;

/// All quantities, still without values.
std::vector<BoundaryQuantity> emptyQuantities(Index count) {
  std::vector<BoundaryQuantity> quantities{{"distance", "distance from\nthe middle", QuantityKind::coordinate, {}},
                                           {"remaining", "smaller gaps\ncould add", QuantityKind::coordinate, {}},
                                           {"gap", "mean gap over\nwire radius", QuantityKind::number, {}},
                                           {"contacts", "pairs of pieces\nin contact", QuantityKind::count, {}},
                                           {"iterations", "iterations", QuantityKind::count, {}},
                                           {"way", "how the limit\nwas reached", QuantityKind::way, {}}};
  for (BoundaryQuantity& quantity : quantities)
    quantity.values.setConstant(count, std::numeric_limits<double>::quiet_NaN());
  return quantities;
}

/// In the order of emptyQuantities().
void setQuantities(std::vector<BoundaryQuantity>& quantities, Index point, const std::array<double, 6>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) quantities[i].values[point] = values[i];
}

double wayOf(bool raised, bool seesBeyond) { return seesBeyond ? 2 : raised ? 1 : 0; }

/// Takes exact places and all quantities from the table beside the mesh, if that is the table of this mesh.
void addLimitTable(BoundarySurface& surface, const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "boundary.csv")) return;
  const CsvTable table(folder / "boundary.csv");
  if (static_cast<Index>(table.size()) != surface.points.cols()) return;
  const bool bends = table.has("k_xx [1/m]");
  surface.space = bends ? curvatureSpace() : strainSpace();
  const std::array<std::string, 3> columns = bends
                                                 ? std::array<std::string, 3>{"k_xx [1/m]", "k_yy [1/m]", "k_xy [1/m]"}
                                                 : std::array<std::string, 3>{"green_xx", "green_yy", "green_xy"};
  const std::string perMetre = bends ? " [1/m]" : "";
  // Readers of meshes may put points in another order: limits are known by their places.
  std::map<std::array<float, 3>, int> rows;
  Eigen::Matrix3Xd exact(3, surface.points.cols());
  const auto key = [](const Vector3d& place) {
    return std::array{static_cast<float>(place[0]), static_cast<float>(place[1]), static_cast<float>(place[2])};
  };
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Vector3d place(table.number(i, columns[0]), table.number(i, columns[1]), table.number(i, columns[2]));
    exact.col(static_cast<Index>(i)) = place;
    rows[key(place)] = static_cast<int>(i);
  }
  std::vector<int> rowOf;
  for (const auto& point : surface.points.colwise()) {
    const auto row = rows.find(key(point));
    if (row == rows.end()) return;
    rowOf.push_back(row->second);
  }
  for (auto& triangle : surface.triangles)
    for (int& corner : triangle) corner = rowOf[static_cast<std::size_t>(corner)];
  surface.points = exact;
  double radius = std::numeric_limits<double>::quiet_NaN();
  if (std::filesystem::exists(folder / "summary.json")) {
    const Json summary = parseJson(readTextFile(folder / "summary.json"));
    radius = summary.value("smallest_radius", radius);
    surface.name = summary.value("study", surface.name);
    if (const Json from = summary.value("provenance", Json::object()); from.contains("scene"))
      surface.name += " of " + std::filesystem::path(from["scene"].get<std::string>()).stem().string();
  }
  surface.quantities = emptyQuantities(surface.points.cols());
  for (std::size_t i = 0; i < table.size(); ++i) {
    surface.known[i] = table.text(i, "termination") == "converged" && table.text(i, "rest") != "unlimited" &&
                       table.text(i, "rest") != "folded";
    if (!surface.known[i]) continue;
    setQuantities(surface.quantities, static_cast<Index>(i),
                  {table.number(i, "distance" + perMetre), table.number(i, "remaining" + perMetre),
                   table.number(i, "mean_gap [m]") / radius, table.number(i, "contacts"), table.number(i, "iterations"),
                   wayOf(table.number(i, "raised") != 0, table.number(i, "sees_beyond") != 0)});
  }
}

}  // namespace

const BoundarySpace& strainSpace() {
  static const BoundarySpace space{{"E_x", "E_y", "E_xy"}, "%", 100};
  return space;
}

const BoundarySpace& curvatureSpace() {
  static const BoundarySpace space{{"k_xx", "k_yy", "k_xy"}, "1/m", 1};
  return space;
}

int BoundarySurface::knownCount() const { return static_cast<int>(std::count(known.begin(), known.end(), true)); }

const BoundaryQuantity* BoundarySurface::quantity(const std::string& key) const {
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [&](const auto& each) { return each.key == key; });
  return found == quantities.end() ? nullptr : &*found;
}

BoundarySurface boundarySurface(const LimitSurface& limits, const std::string& name) {
  const interlock::StrainSpaceBoundary& boundary = limits.boundary;
  const auto count = static_cast<Index>(boundary.states.size());
  const double radius = limits.body()->smallestRadius();
  BoundarySurface surface;
  surface.name = name;
  surface.space = limits.space();
  surface.points.setZero(3, count);
  surface.known.assign(boundary.states.size(), false);
  surface.quantities = emptyQuantities(count);
  std::vector<bool> placed(boundary.states.size(), false);
  Eigen::Matrix3Xd strains(3, count);
  for (Index i = 0; i < count; ++i) {
    const auto direction = static_cast<std::size_t>(i);
    const interlock::BoundaryState& state = boundary.states[direction];
    const auto& [a, b] = boundary.mesh.parents[direction];
    surface.known[direction] =
        state.termination == base::TerminationType::converged && state.kind != interlock::RestKind::unlimited;
    if (surface.known[direction]) {
      strains.col(i) = boundary.strainAt(static_cast<int>(i));
      setQuantities(surface.quantities, i,
                    {state.distance, state.remaining, state.meanGap / radius, double(state.contacts),
                     double(state.iterations), wayOf(state.raised, state.seesBeyond)});
    } else if (a >= 0 && placed[static_cast<std::size_t>(a)] && placed[static_cast<std::size_t>(b)]) {
      strains.col(i) = 0.5 * (strains.col(a) + strains.col(b));  // those come before it
    } else {
      continue;
    }
    placed[direction] = true;
    surface.points.col(i) = limits.coordinates(strains.col(i));
  }
  const auto isPlaced = [&](int corner) { return placed[static_cast<std::size_t>(corner)]; };
  for (const auto& triangle : boundary.mesh.triangles)
    if (std::all_of(triangle.begin(), triangle.end(), isPlaced)) surface.triangles.push_back(triangle);
  return surface;
}

BoundarySurface readBoundarySurface(const std::filesystem::path& place) {
  const bool isFolder = std::filesystem::is_directory(place);
  const std::filesystem::path file = isFolder ? place / "boundary.ply" : place;
  if (!std::filesystem::exists(file))
    throw base::InputError(
        place.string(), isFolder ? "This folder holds no boundary.ply of a stretch_boundary or bending_boundary study."
                                 : "There is no such file.");
  BoundarySurface surface;
  try {
    const geometry::SurfaceMesh mesh = geometry::readMesh(file, 1);
    surface.points = mesh.points;
    surface.triangles = mesh.triangles;
  } catch (const base::InputError& error) {
    throw base::InputError(file.string(), error.problem());
  }
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  surface.name = folder.filename().string();
  surface.known.assign(static_cast<std::size_t>(surface.points.cols()), true);
  try {
    addLimitTable(surface, folder);
  } catch (const Json::exception&) {
    throw base::InputError((folder / "summary.json").string(), "This summary is not one of a study of a boundary.");
  }
  return surface;
}

PrincipalStretch principalStretch(const Vector3d& greenStrain) {
  const double mean = 0.5 * (greenStrain[0] + greenStrain[1]);
  const double half = 0.5 * (greenStrain[0] - greenStrain[1]), shear = greenStrain[2];
  const double radius = std::hypot(half, shear);
  PrincipalStretch result;
  result.larger = std::sqrt(std::max(0.0, 1 + 2 * (mean + radius)));
  result.smaller = std::sqrt(std::max(0.0, 1 + 2 * (mean - radius)));
  result.angle = radius > 0 ? 0.5 * std::atan2(shear, half) : 0;
  return result;
}

}  // namespace pliant::scene
