#include "core/scene/outline_file.hpp"

#include <map>
#include <sstream>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;
using Eigen::Matrix2Xd;
using Eigen::Vector2d;

namespace {

/// The unit in the brackets of a column's name.
double unitOf(std::string_view column) {
  const std::size_t open = column.find('['), close = column.find(']');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open)
    throw InputError("", "the column \"" + std::string(column) + "\" names no unit, as \"x [mm]\" does");
  return base::parseQuantity("1 " + std::string(column.substr(open + 1, close - open - 1)), base::dimensions::length);
}

Matrix2Xd polygonOf(const std::vector<Vector2d>& corners) {
  Matrix2Xd polygon(2, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) polygon.col(static_cast<Eigen::Index>(i)) = corners[i];
  return polygon;
}

std::vector<Matrix2Xd> loopsOfTable(const std::string& text) {
  const auto rows = readCsv(text);
  const std::string header = text.substr(0, text.find('\n'));
  const std::size_t comma = header.find(',');
  if (comma == std::string::npos) throw InputError("", "an outline needs two columns, \"x [mm]\" and \"y [mm]\"");
  const std::size_t second = header.find(',', comma + 1);
  const double unitX = unitOf(header.substr(0, comma)), unitY = unitOf(header.substr(comma + 1, second - comma - 1));
  std::map<int, std::vector<Vector2d>> loops;
  for (const auto& row : rows) {
    const int loop = second == std::string::npos ? 0 : csvInteger(row[2]);
    loops[loop].push_back({unitX * csvNumber(row[0]), unitY * csvNumber(row[1])});
  }
  std::vector<Matrix2Xd> polygons;
  for (const auto& [number, corners] : loops) polygons.push_back(polygonOf(corners));
  return polygons;
}

std::vector<Matrix2Xd> loopsOfObj(const std::string& text) {
  std::istringstream lines(text);
  std::vector<Vector2d> points;
  std::vector<std::vector<Vector2d>> loops;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vector2d point;
      if (!(words >> point[0] >> point[1])) throw InputError("", "a point is no point: \"" + line + "\"");
      points.push_back(point);
    } else if (kind == "l") {
      std::vector<Vector2d>& loop = loops.emplace_back();
      for (long index = 0; words >> index;) {
        const long at = index > 0 ? index - 1 : static_cast<long>(points.size()) + index;
        if (at < 0 || at >= static_cast<long>(points.size()))
          throw InputError("", "a line goes through point " + std::to_string(index) + ", which there is not");
        loop.push_back(points[static_cast<std::size_t>(at)]);
      }
      if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    }
  }
  if (loops.empty()) loops.push_back(points);
  std::vector<Matrix2Xd> polygons;
  for (const auto& loop : loops) polygons.push_back(polygonOf(loop));
  return polygons;
}

}  // namespace

std::vector<Matrix2Xd> readOutline(const std::filesystem::path& file) {
  const std::string text = readTextFile(file);
  return locate(file.string(), [&] {
    std::vector<Matrix2Xd> polygons = file.extension() == ".obj" ? loopsOfObj(text) : loopsOfTable(text);
    if (polygons.empty()) throw InputError("", "there are no corners of an outline");
    return polygons;
  });
}

}  // namespace pliant::scene
