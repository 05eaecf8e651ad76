#include "core/scene/measurement_file.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;
using harmonic::MeasuredCoordinate;
using harmonic::MeasuredMotion;

namespace {

std::string_view trimmed(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> cellsOf(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// What a column holds.
struct Column {
  bool isTime = false;
  int node = -1, axis = -1;  ///< of a coordinate; -1 if the column is left out
  double perUnit = 1;
};

class MeasurementReader {
 public:
  MeasurementReader(const std::filesystem::path& file, const mechanics::Model& model, const std::vector<int>& axes)
      : file_(file), model_(model), axes_(axes) {}

  MeasuredMotion read() {
    const std::string text = readTextFile(file_);
    std::vector<double> times;
    std::vector<std::vector<double>> values;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
      begin = end + 1;
      ++line_;
      if (line.empty() || line.front() == '#') continue;
      if (columns_.empty())
        readHeader(cellsOf(line));
      else
        readRow(cellsOf(line), times, values);
    }
    if (columns_.empty()) fail("The table is empty: it needs a header with \"time [s]\" and columns like " + example());
    if (times.empty()) fail("The table has no rows.");
    MeasuredMotion motion;
    motion.times = Eigen::Map<const mechanics::Vector>(times.data(), static_cast<Eigen::Index>(times.size()));
    for (std::size_t c = 0, next = 0; c < columns_.size(); ++c) {
      if (columns_[c].node < 0) continue;
      MeasuredCoordinate coordinate{
          columns_[c].node, columns_[c].axis, mechanics::Vector(static_cast<Eigen::Index>(times.size()))};
      for (std::size_t i = 0; i < times.size(); ++i) coordinate.values[static_cast<Eigen::Index>(i)] = values[i][next];
      ++next;
      if (coordinate.values.array().isNaN().all()) fail("The column " + quote(names_[c]) + " has no values.");
      motion.coordinates.push_back(std::move(coordinate));
    }
    return motion;
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const {
    throw InputError(file_.string() + ":" + std::to_string(std::max(line_, 1)), sentence);
  }

  std::string example() const {
    return quote((model_.probes.empty() ? std::string("probe") : model_.probes.front().name) + " x [mm]") + ".";
  }

  void readHeader(const std::vector<std::string_view>& cells) {
    int times = 0, coordinates = 0;
    for (const std::string_view cell : cells) {
      names_.emplace_back(cell);
      columns_.push_back(columnOf(cell));
      const Column& column = columns_.back();
      times += column.isTime;
      coordinates += column.node >= 0;
      for (std::size_t before = 0; before + 1 < columns_.size(); ++before)
        if (column.node >= 0 && columns_[before].node == column.node && columns_[before].axis == column.axis)
          fail("The columns " + quote(names_[before]) + " and " + quote(names_.back()) + " are of one coordinate.");
    }
    if (times != 1) fail("Expected one column \"time [s]\", but found " + std::to_string(times) + ".");
    if (coordinates == 0) fail("The table has no column of a coordinate that counts, such as " + example());
  }

  Column columnOf(std::string_view cell) const {
    const std::size_t open = cell.rfind('[');
    if (open == std::string_view::npos || cell.back() != ']')
      fail("The column " + quote(cell) + " has no unit in square brackets at its end.");
    const std::string_view name = trimmed(cell.substr(0, open));
    const std::string unit(cell.substr(open + 1, cell.size() - open - 2));
    const auto perUnit = [&](const base::Dimension& dimension) {
      try {
        return base::parseQuantity("1 " + unit, dimension);
      } catch (const InputError& error) {
        fail("The column " + quote(cell) + " has a wrong unit: " + error.problem());
      }
    };
    if (name == "time") return {true, -1, -1, perUnit(base::dimensions::time)};
    if (name.size() > 2 && name[name.size() - 2] == ' ') {
      const int axis = name.back() - 'x';
      const std::string_view probe = trimmed(name.substr(0, name.size() - 2));
      for (const mechanics::Probe& each : model_.probes)
        if (each.name == probe && axis >= 0 && axis < model_.dimension) {
          const bool counts = axes_.empty() || std::find(axes_.begin(), axes_.end(), axis) != axes_.end();
          return {false, counts ? each.node : -1, axis, perUnit(base::dimensions::length)};
        }
    }
    std::string known;
    for (const mechanics::Probe& each : model_.probes) known += (known.empty() ? "" : ", ") + quote(each.name);
    fail("The column " + quote(cell) + " is neither \"time [s]\" nor a probe's name with an axis; the probes are " +
         (known.empty() ? "none" : known) + ".");
  }

  void readRow(const std::vector<std::string_view>& cells, std::vector<double>& times,
               std::vector<std::vector<double>>& values) const {
    if (cells.size() != columns_.size())
      fail("This row has " + std::to_string(cells.size()) + " cells, but the header has " +
           std::to_string(columns_.size()) + ".");
    std::vector<double> row;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const Column& column = columns_[c];
      if (column.isTime) {
        if (cells[c].empty()) fail("This row has no time.");
        times.push_back(column.perUnit * number(cells[c]));
      } else if (column.node >= 0) {
        row.push_back(cells[c].empty() ? std::numeric_limits<double>::quiet_NaN() : column.perUnit * number(cells[c]));
      }
    }
    values.push_back(std::move(row));
  }

  double number(std::string_view cell) const {
    try {
      return csvNumber(cell);
    } catch (const InputError& error) {
      fail(error.problem());
    }
  }

  const std::filesystem::path& file_;
  const mechanics::Model& model_;
  const std::vector<int>& axes_;
  std::vector<std::string> names_;
  std::vector<Column> columns_;
  int line_ = 0;
};

}  // namespace

MeasuredMotion readMeasurement(const std::filesystem::path& file, const mechanics::Model& model,
                               const std::vector<int>& axes) {
  return MeasurementReader(file, model, axes).read();
}

}  // namespace pliant::scene
