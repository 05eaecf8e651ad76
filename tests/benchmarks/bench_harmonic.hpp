#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::bench {

/// Every motion and curve of every scene in scenes/harmonic, timed, with the part of the time that its evaluations,
/// factorisations and solves took.
base::Json measureHarmonic();

}  // namespace pliant::bench
