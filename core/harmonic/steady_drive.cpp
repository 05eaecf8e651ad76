#include "core/harmonic/steady_drive.hpp"

namespace pliant::harmonic {

int steadySample(const mechanics::PrescribedMotion& drive, const mechanics::Vector& rest,
                 const std::vector<math::Phases>& instants) {
  constexpr double rounding = 1e-9;  // relative to the swing
  mechanics::Matrix positions(static_cast<Eigen::Index>(instants.size()), rest.size());
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    positions.row(i) = drive.values(rest, instants[static_cast<std::size_t>(i)]).transpose();
  const Eigen::RowVectorXd mean = positions.colwise().mean();
  const mechanics::Vector distances = (positions.rowwise() - mean).rowwise().norm();
  const double nearest = distances.minCoeff() + rounding * distances.maxCoeff();
  int sample = 0;
  while (distances[sample] > nearest) ++sample;
  return sample;
}

}  // namespace pliant::harmonic
