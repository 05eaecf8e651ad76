#include "ui/viewport/viewport.hpp"

#include <QApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <cmath>
#include <numbers>
#include <utility>

#include "ui/render/motion_pair.hpp"
#include "ui/viewport/mouse_tool.hpp"
#include "ui/viewport/render_surface.hpp"

namespace pliant::viewport {
namespace {

constexpr double pickRadius = 12;   // device-independent pixels
constexpr double wheelNotch = 120;  // eighths of a degree
constexpr double zoomPerNotch = 1.15;
constexpr int frameInterval = 16;  // milliseconds
constexpr int settleDelay = 250;   // milliseconds
constexpr double fullTurn = 2.0 * std::numbers::pi;

}  // namespace

Viewport::Viewport(QWidget* parent) : QWidget(parent), surface_(makeRenderSurface(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(surface_->widget());
  // Mouse events are the viewport's, whatever the surface.
  surface_->widget()->setAttribute(Qt::WA_TransparentForMouseEvents);
  surface_->widget()->setFocusPolicy(Qt::NoFocus);
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Viewport"));
  attachToSurface();
  surface_->onResize = [this](double pixelRatio) {
    view_->setPixelRatio(pixelRatio);
    if (pair_) {
      pair_->setPixelRatio(pixelRatio);
      pair_->layOut();
    }
    if (framed_) view_->fit();
  };
  timer_.setInterval(frameInterval);
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, &Viewport::advance);
  settleTimer_.setInterval(settleDelay);
  settleTimer_.setSingleShot(true);
  connect(&settleTimer_, &QTimer::timeout, this, [this] {
    if (isPlaying()) return;  // the next frame is on its way
    setFineQuality(true);
    surface_->requestRender();
  });
  view_->setAxisView(render::AxisView::isometric);
  applyTheme();
}

Viewport::~Viewport() {
  surface_->onResize = nullptr;
  pair_.reset();
  view_->attach(nullptr);
}

void Viewport::setModel(std::shared_ptr<const mechanics::Model> model) {
  const int nodes = model ? model->nodeCount() : 0;
  const int dimension = model ? model->dimension : 0;
  const bool other = nodes != nodeCount_ || dimension != dimension_;
  nodeCount_ = nodes;
  dimension_ = dimension;
  clearBeside();
  setCloth(nullptr);
  motion_.setModel(std::move(model));
  if (other) {
    view_->setAxisView(dimension < 3 ? render::AxisView::top : render::AxisView::isometric);
    framed_ = true;
    motionFramed_ = false;
  }
  redraw();
}

void Viewport::setMotion(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z) {
  motion_.setMotion(std::move(problem), z);
  if (pair_) pair_->share();
  // The first motion is brought into view; later ones are compared with it at the same scale.
  if (framed_ && !motionFramed_) motion_.fit();
  motionFramed_ = true;
  redraw();
}

void Viewport::clearMotion() {
  motion_.clearMotion();
  redraw();
}

void Viewport::setPrediction(const mechanics::Vector& z, std::shared_ptr<const mechanics::Model> changedModel) {
  motion_.setPrediction(z, std::move(changedModel));
  redraw(true);
}

void Viewport::clearPrediction() {
  motion_.clearPrediction();
  redraw();
}

void Viewport::setStale(bool stale) {
  motion_.setStale(stale);
  cloth_.setStale(stale);
  redraw();
}

void Viewport::setSelectedNode(std::optional<int> node) {
  motion_.setSelectedNode(node);
  if (pair_) pair_->right().setSelectedNode(node);
  cloth_.setSelectedNode(node);
  redraw();
}

void Viewport::setCaption(const QString& text) {
  motion_.setCaption(text.toStdString());
  cloth_.setCaption(text.toStdString());
  cell_.setCaption(text.toStdString());
  redraw();
}

void Viewport::setFieldVisible(bool visible) {
  motion_.setFieldVisible(visible);
  if (pair_) pair_->setFieldVisible(visible);
  cloth_.setFieldVisible(visible);
  if (guest_) guest_->setFieldVisible(visible);
  redraw();
}

std::optional<int> Viewport::selectedNode() const {
  return showsCloth() ? cloth_.selectedNode() : motion_.selectedNode();
}

double Viewport::tau() const { return motion_.tau(); }

QString Viewport::surfaceName() const { return surface_->name(); }

QImage Viewport::grabImage() {
  settle();
  return surface_->grabImage();
}

QSize Viewport::sizeHint() const { return {720, 480}; }

QSize Viewport::minimumSizeHint() const { return {160, 120}; }

void Viewport::play() {
  if (isPlaying() || live_) return;
  clock_.start();
  timer_.start();
  Q_EMIT playingChanged(true);
}

void Viewport::pause() {
  if (!isPlaying()) return;
  timer_.stop();
  redraw();
  Q_EMIT playingChanged(false);
}

void Viewport::togglePlaying() { isPlaying() ? pause() : play(); }

void Viewport::setTau(double tau) {
  if (!std::isfinite(tau)) return;
  double wrapped = std::fmod(tau, fullTurn);
  if (wrapped < 0) wrapped += fullTurn;
  if (wrapped == motion_.tau()) return;
  motion_.setTau(wrapped);
  if (pair_) pair_->setTau(wrapped);
  redraw(true);
  Q_EMIT tauChanged(wrapped);
}

void Viewport::setSpeed(double periodsPerSecond) { speed_ = periodsPerSecond; }

void Viewport::fit() {
  framed_ = true;
  view_->fit();
  redraw();
}

void Viewport::setAxisView(render::AxisView view) {
  framed_ = true;
  view_->setAxisView(view);
  redraw();
}

void Viewport::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) applyTheme();
  QWidget::changeEvent(event);
}

void Viewport::mousePressEvent(QMouseEvent* event) {
  pressPosition_ = lastPosition_ = event->position();
  dragged_ = false;
  if (pressTool(event->position(), event->button(), event->modifiers())) return;
  if (live_ && event->button() == Qt::LeftButton) beginPull(*event);
  if (showsCell() && event->button() == Qt::LeftButton) beginGrip(*event);
}

void Viewport::mouseMoveEvent(QMouseEvent* event) {
  if (toolHolds_) {
    dragTool(event->position());
    return;
  }
  const bool turns = event->buttons() & (Qt::LeftButton | Qt::RightButton);
  const bool middle = event->buttons() & Qt::MiddleButton;
  if (!turns && !middle) {
    if (live_ || showsCell()) refreshCursor(event->position());
    if (activeTool()) hoverTool(event->position());
    Q_EMIT hovered(event->position());
    return;
  }
  if (!dragged_ && (event->position() - pressPosition_).manhattanLength() < QApplication::startDragDistance()) return;
  dragged_ = true;
  if (pulled_) {
    movePull(event->position());
    return;
  }
  if (grip_) {
    moveGrip(event->position());
    return;
  }
  framed_ = false;
  const QPointF moved = event->position() - lastPosition_;
  lastPosition_ = event->position();
  if (middle || (event->modifiers() & Qt::ShiftModifier)) {
    view_->pan(moved.x() * devicePixelRatioF(), moved.y() * devicePixelRatioF());
  } else {
    view_->orbit(moved.x() / height(), moved.y() / height());
  }
  redraw(true);
}

void Viewport::mouseReleaseEvent(QMouseEvent* event) {
  if (toolHolds_) {
    releaseTool();
    return;
  }
  if (event->button() != Qt::LeftButton) return;
  if (pulled_) endPull(event->modifiers() & Qt::ControlModifier);
  if (grip_) endGrip();
  if (!dragged_) Q_EMIT nodePicked(nodeAt(event->position()).value_or(-1));
}

std::optional<int> Viewport::nodeAt(const QPointF& place) const {
  const auto [view, pixel] = halfAt(place);
  return view.pickNode(pixel.x(), pixel.y(), pickRadius * devicePixelRatioF());
}

void Viewport::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  dragged_ = true;  // its release is no click
  fit();
}

void Viewport::wheelEvent(QWheelEvent* event) {
  const QPointF place = halfAt(event->position()).second;
  framed_ = false;
  view_->zoom(std::pow(zoomPerNotch, event->angleDelta().y() / wheelNotch), place.x(), place.y());
  redraw(true);
  event->accept();
}

void Viewport::leaveEvent(QEvent* event) {
  QWidget::leaveEvent(event);
  Q_EMIT hovered(std::nullopt);
}

void Viewport::keyPressEvent(QKeyEvent* event) {
  using render::AxisView;
  switch (event->key()) {
    case Qt::Key_Space: togglePlaying(); break;
    case Qt::Key_Escape:
      if (activeTool() && activeTool()->escape())
        toolHolds_ = false;
      else if (pulled_)
        endPull(false);
      else if (grip_)
        endGrip();
      else
        QWidget::keyPressEvent(event);
      break;
    case Qt::Key_F: fit(); break;
    case Qt::Key_0: setAxisView(AxisView::isometric); break;
    case Qt::Key_1: setAxisView(AxisView::front); break;
    case Qt::Key_2: setAxisView(AxisView::back); break;
    case Qt::Key_3: setAxisView(AxisView::right); break;
    case Qt::Key_4: setAxisView(AxisView::left); break;
    case Qt::Key_5: setAxisView(AxisView::top); break;
    case Qt::Key_6: setAxisView(AxisView::bottom); break;
    default: QWidget::keyPressEvent(event);
  }
}

void Viewport::advance() {
  const double seconds = 1e-3 * static_cast<double>(clock_.restart());
  if (playback())
    setTime(playback()->after(seconds, clothSpeed_));
  else
    setTau(motion_.tau() + fullTurn * speed_ * seconds / motion_.periods());
}

void Viewport::redraw(bool moving) {
  // What moved a moment ago stays rough whatever else is redrawn: a drag changes the caption as well.
  if ((moving || isPlaying()) && surface_->drawsInSoftware()) settleTimer_.start();
  setFineQuality(!settleTimer_.isActive());
  surface_->requestRender();
}

void Viewport::setFineQuality(bool fine) {
  view_->setFineQuality(fine);
  if (pair_) pair_->setFineQuality(fine);
}

void Viewport::attachToSurface() { view_->attach(surface_->window()); }

void Viewport::settle() {
  if (!settleTimer_.isActive()) return;
  settleTimer_.stop();
  setFineQuality(true);
  surface_->requestRender();
}

render::Theme Viewport::theme() const {
  return palette().color(QPalette::Window).lightnessF() < 0.5 ? render::Theme::dark : render::Theme::light;
}

void Viewport::applyTheme() {
  for (render::View* view : std::initializer_list<render::View*>{&motion_, &cloth_, &cell_}) view->setTheme(theme());
  if (guest_) guest_->setTheme(theme());
  if (pair_) pair_->setTheme(theme());
  redraw();
}

void Viewport::setGuest(std::shared_ptr<render::View> guest) {
  if (guest == guest_) return;
  guestPlayback_.clear();
  const auto before = std::exchange(guest_, std::move(guest));  // detached before it may go
  if (guest_) {
    pause();
    showView(*guest_);
    guest_->setTheme(theme());
    guest_->setFieldVisible(motion_.fieldVisible());
  } else {
    pause();
    showOwnView();
  }
  Q_EMIT clothChanged();
  refreshTools();
}

void Viewport::redrawGuest(bool refit) {
  if (!guest_) return;
  if (refit && framed_) guest_->fit();
  redraw();
}

void Viewport::showOwnView() { showView(clothProblem_ ? static_cast<render::View&>(cloth_) : motion_); }

}  // namespace pliant::viewport
