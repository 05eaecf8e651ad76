#include <cmath>
#include <numbers>

#include "core/mechanics/rod.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

std::vector<std::string> HarmonicResult::warnings() const {
  // Often enough that a rod that swings on through 180° is seen within 10° of it, up to two turns each way and back.
  constexpr int instants = 256;
  const mechanics::Model& model = problem->model();
  // The linear response asks for the rods' frames at the equilibrium alone.
  if (isLinear || !mechanics::largestTurn(model, model.restPositions)) return {};
  double largest = 0, omega = 0;
  for (const harmonic::ResponsePoint& point : points) {
    const auto motion = problemOf(point);
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
  return {"At " + std::to_string(omega) + " rad/s a segment of a rod turns by " + degrees(largest) +
          " degrees from its rest shape; past " + degrees(mechanics::largestTrustedTurn) +
          " degrees the results of rods are not to be trusted."};
}

}  // namespace pliant::scene
