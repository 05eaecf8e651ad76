#include "core/scene/macro_study.hpp"

#include <algorithm>

#include "core/scene/json_text.hpp"
#include "core/scene/macro_placement.hpp"

namespace pliant::scene {

using Eigen::Index;

namespace {

std::string placeOfStudy(const Scene& scene, const std::string& name) {
  const std::vector<std::string> names = studyNames(scene);
  const auto number = std::find(names.begin(), names.end(), name) - names.begin();
  return childPointer(scene.name() + ": /studies", static_cast<std::size_t>(number));
}

}  // namespace

MacroStudy::MacroStudy(const Scene& scene, const Json& options)
    : InterlockStudy(scene, options),
      scene_(scene),
      place_(placeOfStudy(scene, options["name"])),
      builder_(scene_, options_, place_) {}

std::shared_ptr<MacroResult> MacroStudy::begin(interlock::MacroSheet& sheet, base::ExecutionContext& context) const {
  auto result = std::make_shared<MacroResult>();
  result->cell = options_["elements"] ? placedCell(scene_, options_, place_, cell_) : cell_;
  sheet = builder_.sheet(*cell_, begun(), context);
  result->sheet = std::make_shared<const interlock::MacroSheet>(sheet);
  result->bodies = builder_.contact().bodies;
  return result;
}

void MacroStudy::judgeNothing(MacroResult& result) {
  const auto count = static_cast<Index>(result.sheet->mesh.triangles.size());
  result.state.positions = result.sheet->mesh.points.reshaped();
  result.state.strains.stretch.setZero(3, count);
  result.state.strains.curvature.setZero(3, count);
  result.state.stretchGauge.setZero(count);
  result.state.bendingGauge.setZero(count);
  result.deflections.resize(3, 0);
}

}  // namespace pliant::scene
