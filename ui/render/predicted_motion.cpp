#include "ui/render/predicted_motion.hpp"

namespace pliant::render {

namespace {

mechanics::Vector moved(const PredictedMotion& motion, const mechanics::Vector& positions, math::Phases phases) {
  const auto& free = motion.problem->model().dofs.freeCoordinates;
  return motion.model->configuration(positions(free), phases);
}

}  // namespace

mechanics::Vector PredictedMotion::configurationAt(double tau) const {
  const mechanics::Vector positions = problem->configurationAt(z, tau);
  return model ? moved(*this, positions, problem->phasesAt(tau)) : positions;
}

mechanics::Matrix PredictedMotion::trajectories() const {
  mechanics::Matrix positions = problem->trajectories(z);
  for (Eigen::Index i = 0; model && i < positions.rows(); ++i)
    positions.row(i) =
        moved(*this, positions.row(i).transpose(), problem->samplePhases(static_cast<int>(i))).transpose();
  return positions;
}

}  // namespace pliant::render
