#pragma once

#include <QFrame>
#include <QTimer>

#include "core/base/execution_context.hpp"

class QLabel;
class QToolButton;

namespace pliant::panels {

/// One sentence above the window's contents, never in the way. News goes by itself; a warning stays until it is closed
/// or the next message comes.
class MessageBar final : public QFrame {
  Q_OBJECT

 public:
  explicit MessageBar(QWidget* parent = nullptr);

  void show(base::Severity severity, const QString& sentence);
  void dismiss();
  QString sentence() const;

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void applyStyle();

  base::Severity severity_ = base::Severity::information;
  QLabel* icon_;
  QLabel* text_;
  QToolButton* close_;
  QTimer timer_;
};

}  // namespace pliant::panels
