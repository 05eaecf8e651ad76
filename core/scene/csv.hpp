#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pliant::scene {

/// Makes a comma-separated table with units in its header. Numbers are written with as many digits as reading the same
/// number back takes. Texts must not hold commas, quotes or line breaks.
class CsvWriter {
 public:
  CsvWriter& add(std::string_view text);
  CsvWriter& add(const char* text) { return add(std::string_view(text)); }
  CsvWriter& add(double value);
  CsvWriter& add(long value);
  CsvWriter& add(int value) { return add(static_cast<long>(value)); }
  void endRow();
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool rowBegun_ = false;
};

/// The rows of a table after its header, cut at commas. Views into `text`. Throws base::InputError (location empty) if
/// there is no header or a row has another number of columns than the header.
std::vector<std::vector<std::string_view>> readCsv(std::string_view text);

/// Throws base::InputError (location empty) if `text` is no finite number.
double csvNumber(std::string_view text);
int csvInteger(std::string_view text);

}  // namespace pliant::scene
