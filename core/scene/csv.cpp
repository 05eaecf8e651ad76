#include "core/scene/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

CsvWriter& CsvWriter::add(std::string_view text) {
  if (rowBegun_) text_ += ',';
  rowBegun_ = true;
  text_ += text;
  return *this;
}

CsvWriter& CsvWriter::add(double value) {
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return add(std::string_view(buffer.data(), static_cast<std::size_t>(end - buffer.data())));
}

CsvWriter& CsvWriter::add(long value) { return add(std::string_view(std::to_string(value))); }

void CsvWriter::endRow() {
  text_ += '\n';
  rowBegun_ = false;
}

std::vector<std::vector<std::string_view>> readCsv(std::string_view text) {
  std::vector<std::vector<std::string_view>> rows;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    std::vector<std::string_view> cells;
    for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
      cells.push_back(line.substr(0, comma));
      line.remove_prefix(comma + 1);
    }
    cells.push_back(line);
    rows.push_back(std::move(cells));
    if (rows.back().size() != rows.front().size())
      throw InputError("", "Row " + std::to_string(rows.size()) + " of the table has " +
                               std::to_string(rows.back().size()) + " columns, but its header has " +
                               std::to_string(rows.front().size()) + ".");
  }
  if (rows.empty()) throw InputError("", "The table has no header.");
  rows.erase(rows.begin());
  return rows;
}

namespace {

template <class Number>
Number parse(std::string_view text, const char* what) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(static_cast<double>(value)))
    throw InputError("", quote(text) + " is no " + what + ".");
  return value;
}

}  // namespace

double csvNumber(std::string_view text) { return parse<double>(text, "finite number"); }
int csvInteger(std::string_view text) { return parse<int>(text, "whole number"); }

}  // namespace pliant::scene
