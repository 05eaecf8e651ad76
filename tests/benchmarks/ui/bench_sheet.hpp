#pragma once

#include "core/scene/json_text.hpp"

namespace pliant::bench {

/// Adds rows for a camera that is turned around a large piece of interlocking material, by the mouse, in a viewport of
/// 900 x 560: as a sheet of 10,584 triangles, and as placed elements; and for the still picture after it.
void measureSheets(base::Json& rows);

}  // namespace pliant::bench
