#include "core/geometry/print_files.hpp"

#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/pending_file.hpp"
#include "core/geometry/zip_file.hpp"

namespace pliant::geometry {

namespace {

using Eigen::Vector3d;

constexpr double millimetres = 1e3;

/// With as many digits as reading the same number back takes.
void append(std::string& text, double number) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
}
void append(std::string& text, int number) { text += std::to_string(number); }

Vector3d placed(const BodyCopy& copy, const Vector3d& point) { return copy.rotation * point + copy.position; }

std::string objectText(const SurfaceMesh& body, int id, const std::string& name) {
  std::string text = "  <object id=\"" + std::to_string(id) + "\" type=\"model\"";
  if (!name.empty()) text += " name=\"" + name + '"';
  text += ">\n   <mesh>\n    <vertices>\n";
  for (Eigen::Index i = 0; i < body.points.cols(); ++i) {
    // A nanometre is enough, and stays short.
    const Vector3d point = (body.points.col(i) * millimetres * 1e6).array().round() / 1e6;
    text += "     <vertex x=\"";
    append(text, point[0]);
    text += "\" y=\"";
    append(text, point[1]);
    text += "\" z=\"";
    append(text, point[2]);
    text += "\"/>\n";
  }
  text += "    </vertices>\n    <triangles>\n";
  for (const auto& [a, b, c] : body.triangles) {
    text += "     <triangle v1=\"";
    append(text, a);
    text += "\" v2=\"";
    append(text, b);
    text += "\" v3=\"";
    append(text, c);
    text += "\"/>\n";
  }
  return text + "    </triangles>\n   </mesh>\n  </object>\n";
}

/// The item's matrix is written by columns: points are rows that it multiplies from the right.
std::string itemText(const BodyCopy& copy) {
  std::string text = "  <item objectid=\"" + std::to_string(copy.body + 1) + "\" transform=\"";
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) {
      append(text, copy.rotation(row, column));
      text += ' ';
    }
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) text += ' ';
    append(text, millimetres * copy.position[axis]);
  }
  return text + "\"/>\n";
}

}  // namespace

SurfaceMesh assembled(const std::vector<SurfaceMesh>& bodies, const std::vector<BodyCopy>& copies) {
  SurfaceMesh mesh;
  Eigen::Index points = 0;
  for (const BodyCopy& copy : copies) points += bodies[copy.body].points.cols();
  mesh.points.resize(3, points);
  Eigen::Index first = 0;
  for (const BodyCopy& copy : copies) {
    const SurfaceMesh& body = bodies[copy.body];
    mesh.points.middleCols(first, body.points.cols()) = (copy.rotation * body.points).colwise() + copy.position;
    const int offset = static_cast<int>(first);
    for (const auto& [a, b, c] : body.triangles) mesh.triangles.push_back({a + offset, b + offset, c + offset});
    first += body.points.cols();
  }
  return mesh;
}

bool writePrintStl(const std::vector<SurfaceMesh>& bodies, const std::vector<BodyCopy>& copies,
                   const std::filesystem::path& file, const base::ExecutionContext* context) {
  static_assert(std::endian::native == std::endian::little && std::numeric_limits<float>::is_iec559);
  std::uint64_t count = 0;
  for (const BodyCopy& copy : copies) count += bodies[copy.body].triangles.size();
  if (count > std::numeric_limits<std::uint32_t>::max())
    throw base::InputError(file.string(), "An STL file cannot hold more than 4,294,967,295 triangles.");
  base::PendingFile output(file);
  std::string bytes = "Binary STL, lengths in millimetres";
  bytes.resize(80, ' ');
  const auto appendBytes = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  appendBytes(static_cast<std::uint32_t>(count));
  for (const BodyCopy& copy : copies) {
    if (context && context->cancelRequested()) return false;
    const SurfaceMesh& body = bodies[copy.body];
    for (const auto& triangle : body.triangles) {
      Eigen::Matrix3d corners;
      for (int i = 0; i < 3; ++i) corners.col(i) = millimetres * placed(copy, body.points.col(triangle[i]));
      const Vector3d normal = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
      for (int axis = 0; axis < 3; ++axis) appendBytes(static_cast<float>(normal[axis]));
      for (int i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis) appendBytes(static_cast<float>(corners(axis, i)));
      appendBytes(std::uint16_t(0));
    }
    output.write(bytes);
    bytes.clear();
  }
  output.commit();
  return true;
}

void writePrint3mf(const std::vector<SurfaceMesh>& bodies, const std::vector<BodyCopy>& copies,
                   const std::filesystem::path& file, const std::vector<std::string>& names) {
  std::string model =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n <resources>\n";
  for (std::size_t i = 0; i < bodies.size(); ++i)
    model += objectText(bodies[i], static_cast<int>(i) + 1, i < names.size() ? names[i] : "");
  model += " </resources>\n <build>\n";
  for (const BodyCopy& copy : copies) model += itemText(copy);
  model += " </build>\n</model>\n";
  writeZip({{"[Content_Types].xml",
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Types "
             "xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default Extension=\"rels\" "
             "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default Extension=\"model\" "
             "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n"},
            {"_rels/.rels",
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Relationships "
             "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship "
             "Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
             "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n"},
            {"3D/3dmodel.model", std::move(model)}},
           file);
}

}  // namespace pliant::geometry
