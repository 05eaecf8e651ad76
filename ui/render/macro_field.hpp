#pragma once

namespace pliant::render {

/// What colours a sheet of interlocking material: how near it is to its limits, 1 being at one.
enum class MacroField { nearest, stretch, bending };

}  // namespace pliant::render
