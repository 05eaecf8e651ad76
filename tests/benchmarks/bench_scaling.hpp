#pragma once

#include "core/base/parameter_spec.hpp"

namespace pliant::bench {

/// One Newton iteration of harmonic balance (evaluation, assembly, factorisation, solution) on strips of shell of
/// growing size, with growing numbers of harmonics and samples: a row each, printed as well.
void measureNewtonIterations(base::Json& rows);

}  // namespace pliant::bench
