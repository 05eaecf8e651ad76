#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// Kinds of entries of "interlocking_cells".
std::vector<base::ParameterSpec> interlockingCellSpecs();
/// Studies of interlocking cells.
std::vector<base::ParameterSpec> interlockStudySpecs();
/// "friction" of a study.
base::ParameterSpec frictionKey();

}  // namespace pliant::scene
