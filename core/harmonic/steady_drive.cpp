#include "core/harmonic/steady_drive.hpp"

#include <numbers>

namespace pliant::harmonic {

int steadySample(const mechanics::PrescribedMotion& drive, const mechanics::Vector& rest, int samples, int periods) {
  constexpr double rounding = 1e-9;  // relative to the swing
  mechanics::Matrix positions(samples, rest.size());
  for (int i = 0; i < samples; ++i)
    positions.row(i) = drive.values(rest, 2 * std::numbers::pi * periods * i / samples).transpose();
  const Eigen::RowVectorXd mean = positions.colwise().mean();
  const mechanics::Vector distances = (positions.rowwise() - mean).rowwise().norm();
  const double nearest = distances.minCoeff() + rounding * distances.maxCoeff();
  int sample = 0;
  while (distances[sample] > nearest) ++sample;
  return sample;
}

}  // namespace pliant::harmonic
