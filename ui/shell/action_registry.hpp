#pragma once

#include <QAction>
#include <QObject>
#include <functional>
#include <vector>

namespace pliant::shell {

/// What an action is, declared once: menus, tool bar, command palette and tooltips are made from it.
struct ActionRecord {
  QString id;    ///< "file.open"
  QString text;  ///< with a mnemonic: "&Open…"
  QString icon;  ///< of resources/icons; may be empty
  QKeySequence shortcut;
  QString tooltip;  ///< one sentence
};

/// All actions of a window, by id.
class ActionRegistry final : public QObject {
  Q_OBJECT

 public:
  /// Actions belong to `window`, so that their shortcuts work in all of it.
  explicit ActionRegistry(QWidget* window);

  QAction* add(const ActionRecord& record, std::function<void()> trigger);
  /// Null if there is no such action.
  QAction* find(const QString& id) const;
  const std::vector<QAction*>& all() const { return actions_; }

 private:
  QWidget* window_;
  std::vector<QAction*> actions_;
};

}  // namespace pliant::shell
