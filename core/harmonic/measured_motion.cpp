#include "core/harmonic/measured_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/phase_shift.hpp"

namespace pliant::harmonic {

using std::numbers::pi;

int MeasuredMotion::sampleCount() const {
  int count = 0;
  for (const MeasuredCoordinate& coordinate : coordinates)
    count += static_cast<int>((coordinate.values.array() == coordinate.values.array()).count());
  return count;
}

int MeasuredMotion::unknownCount() const {
  return (timeOffset ? 0 : 1) + (meaning == MeasuredValue::swing ? static_cast<int>(coordinates.size()) : 0);
}

MotionComparison::MotionComparison(MeasuredMotion measured, int harmonics)
    : measured_(std::move(measured)), size_(2 * harmonics + 1), values_(measured_.sampleCount()) {
  const math::HarmonicBasis basis(harmonics, size_);
  Eigen::Index row = 0;
  for (const MeasuredCoordinate& coordinate : measured_.coordinates) {
    std::vector<Eigen::Index> known;
    for (Eigen::Index i = 0; i < coordinate.values.size(); ++i)
      if (!std::isnan(coordinate.values[i])) known.push_back(i);
    Matrix rows(static_cast<Eigen::Index>(known.size()), size_);
    for (std::size_t i = 0; i < known.size(); ++i)
      rows.row(static_cast<Eigen::Index>(i)) = basis.valuesAt(measured_.omega * measured_.times[known[i]]).transpose();
    values_.segment(row, rows.rows()) = coordinate.values(known);
    Matrix centred = rows;
    if (measured_.meaning == MeasuredValue::swing) centred.rowwise() -= rows.colwise().mean();
    grams_.emplace_back(centred.transpose() * centred);
    projections_.emplace_back(centred.transpose() * values_.segment(row, rows.rows()));
    row += rows.rows();
    instants_.push_back(std::move(rows));
  }
}

Vector MotionComparison::synthesis(const Matrix& coefficients, double phase) const {
  const Matrix shifted = math::shiftedInPhase(coefficients, phase);
  Vector rows(values_.size());
  Eigen::Index row = 0;
  for (std::size_t c = 0; c < instants_.size(); ++c) {
    rows.segment(row, instants_[c].rows()) = instants_[c] * shifted.col(static_cast<Eigen::Index>(c));
    row += instants_[c].rows();
  }
  return rows;
}

void MotionComparison::removePlaces(Vector& rows) const {
  if (measured_.meaning != MeasuredValue::swing) return;
  Eigen::Index row = 0;
  for (const Matrix& instants : instants_) {
    auto part = rows.segment(row, instants.rows());
    part.array() -= part.mean();
    row += instants.rows();
  }
}

double MotionComparison::bestPhase(const Matrix& coefficients) const {
  // Σ r² is a trigonometric polynomial of φ of order 2H: a grid that resolves it, then Newton's method.
  const int count = 16 * size_;
  double best = 0, least = 0;
  for (int i = 0; i < count; ++i) {
    const double phase = 2 * pi * i / count;
    const Matrix shifted = math::shiftedInPhase(coefficients, phase);
    double sum = 0;
    for (std::size_t c = 0; c < instants_.size(); ++c) {
      const auto column = shifted.col(static_cast<Eigen::Index>(c));
      sum += column.dot(grams_[c] * column - 2 * projections_[c]);
    }
    if (i == 0 || sum < least) {
      least = sum;
      best = phase;
    }
  }
  const math::HarmonicBasis basis((size_ - 1) / 2, size_);
  const Matrix velocity = basis.derivative(coefficients), acceleration = basis.secondDerivative(coefficients);
  const double spacing = 2 * pi / count;
  for (int iteration = 0; iteration < 30; ++iteration) {
    Vector residuals = synthesis(coefficients, best) - values_;
    removePlaces(residuals);
    Vector slope = synthesis(velocity, best);
    removePlaces(slope);
    const double square = slope.squaredNorm();
    if (square == 0) break;
    const double curvature = square + residuals.dot(synthesis(acceleration, best));
    const double step = -residuals.dot(slope) / (curvature > 0 ? curvature : square);
    best += std::clamp(step, -spacing, spacing);
    if (std::abs(step) < 1e-14) break;
  }
  best = std::fmod(best, 2 * pi);
  return best < 0 ? best + 2 * pi : best;
}

MotionFit MotionComparison::compare(const Matrix& coefficients) const {
  MotionFit fit;
  fit.phase = measured_.timeOffset ? measured_.omega * *measured_.timeOffset : bestPhase(coefficients);
  fit.residuals = synthesis(coefficients, fit.phase) - values_;
  removePlaces(fit.residuals);
  fit.fitted = values_ + fit.residuals;
  if (!measured_.timeOffset) {
    const math::HarmonicBasis basis((size_ - 1) / 2, size_);
    fit.byPhase = synthesis(basis.derivative(coefficients), fit.phase);
    removePlaces(fit.byPhase);
  }
  return fit;
}

Vector MotionComparison::derivative(const MotionFit& at, const Matrix& coefficientDerivative, bool projected) const {
  Vector rows = synthesis(coefficientDerivative, at.phase);
  if (!projected) return rows;
  removePlaces(rows);
  if (at.byPhase.size() > 0 && !at.byPhase.isZero(0))
    rows -= at.byPhase * (at.byPhase.dot(rows) / at.byPhase.squaredNorm());
  return rows;
}

}  // namespace pliant::harmonic
