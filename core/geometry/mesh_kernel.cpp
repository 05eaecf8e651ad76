#include "core/geometry/mesh_kernel.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pliant::geometry {

namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double relativeDepth = 1e-9;
constexpr double kernelWeightGrowth = 10;
constexpr int mostCentringSteps = 100;

/// n·p + t <= o, with (n, 1) in the rows.
struct FacePlanes {
  Eigen::Matrix<double, Eigen::Dynamic, 4> rows;
  Eigen::VectorXd offsets;

  explicit FacePlanes(const SurfaceMesh& mesh) {
    const auto count = static_cast<Eigen::Index>(mesh.triangles.size());
    rows.resize(count, 4);
    offsets.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(i)];
      const Vector3d corner = mesh.points.col(a), first = mesh.points.col(b) - corner,
                     second = mesh.points.col(c) - corner, normal = first.cross(second).normalized();
      rows.row(i) << normal.transpose(), 1;
      offsets[i] = normal.dot(corner);
    }
  }

  double depthAt(const Vector3d& point) const { return (offsets - rows.leftCols<3>() * point).minCoeff(); }
};

}  // namespace

double kernelDepth(const SurfaceMesh& mesh, const Vector3d& point) { return FacePlanes(mesh).depthAt(point); }

/// max t with n·p + t <= o for each triangle's plane, as the minima of -w t - Σ ln(o - n·p - t) for growing w, at each
/// of which t lacks at most (triangles)/w.
KernelPoint deepestKernelPoint(const SurfaceMesh& mesh) {
  const FacePlanes planes(mesh);
  const double count = static_cast<double>(planes.offsets.size());
  const double size = (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  Vector4d x;
  x << mesh.points.rowwise().mean(), 0;
  x[3] = planes.depthAt(x.head<3>()) - size;
  for (double weight = count / size; count / weight > relativeDepth * size; weight *= kernelWeightGrowth)
    for (int step = 0; step < mostCentringSteps; ++step) {
      const Eigen::VectorXd inverse = (planes.offsets - planes.rows * x).cwiseInverse();
      const Vector4d gradient = planes.rows.transpose() * inverse - weight * Vector4d::UnitW();
      const Eigen::Matrix4d hessian = planes.rows.transpose() * inverse.cwiseAbs2().asDiagonal() * planes.rows;
      const Vector4d newton = -hessian.ldlt().solve(gradient);
      const double decrement = std::sqrt(std::max(0.0, -gradient.dot(newton)));
      x += newton / (1 + decrement);  // stays feasible: the barrier is self-concordant
      if (decrement < 0.1) break;
    }
  return {x.head<3>(), planes.depthAt(x.head<3>())};
}

}  // namespace pliant::geometry
