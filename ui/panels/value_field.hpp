#pragma once

#include <QLineEdit>

namespace pliant::panels {

/// A number with its unit that reads like a label. A double click, or Return while it has the focus, makes it editable;
/// Return takes what was typed, Escape takes it back.
class ValueField final : public QLineEdit {
  Q_OBJECT

 public:
  explicit ValueField(QWidget* parent = nullptr);

  /// What is shown, and what editing begins with.
  void setTexts(const QString& shown, const QString& exact);
  QString shownText() const { return shown_; }
  /// Shows `text` without changing what editing begins with: the number that is being dragged.
  void showTransient(const QString& text);

 Q_SIGNALS:
  void typed(const QString& text);

 protected:
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void beginEditing();
  void endEditing();

  QString shown_;
  QString exact_;
};

}  // namespace pliant::panels
