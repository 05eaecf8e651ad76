#pragma once

#include <QTreeWidget>

#include "core/base/execution_context.hpp"

namespace pliant::panels {

/// Everything that was said in this session, with its time, newest last.
class LogPanel final : public QTreeWidget {
  Q_OBJECT

 public:
  explicit LogPanel(QWidget* parent = nullptr);

  void add(base::Severity severity, const QString& sentence);
  int warningCount() const { return warnings_; }

 private:
  int warnings_ = 0;
};

}  // namespace pliant::panels
