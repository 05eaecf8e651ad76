#include "core/scene/csv_table.hpp"

#include <algorithm>
#include <sstream>

#include "core/base/error.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

namespace {

/// What `read` gives, its errors with the file as location.
template <class Read>
auto readingFile(const std::filesystem::path& file, const Read& read) {
  try {
    return read();
  } catch (const base::InputError& error) {
    throw base::InputError(file.string(), error.problem());
  }
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& file)
    : file_(file), text_(readTextFile(file)), rows_(readingFile(file, [this] { return readCsv(text_); })) {
  std::istringstream header(text_.substr(0, text_.find('\n')));
  for (std::string name; std::getline(header, name, ',');) names_.push_back(name);
}

bool CsvTable::has(std::string_view column) const {
  return std::find(names_.begin(), names_.end(), column) != names_.end();
}

std::string_view CsvTable::text(std::size_t row, std::string_view column) const {
  const auto found = std::find(names_.begin(), names_.end(), column);
  if (found == names_.end())
    throw base::InputError(file_.string(), "This table has no column " + quote(std::string(column)) + ".");
  return rows_.at(row).at(static_cast<std::size_t>(found - names_.begin()));
}

double CsvTable::number(std::size_t row, std::string_view column) const {
  return readingFile(file_, [&] { return csvNumber(text(row, column)); });
}

int CsvTable::integer(std::size_t row, std::string_view column) const {
  return readingFile(file_, [&] { return csvInteger(text(row, column)); });
}

}  // namespace pliant::scene
