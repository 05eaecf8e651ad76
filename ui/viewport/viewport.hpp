#pragma once

#include <QElapsedTimer>
#include <QImage>
#include <QPointF>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>
#include <utility>

#include "core/harmonic/harmonic_balance_problem.hpp"
#include "ui/render/cell_view.hpp"
#include "ui/render/cloth_view.hpp"
#include "ui/render/film.hpp"
#include "ui/render/motion_view.hpp"
#include "ui/viewport/playback.hpp"

namespace pliant::render {
class MotionPair;
}

namespace pliant::viewport {

class MouseTool;
class RenderSurface;

/// The widget that shows a model and plays its motion, or a cloth and its frames. Left drag orbits, middle or shift
/// drag pans, the wheel zooms towards the cursor, a double click or F fits, 1 to 6 look along the axes, 0
/// isometrically, Space plays and pauses, a click picks a node. A live cloth is pulled by a left drag that begins at
/// one of its nodes; a right drag turns in any case. Colours follow the palette.
class Viewport : public QWidget {
  Q_OBJECT

 public:
  using FrameClock = render::FrameClock;

  /// Throws std::runtime_error if this machine can draw neither by OpenGL nor by Mesa's software renderer.
  explicit Viewport(QWidget* parent = nullptr);
  ~Viewport() override;

  /// See render::MotionView. A new model with as many nodes keeps the camera, another one is fitted.
  void setModel(std::shared_ptr<const mechanics::Model> model);
  void setMotion(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z);
  void clearMotion();
  void setPrediction(const mechanics::Vector& z, std::shared_ptr<const mechanics::Model> changedModel = nullptr);
  void clearPrediction();
  void setGhost(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z,
                const QString& label);
  /// Shows another motion to the right of the one on show, whose model has the same nodes: both in step, seen by one
  /// camera, coloured by one scale.
  void setBeside(std::shared_ptr<const harmonic::HarmonicBalanceProblem> problem, const mechanics::Vector& z,
                 const QString& caption);
  void clearBeside();
  /// Null: the motion has the viewport to itself.
  const render::MotionPair* pair() const { return pair_.get(); }
  /// Gets the mouse first while a motion or a model is shown, or a guest; outlives that. Null: none.
  void setTool(MouseTool* tool);
  void setGuestTool(MouseTool* tool);
  const MouseTool* tool() const { return tool_; }
  render::MotionView& motionView() { return motion_; }
  /// Redraws after something was set at motionView().
  void redrawMotion() { redraw(true); }
  void setStale(bool stale);
  void setSelectedNode(std::optional<int> node);
  void setCaption(const QString& text);
  void setFieldVisible(bool visible);

  /// Shows a cloth in the place of the model and its motion, at rest; null: these again. See render::ClothView.
  void setCloth(std::shared_ptr<const cloth::ClothProblem> problem);
  bool showsCloth() const { return view_ == &cloth_; }
  /// Shows another view in the place of all that, from where it was seen last; null: that again.
  void setGuest(std::shared_ptr<render::View> guest);
  const std::shared_ptr<render::View>& guest() const { return guest_; }
  /// The guest, a render::FrameView, has frames at these times, which are played as those of a cloth are; none: it
  /// stands still. See setClothFrames.
  void setGuestFrames(std::vector<double> times, bool growing, FrameClock clock);
  /// Whether there are frames to be played and scrubbed, of a cloth or a guest.
  bool showsFrames() const { return playback() != nullptr; }
  /// Redraws after something was set at the guest. `refit`: it reaches elsewhere now, and is fitted unless somebody has
  /// moved the camera.
  void redrawGuest(bool refit = false);
  render::ClothView& clothView() { return cloth_; }
  std::shared_ptr<const cloth::ClothProblem> clothProblem() const { return clothProblem_; }
  /// All frames of the cloth. While they grow the newest is shown, unless another one was chosen.
  void setClothFrames(std::vector<std::shared_ptr<const scene::ClothFrame>> frames, bool growing, FrameClock clock);
  const std::vector<std::shared_ptr<const scene::ClothFrame>>& clothFrames() const { return frames_; }
  /// What is shown of the frames of a cloth or a guest; without any, as of seconds.
  FrameClock frameClock() const { return playback() ? playback()->clock() : FrameClock::seconds; }
  double duration() const { return playback() ? playback()->duration() : 0; }
  double time() const { return playback() ? playback()->time() : 0; }
  /// The cloth on show goes on by itself, and its nodes can be pulled; there is nothing to play or to scrub.
  void setLive(bool live);
  bool isLive() const { return live_; }
  /// The live cloth as it is now, and the hands that hold it.
  void showLive(std::shared_ptr<const scene::ClothFrame> frame, std::vector<render::Hand> hands);
  /// The node that the mouse pulls.
  std::optional<int> pulledNode() const { return pulled_; }
  /// Shows an interlocking cell in the place of the model, at rest; null: the model again. Its elements and handles are
  /// pulled by a left drag that begins at one of them. See render::CellView.
  void setCell(std::shared_ptr<const interlock::UnitCell> cell);
  bool showsCell() const { return view_ == &cell_; }
  render::CellView& cellView() { return cell_; }
  /// Where its elements are now. The view follows as long as nobody moved the camera or holds a grip.
  void showCellState(const interlock::CellState& state, const std::vector<interlock::LiveContact>& contacts);
  void redrawCell() { redraw(true); }
  /// What the mouse holds of the cell.
  const std::optional<render::CellPick>& heldGrip() const { return grip_; }

  /// Redraws after something was set at clothView().
  void redrawCloth() { redraw(); }

  std::optional<int> selectedNode() const;
  double tau() const;
  bool isPlaying() const { return timer_.isActive(); }
  /// Periods shown in a second; 0.5 at first.
  double speed() const { return speed_; }
  /// How much faster than life a cloth or a guest is shown; 1 at first.
  double clothSpeed() const { return clothSpeed_; }
  /// What a click there would pick.
  std::optional<int> nodeAt(const QPointF& place) const;
  /// "OpenGL" or "software".
  QString surfaceName() const;

  /// While things move, a processor that draws in software leaves edges rough, and smooths them a moment after. This
  /// does it at once: for pictures.
  void settle();
  /// What makes a film look and play as this does: camera, colours, caption and speed; at least 720 pixels high.
  render::FilmOptions filmOptions() const;
  /// The settled picture at the screen's resolution.
  QImage grabImage();

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 public Q_SLOTS:
  void play();
  void pause();
  void togglePlaying();
  /// The place in the period [rad], wrapped to [0, 2π).
  void setTau(double tau);
  void setSpeed(double periodsPerSecond);
  /// Shows the last frame of the cloth or guest that is not after this time.
  void setTime(double time);
  void setClothSpeed(double factor) { clothSpeed_ = factor; }
  void fit();
  void setAxisView(pliant::render::AxisView view);

 Q_SIGNALS:
  /// A click hit this node; -1: nothing near. The selection is the receiver's to change.
  void nodePicked(int node);
  /// The mouse took a node of the live cloth or moves it: where it is to go [m].
  void nodePulled(int node, const Eigen::Vector3d& hand);
  /// The mouse let it go. `stay`: it is to be held where it is.
  void nodeLetGo(int node, bool stay);
  /// The mouse took a place of the cell, or moves it: where it is to go [m].
  void gripPulled(const pliant::render::CellPick& grip, const Eigen::Vector3d& hand);
  void gripLetGo();
  void tauChanged(double tau);
  void timeChanged(double time);
  /// A cloth or a guest with frames, or how much there is of it, or none any more.
  void clothChanged();
  /// Where the pointer is while no button is pressed; none once it has left. Only with setMouseTracking(true).
  void hovered(std::optional<QPointF> place);
  void playingChanged(bool playing);

 protected:
  void changeEvent(QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void advance();
  /// Of what is shown; null: it has no frames.
  const Playback* playback() const;
  Playback* playback() { return const_cast<Playback*>(std::as_const(*this).playback()); }
  void showPlayback();
  void beginPull(const QMouseEvent& event);
  void movePull(const QPointF& place);
  void endPull(bool toggles);
  void beginGrip(const QMouseEvent& event);
  void moveGrip(const QPointF& place);
  void endGrip();
  std::optional<render::CellPick> gripAt(const QPointF& place) const;
  MouseTool* activeTool() const;
  void refreshTools();
  bool pressTool(const QPointF& place, Qt::MouseButton button, Qt::KeyboardModifiers modifiers);
  void dragTool(const QPointF& place);
  void releaseTool();
  void hoverTool(const QPointF& place);
  std::pair<render::View&, QPointF> halfAt(const QPointF& place) const;
  void refreshCursor(const QPointF& place);
  void showView(render::View& view);
  void showOwnView();
  void attachToSurface();
  /// `moving`: more of the kind is to come soon.
  void redraw(bool moving = false);
  void setFineQuality(bool fine);
  void applyTheme();
  render::Theme theme() const;

  render::MotionView motion_;
  render::ClothView cloth_;
  render::CellView cell_;
  std::shared_ptr<render::View> guest_;
  render::View* view_ = &motion_;  ///< what is shown
  std::unique_ptr<RenderSurface> surface_;
  std::unique_ptr<render::MotionPair> pair_;
  MouseTool *tool_ = nullptr, *guestTool_ = nullptr;
  bool toolHolds_ = false;
  QTimer timer_;
  QTimer settleTimer_;
  QElapsedTimer clock_;
  double speed_ = 0.5;
  std::vector<std::shared_ptr<const scene::ClothFrame>> frames_;
  std::shared_ptr<const cloth::ClothProblem> clothProblem_;
  Playback clothPlayback_, guestPlayback_;
  double clothSpeed_ = 1;
  bool live_ = false;
  std::vector<int> handheld_;             ///< nodes of the live cloth, the pulled one too
  std::optional<int> pulled_;             ///< by the mouse
  bool heldBefore_ = false;               ///< the pulled node, by hand
  Eigen::Vector3d pullBegin_;             ///< where the pulled node was
  QPointF pullFrom_;                      ///< where the mouse was then
  std::optional<render::CellPick> grip_;  ///< held by the mouse, as it was taken
  Eigen::Vector3d gripOffset_;            ///< from the mouse's place to the grip's
  int nodeCount_ = 0;
  int dimension_ = 0;
  bool framed_ = true;         ///< the camera is where fit() or an axis view put it
  bool motionFramed_ = false;  ///< the present model's motion has been fitted
  bool dragged_ = false;
  QPointF pressPosition_;
  QPointF lastPosition_;
};

}  // namespace pliant::viewport
