#pragma once

#include <Eigen/Core>
#include <QObject>
#include <memory>
#include <set>
#include <vector>

#include "ui/viewport/mouse_tool.hpp"

namespace pliant::render {
class MacroView;
}

namespace pliant::viewport {

/// Paints triangles of a sheet: a left drag that begins on it is a stroke, with Ctrl one that wipes. Beside the sheet
/// and with the other buttons the view turns.
class SheetBrush final : public QObject, public MouseTool {
  Q_OBJECT

 public:
  explicit SheetBrush(std::shared_ptr<render::MacroView> view, QObject* parent = nullptr);
  /// Of the brush [physical pixels].
  void setRadius(double pixels) { radius_ = pixels; }

  bool press(double x, double y, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) override;
  void drag(double x, double y) override;
  void release() override;
  bool hover(double x, double y) override;
  bool escape() override;

 Q_SIGNALS:
  /// The stroke so far, in ascending order; empty: it was given up.
  void strokeGrows(const std::vector<int>& triangles, bool wipes);
  /// The mouse has let go.
  void strokeEnded(const std::vector<int>& triangles, bool wipes);

 private:
  void touch(double x, double y);

  std::shared_ptr<render::MacroView> view_;
  std::set<int> stroke_;
  bool wipes_ = false;
  double radius_ = 12;
  Eigen::Matrix2Xd pixels_;  ///< of the middles of all triangles, while a stroke is painted
  double x_ = 0, y_ = 0;     ///< where the mouse was
};

}  // namespace pliant::viewport
