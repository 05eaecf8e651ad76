#include "core/scene/element_design_study.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/element_design_result.hpp"
#include "core/scene/interlock_study.hpp"
#include "core/scene/json_text.hpp"

namespace pliant::scene {

namespace {

using base::InputError;

class ElementDesignStudy final : public InterlockStudy {
 public:
  ElementDesignStudy(const Scene& scene, const Json& options)
      : InterlockStudy(scene, options), cellIndex_(scene::cellIndex(scene, options["cell"])) {
    const auto names = studyNames(scene);
    const auto index = std::find(names.begin(), names.end(), name()) - names.begin();
    const std::string pointer = childPointer("/studies", static_cast<std::size_t>(index));
    entry_ = scene.json()["interlocking_cells"][cellIndex_];
    goals_ = elementGoals(scene, options, pointer, lateral());
    readNumbers(scene, pointer + "/parameters");
    makeProblem(scene);
  }

  std::shared_ptr<const Result> run(base::ExecutionContext& context, const ResultObserver& observe) const override {
    const base::Stopwatch watch;
    const auto resultWith = [&](const interlock::ElementDesignResult& design, base::TerminationType termination) {
      auto result = std::make_shared<ElementDesignStudyResult>();
      result->design = design;
      result->numbers = numbers_;
      result->goals = goals_;
      result->wantedClearance = problem_.clearance;
      result->cellIndex = cellIndex_;
      result->entry = entry_;
      finish(*result, termination, design.message, watch);
      return result;
    };
    std::function<void(const interlock::ElementDesignResult&)> observeDesign;
    if (observe)
      observeDesign = [&](const auto& soFar) { observe(resultWith(soFar, base::TerminationType::cancelled)); };
    interlock::ElementDesignOptions options;
    options.maximumIterations = options_["iterations"];
    options.tolerance = options_["tolerance"];
    options.firstStep = options_["first_step"];
    options.largestStep = std::max(options.largestStep, options.firstStep);
    const auto design = interlock::designElement(problem_, options, context, observeDesign);
    auto result = resultWith(design, design.termination);
    if (observe) observe(result);
    return result;
  }

 private:
  void readNumbers(const Scene& scene, const std::string& pointer) {
    const auto all = cellParameters(scene, cellIndex_);
    for (std::size_t i = 0; i < options_["parameters"].size(); ++i) {
      const Json& own = options_["parameters"][i];
      const std::string place = scene.name() + ": " + childPointer(pointer, i), name = own["name"];
      const auto found = std::find_if(all.begin(), all.end(), [&](const auto& each) { return each.name == name; });
      if (found == all.end()) {
        std::string known;
        for (const CellParameter& each : all) known += (known.empty() ? "" : ", ") + quote(each.name);
        throw InputError(place + "/name", "The material has no number " + quote(name) + "; it has " +
                                              (known.size() < 400 ? known : std::string("others")) + ".");
      }
      if (std::any_of(numbers_.begin(), numbers_.end(), [&](const auto& each) { return each.parameter.name == name; }))
        throw InputError(place + "/name", "The number " + quote(name) + " stands twice in this list.");
      DesignedNumber number{*found, own.value("minimum", std::min(found->value / 2, found->value * 2)),
                            own.value("maximum", std::max(found->value / 2, found->value * 2))};
      number.lower = std::max(number.lower, found->minimum);
      number.upper = std::min(number.upper, found->maximum);
      if (!(number.lower < number.upper))
        throw InputError(place, "The maximum must be above the minimum; where the value is 0 both are needed.");
      if (found->value < number.lower || found->value > number.upper)
        throw InputError(place, "The value of " + quote(name) + " is not between the minimum and the maximum.");
      numbers_.push_back(std::move(number));
    }
  }

  void makeProblem(const Scene& scene) {
    std::vector<CellParameter> parameters;
    for (const DesignedNumber& number : numbers_) parameters.push_back(number.parameter);
    const auto count = static_cast<Eigen::Index>(numbers_.size());
    problem_.build = cellFunction(scene, cellIndex_, parameters);
    problem_.start = valuesOf(parameters);
    problem_.lower.resize(count);
    problem_.upper.resize(count);
    problem_.steps.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& [parameter, lower, upper] = numbers_[static_cast<std::size_t>(i)];
      problem_.lower[i] = lower;
      problem_.upper[i] = upper;
      problem_.steps[i] = parameter.step;
    }
    for (const ElementGoal& goal : goals_) problem_.goals.push_back(goal.limit);
    problem_.clearance = options_["clearance"];
    problem_.equilibrium = equilibriumOptions();
    problem_.perturbation = options_["perturbation"];
    problem_.seed = options_["seed"];
    problem_.trials = options_["trials"];
  }

  std::size_t cellIndex_;
  Json entry_;
  std::vector<DesignedNumber> numbers_;
  std::vector<ElementGoal> goals_;
  interlock::ElementDesignProblem problem_;
};

}  // namespace

std::unique_ptr<Study> makeElementDesignStudy(const Scene& scene, std::shared_ptr<const mechanics::Model>,
                                              const Json& options) {
  return std::make_unique<ElementDesignStudy>(scene, options);
}

}  // namespace pliant::scene
