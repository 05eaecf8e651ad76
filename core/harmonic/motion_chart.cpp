#include "core/harmonic/motion_chart.hpp"

#include <cmath>
#include <numbers>

#include "core/mechanics/mechanism.hpp"
#include "core/mechanics/strain.hpp"

namespace pliant::harmonic {

namespace {

namespace dimensions = base::dimensions;
using Style = MotionChart::Style;

constexpr int instants = 256;
constexpr base::Dimension velocityDimension{0, 1, -1, 0};

/// Positions and velocities of one node at `instants` + 1 instants of a period, or that many of each period of the
/// first of two frequencies.
struct NodeMotion {
  Vector time;       ///< [s]
  Matrix position;   ///< as many x dimension [m]
  Matrix velocity;   ///< likewise [m/s]
  Matrix harmonics;  ///< coefficients, (2H+1) x dimension [m]
};

NodeMotion motionOf(const HarmonicBalanceProblem& problem, const Vector& z, double omega, int node) {
  const math::HarmonicBasis& basis = problem.basis();
  const int count = instants * basis.periods();
  const double rate = omega / problem.drivePeriods();
  NodeMotion motion;
  motion.harmonics = basis.analysis() * problem.nodeTrajectory(z, node);
  Matrix synthesis(count + 1, basis.size());
  motion.time.resize(count + 1);
  for (int i = 0; i <= count; ++i) {
    const double tau = 2 * std::numbers::pi * i / count;
    synthesis.row(i) = basis.valuesAt(tau).transpose();
    motion.time[i] = tau / rate;
  }
  motion.position = synthesis * motion.harmonics;
  motion.velocity = rate * synthesis * basis.derivative(motion.harmonics);
  return motion;
}

std::string axisName(Eigen::Index axis) { return std::string(1, static_cast<char>('x' + axis)); }

MotionChart overTime(const NodeMotion& motion, const Matrix& values, ChartAxis axis) {
  MotionChart chart;
  chart.x = {"Time", dimensions::time};
  chart.y = std::move(axis);
  for (Eigen::Index i = 0; i < values.cols(); ++i) chart.series.push_back({axisName(i), motion.time, values.col(i)});
  return chart;
}

MotionChart harmonicContent(const HarmonicBalanceProblem& problem, const Vector& z, double omega, int node) {
  const NodeMotion motion = motionOf(problem, z, omega, node);
  const int count = problem.basis().harmonics();
  MotionChart chart;
  chart.style = Style::stems;
  chart.x = {"Harmonic", dimensions::none};
  chart.y = {"Amplitude", dimensions::length, true};
  for (Eigen::Index axis = 0; axis < motion.harmonics.cols(); ++axis) {
    ChartSeries series{axisName(axis), Vector(count), Vector(count)};
    for (int k = 1; k <= count; ++k) {
      series.x[k - 1] = std::abs(problem.basis().rate(k)) / problem.basis().periods();
      series.y[k - 1] = std::hypot(motion.harmonics(2 * k - 1, axis), motion.harmonics(2 * k, axis));
    }
    if (series.y.maxCoeff() > 0) chart.series.push_back(std::move(series));
  }
  if (chart.series.empty()) chart.note = "This node does not move.";
  return chart;
}

MotionChart displacement(const HarmonicBalanceProblem& problem, const Vector& z, double omega, int node) {
  const NodeMotion motion = motionOf(problem, z, omega, node);
  const Matrix moved = motion.position.rowwise() - motion.harmonics.row(0);
  return overTime(motion, moved, {"Displacement from the mean", dimensions::length});
}

MotionChart velocity(const HarmonicBalanceProblem& problem, const Vector& z, double omega, int node) {
  const NodeMotion motion = motionOf(problem, z, omega, node);
  return overTime(motion, motion.velocity, {"Velocity", velocityDimension});
}

MotionChart phasePlane(const HarmonicBalanceProblem& problem, const Vector& z, double omega, int node) {
  const NodeMotion motion = motionOf(problem, z, omega, node);
  MotionChart chart;
  chart.style = problem.basis().hasTwoFrequencies() ? Style::line : Style::closedLine;
  chart.x = {"Displacement from the mean", dimensions::length};
  chart.y = {"Velocity", velocityDimension};
  for (Eigen::Index axis = 0; axis < motion.position.cols(); ++axis)
    chart.series.push_back(
        {axisName(axis), motion.position.col(axis).array() - motion.harmonics(0, axis), motion.velocity.col(axis)});
  return chart;
}

template <class Value>
ChartSeries sampledInTime(const HarmonicBalanceProblem& problem, const Vector& z, double omega, std::string name,
                          const Value& value) {
  constexpr int instantsOfPeriod = 32;
  const int count = instantsOfPeriod * problem.drivePeriods();
  ChartSeries series{std::move(name), Vector(count + 1), Vector(count + 1)};
  for (int i = 0; i <= count; ++i) {
    const double tau = 2 * std::numbers::pi * i / count;
    series.x[i] = tau * problem.drivePeriods() / omega;
    series.y[i] = value(problem.configurationAt(z, tau));
  }
  return series;
}

/// value(configuration) at the samples of a period, its end included; of two frequencies at instants of the span.
template <class Value>
ChartSeries sampled(const HarmonicBalanceProblem& problem, const Vector& z, double omega, std::string name,
                    const Value& value) {
  if (problem.basis().hasTwoFrequencies()) return sampledInTime(problem, z, omega, std::move(name), value);
  const Matrix positions = problem.trajectories(z);
  const Eigen::Index samples = positions.rows();
  ChartSeries series{std::move(name), Vector(samples + 1), Vector(samples + 1)};
  for (Eigen::Index i = 0; i <= samples; ++i) {
    series.x[i] =
        2 * std::numbers::pi * problem.drivePeriods() * static_cast<double>(i) / (static_cast<double>(samples) * omega);
    series.y[i] = i < samples ? value(Vector(positions.row(i).transpose())) : series.y[0];
  }
  return series;
}

MotionChart strain(const HarmonicBalanceProblem& problem, const Vector& z, double omega, int) {
  const Model& model = problem.model();
  MotionChart chart;
  if (!mechanics::largestStrain(model, model.restPositions)) {
    chart.note = "The model has no triangles or tetrahedra whose strain could be shown.";
    return chart;
  }
  chart.x = {"Time", dimensions::time};
  chart.y = {"Largest principal stretch - 1", dimensions::none};
  chart.series.push_back(sampled(
      problem, z, omega, "largest", [&](const Vector& x) { return mechanics::largestStrain(model, x).value_or(0); }));
  return chart;
}

MotionChart violation(const HarmonicBalanceProblem& problem, const Vector& z, double omega, int) {
  const Model& model = problem.model();
  MotionChart chart;
  if (!mechanics::constraintViolation(model, model.restPositions)) {
    chart.note = "The model has no rigid links, bars or angles.";
    return chart;
  }
  chart.x = {"Time", dimensions::time};
  chart.y = {"Largest relative violation", dimensions::none};
  chart.series.push_back(sampled(problem, z, omega, "largest", [&](const Vector& x) {
    return mechanics::constraintViolation(model, x).value_or(0);
  }));
  return chart;
}

}  // namespace

const std::vector<MotionChartKind>& motionChartKinds() {
  static const std::vector<MotionChartKind> kinds{
      {"harmonics", "Harmonic content", "How much of each harmonic the node's motion has.", true, harmonicContent},
      {"displacement", "Displacement over time", "The node's displacement from its mean place over a period.", true,
       displacement},
      {"velocity", "Velocity over time", "The node's velocity over a period.", true, velocity},
      {"phase_plane", "Phase plane", "The node's velocity over its displacement, an axis a loop.", true, phasePlane},
      {"strain", "Strain over time", "The largest stretch of any triangle or tetrahedron over a period.", false,
       strain},
      {"violation", "Rigidity over time",
       "By how much rigid links and angles give way over a period, relative to their size.", false, violation}};
  return kinds;
}

}  // namespace pliant::harmonic
