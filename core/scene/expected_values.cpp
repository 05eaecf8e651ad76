#include "core/scene/expected_values.hpp"

#include <cmath>
#include <limits>

namespace pliant::scene {

bool ExpectedValue::holds() const { return std::abs(found - expected) <= tolerance; }

std::vector<ExpectedValue> compareWithExpected(const Scene& scene, const std::string& study, const Json& summary) {
  std::vector<ExpectedValue> values;
  for (const Json& entry : scene.normalized()["expected"]) {
    if (entry["study"] != study) continue;
    ExpectedValue value{entry["pointer"], entry["value"]};
    value.tolerance = entry.contains("tolerance")
                          ? entry["tolerance"].get<double>()
                          : entry["relative_tolerance"].get<double>() * std::abs(value.expected);
    const Json::json_pointer pointer(value.pointer);
    const bool isNumber = summary.contains(pointer) && summary[pointer].is_number();
    value.found = isNumber ? summary[pointer].get<double>() : std::numeric_limits<double>::quiet_NaN();
    values.push_back(value);
  }
  return values;
}

}  // namespace pliant::scene
