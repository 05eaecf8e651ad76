#pragma once

#include <QWidget>

#include "ui/plots/polar_picture.hpp"

namespace pliant::plots {

/// The polar curve of a stretch limit, to be edited: handles are dragged, a double click on a free curve adds a point,
/// Delete removes the selected one, the arrow keys nudge it (with Shift ten times finer), PageUp and PageDown select
/// another, Escape takes a drag back. What is not feasible is refused with a sentence.
///
/// It edits its own copy and says so; whoever listens brings it into the scene. The edits of one drag have one merge
/// id, and so have nudges of one handle in a row.
class PolarEditor final : public QWidget {
  Q_OBJECT

 public:
  explicit PolarEditor(QWidget* parent = nullptr);

  /// Shows another limit, none: the empty text. What is being dragged stays as it is. `another`: not an edit of the one
  /// before, so that axis and symmetry begin anew.
  void setLimit(const std::optional<cloth::StretchLimit>& limit, bool another = false);
  void setEmptyText(const QString& text);
  /// How the limit is enforced; none while that is computed.
  void setConstraints(std::optional<cloth::LimitConstraints> constraints);
  void setMeasured(std::vector<MeasuredLimit> measured);
  /// The largest stretches in the directions π i / size, reached by `name`; empty: none.
  void setReached(Eigen::VectorXd reached, const QString& name);
  void setPercent(bool percent);

  const PolarPicture& picture() const { return picture_; }
  const std::optional<LimitShape>& shape() const { return picture_.shape; }
  const PolarAxis& axis() const { return axis_; }
  bool isDragging() const { return dragged_ >= 0; }
  int selected() const { return picture_.selected; }

  /// Edits, as if made by hand.
  void setKind(LimitKind kind);
  void setSymmetry(LimitSymmetry symmetry);
  void takePreset(const LimitPreset& preset);
  void putHandle(int handle, const cloth::DirectionLimit& place);
  void addPoint(double angle);
  void removePoint(int handle);
  void select(int handle);

  /// Writes what is drawn as PDF, SVG, PNG or its numbers as CSV, by the extension. Throws base::InputError.
  void exportTo(const QString& file);

  QSize sizeHint() const override { return {320, 360}; }
  QSize minimumSizeHint() const override { return {220, 240}; }

 Q_SIGNALS:
  /// The limit is another one now; `text` names the edit.
  void edited(const QString& text, int mergeId);
  void refused(const QString& sentence);
  void selectionChanged(int handle);
  /// A handle was double-clicked: its number is to be typed.
  void activated(int handle);
  void exportRequested();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void layOut();
  void refit(bool anyway);
  int placeAt(const QPointF& position) const;
  bool onCurve(const QPointF& position) const;
  void dragTo(const QPointF& position, bool fine);
  void endDrag(bool keep);
  void nudge(int key, bool fine);
  /// Says what came of an edit, and shows it.
  void finish(const std::string& refusal, const QString& text, int mergeId = -1);

  PolarPicture picture_;
  PolarAxis axis_;
  int dragged_ = -1;                  ///< a place; -1: nothing is dragged
  HandlePlace grip_;                  ///< what was seized
  QPointF gripOffset_;                ///< from the handle to the pointer
  std::optional<LimitShape> before_;  ///< the drag
  bool moved_ = false;
  bool warned_ = false;  ///< the drag was refused something, and that was said
  int mergeId_ = 0;
  int nudged_ = -1;  ///< the handle of the last nudge, if nothing has come since
};

}  // namespace pliant::plots
