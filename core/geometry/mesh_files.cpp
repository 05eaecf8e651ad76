#include <assimp/scene.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <fstream>
#include <memory>

#include "core/base/error.hpp"
#include "core/geometry/mesh_checks.hpp"

namespace pliant::geometry {

namespace {

struct Format {
  const char* extension;
  const char* exporter;  ///< assimp's name
  double unitsPerMetre;
  bool readable;  ///< 3MF is not: assimp ignores the unit that the file names
};
constexpr Format formats[] = {{".stl", "stlb", 1, true},   {".obj", "objnomtl", 1, true}, {".ply", "ply", 1, true},
                              {".gltf", "gltf2", 1, true}, {".glb", "glb2", 1, true},     {".3mf", "3mf", 1000, false}};

const Format* findFormat(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(
      extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const Format& format : formats)
    if (extension == format.extension) return &format;
  return nullptr;
}

/// Assimp never returns from a PLY file whose header has no end (and it knows such files by their first bytes, whatever
/// their name).
void refuseEndlessHeader(const std::filesystem::path& file) {
  std::string head(1 << 16, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  if (head.starts_with("ply") && head.find("\nend_header") == std::string::npos)
    throw base::InputError("", "the mesh '" + file.string() + "' is cut off within its header");
}

/// Collects the polygons of an assimp scene as triangles. Assimp's own steps for this abort the program where a damaged
/// file has faces without corners.
class TriangleCollector {
 public:
  explicit TriangleCollector(const aiScene& scene) : scene_(scene) { visit(*scene.mRootNode, aiMatrix4x4()); }

  SurfaceMesh finish(double scale) {
    SurfaceMesh mesh;
    mesh.points.resize(3, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t n = 0; n < points_.size(); ++n) mesh.points.col(static_cast<Eigen::Index>(n)) = scale * points_[n];
    if (textured_)
      for (const auto& [a, b, c] : triangles_) mesh.texture.push_back({texture_[a], texture_[b], texture_[c]});
    mesh.triangles = std::move(triangles_);
    return mesh;
  }

 private:
  void visit(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m)
      if (node.mMeshes[m] < scene_.mNumMeshes) append(*scene_.mMeshes[node.mMeshes[m]], transform);
    for (unsigned child = 0; child < node.mNumChildren; ++child) visit(*node.mChildren[child], transform);
  }

  void append(const aiMesh& part, const aiMatrix4x4& transform) {
    textured_ = textured_ && (part.mNumFaces == 0 || part.HasTextureCoords(0));
    std::vector<int> index(part.mNumVertices, -1);
    std::vector<int> polygon;
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices < 3) continue;  // a point or a line
      polygon.clear();
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        const unsigned vertex = face.mIndices[i];
        if (vertex >= part.mNumVertices)
          throw base::InputError("", "face " + std::to_string(f) + " names point " + std::to_string(vertex) +
                                         ", but there are " + std::to_string(part.mNumVertices) + " points");
        if (index[vertex] < 0) {
          index[vertex] = static_cast<int>(points_.size());
          const aiVector3D p = transform * part.mVertices[vertex];
          points_.emplace_back(p.x, p.y, p.z);
          const aiVector3D uv = part.HasTextureCoords(0) ? part.mTextureCoords[0][vertex] : aiVector3D();
          texture_.emplace_back(uv.x, uv.y);
        }
        polygon.push_back(index[vertex]);
      }
      split(polygon, f);
    }
  }

  Eigen::Vector3d normal(int a, int b, int c) const { return (points_[b] - points_[a]).cross(points_[c] - points_[a]); }

  /// Splits a polygon into a fan about the first of its corners for which no triangle of the fan is turned over.
  void split(const std::vector<int>& polygon, unsigned face) {
    const int count = static_cast<int>(polygon.size());
    const auto corner = [&](int i) { return polygon[i % count]; };
    Eigen::Vector3d whole = Eigen::Vector3d::Zero();
    for (int i = 1; i + 1 < count; ++i) whole += normal(corner(0), corner(i), corner(i + 1));
    for (int first = 0; first < count; ++first) {
      bool agrees = true;
      for (int i = 1; i + 1 < count && count > 3; ++i)
        agrees = agrees && normal(corner(first), corner(first + i), corner(first + i + 1)).dot(whole) > 0;
      if (!agrees) continue;
      for (int i = 1; i + 1 < count; ++i)
        triangles_.push_back({corner(first), corner(first + i), corner(first + i + 1)});
      return;
    }
    throw base::InputError(
        "", "face " + std::to_string(face) + " is a polygon that cannot be split into a fan of triangles");
  }

  const aiScene& scene_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Eigen::Vector2d> texture_;  ///< of each point
  bool textured_ = true;                  ///< whether all points have it
  std::vector<std::array<int, 3>> triangles_;
};

/// The mesh as a scene with one node below its root (assimp's 3MF exporter skips the root); assimp deletes what it
/// holds.
std::unique_ptr<aiScene> toScene(const SurfaceMesh& mesh, double unitsPerMetre) {
  auto scene = std::make_unique<aiScene>();
  scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene->mNumMaterials = 1;
  auto* part = new aiMesh;
  scene->mMeshes = new aiMesh* [1] { part };
  scene->mNumMeshes = 1;
  auto* node = new aiNode("mesh");
  node->mMeshes = new unsigned[1]{0};
  node->mNumMeshes = 1;
  scene->mRootNode = new aiNode("root");
  scene->mRootNode->addChildren(1, &node);

  part->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  part->mNumVertices = static_cast<unsigned>(mesh.points.cols());
  part->mVertices = new aiVector3D[part->mNumVertices];
  for (unsigned n = 0; n < part->mNumVertices; ++n) {
    const Eigen::Vector3f p = (unitsPerMetre * mesh.points.col(n)).cast<float>();
    part->mVertices[n] = {p[0], p[1], p[2]};
  }
  part->mNumFaces = static_cast<unsigned>(mesh.triangles.size());
  part->mFaces = new aiFace[part->mNumFaces];
  for (unsigned t = 0; t < part->mNumFaces; ++t) {
    part->mFaces[t].mNumIndices = 3;
    part->mFaces[t].mIndices = new unsigned[3];
    for (int i = 0; i < 3; ++i) part->mFaces[t].mIndices[i] = static_cast<unsigned>(mesh.triangles[t][i]);
  }
  return scene;
}

}  // namespace

SurfaceMesh readMesh(const std::filesystem::path& file, double scale) {
  if (!(std::isfinite(scale) && scale > 0)) throw base::InputError("", "the scale of a mesh must be a number above 0");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw base::InputError("", "there is no mesh file '" + file.string() + "'");
  const Format* format = findFormat(file);
  if (!format || !format->readable)
    throw base::InputError("", "the mesh '" + file.string() + "' must be an .stl, .obj, .ply, .gltf or .glb file");
  refuseEndlessHeader(file);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (!scene)
    throw base::InputError("", "the mesh '" + file.string() + "' cannot be read: " + importer.GetErrorString());
  try {
    SurfaceMesh mesh = TriangleCollector(*scene).finish(scale);
    checkPointsAndIndices(mesh);
    return mesh;
  } catch (const base::InputError& error) {
    throw base::InputError("", "in the mesh '" + file.string() + "', " + error.problem());
  }
}

void writeMesh(const SurfaceMesh& mesh, const std::filesystem::path& file) {
  checkMesh(mesh);
  const Format* format = findFormat(file);
  if (!format)
    throw base::InputError("", "the mesh '" + file.string() + "' must end with .stl, .obj, .ply, .gltf, .glb or .3mf");
  Assimp::Exporter exporter;
  const std::unique_ptr<aiScene> scene = toScene(mesh, format->unitsPerMetre);
  if (exporter.Export(scene.get(), format->exporter, file.string()) != aiReturn_SUCCESS)
    throw base::InputError("", "the mesh '" + file.string() + "' cannot be written: " + exporter.GetErrorString());
}

}  // namespace pliant::geometry
