#include "core/scene/interlock_head.hpp"

#include <algorithm>

#include "core/scene/interlock_builder.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

using base::InputError;

base::TerminationType limitTerminationNamed(std::string_view name) {
  for (const auto type : {base::TerminationType::converged, base::TerminationType::cancelled,
                          base::TerminationType::iterationLimit, base::TerminationType::infeasible})
    if (base::toString(type) == name) return type;
  return base::TerminationType::failed;
}

Json readInterlockHead(const Scene& scene, const std::filesystem::path& directory, std::string_view type,
                       InterlockResult& result) {
  Json summary = parseJson(readTextFile(directory / "summary.json"));
  const std::string name = summary.at("cell");
  const Json& cells = scene.normalized().at("interlocking_cells");
  if (summary.at("type") != type ||
      std::none_of(cells.begin(), cells.end(), [&](const Json& cell) { return cell.at("name") == name; }))
    throw InputError(directory.string(), "This is no result of a " + std::string(type) + " study of this scene.");
  result.cell = std::make_shared<const interlock::UnitCell>(buildCell(scene, name));
  result.termination = limitTerminationNamed(summary.at("termination").get<std::string>());
  result.message = summary.at("message");
  result.seconds = summary.at("seconds");
  const Json& from = summary.at("provenance");
  result.provenance = {
      from.at("version"), from.at("scene"), from.at("scene_hash"), summary.at("study"), from.at("options")};
  return summary;
}

}  // namespace pliant::scene
