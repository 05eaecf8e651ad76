#pragma once

#include <vector>

#include "core/scene/expected_values.hpp"

/// What `run` and `merge` say about results, on standard output.
namespace pliant::cli {

/// The numbers of a summary.json that a person would want first.
void printSummary(const scene::Json& summary);
/// How many values are as expected, and those that are not.
void printExpected(const std::vector<scene::ExpectedValue>& values);

}  // namespace pliant::cli
