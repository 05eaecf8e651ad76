#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mechanics/rod.hpp"
#include "core/scene/second_frequency.hpp"

namespace pliant::scene {

namespace {

/// Empty unless something drives faster than a series with these harmonics can answer.
std::string unansweredDrive(const harmonic::HarmonicBalanceProblem& problem) {
  const mechanics::Model& model = problem.model();
  int highest = 0;
  const auto visit = [&](const mechanics::PeriodicSignal& signal) {
    for (const auto& term : signal.terms)
      if (term.amplitude != 0) highest = std::max(highest, term.order);
  };
  for (const auto& drive : model.drives) visit(drive->signal());
  for (const auto& force : model.forces) visit(force.signal);
  const int answered = problem.basis().hasTwoFrequencies() ? problem.basis().order()
                                                           : problem.basis().harmonics() / problem.drivePeriods();
  if (highest <= answered) return {};
  return "Something drives at " + std::to_string(highest) + " times the frequency, but the motion has " +
         std::to_string(answered) + " harmonics, so the answer to it is missing: take more harmonics.";
}

/// Empty unless a rod turns farther than its energy is good for.
std::string untrustedTurn(const HarmonicResult& result) {
  // Often enough that a rod that swings on through 180° is seen within 10° of it, up to two turns each way and back.
  constexpr int instants = 256;
  const mechanics::Model& model = result.problem->model();
  // The linear response asks for the rods' frames at the equilibrium alone.
  if (result.isLinear || !mechanics::largestTurn(model, model.restPositions)) return {};
  double largest = 0, omega = 0;
  for (const harmonic::ResponsePoint& point : result.points) {
    const auto motion = result.problemOf(point);
    const int count = instants * point.drivePeriods;
    for (int i = 0; i < count; ++i) {
      const double tau = 2 * std::numbers::pi * i / count;
      const double turn = mechanics::largestTurn(model, motion->configurationAt(point.z, tau)).value_or(0);
      if (turn <= largest) continue;
      largest = turn;
      omega = point.omega;
    }
  }
  if (largest <= mechanics::largestTrustedTurn) return {};
  const auto degrees = [](double angle) { return std::to_string(std::lround(angle * 180 / std::numbers::pi)); };
  return "At " + std::to_string(omega) + " rad/s a segment of a rod turns by " + degrees(largest) +
         " degrees from its rest shape; past " + degrees(mechanics::largestTrustedTurn) +
         " degrees the results of rods are not to be trusted.";
}

}  // namespace

std::vector<std::string> HarmonicResult::warnings() const {
  std::vector<std::string> sentences;
  for (std::string sentence : {isBackbone ? std::string() : unansweredDrive(*problem), untrustedTurn(*this)})
    if (!sentence.empty()) sentences.push_back(std::move(sentence));
  for (std::string& sentence : secondFrequencyWarnings(*problem)) sentences.push_back(std::move(sentence));
  return sentences;
}

}  // namespace pliant::scene
