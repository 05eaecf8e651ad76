#include "core/scene/study_specs.hpp"

#include "core/scene/spec_builder.hpp"

namespace pliant::scene {
namespace {

using namespace spec;
namespace dimensions = base::dimensions;

ParameterSpec frequency(std::string key, std::string symbol, std::string description) {
  return positive(number(std::move(key), std::move(symbol), std::move(description), dimensions::angularFrequency));
}

/// `own` keys between the study's name and the options that every harmonic-balance study has.
ParameterSpec harmonicStudy(std::string type, std::string description, std::vector<ParameterSpec> own,
                            std::vector<ParameterSpec> last) {
  std::vector<ParameterSpec> keys{name()};
  keys.insert(keys.end(), own.begin(), own.end());
  keys.push_back(withDefault(integer("harmonics", "H", "Harmonics of the motion.", 1, 200), 5));
  keys.push_back(withDefault(
      integer("samples", "N", "Samples of a period at which forces are evaluated; at least 2 H + 1.", 3, 8192), 64));
  keys.push_back(withDefault(
      positive(
          number("tolerance", "",
                 "Residual force, relative to the driving force, at which Newton's method stops. It also stops where "
                 "the motion changes by less than 1e-10 of its swing.",
                 dimensions::none)),
      1e-8));
  keys.push_back(withDefault(integer("maximum_iterations", "", "Newton iterations for one solution.", 1, 10'000), 40));
  keys.push_back(
      withDefault(integer("maximum_ramp_steps", "",
                          "Steps in which the drive may be raised where Newton's method fails from rest.", 1, 10'000),
                  64));
  keys.push_back(
      withDefault(choice("stability", "Whether to find the stability of each motion, and the bifurcations of a curve.",
                         {"on", "off"}),
                  "on"));
  keys.insert(keys.end(), last.begin(), last.end());
  return object(std::move(type), std::move(description), std::move(keys));
}

ParameterSpec step(std::string key, std::string description) {
  return optional(positive(number(std::move(key), "", std::move(description), dimensions::none)));
}

}  // namespace

const std::vector<ParameterSpec>& studySpecs() {
  static const std::vector<ParameterSpec> specs{
      harmonicStudy("periodic_motion",
                    "The periodic motion at one driving frequency, and how it depends on each design parameter.",
                    {frequency("frequency", "ω", "Driving frequency.")},
                    {optional(positive(
                         number("harmonics_tolerance", "",
                                "Raise the harmonics until no probe's trajectory changes by more than this fraction "
                                "of its length.",
                                dimensions::none))),
                     withDefault(integer("maximum_harmonics", "", "Where raising the harmonics ends.", 1, 200), 25)}),
      harmonicStudy(
          "frequency_response", "The curve of all periodic motions between two driving frequencies, through folds.",
          {frequency("from", "ω_1", "Where the curve starts."),
           frequency("to", "ω_2", "Where it ends; may be below \"from\".")},
          {step("initial_step", "First step along the curve, in the scaled arc length; chosen if left out."),
           step("minimum_step", "Smallest step before giving up; chosen if left out."),
           step("maximum_step", "Largest step; chosen if left out."),
           withDefault(integer("maximum_points", "", "Most points on the curve.", 2, 100'000), 2000),
           withDefault(
               positive(number("location_tolerance", "",
                               "Relative error of the frequency of folds, peaks and bifurcations.", dimensions::none)),
               1e-6)}),
      object("linear_modes",
             "Natural frequencies and modes of the model linearised about its static equilibrium, driven nodes held.",
             {name(), withDefault(integer("count", "", "Modes, from the lowest frequency upwards.", 1, 1000), 6)})};
  return specs;
}

}  // namespace pliant::scene
