#pragma once

#include <vector>

#include "core/base/parameter_spec.hpp"

namespace pliant::scene {

/// "path": keyframes.
base::ParameterSpec motionSpec(std::string description);
/// Entries of "seams".
base::ParameterSpec seamSpecs();
/// Entries of "stretch_limits".
base::ParameterSpec stretchLimitSpecs();
/// Entries of "bodies".
base::ParameterSpec bodySpecs();
/// The object "contact".
base::ParameterSpec contactSpec();
/// Of "boundary_conditions": nodes that are held, moved and let go.
base::ParameterSpec pinSpec();
/// Of "loads".
base::ParameterSpec windSpec();
/// Of shells and membranes: another rest shape than where the geometry starts.
base::ParameterSpec patternSpec();
/// The kinds of studies of cloth.
std::vector<base::ParameterSpec> clothStudySpecs();

}  // namespace pliant::scene
