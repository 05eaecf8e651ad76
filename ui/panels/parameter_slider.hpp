#pragma once

#include <QAbstractSlider>
#include <QBrush>

namespace pliant::panels {

/// A slider over a range of real numbers. It keeps a tick at a reference value (what the shown motion was solved with),
/// so that one sees how far the handle was moved. Arrow keys nudge by a hundredth of the range, with Shift by a
/// thousandth; Escape during a drag takes it back.
class ParameterSlider final : public QAbstractSlider {
  Q_OBJECT

 public:
  explicit ParameterSlider(QWidget* parent = nullptr);

  void setBounds(double minimum, double maximum);
  /// Values out of bounds stand at the end.
  void setRealValue(double value);
  double realValue() const { return value_; }
  double realMinimum() const { return minimum_; }
  double realMaximum() const { return maximum_; }
  void setReference(double reference);
  /// Parts of the range by which it would be moved along with others, from where it is: an arrow. 0: none.
  void setPlannedStep(double step);
  double plannedStep() const { return planned_; }
  /// Between these the prediction can be trusted; beyond, the track fades.
  void setTrusted(double low, double high);
  void clearTrusted();
  /// 1 where it can be trusted, towards 0 beyond.
  double trustAt(double value) const;
  bool isDragging() const { return dragging_; }

  /// The middle of the handle, in this widget's coordinates.
  QPoint handlePosition() const;

  QSize sizeHint() const override { return {160, 24}; }
  QSize minimumSizeHint() const override { return {80, 24}; }

 Q_SIGNALS:
  void dragged(double value);
  /// The drag ended, or a key was pressed (`nudge`).
  void committed(double value, bool nudge);
  void dragCancelled();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  double positionOf(double value) const;
  double valueAt(double x) const;
  void put(double value);
  void paintPlan(QPainter& painter, const QColor& color) const;
  QBrush faded(const QColor& color) const;

  double minimum_ = 0;
  double maximum_ = 1;
  double value_ = 0;
  double reference_ = 0;
  double planned_ = 0;
  double trustedLow_ = 0, trustedHigh_ = 0;
  bool trustKnown_ = false;
  double before_ = 0;  ///< the drag
  double grip_ = 0;    ///< from the handle's middle to where it was seized
  bool dragging_ = false;
};

}  // namespace pliant::panels
