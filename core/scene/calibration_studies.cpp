#include "core/scene/calibration_studies.hpp"

#include "core/base/stopwatch.hpp"
#include "core/scene/calibration_result.hpp"
#include "core/scene/harmonic_studies.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/measurement_file.hpp"
#include "core/scene/run_information.hpp"
#include "core/scene/study_input.hpp"

namespace pliant::scene {

namespace {

harmonic::MeasuredValue measuredValueNamed(const std::string& name) {
  if (name == "displacements") return harmonic::MeasuredValue::displacement;
  return name == "swings" ? harmonic::MeasuredValue::swing : harmonic::MeasuredValue::position;
}

class CalibrationStudy final : public Study {
 public:
  CalibrationStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model, const Json& options)
      : model_(std::move(model)),
        options_(options),
        provenance_(provenanceOf(scene, options)),
        place_(placeOfStudy(scene, options)) {
    requireModestSize(scene, model_, name(), "harmonics", options["harmonics"]);
    for (std::size_t i = 0; i < options["parameters"].size(); ++i)
      parameters_.push_back(parameterNamed(*model_, options["parameters"], i, place_ + "/parameters"));
    for (const Json& entry : options["measurements"]) {
      std::vector<int> axes;
      for (const Json& axis : entry.value("axes", Json::array()))
        axes.push_back(axis.get_ref<const std::string&>()[0] - 'x');
      harmonic::MeasuredMotion motion =
          readMeasurement(scene.directory() / entry["file"].get<std::string>(), *model_, axes);
      motion.omega = entry["frequency"];
      motion.meaning = measuredValueNamed(entry["values"]);
      if (entry.contains("time_offset")) motion.timeOffset = entry["time_offset"].get<double>();
      measured_.push_back(std::move(motion));
    }
  }

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    auto result = std::make_shared<CalibrationStudyResult>();
    result->provenance = provenance_;
    result->harmonics = options_["harmonics"];
    result->samples = options_["samples"];
    result->confidence = options_["confidence"];
    result->measured = measured_;
    for (const Json& entry : options_["measurements"]) result->files.push_back(entry["file"]);
    const harmonic::HarmonicBalanceProblem problem(model_, math::HarmonicBasis(result->harmonics, result->samples));
    locate(
        place_, [&] { result->calibration = harmonic::calibrate(problem, measured_, calibrationOptions(), context); });
    result->termination = result->calibration.report.termination;
    result->message = result->calibration.report.message;
    if (options_["stability"] == "on" && !result->calibration.history.empty()) addStabilities(*result, context);
    result->seconds = watch.seconds();
    if (observe) observe(result);
    return result;
  }

 private:
  harmonic::CalibrationOptions calibrationOptions() const {
    harmonic::CalibrationOptions calibration;
    calibration.parameters = parameters_;
    calibration.level = options_["confidence"];
    calibration.motion.tolerance = options_["tolerance"];
    calibration.motion.maximumIterations = options_["maximum_iterations"];
    calibration.motion.maximumRampSteps = options_["maximum_ramp_steps"];
    calibration.motion.startScale = options_["start_scale"];
    calibration.fit.maximumIterations = options_["iterations"];
    calibration.fit.maximumStep = options_["largest_step"];
    return calibration;
  }

  static void addStabilities(CalibrationStudyResult& result, const base::ExecutionContext& context) {
    const harmonic::HarmonicBalanceProblem fitted(
        result.calibration.after, math::HarmonicBasis(result.harmonics, result.samples));
    for (std::size_t i = 0; i < result.measured.size(); ++i)
      result.stabilities.push_back(
          context.cancelRequested()
              ? harmonic::Stability{}
              : harmonic::floquetStability(fitted, result.calibration.motions[i].z, result.measured[i].omega));
  }

  std::shared_ptr<const mechanics::Model> model_;
  Json options_;
  Provenance provenance_;
  std::string place_;
  std::vector<int> parameters_;
  std::vector<harmonic::MeasuredMotion> measured_;
};

}  // namespace

std::unique_ptr<Study> makeCalibrationStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                            const Json& options) {
  return std::make_unique<CalibrationStudy>(scene, std::move(model), options);
}

}  // namespace pliant::scene
