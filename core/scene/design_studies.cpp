#include "core/scene/design_studies.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/mechanics/joint_parameter.hpp"
#include "core/mechanics/stiffness_factor.hpp"
#include "core/scene/design_constraint_reading.hpp"
#include "core/scene/design_result.hpp"
#include "core/scene/harmonic_studies.hpp"
#include "core/scene/input_error_location.hpp"
#include "core/scene/json_text.hpp"
#include "core/scene/resonance_goals.hpp"
#include "core/scene/run_information.hpp"
#include "core/scene/study_input.hpp"
#include "core/scene/target_path.hpp"

namespace pliant::scene {

using base::InputError;
using mechanics::Matrix;
using mechanics::Model;

namespace {

/// What the options of a design study mean for the scene's model.
class DesignReader {
 public:
  DesignReader(const Scene& scene, Model& model, const Json& options)
      : scene_(scene), model_(model), options_(options) {
    place_ = placeOfStudy(scene, options);
  }

  /// Indices of those that may change; adds factors of stiffness to the model's parameters.
  std::vector<int> parameters() {
    std::vector<int> chosen;
    if (options_.contains("parameters"))
      for (std::size_t i = 0; i < options_["parameters"].size(); ++i)
        chosen.push_back(parameterNamed(model_, options_["parameters"], i, place_ + "/parameters"));
    if (options_.contains("stiffness_factors"))
      for (std::size_t i = 0; i < options_["stiffness_factors"].size(); ++i) addFactors(i, chosen);
    if (!options_.contains("parameters") && !options_.contains("stiffness_factors"))
      for (std::size_t i = 0; i < model_.parameters.size(); ++i) chosen.push_back(static_cast<int>(i));
    if (chosen.empty()) throw InputError(place_, "The scene has no parameters that could change.");
    return chosen;
  }

  std::shared_ptr<const harmonic::DesignObjective> objective(const std::vector<int>& parameters,
                                                             std::vector<harmonic::PathGoal>& paths) const {
    std::vector<harmonic::WeightedObjective> terms;
    for (std::size_t i = 0; i < options_["objectives"].size(); ++i) {
      const Json& entry = options_["objectives"][i];
      terms.push_back(
          {entry["weight"], objectiveOf(entry, childPointer(place_ + "/objectives", i), parameters, paths)});
    }
    return harmonic::makeWeightedSum(std::move(terms));
  }

 private:
  void addFactors(std::size_t index, std::vector<int>& chosen) {
    const Json& entry = options_["stiffness_factors"][index];
    const std::string place = childPointer(place_ + "/stiffness_factors", index);
    if (!(entry["minimum"] < entry["maximum"]))
      throw InputError(place + "/maximum", "The maximum must be above the minimum.");
    const auto [element, energy] = energyOf(entry["element"], place + "/element");
    mechanics::StiffnessFactorOptions factors;
    factors.name = entry["element"];
    factors.pointer = childPointer("/elements", element) + "/stiffness_factors";
    factors.values = scene_.normalized()["elements"][element]["stiffness_factors"].get<std::vector<double>>();
    factors.minimum = entry["minimum"];
    factors.maximum = entry["maximum"];
    auto made = mechanics::makeStiffnessFactors(model_, energy, factors);
    mechanics::Vector initial(static_cast<Eigen::Index>(made.size()));
    for (std::size_t i = 0; i < made.size(); ++i) {
      double& value = initial[static_cast<Eigen::Index>(i)];
      value = entry.contains("initial") ? entry["initial"].get<double>() : made[i]->value(model_);
      if (value < factors.minimum || value > factors.maximum)
        throw InputError(place, "A factor starts from " + std::to_string(value) +
                                    ", which is not between the minimum and the maximum.");
    }
    model_ = mechanics::withParameterValues(model_, made, initial);
    for (auto& parameter : made) {
      chosen.push_back(static_cast<int>(model_.parameters.size()));
      model_.parameters.push_back(std::move(parameter));
    }
  }

  /// The index of an element by its name, and of the energy that it became: elements become energies in their order.
  std::pair<std::size_t, int> energyOf(const std::string& name, const std::string& place) const {
    const Json& elements = scene_.normalized()["elements"];
    std::map<std::string, int> ordinals;  // of energies by their name
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const std::string type = elements[i]["type"];
      const std::string kind = type == "shell" ? "membrane" : type;
      const int ordinal = ordinals[kind]++;
      if (elements[i]["name"] != name) continue;
      if (type != "membrane" && type != "solid")
        throw InputError(place, "Only membranes and solids can have a factor of stiffness for each element.");
      for (std::size_t energy = 0, seen = 0; energy < model_.energies.size(); ++energy)
        if (model_.energies[energy]->name() == kind && seen++ == static_cast<std::size_t>(ordinal))
          return {i, static_cast<int>(energy)};
    }
    throw InputError(place, "There is no such element.");
  }

  int nodeOf(const Json& probe) const {
    return std::find_if(model_.probes.begin(), model_.probes.end(),
                        [&](const mechanics::Probe& p) { return p.name == probe.get_ref<const std::string&>(); })
        ->node;
  }

  std::shared_ptr<const harmonic::DesignObjective> objectiveOf(const Json& entry, const std::string& place,
                                                               const std::vector<int>& parameters,
                                                               std::vector<harmonic::PathGoal>& paths) const {
    if (entry["type"] == "amplitude") return amplitudeObjective(entry, place);
    if (entry["type"] == "path") return harmonic::makePathObjective(paths.emplace_back(pathGoal(entry, place)));
    if (auto goal = resonanceGoal(entry, place, model_, options_)) return goal;
    mechanics::Vector reference(static_cast<Eigen::Index>(parameters.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i)
      reference[static_cast<Eigen::Index>(i)] =
          model_.parameters[static_cast<std::size_t>(parameters[i])]->value(model_);
    return harmonic::makeParameterRegularization(parameters, std::move(reference));
  }

  std::shared_ptr<const harmonic::DesignObjective> amplitudeObjective(const Json& entry,
                                                                      const std::string& place) const {
    harmonic::AmplitudeGoal goal;
    for (const Json& probe : entry["probes"]) goal.nodes.push_back(nodeOf(probe));
    if (entry.contains("target")) goal.target = entry["target"].get<double>();
    for (const Json& axis : entry.value("axes", Json::array())) {
      goal.axes.push_back(axis.get_ref<const std::string&>()[0] - 'x');
      if (goal.axes.back() >= model_.dimension)
        throw InputError(place + "/axes", "There is no axis " + quote(axis.get<std::string>()) +
                                              " because the scene's dimension is " + std::to_string(model_.dimension) +
                                              ".");
    }
    return harmonic::makeAmplitudeObjective(std::move(goal));
  }

  harmonic::PathGoal pathGoal(const Json& entry, const std::string& place) const {
    harmonic::PathGoal goal;
    goal.matchPlace = entry["match_place"];
    goal.sharpness = entry["sharpness"];
    goal.phases = entry["phases"];
    double swing = 0;
    for (const Json& path : entry["paths"]) {
      const Matrix points = targetPlaces(scene_, path, model_.dimension);
      goal.paths.push_back({nodeOf(path["probe"]), harmonic::pathCoefficients(points, options_["harmonics"])});
      const mechanics::Vector middle = points.rowwise().mean();
      swing += (points.colwise() - middle).squaredNorm();
    }
    if (!(swing > 0)) throw InputError(place + "/paths", "Paths must not be single points.");
    return goal;
  }

  const Scene& scene_;
  Model& model_;
  const Json& options_;
  std::string place_;
};

class DesignStudy final : public Study {
 public:
  DesignStudy(const Scene& scene, const std::shared_ptr<const Model>& model, const Json& options)
      : options_(options), provenance_(provenanceOf(scene, options)) {
    requireModestSize(scene, model, name(), "harmonics", options["harmonics"]);
    auto designed = std::make_shared<Model>(*model);
    DesignReader reader(scene, *designed, options_);
    parameters_ = reader.parameters();
    objective_ = reader.objective(parameters_, paths_);
    if (options_.contains("constraints"))
      constraints_ = readDesignConstraints(
          scene, *designed, options_["constraints"], placeOfStudy(scene, options_) + "/constraints");
    model_ = std::move(designed);
  }

  std::string name() const override { return options_["name"]; }
  std::string type() const override { return options_["type"]; }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    constexpr double secondsBetweenSnapshots = 0.05;
    const base::Stopwatch watch;
    base::Stopwatch sinceSnapshot;
    auto result = std::make_shared<DesignResult>();
    result->provenance = provenance_;
    result->omega = options_["frequency"];
    result->harmonics = options_["harmonics"];
    result->samples = options_["samples"];
    result->parameters = parameters_;
    result->paths = paths_;
    const auto onIterate = [&](const harmonic::DesignIterate& design) {
      if (design.iteration == 0) result->design.history.clear();  // another start
      result->design.history.push_back(design);
      result->design.evaluations = design.evaluations;
      result->design.solves = design.solves;
      if (!observe || sinceSnapshot.seconds() < secondsBetweenSnapshots) return;
      sinceSnapshot = {};
      auto snapshot = std::make_shared<DesignResult>(*result);
      snapshot->seconds = watch.seconds();
      observe(std::move(snapshot));
    };
    harmonic::HarmonicBalanceProblem problem(model_, math::HarmonicBasis(result->harmonics, result->samples));
    if (const int starts = options_["starts"]; starts > 1) {
      auto all = harmonic::designFromSeveralStarts(
          problem, *objective_, constraints_, designOptions(), starts, options_["seed"], context, onIterate);
      result->design = std::move(all.found.design);
      if (!constraints_.empty())
        result->constraints = {constraints_, std::move(all.found.states), std::move(all.found.optimality)};
      result->starts = std::move(all.starts);
      result->bestStart = all.best;
    } else if (constraints_.empty()) {
      result->design = harmonic::designInversely(std::move(problem), *objective_, designOptions(), context, onIterate);
    } else {
      auto found = harmonic::designWithConstraints(
          std::move(problem), *objective_, constraints_, designOptions(), context, onIterate);
      result->design = std::move(found.design);
      result->constraints = {constraints_, std::move(found.states), std::move(found.optimality)};
    }
    result->termination = result->design.report.termination;
    result->message = result->design.report.message;
    if (options_["stability"] == "on" && !result->design.history.empty() && !context.cancelRequested()) {
      const auto last = result->motionOf(result->after());
      result->stability =
          harmonic::floquetStability(*last->problem, result->after().z, result->omegaOf(result->after()));
    }
    result->seconds = watch.seconds();
    if (observe) observe(result);
    return result;
  }

 private:
  harmonic::InverseDesignOptions designOptions() const {
    harmonic::InverseDesignOptions design;
    design.omega = options_["frequency"];
    design.parameters = parameters_;
    design.motion.tolerance = options_["tolerance"];
    design.motion.maximumIterations = options_["maximum_iterations"];
    design.motion.maximumRampSteps = options_["maximum_ramp_steps"];
    design.motion.startScale = options_["start_scale"];
    design.optimizer.maximumIterations = options_["iterations"];
    design.optimizer.valueTolerance = options_["objective_tolerance"];
    design.optimizer.gradientTolerance = options_["gradient_tolerance"];
    design.optimizer.firstStep = options_["first_step"];
    design.optimizer.maximumStep = options_["largest_step"];
    return design;
  }

  Json options_;
  Provenance provenance_;
  std::shared_ptr<const Model> model_;
  std::vector<int> parameters_;
  std::vector<harmonic::PathGoal> paths_;
  std::shared_ptr<const harmonic::DesignObjective> objective_;
  std::vector<harmonic::DesignConstraint> constraints_;
};

}  // namespace

std::unique_ptr<Study> makeDesignStudy(const Scene& scene, std::shared_ptr<const mechanics::Model> model,
                                       const Json& options) {
  return std::make_unique<DesignStudy>(scene, model, options);
}

}  // namespace pliant::scene
