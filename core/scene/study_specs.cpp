#include "core/scene/study_specs.hpp"

#include "core/scene/bending_specs.hpp"
#include "core/scene/calibration_specs.hpp"
#include "core/scene/cloth_specs.hpp"
#include "core/scene/design_space_specs.hpp"
#include "core/scene/design_specs.hpp"
#include "core/scene/interlock_specs.hpp"
#include "core/scene/macro_specs.hpp"
#include "core/scene/spec_builder.hpp"

namespace pliant::scene {
namespace {

using namespace spec;
namespace dimensions = base::dimensions;

ParameterSpec frequency(std::string key, std::string symbol, std::string description) {
  return positive(number(std::move(key), std::move(symbol), std::move(description), dimensions::angularFrequency));
}

ParameterSpec secondFrequency() {
  return optional(frequency("second_frequency", "ω_2",
                            "A second driving frequency that has no period in common with the first: the motion never "
                            "repeats. \"harmonics\" are then the largest |k_1| + |k_2| of its frequencies "
                            "k_1 ω + k_2 ω_2, and \"samples\" those of a period of each frequency, so N² in all: "
                            "4 H + 1 are enough."));
}

ParameterSpec frequencyRatio() {
  return optional(positive(number("frequency_ratio", "r",
                                  "There is a second driving frequency, r times the first all along the curve, with "
                                  "no period in common; \"harmonics\" and \"samples\" are as in periodic_motion.",
                                  dimensions::none)));
}

ParameterSpec harmonics() { return withDefault(integer("harmonics", "H", "Harmonics of the motion.", 1, 200), 5); }

ParameterSpec samples() {
  return withDefault(
      integer("samples", "N", "Samples of a period at which forces are evaluated; at least 2 H + 1.", 3, 8192), 64);
}

ParameterSpec from() { return frequency("from", "ω_1", "Where the curve starts."); }
ParameterSpec to() { return frequency("to", "ω_2", "Where it ends; may be below \"from\"."); }

ParameterSpec locationTolerance(std::string description) {
  return withDefault(positive(number("location_tolerance", "", std::move(description), dimensions::none)), 1e-6);
}

ParameterSpec maximumPeriods() {
  return withDefault(
      integer("maximum_periods", "", "Periods after which the integration gives up.", 2, 1'000'000), 1000);
}

ParameterSpec periodTolerance() {
  return withDefault(positive(number("tolerance", "",
                                     "Difference between successive periods, e_p per time step, relative to the swing, "
                                     "at which the motion counts as periodic.",
                                     dimensions::none)),
                     1e-7);
}

/// `own` keys between the study's name and the options that every harmonic-balance study has.
ParameterSpec harmonicStudy(std::string type, std::string description, std::vector<ParameterSpec> own,
                            std::vector<ParameterSpec> last) {
  std::vector<ParameterSpec> keys{name()};
  keys.insert(keys.end(), own.begin(), own.end());
  keys.push_back(harmonics());
  keys.push_back(samples());
  keys.push_back(withDefault(
      positive(
          number("tolerance", "",
                 "Residual force, relative to the driving force, at which Newton's method stops. It also stops where "
                 "the motion changes by less than 1e-10 of its swing.",
                 dimensions::none)),
      1e-8));
  keys.push_back(withDefault(integer("maximum_iterations", "", "Newton iterations for one solution.", 1, 10'000), 40));
  keys.insert(keys.end(), last.begin(), last.end());
  return object(std::move(type), std::move(description), std::move(keys));
}

/// How the first motion of studies of driven motions is found.
std::vector<ParameterSpec> startKeys() {
  return {
      withDefault(integer("maximum_ramp_steps", "",
                          "Steps in which the drive may be raised where Newton's method fails from rest.", 1, 10'000),
                  64),
      withDefault(
          number("start_scale", "",
                 "Factor on the linear response that the first motion is sought from. Where there are several "
                 "motions, others than 1, also negative ones, lead to others: to an isolated curve, for example.",
                 dimensions::none),
          1)};
}

/// What studies of driven motions have as well, before their `own` last keys.
std::vector<ParameterSpec> drivenKeys(const std::vector<ParameterSpec>& own) {
  std::vector<ParameterSpec> keys = startKeys();
  keys.push_back(
      withDefault(choice("stability", "Whether to find the stability of each motion, and the bifurcations of a curve.",
                         {"on", "off"}),
                  "on"));
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

ParameterSpec step(std::string key, std::string description) {
  return optional(positive(number(std::move(key), "", std::move(description), dimensions::none)));
}

}  // namespace

const std::vector<ParameterSpec>& studySpecs() {
  static const std::vector<ParameterSpec> specs = [] {
    std::vector<ParameterSpec> all{
        harmonicStudy(
            "periodic_motion",
            "The periodic motion at one driving frequency, and how it depends on each design parameter.",
            {frequency("frequency", "ω", "Driving frequency."), secondFrequency()},
            drivenKeys(
                {optional(positive(
                     number("harmonics_tolerance", "",
                            "Raise the harmonics until no probe's trajectory changes by more than this fraction "
                            "of its length.",
                            dimensions::none))),
                 withDefault(choice("harmonics_of",
                                    "With \"harmonics_tolerance\": \"model\" raises the harmonics of all nodes alike; "
                                    "\"node\" those of each node, until what is left out would move it by no more "
                                    "than that fraction of the longest path.",
                                    {"model", "node"}),
                             "model"),
                 withDefault(integer("maximum_harmonics", "", "Where raising the harmonics ends.", 1, 200), 25)})),
        harmonicStudy(
            "frequency_response", "The curve of all periodic motions between two driving frequencies, through folds.",
            {from(), to(), frequencyRatio()},
            drivenKeys(
                {step("initial_step", "First step along the curve, in the scaled arc length; chosen if left out."),
                 step("minimum_step", "Smallest step before giving up; chosen if left out."),
                 step("maximum_step", "Largest step; chosen if left out."),
                 withDefault(integer("maximum_points", "", "Most points on the curve.", 2, 100'000), 2000),
                 locationTolerance("Relative error of the frequency of folds, peaks and bifurcations."),
                 withDefault(boolean("peak_sensitivity",
                                     "Find how frequency and path length of each peak change with every design "
                                     "parameter."),
                             false),
                 withDefault(
                     integer("branches", "",
                             "Follow the curves that branch off at branch points and period doublings: 1 those that "
                             "branch off the first curve, 2 also those that branch off these, and so on.",
                             0, 10),
                     0)})),
        harmonicStudy(
            "backbone",
            "The free motions without damping, loads' swings and drives that continue a linear mode: how its frequency "
            "changes with the amplitude (a nonlinear normal mode).",
            {withDefault(integer("mode", "", "Which mode, by rising frequency.", 1, 1000), 1),
             positive(number("maximum_amplitude", "a",
                             "The curve ends where a node is this far from its mean position.", dimensions::length))},
            {withDefault(integer("maximum_points", "", "Most points on the curve.", 2, 100'000), 500)}),
        harmonicStudy("design",
                      "Changes design parameters within their bounds so that the motion at one frequency comes nearer "
                      "to what is wanted (thesis 2.4.3).",
                      designKeys(), startKeys()),
        harmonicStudy(
            "design_space",
            "Motions of many designs, spread evenly between the bounds of the parameters: which can be reached, "
            "and what one good costs of another (thesis 2.5.5).",
            designSpaceKeys(), startKeys()),
        harmonicStudy("calibration",
                      "Fits parameters, such as damping, to measured steady motions, with confidence intervals (thesis "
                      "2.5.2).",
                      calibrationKeys(), startKeys()),
        object("linear_modes",
               "Natural frequencies and modes of the model linearised about its static equilibrium, driven nodes held.",
               {name(), withDefault(integer("count", "", "Modes, from the lowest frequency upwards.", 1, 1000), 6)}),
        object(
            "linear_response",
            "The response curve of the model linearised about its static equilibrium: what linear modal analysis with "
            "all modes gives.",
            {name(), from(), to(),
             withDefault(
                 integer("points", "", "Points spread evenly; more are put around resonances.", 2, 100'000), 200),
             harmonics(), samples(), locationTolerance("Relative error of the frequency of peaks.")}),
        object(
            "time_integration",
            "Newmark's method (trapezoidal rule) from the static equilibrium until two successive periods agree.",
            {name(), frequency("frequency", "ω", "Driving frequency."),
             withDefault(integer("steps_per_period", "N", "Time steps of a period.", 8, 100'000), 256),
             maximumPeriods(), periodTolerance(),
             withDefault(boolean("extrapolate",
                                 "Extrapolate the start of the next period from the ones before, so that transients "
                                 "need not die away; unstable motions are found as well."),
                         false),
             withDefault(boolean("shooting",
                                 "Instead, once nearly periodic, Newton's method on the start of a period, with the "
                                 "monodromy matrix by differences, which gives all Floquet multipliers as well: four "
                                 "periods a free coordinate and iteration, for checks of small models."),
                         false)}),
        object(
            "comparison",
            "Harmonic balance against Newmark's method at one frequency: how the difference falls with harmonics, "
            "samples and steps.",
            {name(), frequency("frequency", "ω", "Driving frequency."),
             withDefault(list("harmonic_counts", "Harmonic balance with each of these numbers of harmonics; ascending.",
                              integer("", "H", "Harmonics.", 1, 200), 1, 100),
                         base::Json{1, 2, 3, 5, 7, 9}),
             samples(),
             withDefault(list("steps_per_period",
                              "Newmark's method with each of these numbers of steps; ascending multiples of the first.",
                              integer("", "N", "Time steps of a period.", 8, 100'000), 1, 100),
                         base::Json{64, 128, 256, 512}),
             withDefault(
                 integer("harmonics", "H",
                         "Harmonics of the solutions that have as many samples as Newmark's method has steps.", 1, 200),
                 5),
             maximumPeriods(), periodTolerance()})};
    for (ParameterSpec& cloth : clothStudySpecs()) all.push_back(std::move(cloth));
    for (ParameterSpec& interlock : interlockStudySpecs()) all.push_back(std::move(interlock));
    for (ParameterSpec& bending : bendingStudySpecs()) all.push_back(std::move(bending));
    for (ParameterSpec& macro : macroStudySpecs()) all.push_back(std::move(macro));
    return all;
  }();
  return specs;
}

}  // namespace pliant::scene
