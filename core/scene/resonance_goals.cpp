#include "core/scene/resonance_goals.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/spec_builder.hpp"

namespace pliant::scene {

using namespace spec;
namespace dimensions = base::dimensions;

namespace {

ParameterSpec goalFrequency(std::string key, std::string symbol, std::string description) {
  return positive(number(std::move(key), std::move(symbol), std::move(description), dimensions::angularFrequency));
}

}  // namespace

std::vector<ParameterSpec> resonanceGoalSpecs(const ParameterSpec& weight) {
  ParameterSpec probe = reference("probe", "Whose path length peaks; does not count with \"linear\".", "probes");
  return {
      object("resonance_placement",
             "Puts a resonance at a frequency: ((ω* - ω) / ω)², ω* being that of the nearest peak of the response "
             "curve with the drive as it is. The motion at the study's own frequency is followed beside it, so "
             "choose that away from resonances.",
             {goalFrequency("frequency", "ω", "Where the resonance is to lie."), optional(probe),
              optional(goalFrequency("from", "",
                                     "The curve is traced from here to find the first design's peak; "
                                     "half the frequency if left out.")),
              optional(goalFrequency("to", "", "And to here; one and a half times the frequency if left out.")),
              withDefault(boolean("linear",
                                  "A natural frequency about the static equilibrium instead of a peak: much "
                                  "cheaper, and the same for small drives and little damping."),
                          false),
              optional(integer(
                  "mode", "", "With \"linear\": which mode, by rising frequency; the nearest if left out.", 1, 1000)),
              weight}),
      object("resonance_avoidance",
             "Keeps natural frequencies out of a band: Σ max(0, 1 - ((ω_i - ω) / half width)²)² over all modes.",
             {goalFrequency("frequency", "ω", "The middle of the band."),
              goalFrequency("half_width", "", "Half its width."), weight})};
}

std::shared_ptr<const harmonic::DesignObjective> resonanceGoal(const Json& entry, const std::string& place,
                                                               const mechanics::Model& model, const Json& options) {
  if (entry["type"] == "resonance_avoidance")
    return harmonic::makeResonanceAvoidance({entry["frequency"], entry["half_width"]});
  if (entry["type"] != "resonance_placement") return nullptr;
  const double frequency = entry["frequency"];
  if (entry["linear"]) {
    harmonic::LinearResonancePlacement goal{frequency, {}};
    if (entry.contains("mode")) goal.mode = entry["mode"].get<int>() - 1;
    return harmonic::makeLinearResonancePlacement(goal);
  }
  const auto probe = std::find_if(model.probes.begin(), model.probes.end(), [&](const mechanics::Probe& p) {
    return p.name == entry["probe"].get_ref<const std::string&>();
  });
  harmonic::ResonancePlacement goal;
  goal.frequency = frequency;
  goal.probe = static_cast<int>(probe - model.probes.begin());
  goal.from = entry.value("from", 0.5 * frequency);
  goal.to = entry.value("to", 1.5 * frequency);
  if (goal.from == goal.to) throw base::InputError(place + "/to", "The range of frequencies is empty.");
  goal.motion.tolerance = options["tolerance"];
  goal.motion.maximumIterations = options["maximum_iterations"];
  goal.motion.maximumRampSteps = options["maximum_ramp_steps"];
  return harmonic::makeResonancePlacement(goal);
}

}  // namespace pliant::scene
