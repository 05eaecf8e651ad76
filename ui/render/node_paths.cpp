#include "ui/render/node_paths.hpp"

#include <algorithm>
#include <numbers>

#include "ui/render/figure_layout.hpp"

namespace pliant::render {
namespace {

constexpr int curveSamples = 256;
constexpr int samplesOfSpannedPeriod = 64;
constexpr int mostSamples = 8192;

/// Of a closed curve, or of one over the span of a motion with two frequencies, whose ends are close to one another.
int samplesOf(const math::HarmonicBasis& basis) {
  if (!basis.hasTwoFrequencies()) return curveSamples;
  const double wanted = samplesOfSpannedPeriod * basis.periods() * std::max(1.0, basis.ratio());
  return static_cast<int>(std::clamp<double>(wanted, curveSamples, mostSamples));
}
constexpr int fewestInstants = 64;

}  // namespace

using mechanics::Matrix;

std::vector<Points> nodePaths(const harmonic::HarmonicBalanceProblem& problem, const Matrix& trajectories,
                              const std::vector<int>& nodes) {
  const math::HarmonicBasis& basis = problem.basis();
  const int count = samplesOf(basis);
  Matrix interpolation(count, basis.size());
  for (int i = 0; i < count; ++i) interpolation.row(i) = basis.valuesAt(2.0 * std::numbers::pi * i / count).transpose();
  const int dimension = problem.model().dimension;
  std::vector<Points> paths;
  for (const int node : nodes) {
    const Matrix samples = trajectories.middleCols(node * dimension, dimension);
    Points path = Points::Zero(3, count);
    path.topRows(dimension) = (interpolation * (basis.analysis() * samples)).transpose();
    paths.push_back(std::move(path));
  }
  return paths;
}

Matrix instantsOf(const PredictedMotion& motion) {
  const Eigen::Index count = std::max(fewestInstants, motion.problem->basis().samples());
  Matrix instants(count, motion.problem->model().coordinateCount());
  for (Eigen::Index i = 0; i < count; ++i)
    instants.row(i) =
        motion.configurationAt(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count)).transpose();
  return instants;
}

Points reachOf(const FigureLayout& layout, const Matrix& instants) {
  Points reach;
  for (Eigen::Index i = 0; i < instants.rows(); ++i) {
    const Points places = layout.places(instants.row(i).transpose());
    if (i == 0) reach.resize(3, instants.rows() * places.cols());
    reach.middleCols(i * places.cols(), places.cols()) = places;
  }
  return reach;
}

Points joined(const Points& a, const Points& b) {
  Points both(3, a.cols() + b.cols());
  both.leftCols(a.cols()) = a;
  both.rightCols(b.cols()) = b;
  return both;
}

}  // namespace pliant::render
