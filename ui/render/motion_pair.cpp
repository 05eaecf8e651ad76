#include "ui/render/motion_pair.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>

#include "ui/render/legend.hpp"
#include "ui/render/thread_safe_text.hpp"

namespace pliant::render {
namespace {

constexpr double dividerWidth = 1;  // device-independent pixels

}  // namespace

/// What lies below both halves: the line between them, and the scalar bar of both at the right.
struct MotionPair::Backdrop {
  ThreadSafeText threadSafeText;  // before any text
  vtkNew<vtkRenderer> renderer;
  Legend legend;
  vtkNew<vtkPolyData> line;
  vtkNew<vtkActor2D> divider;
  bool legendVisible = false;

  Backdrop() {
    renderer->InteractiveOff();
    legend.addTo(renderer);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(line);
    divider->SetMapper(mapper);
    renderer->AddActor2D(divider);
  }

  void setDivider(double left, double right, double height) {
    vtkNew<vtkPoints> points;
    for (const auto& [x, y] : {std::pair(left, 0.0), {right, 0.0}, {right, height}, {left, height}})
      points->InsertNextPoint(x, y, 0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({0, 1, 2, 3});
    line->SetPoints(points);
    line->SetPolys(cells);
  }
};

MotionPair::MotionPair(MotionView& left) : left_(left), backdrop_(std::make_unique<Backdrop>()) {
  right_.renderer()->SetActiveCamera(left_.renderer()->GetActiveCamera());
  right_.setGizmoVisible(false);
}

MotionPair::~MotionPair() {
  right_.attach(nullptr);
  if (window_) window_->RemoveRenderer(backdrop_->renderer);
  left_.renderer()->SetViewport(0, 0, 1, 1);
  left_.setSharedRange(std::nullopt);
  left_.setBeyond(Points(3, 0));
}

void MotionPair::attach(vtkRenderWindow* window) {
  window_ = window;
  left_.attach(nullptr);
  window->AddRenderer(backdrop_->renderer);  // drawn first
  left_.attach(window);
  right_.attach(window);
  layOut();
}

void MotionPair::setRight(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z,
                          const std::string& caption) {
  right_.setModel(problem->sharedModel());
  right_.setMotion(std::move(problem), z);
  right_.setSelectedNode(left_.selectedNode());
  right_.setCaption(caption);
  right_.setTau(left_.tau());
  share();
}

void MotionPair::share() {
  const FieldRange a = left_.fieldRange(), b = right_.fieldRange();
  const FieldRange both{std::min(a.least, b.least), std::max(a.most, b.most)};
  left_.setSharedRange(both);
  right_.setSharedRange(both);
  left_.setBeyond(right_.reach());
  backdrop_->legendVisible = left_.showsField();
  backdrop_->legend.setVisible(backdrop_->legendVisible);
  backdrop_->legend.setRange(both.least, both.most);
  backdrop_->legend.setTable(left_.colorTable());
  layOut();
}

void MotionPair::setTheme(Theme theme) {
  theme_ = theme;
  right_.setTheme(theme);
  const Palette& colors = palette(theme);
  backdrop_->renderer->SetBackground(colors.background.data());
  backdrop_->legend.setTheme(colors);
  backdrop_->divider->GetProperty()->SetColor(colors.rest.data());
}

void MotionPair::setPixelRatio(double ratio) {
  ratio_ = ratio;
  right_.setPixelRatio(ratio);
  backdrop_->legend.setPixelRatio(ratio);
}

void MotionPair::setFieldVisible(bool visible) {
  right_.setFieldVisible(visible);
  share();
}

void MotionPair::setFineQuality(bool fine) { right_.setFineQuality(fine); }

void MotionPair::layOut() {
  if (!window_) return;
  const int* size = window_->GetSize();
  const int width = std::max(1, size[0]);
  const double legend = backdrop_->legendVisible ? std::min(0.4, Legend::width * ratio_ / width) : 0;
  const double line = dividerWidth * ratio_ / width, half = 0.5 * (1 - legend - line);
  left_.renderer()->SetViewport(0, 0, half, 1);
  right_.renderer()->SetViewport(half + line, 0, 2 * half + line, 1);
  backdrop_->setDivider(half * width, (half + line) * width, size[1]);
  backdrop_->legend.layOut(size[0], size[1]);
}

double MotionPair::rightBegin() const { return right_.renderer()->GetViewport()[0] * window_->GetSize()[0]; }

}  // namespace pliant::render
