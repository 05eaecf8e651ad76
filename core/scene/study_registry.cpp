#include "core/base/error.hpp"
#include "core/mechanics/drive_frequency.hpp"
#include "core/scene/bending_studies.hpp"
#include "core/scene/calibration_studies.hpp"
#include "core/scene/cloth_studies.hpp"
#include "core/scene/design_space_studies.hpp"
#include "core/scene/design_studies.hpp"
#include "core/scene/element_design_study.hpp"
#include "core/scene/harmonic_studies.hpp"
#include "core/scene/interlock_studies.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/linear_studies.hpp"
#include "core/scene/macro_studies.hpp"
#include "core/scene/resumable_study.hpp"
#include "core/scene/second_frequency.hpp"
#include "core/scene/sharded_study.hpp"
#include "core/scene/study_input.hpp"
#include "core/scene/study_specs.hpp"
#include "core/scene/time_studies.hpp"

namespace pliant::scene {

namespace {

/// A study that logs the warnings of what it returns, whatever its type.
class WarningStudy final : public Study, public ShardedStudy, public ResumableStudy {
 public:
  explicit WarningStudy(std::unique_ptr<Study> study) : study_(std::move(study)) {}

  std::string name() const override { return study_->name(); }
  std::string type() const override { return study_->type(); }
  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    return logged(study_->run(context, observe), context);
  }

  const ShardedStudy* sharded() const override { return study_->sharded() ? this : nullptr; }
  base::TerminationType runShard(const base::Shard& shard, const std::filesystem::path& file,
                                 base::ExecutionContext& context) const override {
    return study_->sharded()->runShard(shard, file, context);
  }
  std::shared_ptr<const Result> merge(const std::vector<std::filesystem::path>& files,
                                      base::ExecutionContext& context) const override {
    return logged(study_->sharded()->merge(files, context), context);
  }

  void goOnFrom(const Result& before) override {
    if (auto* study = dynamic_cast<ResumableStudy*>(study_.get())) study->goOnFrom(before);
  }

 private:
  static std::shared_ptr<const Result> logged(std::shared_ptr<const Result> result, base::ExecutionContext& context) {
    for (const std::string& warning : result->warnings()) context.log(base::Severity::warning, warning);
    return result;
  }

  std::unique_ptr<Study> study_;
};

}  // namespace

StudyRegistry::StudyRegistry()
    : factories_{{"periodic_motion", makePeriodicMotionStudy},
                 {"frequency_response", makeFrequencyResponseStudy},
                 {"backbone", makeBackboneStudy},
                 {"calibration", makeCalibrationStudy},
                 {"design", makeDesignStudy},
                 {"design_space", makeDesignSpaceStudy},
                 {"linear_modes", makeLinearModesStudy},
                 {"linear_response", makeLinearResponseStudy},
                 {"time_integration", makeTimeIntegrationStudy},
                 {"comparison", makeComparisonStudy},
                 {"cloth_motion", makeClothMotionStudy},
                 {"cloth_drape", makeClothDrapeStudy},
                 {"projection", makeProjectionStudy},
                 {"cell_test", makeCellTestStudy},
                 {"free_travel", makeFreeTravelStudy},
                 {"stretch_grid", makeStretchGridStudy},
                 {"stretch_boundary", makeStretchBoundaryStudy},
                 {"element_design", makeElementDesignStudy},
                 {"bending_test", makeBendingTestStudy},
                 {"curvature_limits", makeCurvatureLimitsStudy},
                 {"bending_size", makeBendingSizeStudy},
                 {"bending_boundary", makeBendingBoundaryStudy},
                 {"gravity_bending", makeGravityBendingStudy},
                 {"macro_equilibrium", makeMacroEquilibriumStudy},
                 {"macro_motion", makeMacroMotionStudy}} {}

const StudyRegistry& StudyRegistry::instance() {
  static const StudyRegistry registry;
  return registry;
}

const std::vector<base::ParameterSpec>& StudyRegistry::specs() const { return studySpecs(); }

std::unique_ptr<Study> StudyRegistry::make(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                           const std::string& studyName) const {
  for (const Json& options : scene.normalized()["studies"])
    if (options["name"] == studyName) {
      if (scene.normalized()["geometry"].empty() && !options.contains("cell"))
        throw base::InputError(
            scene.name() + ": /geometry", "The scene has no nodes, which the study " + quote(studyName) + " needs.");
      // The frequencies of other studies are no parameters of this one. Studies of interlocking cells need no model.
      const std::string own = placeOfStudy(scene, options) + "/frequency";
      if (model)
        model = mechanics::withoutDriveFrequencies(
            std::move(model), [&](const std::string& pointer) { return scene.name() + ": " + pointer == own; });
      checkSecondFrequency(scene, options);
      return std::make_unique<WarningStudy>(factories_.at(options["type"])(scene, std::move(model), options));
    }
  std::string known;
  for (const std::string& name : studyNames(scene)) known += (known.empty() ? "" : ", ") + quote(name);
  throw base::InputError(scene.name() + ": /studies", "There is no study " + quote(studyName) + "; the scene has " +
                                                          (known.empty() ? "none" : known) + ".");
}

std::vector<std::string> studyNames(const Scene& scene) {
  std::vector<std::string> names;
  for (const Json& study : scene.normalized()["studies"]) names.push_back(study["name"]);
  return names;
}

std::string hashScene(const Scene& scene) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  };
  add(scene.normalized().dump());
  const auto addFile = [&](const Json& entry, const char* key) {
    if (entry.contains(key)) add(readTextFile(scene.directory() / entry[key].get<std::string>()));
  };
  for (const Json& geometry : scene.normalized()["geometry"]) addFile(geometry, "path");
  for (const Json& element : scene.normalized()["elements"])
    if (element.contains("pattern")) addFile(element["pattern"], "path");
  for (const Json& body : scene.normalized()["bodies"]) addFile(body, "file");
  for (const Json& study : scene.normalized()["studies"]) {
    addFile(study, "candidate");
    for (const Json& measurement : study.value("measurements", Json::array())) addFile(measurement, "file");
    addFile(study, "polar_file");
    if (study.contains("strain_region")) addFile(study["strain_region"], "file");
    // Studies say themselves which of these they miss.
    const auto addOwnFile = [&](const Json& entry, const char* key) {
      const Json name = entry.value(key, Json());
      if (name.is_string() && std::filesystem::exists(scene.directory() / name.get<std::string>())) addFile(entry, key);
    };
    for (const char* key : {"stretch_limits", "bending_limits", "outline", "mesh"}) addOwnFile(study, key);
    for (const Json& region : study.value("regions", Json::array()))
      for (const char* key : {"stretch_limits", "bending_limits"}) addOwnFile(region, key);
    for (const Json& objective : study.value("objectives", Json::array()))
      for (const Json& path : objective.value("paths", Json::array())) addFile(path, "file");
  }
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += digits[(hash >> shift) & 15];
  return text;
}

}  // namespace pliant::scene
