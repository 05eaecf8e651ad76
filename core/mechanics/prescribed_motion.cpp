#include "core/mechanics/prescribed_motion.hpp"

#include <Eigen/Geometry>

#include "core/base/error.hpp"
#include "core/mechanics/checks.hpp"

namespace pliant::mechanics {

namespace {

class Translation final : public PrescribedMotion {
 public:
  Translation(std::vector<int> nodes, Vector direction, PeriodicSignal signal)
      : nodes_(std::move(nodes)), direction_(std::move(direction)), signal_(std::move(signal)) {}

  const std::vector<int>& nodes() const override { return nodes_; }
  Vector position(const Vector& rest, double tau) const override { return rest + signal_(tau) * direction_; }

 private:
  std::vector<int> nodes_;
  Vector direction_;
  PeriodicSignal signal_;
};

class Rotation final : public PrescribedMotion {
 public:
  Rotation(std::vector<int> nodes, Vector center, const Eigen::Vector3d& axis, PeriodicSignal signal)
      : nodes_(std::move(nodes)), center_(std::move(center)), axis_(axis), signal_(std::move(signal)) {}

  const std::vector<int>& nodes() const override { return nodes_; }
  Vector position(const Vector& rest, double tau) const override {
    Eigen::Vector3d arm = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < rest.size(); ++i) arm[i] = rest[i] - center_[i];
    const Eigen::Vector3d turned = Eigen::AngleAxisd(signal_(tau), axis_) * arm;
    Vector position = center_;
    for (Eigen::Index i = 0; i < rest.size(); ++i) position[i] += turned[i];
    return position;
  }

 private:
  std::vector<int> nodes_;
  Vector center_;
  Eigen::Vector3d axis_;
  PeriodicSignal signal_;
};

}  // namespace

std::shared_ptr<const PrescribedMotion> makeTranslation(std::vector<int> nodes, Vector direction,
                                                        PeriodicSignal signal) {
  requireVector(direction, static_cast<int>(direction.size()), "the translation's direction");
  requireDimension(static_cast<int>(direction.size()), "the translation's direction");
  requireSignal(signal, "the translation's signal");
  return std::make_shared<Translation>(std::move(nodes), std::move(direction), std::move(signal));
}

std::shared_ptr<const PrescribedMotion> makeRotation(std::vector<int> nodes, Vector center, Eigen::Vector3d axis,
                                                     PeriodicSignal signal) {
  requireVector(center, static_cast<int>(center.size()), "the rotation's center");
  requireDimension(static_cast<int>(center.size()), "the rotation's center", 2);
  requireSignal(signal, "the rotation's signal");
  if (center.size() == 2) {
    axis = Eigen::Vector3d::UnitZ();
  } else {
    requireVector(axis, 3, "the rotation's axis");
    if (axis.isZero(0)) throw base::InputError("", "the rotation's axis must not be zero");
    axis.stableNormalize();
  }
  return std::make_shared<Rotation>(std::move(nodes), std::move(center), axis, std::move(signal));
}

}  // namespace pliant::mechanics
