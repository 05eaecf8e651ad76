#pragma once

#include <stdexcept>
#include <string>

namespace pliant::base {

/// The user's input is wrong. `location` says where (a JSON pointer such as `/elements/0/thickness`, a file, or both as
/// `FILE: POINTER`; empty if unknown), `problem` is one sentence that says what was found and what was expected.
class InputError : public std::runtime_error {
 public:
  InputError(std::string location, std::string problem);

  const std::string& location() const noexcept { return location_; }
  const std::string& problem() const noexcept { return problem_; }

  /// The same error, found inside `outer` (a file name, say).
  InputError inside(const std::string& outer) const;

 private:
  std::string location_;
  std::string problem_;
};

}  // namespace pliant::base
