#include "ui/render/predicted_motion.hpp"

#include <numbers>

namespace pliant::render {

namespace {

mechanics::Vector moved(const PredictedMotion& motion, const mechanics::Vector& positions, double tau) {
  const auto& free = motion.problem->model().dofs.freeCoordinates;
  return motion.model->configuration(positions(free), motion.problem->drivePeriods() * tau);
}

}  // namespace

mechanics::Vector PredictedMotion::configurationAt(double tau) const {
  const mechanics::Vector positions = problem->configurationAt(z, tau);
  return model ? moved(*this, positions, tau) : positions;
}

mechanics::Matrix PredictedMotion::trajectories() const {
  mechanics::Matrix positions = problem->trajectories(z);
  for (Eigen::Index i = 0; model && i < positions.rows(); ++i) {
    const double tau = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(positions.rows());
    positions.row(i) = moved(*this, positions.row(i).transpose(), tau).transpose();
  }
  return positions;
}

}  // namespace pliant::render
