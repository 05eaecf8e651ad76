#include "ui/render/camera_control.hpp"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pliant::render {
namespace {

constexpr double viewAngle = 22.0;  // degrees, vertical
constexpr double margin = 0.09;     // of half the window, on each side

Eigen::Vector3d vectorOf(const double* values) { return Eigen::Map<const Eigen::Vector3d>(values); }

struct Direction {
  Eigen::Vector3d from;  ///< from the model to the camera
  Eigen::Vector3d up;
};

Direction direction(AxisView view) {
  switch (view) {
    case AxisView::front: return {{0, -1, 0}, {0, 0, 1}};
    case AxisView::back: return {{0, 1, 0}, {0, 0, 1}};
    case AxisView::right: return {{1, 0, 0}, {0, 0, 1}};
    case AxisView::left: return {{-1, 0, 0}, {0, 0, 1}};
    case AxisView::top: return {{0, 0, 1}, {0, 1, 0}};
    case AxisView::bottom: return {{0, 0, -1}, {0, 1, 0}};
    case AxisView::isometric: break;
  }
  return {{0.45, -0.75, 0.5}, {0, 0, 1}};
}

std::optional<Eigen::Vector2d> seenAt(const Eigen::Matrix4d& projection, const int* size,
                                      const Eigen::Vector3d& point) {
  const Eigen::Vector4d clip = projection * point.homogeneous();
  if (clip.w() <= 0) return std::nullopt;
  return Eigen::Vector2d(0.5 * (1.0 + clip.x() / clip.w()) * size[0], 0.5 * (1.0 + clip.y() / clip.w()) * size[1]);
}

}  // namespace

CameraControl::CameraControl(vtkRenderer* renderer) : renderer_(renderer), reach_(Points::Zero(3, 1)) {
  renderer_->GetActiveCamera()->SetViewAngle(viewAngle);
}

void CameraControl::setReach(Points reach) {
  reach_ = std::move(reach);
  updateClipping();
}

void CameraControl::setAxisView(AxisView view) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  auto [from, up] = direction(view);
  if (upIsY_) {
    // Turned about x, so that what was along z is along y.
    from = Eigen::Vector3d(from.x(), from.z(), -from.y());
    up = Eigen::Vector3d(up.x(), up.z(), -up.y());
  }
  const Eigen::Vector3d position = vectorOf(camera->GetFocalPoint()) + camera->GetDistance() * from.normalized();
  camera->SetPosition(position.data());
  camera->SetViewUp(up.data());
  camera->OrthogonalizeViewUp();
  fit();
}

void CameraControl::fit() {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const Eigen::Vector3d low = reach_.rowwise().minCoeff(), high = reach_.rowwise().maxCoeff();
  const double extent = std::max((high - low).norm(), 1e-9);
  const Eigen::Vector3d toCamera = -vectorOf(camera->GetDirectionOfProjection());
  const Eigen::Vector3d up = vectorOf(camera->GetViewUp()).normalized();
  const Eigen::Vector3d right = up.cross(toCamera).normalized();
  const double tangent = std::tan(0.5 * viewAngle * std::numbers::pi / 180.0);
  const int* size = renderer_->GetSize();
  const double aspect = size[0] > 0 && size[1] > 0 ? static_cast<double>(size[0]) / size[1] : 1.0;
  // The free rectangle of the window in units of half its width and height.
  const double rightEdge = 1.0 - margin - (size[0] > 0 ? 2.0 * std::min(rightMargin_ / size[0], 0.4) : 0.0);
  const double width = rightEdge + 1.0 - margin, top = size[1] > 0 ? std::min(topMargin_ / size[1], 0.3) : 0;
  const double height = 2.0 - 2.0 * margin - 2.0 * top;
  const double middle = 0.5 * (rightEdge - 1.0 + margin);

  Eigen::Vector3d center = 0.5 * (low + high);
  double distance = 2.0 * extent / tangent;
  for (int pass = 0; pass < 6; ++pass) {
    // Project, then move and scale so that the projected box fills the rectangle; perspective makes that an iteration.
    Eigen::Array2d least = Eigen::Array2d::Constant(1e300), most = -least;
    for (const auto& point : reach_.colwise()) {
      const Eigen::Vector3d offset = point - center;
      const double depth = std::max(distance - offset.dot(toCamera), 0.05 * extent);
      const Eigen::Array2d seen(offset.dot(right) / (depth * tangent * aspect), offset.dot(up) / (depth * tangent));
      least = least.min(seen);
      most = most.max(seen);
    }
    const Eigen::Array2d halfBox = 0.5 * (most - least);
    center += distance * tangent * (aspect * 0.5 * (most.x() + least.x()) * right + 0.5 * (most.y() + least.y()) * up);
    const double scale = std::max({2.0 * halfBox.x() / width, 2.0 * halfBox.y() / height, 1e-6});
    distance *= scale;
    distance = std::max(distance, 0.6 * extent);
  }
  const Eigen::Vector3d focus = center - middle * distance * tangent * aspect * right + top * distance * tangent * up;
  const Eigen::Vector3d position = focus + distance * toCamera;
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(position.data());
  updateClipping();
}

CameraPose CameraControl::pose() const {
  vtkCamera* camera = renderer_->GetActiveCamera();
  return {vectorOf(camera->GetPosition()), vectorOf(camera->GetFocalPoint()), vectorOf(camera->GetViewUp())};
}

void CameraControl::setPose(const CameraPose& pose) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetPosition(pose.position.data());
  camera->SetFocalPoint(pose.focus.data());
  camera->SetViewUp(pose.up.data());
  updateClipping();
}

void CameraControl::orbit(double dx, double dy) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->Azimuth(-180.0 * dx);
  camera->Elevation(180.0 * dy);
  camera->OrthogonalizeViewUp();
  updateClipping();
}

void CameraControl::pan(double dx, double dy) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const int* size = renderer_->GetSize();
  if (size[1] <= 0) return;
  const double pixel = 2.0 * camera->GetDistance() * std::tan(0.5 * viewAngle * std::numbers::pi / 180.0) / size[1];
  const Eigen::Vector3d up = vectorOf(camera->GetViewUp()).normalized();
  const Eigen::Vector3d right = vectorOf(camera->GetDirectionOfProjection()).cross(up).normalized();
  const Eigen::Vector3d shift = pixel * (-dx * right + dy * up);
  camera->SetFocalPoint(Eigen::Vector3d(vectorOf(camera->GetFocalPoint()) + shift).data());
  camera->SetPosition(Eigen::Vector3d(vectorOf(camera->GetPosition()) + shift).data());
  updateClipping();
}

void CameraControl::zoom(double factor, double x, double y) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const int* size = renderer_->GetSize();
  if (size[1] <= 0) return;
  if (x >= size[0]) x -= size[0];
  // The point of the focal plane under the pointer is the fixed point of the enlargement.
  const double pixel = 2.0 * camera->GetDistance() * std::tan(0.5 * viewAngle * std::numbers::pi / 180.0) / size[1];
  const Eigen::Vector3d up = vectorOf(camera->GetViewUp()).normalized();
  const Eigen::Vector3d right = vectorOf(camera->GetDirectionOfProjection()).cross(up).normalized();
  const Eigen::Vector3d focus = vectorOf(camera->GetFocalPoint());
  const Eigen::Vector3d fixed = focus + pixel * ((x - 0.5 * size[0]) * right + (0.5 * size[1] - y) * up);
  camera->SetFocalPoint(Eigen::Vector3d(fixed + (focus - fixed) / factor).data());
  camera->SetPosition(Eigen::Vector3d(fixed + (vectorOf(camera->GetPosition()) - fixed) / factor).data());
  updateClipping();
}

std::optional<Eigen::Vector2d> CameraControl::pixelOf(const Eigen::Vector3d& point) const {
  return seenAt(projection(), renderer_->GetSize(), point);
}

std::optional<Eigen::Vector3d> CameraControl::pointBeside(const Eigen::Vector3d& point, double x, double y) const {
  vtkCamera* camera = renderer_->GetActiveCamera();
  const int* size = renderer_->GetSize();
  const Eigen::Vector3d forward = vectorOf(camera->GetDirectionOfProjection()).normalized();
  const Eigen::Vector3d eye = vectorOf(camera->GetPosition());
  const double depth = (point - eye).dot(forward);
  if (size[1] <= 0 || depth <= 0) return std::nullopt;
  const double pixel = 2.0 * depth * std::tan(0.5 * viewAngle * std::numbers::pi / 180.0) / size[1];
  const Eigen::Vector3d up = vectorOf(camera->GetViewUp()).normalized();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  return eye + depth * forward + pixel * ((x - 0.5 * size[0]) * right + (0.5 * size[1] - y) * up);
}

std::vector<char> CameraControl::inView(const Points& points, double slack) const {
  const Eigen::Matrix4d seen = projection();
  const int* size = renderer_->GetSize();
  const double room = slack / pixelSize();
  std::vector<char> inside(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto pixel = seenAt(seen, size, points.col(i));
    inside[static_cast<std::size_t>(i)] =
        pixel && pixel->x() > -room && pixel->y() > -room && pixel->x() < size[0] + room && pixel->y() < size[1] + room;
  }
  return inside;
}

double CameraControl::pixelSize() const {
  return 2.0 * renderer_->GetActiveCamera()->GetDistance() * std::tan(0.5 * viewAngle * std::numbers::pi / 180.0) /
         std::max(1, renderer_->GetSize()[1]);
}

std::optional<int> CameraControl::nearestPoint(const Points& points, double x, double y, double radius) const {
  const Eigen::Vector2d place(x, renderer_->GetSize()[1] - y);
  std::optional<int> nearest;
  double least = radius;
  const Eigen::Matrix4d seen = projection();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const std::optional<Eigen::Vector2d> pixel = seenAt(seen, renderer_->GetSize(), points.col(i));
    if (!pixel || (*pixel - place).norm() > least) continue;
    least = (*pixel - place).norm();
    nearest = static_cast<int>(i);
  }
  return nearest;
}

Eigen::Matrix4d CameraControl::projection() const {
  const vtkMatrix4x4* matrix =
      renderer_->GetActiveCamera()->GetCompositeProjectionTransformMatrix(renderer_->GetTiledAspectRatio(), -1, 1);
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&matrix->Element[0][0]);
}

void CameraControl::updateClipping() {
  // Wide enough for markers and the ghost, which reach a little beyond the nodes of the solved motion.
  const Eigen::Vector3d low = reach_.rowwise().minCoeff(), high = reach_.rowwise().maxCoeff();
  const Eigen::Vector3d slack = Eigen::Vector3d::Constant(0.5 * std::max((high - low).norm(), 1e-9));
  double bounds[6];
  for (int axis = 0; axis < 3; ++axis) {
    bounds[2 * axis] = (low - slack)[axis];
    bounds[2 * axis + 1] = (high + slack)[axis];
  }
  renderer_->ResetCameraClippingRange(bounds);
}

}  // namespace pliant::render
