#include "core/scene/element_table.hpp"

#include "core/base/error.hpp"
#include "core/scene/csv.hpp"
#include "core/scene/csv_table.hpp"

namespace pliant::scene {

namespace {
constexpr std::array<const char*, 3> axes{"x", "y", "z"};
}

std::string elementTable(const interlock::CellState& state) {
  CsvWriter csv;
  csv.add("element").add("x [m]").add("y [m]").add("z [m]");
  for (const char* row : axes)
    for (const char* column : axes) csv.add(std::string("rotation_") + row + column);
  csv.endRow();
  for (std::size_t i = 0; i < state.rotations.size(); ++i) {
    csv.add(static_cast<long>(i));
    for (int row = 0; row < 3; ++row) csv.add(state.positions(row, static_cast<Eigen::Index>(i)));
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) csv.add(state.rotations[i](row, column));
    csv.endRow();
  }
  return csv.text();
}

interlock::CellState readElementTable(const std::filesystem::path& file, const interlock::UnitCell& cell) {
  const CsvTable table(file);
  if (table.size() != cell.elements.size())
    throw base::InputError(file.string(), "There are " + std::to_string(table.size()) +
                                              " elements, but there should be " + std::to_string(cell.elements.size()) +
                                              "; run the study again.");
  interlock::CellState state = interlock::restState(cell);
  for (std::size_t i = 0; i < table.size(); ++i)
    for (int row = 0; row < 3; ++row) {
      const std::string name = axes[static_cast<std::size_t>(row)];
      state.positions(row, static_cast<Eigen::Index>(i)) = table.number(i, name + " [m]");
      for (int column = 0; column < 3; ++column)
        state.rotations[i](row, column) = table.number(i, "rotation_" + name + axes[static_cast<std::size_t>(column)]);
    }
  return state;
}

}  // namespace pliant::scene
