#include "core/mechanics/prescribed_motion.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

namespace {

std::vector<int> coordinatesOf(const std::vector<int>& nodes, int dimension) {
  std::vector<int> coordinates;
  for (const int node : nodes)
    for (int axis = 0; axis < dimension; ++axis) coordinates.push_back(node * dimension + axis);
  return coordinates;
}

class Translation final : public PrescribedMotion {
 public:
  Translation(std::vector<int> coordinates, Vector direction, PeriodicSignal signal)
      : coordinates_(std::move(coordinates)), direction_(std::move(direction)), signal_(std::move(signal)) {}

  const std::vector<int>& coordinates() const override { return coordinates_; }
  const PeriodicSignal& signal() const override { return signal_; }
  Vector place(const Vector& rest, double length) const override {
    return rest + length * direction_.replicate(rest.size() / direction_.size(), 1);
  }

 private:
  std::vector<int> coordinates_;
  Vector direction_;  ///< for each of them in turn
  PeriodicSignal signal_;
};

class Rotation final : public PrescribedMotion {
 public:
  Rotation(std::vector<int> coordinates, Vector center, const Eigen::Vector3d& axis, PeriodicSignal signal)
      : coordinates_(std::move(coordinates)), center_(std::move(center)), axis_(axis), signal_(std::move(signal)) {}

  const std::vector<int>& coordinates() const override { return coordinates_; }
  const PeriodicSignal& signal() const override { return signal_; }
  Vector place(const Vector& rest, double angle) const override {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis_).toRotationMatrix();
    const Eigen::Index d = center_.size();
    Vector positions(rest.size());
    for (Eigen::Index i = 0; i < rest.size(); i += d)
      positions.segment(i, d) = center_ + turn.topLeftCorner(d, d) * (rest.segment(i, d) - center_);
    return positions;
  }

 private:
  std::vector<int> coordinates_;
  Vector center_;
  Eigen::Vector3d axis_;
  PeriodicSignal signal_;
};

class TurningFrame final : public PrescribedMotion {
 public:
  TurningFrame(int firstCoordinate, Eigen::Vector3d scaledAxis, PeriodicSignal signal)
      : coordinates_{firstCoordinate, firstCoordinate + 1, firstCoordinate + 2},
        scaledAxis_(std::move(scaledAxis)),
        signal_(std::move(signal)) {}

  const std::vector<int>& coordinates() const override { return coordinates_; }
  const PeriodicSignal& signal() const override { return signal_; }
  Vector place(const Vector& rest, double angle) const override { return rest + std::tan(angle / 4) * scaledAxis_; }

 private:
  std::vector<int> coordinates_;
  Eigen::Vector3d scaledAxis_;  ///< unit axis times 4 frameLength
  PeriodicSignal signal_;
};

void requireAxis(const Eigen::Vector3d& axis) {
  requireVector(axis, 3, "the rotation's axis");
  if (axis.isZero(0)) throw base::InputError("", "the rotation's axis must not be zero");
}

}  // namespace

std::shared_ptr<const PrescribedMotion> makeTranslation(const std::vector<int>& nodes, Vector direction,
                                                        PeriodicSignal signal) {
  requireVector(direction, static_cast<int>(direction.size()), "the translation's direction");
  requireDimension(static_cast<int>(direction.size()), "the translation's direction");
  requireSignal(signal, "the translation's signal");
  std::vector<int> coordinates = coordinatesOf(nodes, static_cast<int>(direction.size()));
  return std::make_shared<Translation>(std::move(coordinates), std::move(direction), std::move(signal));
}

std::shared_ptr<const PrescribedMotion> makeRotation(const std::vector<int>& nodes, Vector center, Eigen::Vector3d axis,
                                                     PeriodicSignal signal) {
  requireVector(center, static_cast<int>(center.size()), "the rotation's center");
  requireDimension(static_cast<int>(center.size()), "the rotation's center", 2);
  requireSignal(signal, "the rotation's signal");
  if (center.size() == 2) {
    axis = Eigen::Vector3d::UnitZ();
  } else {
    requireAxis(axis);
    axis.stableNormalize();
  }
  std::vector<int> coordinates = coordinatesOf(nodes, static_cast<int>(center.size()));
  return std::make_shared<Rotation>(std::move(coordinates), std::move(center), axis, std::move(signal));
}

std::shared_ptr<const PrescribedMotion> makeFrameRotation(int firstCoordinate, double frameLength, Eigen::Vector3d axis,
                                                          PeriodicSignal signal) {
  requirePositive(frameLength, "the length of a frame");
  requireAxis(axis);
  requireSignal(signal, "the rotation's signal");
  double largest = 0;
  for (const PeriodicSignal::Term& term : signal.terms) largest += std::abs(term.amplitude);
  if (largest >= M_PI) throw base::InputError("", "a rotation of rods must stay below 180 degrees");
  axis.stableNormalize();
  return std::make_shared<TurningFrame>(firstCoordinate, 4 * frameLength * axis, std::move(signal));
}

std::shared_ptr<const PrescribedMotion> makeScalarDrive(int coordinate, double lever, PeriodicSignal signal) {
  requirePositive(lever, "the lever of a scalar drive");
  requireSignal(signal, "the scalar drive's signal");
  return std::make_shared<Translation>(std::vector<int>{coordinate}, Vector::Constant(1, lever), std::move(signal));
}

}  // namespace pliant::mechanics
