#pragma once

#include <filesystem>

#include "core/interlock/cell_contact.hpp"

namespace pliant::scene {

/// elements.csv: where the elements of a state are, a row an element.
std::string elementTable(const interlock::CellState& state);

/// A state that was written so, without its strain. Throws base::InputError if the cell has another number of elements.
interlock::CellState readElementTable(const std::filesystem::path& file, const interlock::UnitCell& cell);

}  // namespace pliant::scene
