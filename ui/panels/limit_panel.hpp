#pragma once

#include <QWidget>
#include <functional>

#include "ui/document/document.hpp"
#include "ui/panels/limit_entry.hpp"

class QComboBox;
class QLabel;
class QSpinBox;
class QToolButton;

namespace pliant::plots {
class PolarEditor;
}

namespace pliant::panels {

class LimitTable;

/// The stretch limits of the scene, one at a time: the polar editor, the kind of limit, how it is enforced, and its
/// numbers in a table. Each edit is one undo step at the limit's entry, and so is a whole drag.
class LimitPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit LimitPanel(document::Document& document, QWidget* parent = nullptr);

  plots::PolarEditor* editor() const { return editor_; }
  LimitTable* table() const { return table_; }
  QComboBox* limits() const { return limits_; }
  QComboBox* kinds() const { return kinds_; }
  /// What was refused last; empty after the next edit.
  QString message() const;

  /// Which entry of "stretch_limits" is shown; -1: there is none.
  int shownLimit() const;
  void showLimit(int index);
  /// The largest stretches in the directions π i / size, reached by `name`; empty: none.
  void setReached(Eigen::VectorXd reached, const QString& name);
  /// Measured limits over the curve. Throws base::InputError.
  void importMeasured(const QString& file);

 Q_SIGNALS:
  /// Another limit is shown, or the panel is seen again.
  void limitShown(int index);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QToolButton* makeMenuButton();
  void makeWidgets();
  void connectParts();
  void fillLimits();
  void refresh(bool another);
  void refreshControls();
  void write(const QString& text, int mergeId);
  void say(const QString& sentence);
  void exportPlot();
  void act(const std::function<void()>& act);
  ConstraintChoice choice() const;

  document::Document& document_;
  QComboBox* limits_;
  QComboBox* kinds_;
  QToolButton* mirrored_;
  QToolButton* presets_;
  plots::PolarEditor* editor_;
  QLabel* message_;
  QWidget* enforcement_;
  QComboBox* methods_;
  QSpinBox* count_;
  LimitTable* table_;
};

}  // namespace pliant::panels
