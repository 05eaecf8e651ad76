#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pliant::scene {

/// A comma-separated table read from a file, cells by row and by the column's name. Everything throws base::InputError
/// with the file as location.
class CsvTable {
 public:
  explicit CsvTable(const std::filesystem::path& file);

  std::size_t size() const { return rows_.size(); }
  bool has(std::string_view column) const;
  std::string_view text(std::size_t row, std::string_view column) const;
  double number(std::size_t row, std::string_view column) const;
  int integer(std::size_t row, std::string_view column) const;

 private:
  std::filesystem::path file_;
  std::string text_;
  std::vector<std::vector<std::string_view>> rows_;  ///< into text_
  std::vector<std::string> names_;
};

}  // namespace pliant::scene
