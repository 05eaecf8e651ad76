#pragma once

#include "core/scene/cell_parameters.hpp"
#include "core/scene/element_goals.hpp"
#include "core/scene/interlock_result.hpp"

namespace pliant::scene {

/// A number that a design of an element may change.
struct DesignedNumber {
  CellParameter parameter;
  double lower, upper;
};

/// The way from a scene's element to one whose limits are nearer to those wanted: "element_design".
class ElementDesignStudyResult final : public InterlockResult {
 public:
  Json summary() const override;
  /// summary.json, history.csv (a row an element), parameters.csv, limits.csv (a row a wanted limit), element.json (the
  /// entry of "interlocking_cells" that was found).
  void write(const std::filesystem::path& directory) const override;
  std::vector<std::string> warnings() const override;

  interlock::ElementDesignResult design;
  std::vector<DesignedNumber> numbers;
  std::vector<ElementGoal> goals;
  double wantedClearance = 0;  ///< [m]
  std::size_t cellIndex = 0;   ///< in "interlocking_cells"
  Json entry;                  ///< of the material as it is written in the scene
};

/// What ended a design, in words.
std::string_view nameOf(interlock::DesignEnd end);

/// The entry with an iterate's values.
Json designedEntry(const ElementDesignStudyResult& result, const interlock::ElementIterate& element);

/// `scene`, as JSON, with an iterate's values in its material. Throws base::InputError if the scene has changed so that
/// a number has no place in it.
Json designedElementScene(const Scene& scene, const ElementDesignStudyResult& result,
                          const interlock::ElementIterate& element);

}  // namespace pliant::scene
