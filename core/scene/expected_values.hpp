#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace pliant::scene {

/// One entry of the scene's "expected" beside what a study gave.
struct ExpectedValue {
  std::string pointer;  ///< into summary.json
  double expected = 0;
  double tolerance = 0;  ///< largest difference
  double found = 0;      ///< NaN if the summary has no number there
  bool holds() const;
};

/// The scene's expected values of one study, compared with its summary.
std::vector<ExpectedValue> compareWithExpected(const Scene& scene, const std::string& study, const Json& summary);

}  // namespace pliant::scene
