#include "core/geometry/tet_mesh.hpp"

#include <Eigen/Dense>
#include <algorithm>

#include "core/base/error.hpp"

namespace pliant::geometry {

namespace {

using Face = std::array<int, 3>;

std::string tetrahedronText(std::size_t index) { return "tetrahedron " + std::to_string(index); }

Eigen::Matrix3d edgesOf(const TetMesh& mesh, const std::array<int, 4>& tetrahedron) {
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = mesh.points.col(tetrahedron[k + 1]) - mesh.points.col(tetrahedron[0]);
  return edges;
}

/// The face opposite corner i, counter-clockwise seen from outside a positively oriented tetrahedron.
Face faceOpposite(const std::array<int, 4>& t, int i) {
  switch (i) {
    case 0: return {t[1], t[2], t[3]};
    case 1: return {t[0], t[3], t[2]};
    case 2: return {t[0], t[1], t[3]};
    default: return {t[0], t[2], t[1]};
  }
}

struct SortedFace {
  Face corners;
  std::size_t tetrahedron;
  int opposite;

  bool operator<(const SortedFace& other) const {
    return std::tie(corners, tetrahedron) < std::tie(other.corners, other.tetrahedron);
  }
};

std::vector<SortedFace> sortedFaces(const std::vector<std::array<int, 4>>& tetrahedra) {
  std::vector<SortedFace> faces;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t)
    for (int i = 0; i < 4; ++i) {
      Face corners = faceOpposite(tetrahedra[t], i);
      std::sort(corners.begin(), corners.end());
      faces.push_back({corners, t, i});
    }
  std::sort(faces.begin(), faces.end());
  return faces;
}

void checkTetrahedron(const TetMesh& mesh, std::size_t t) {
  for (const int node : mesh.tetrahedra[t])
    if (node < 0 || node >= mesh.points.cols())
      throw base::InputError("", tetrahedronText(t) + " names point " + std::to_string(node) + ", but there are " +
                                     std::to_string(mesh.points.cols()) + " points");
  const Eigen::Matrix3d edges = edgesOf(mesh, mesh.tetrahedra[t]);
  const double longest = std::max({edges.colwise().norm().maxCoeff(), (edges.col(1) - edges.col(0)).norm(),
                                   (edges.col(2) - edges.col(0)).norm(), (edges.col(2) - edges.col(1)).norm()});
  if (!(std::abs(edges.determinant()) / 6 > smallestRelativeVolume * longest * longest * longest))
    throw base::InputError("", tetrahedronText(t) + " has no volume: its corners lie in a plane");
}

}  // namespace

void checkTetMesh(const TetMesh& mesh) {
  if (mesh.tetrahedra.empty()) throw base::InputError("", "the mesh has no tetrahedra");
  for (Eigen::Index n = 0; n < mesh.points.cols(); ++n)
    if (!mesh.points.col(n).allFinite())
      throw base::InputError("", "point " + std::to_string(n) + " has a coordinate that is not finite");
  for (const auto& [name, nodes] : mesh.groups)
    for (const int node : nodes)
      if (node < 0 || node >= mesh.points.cols())
        throw base::InputError("", "group '" + name + "' names point " + std::to_string(node) + ", but there are " +
                                       std::to_string(mesh.points.cols()) + " points");
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) checkTetrahedron(mesh, t);
  std::vector<std::pair<std::array<int, 4>, std::size_t>> corners;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    corners.push_back({mesh.tetrahedra[t], t});
    std::sort(corners.back().first.begin(), corners.back().first.end());
  }
  std::sort(corners.begin(), corners.end());
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (corners[i].first == corners[i - 1].first)
      throw base::InputError("", tetrahedronText(corners[i].second) + " has the same corners as " +
                                     tetrahedronText(corners[i - 1].second));
  const std::vector<SortedFace> faces = sortedFaces(mesh.tetrahedra);
  for (std::size_t i = 2; i < faces.size(); ++i)
    if (faces[i].corners == faces[i - 2].corners)
      throw base::InputError("", tetrahedronText(faces[i].tetrahedron) + " shares a face with " +
                                     tetrahedronText(faces[i - 2].tetrahedron) + " and " +
                                     tetrahedronText(faces[i - 1].tetrahedron) + ", but a face has two sides");
}

std::vector<std::array<int, 4>> orientTetrahedra(const TetMesh& mesh) {
  std::vector<std::array<int, 4>> oriented = mesh.tetrahedra;
  for (auto& tetrahedron : oriented)
    if (edgesOf(mesh, tetrahedron).determinant() < 0) std::swap(tetrahedron[2], tetrahedron[3]);
  return oriented;
}

std::vector<Face> boundaryTriangles(const std::vector<std::array<int, 4>>& tetrahedra) {
  const std::vector<SortedFace> faces = sortedFaces(tetrahedra);
  std::vector<std::pair<std::size_t, int>> outer;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool hasTwin = (i > 0 && faces[i - 1].corners == faces[i].corners) ||
                         (i + 1 < faces.size() && faces[i + 1].corners == faces[i].corners);
    if (!hasTwin) outer.push_back({faces[i].tetrahedron, faces[i].opposite});
  }
  std::sort(outer.begin(), outer.end());
  std::vector<Face> triangles;
  for (const auto& [t, opposite] : outer) triangles.push_back(faceOpposite(tetrahedra[t], opposite));
  return triangles;
}

double volumeOf(const TetMesh& mesh) {
  double sum = 0;
  for (const auto& tetrahedron : mesh.tetrahedra) sum += edgesOf(mesh, tetrahedron).determinant() / 6;
  return sum;
}

}  // namespace pliant::geometry
