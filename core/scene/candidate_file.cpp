#include "core/scene/candidate_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>

#include "core/scene/csv.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

namespace {

std::string countText(std::size_t found, int expected) {
  return "the file has " + std::to_string(found) + " positions, but the scene has " + std::to_string(expected) +
         " nodes";
}

Eigen::Matrix3Xd candidateFromCsv(std::string_view text, int nodeCount) {
  std::vector<std::array<double, 3>> places;
  int line = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view row = text.substr(begin, end - begin);
    begin = end + 1;
    ++line;
    if (!row.empty() && row.back() == '\r') row.remove_suffix(1);
    if (line == 1 || row.empty()) continue;  // the header
    const std::string where = "line " + std::to_string(line) + ": ";
    std::vector<std::string_view> cells;
    for (std::size_t comma = row.find(','); comma != std::string_view::npos; comma = row.find(',')) {
      cells.push_back(row.substr(0, comma));
      row.remove_prefix(comma + 1);
    }
    cells.push_back(row);
    if (cells.size() != 3 && cells.size() != 4)
      throw InputError("", where + "expected x, y and z, with or without the node's number before them, found " +
                               std::to_string(cells.size()) + " columns");
    try {
      if (cells.size() == 4 && csvInteger(cells[0]) != static_cast<int>(places.size()))
        throw InputError("", "expected node " + std::to_string(places.size()) + ", found " + std::string(cells[0]));
      const std::size_t first = cells.size() - 3;
      places.push_back({csvNumber(cells[first]), csvNumber(cells[first + 1]), csvNumber(cells[first + 2])});
    } catch (const InputError& error) {
      throw InputError("", where + error.problem());
    }
  }
  if (static_cast<int>(places.size()) != nodeCount) throw InputError("", countText(places.size(), nodeCount));
  Eigen::Matrix3Xd positions(3, nodeCount);
  for (int node = 0; node < nodeCount; ++node)
    positions.col(node) = Eigen::Map<const Eigen::Vector3d>(places[static_cast<std::size_t>(node)].data());
  return positions;
}

/// The vertices of a PLY file's header: how many, and where x, y and z stand in one.
struct VertexLayout {
  bool binary = false;
  std::size_t count = 0;
  std::vector<int> sizes;  ///< bytes of each property, -8 and -4 for real numbers
  std::array<int, 3> axes{-1, -1, -1};
  std::size_t begin = 0;  ///< of the data
  int headerLines = 0;
};

VertexLayout readPlyHeader(std::string_view text) {
  static const std::map<std::string, int> sizes{{"char", 1},   {"uchar", 1},    {"int8", 1},    {"uint8", 1},
                                                {"short", 2},  {"ushort", 2},   {"int16", 2},   {"uint16", 2},
                                                {"int", 4},    {"uint", 4},     {"int32", 4},   {"uint32", 4},
                                                {"float", -4}, {"float32", -4}, {"double", -8}, {"float64", -8}};
  VertexLayout layout;
  bool inVertex = false, ended = false, first = true;
  std::size_t begin = 0;
  while (!ended && begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) break;
    std::istringstream line{std::string(text.substr(begin, end - begin))};
    begin = end + 1;
    ++layout.headerLines;
    std::string word, kind, name;
    line >> word;
    if (std::exchange(first, false) && word != "ply") throw InputError("", "this is no PLY file");
    if (word == "format") {
      line >> kind;
      layout.binary = kind == "binary_little_endian";
      if (!layout.binary && kind != "ascii")
        throw InputError("", "PLY files may be ascii or binary_little_endian, not " + kind);
    } else if (word == "element") {
      line >> kind;
      inVertex = kind == "vertex";
      if (inVertex) line >> layout.count;
      if (!inVertex && layout.sizes.empty()) throw InputError("", "the vertices must come first in a PLY file");
    } else if (word == "property" && inVertex) {
      line >> kind >> name;
      if (!sizes.contains(kind))
        throw InputError("", "the vertices of a PLY file must have no property of type " + quote(kind));
      for (int axis = 0; axis < 3; ++axis)
        if (name == std::string(1, "xyz"[axis]))
          layout.axes[static_cast<std::size_t>(axis)] = static_cast<int>(layout.sizes.size());
      layout.sizes.push_back(sizes.at(kind));
    }
    ended = word == "end_header";
  }
  if (!ended) throw InputError("", "the PLY file is cut off within its header");
  for (const int axis : layout.axes)
    if (axis < 0 || layout.sizes[static_cast<std::size_t>(axis)] > 0)
      throw InputError("", "the vertices of a PLY file need x, y and z as float or double");
  layout.begin = begin;
  return layout;
}

Eigen::Matrix3Xd candidateFromPly(std::string_view text, int nodeCount) {
  const VertexLayout layout = readPlyHeader(text);
  if (layout.count != static_cast<std::size_t>(nodeCount)) throw InputError("", countText(layout.count, nodeCount));
  Eigen::Matrix3Xd positions(3, nodeCount);
  std::vector<std::size_t> offsets{0};
  for (const int size : layout.sizes) offsets.push_back(offsets.back() + static_cast<std::size_t>(std::abs(size)));
  const std::string_view data = text.substr(layout.begin);
  if (layout.binary && data.size() < offsets.back() * layout.count) throw InputError("", "the PLY file is cut off");
  std::istringstream lines{layout.binary ? std::string() : std::string(data)};
  for (int node = 0; node < nodeCount; ++node) {
    std::string line;
    std::vector<double> numbers;
    if (!layout.binary) {
      if (!std::getline(lines, line)) throw InputError("", "the PLY file is cut off");
      std::istringstream words(line);
      for (std::string word; words >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
      if (numbers.size() != layout.sizes.size())
        throw InputError("", "line " + std::to_string(layout.headerLines + node + 1) + ": expected " +
                                 std::to_string(layout.sizes.size()) + " numbers, found " +
                                 std::to_string(numbers.size()));
    }
    for (int axis = 0; axis < 3; ++axis) {
      const auto property = static_cast<std::size_t>(layout.axes[static_cast<std::size_t>(axis)]);
      double value = 0;
      if (!layout.binary) {
        value = numbers[property];
      } else {
        const char* place = data.data() + static_cast<std::size_t>(node) * offsets.back() + offsets[property];
        float single = 0;
        if (layout.sizes[property] == -8) std::memcpy(&value, place, sizeof value);
        if (layout.sizes[property] == -4) std::memcpy(&single, place, sizeof single), value = single;
      }
      if (!std::isfinite(value))
        throw InputError("", "vertex " + std::to_string(node) + " has a coordinate that is not finite");
      positions(axis, node) = value;
    }
  }
  return positions;
}

}  // namespace

Eigen::Matrix3Xd readCandidate(const std::filesystem::path& file, int nodeCount) {
  const std::string text = readTextFile(file);
  return locate(file.string(), [&] {
    const std::string extension = file.extension().string();
    if (extension == ".ply") return candidateFromPly(text, nodeCount);
    if (extension == ".csv") return candidateFromCsv(text, nodeCount);
    throw InputError("", "positions are read from .ply and .csv files");
  });
}

}  // namespace pliant::scene
