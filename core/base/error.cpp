#include "core/base/error.hpp"

namespace pliant::base {

InputError::InputError(std::string location, std::string problem)
    : std::runtime_error(location.empty() ? problem : location + ": " + problem),
      location_(std::move(location)),
      problem_(std::move(problem)) {}

InputError InputError::inside(const std::string& outer) const {
  return {location_.empty() ? outer : outer + ": " + location_, problem_};
}

}  // namespace pliant::base
