#include "ui/shell/action_registry.hpp"

#include <QWidget>

#include "ui/panels/icon.hpp"

namespace pliant::shell {

ActionRegistry::ActionRegistry(QWidget* window) : QObject(window), window_(window) {}

QAction* ActionRegistry::add(const ActionRecord& record, std::function<void()> trigger) {
  auto* action = new QAction(record.text, window_);
  action->setObjectName(record.id);
  action->setShortcut(record.shortcut);
  if (!record.icon.isEmpty()) action->setIcon(panels::icon(record.icon));
  const QString keys = record.shortcut.toString(QKeySequence::NativeText);
  action->setToolTip(keys.isEmpty() ? record.tooltip : QStringLiteral("%1 (%2)").arg(record.tooltip, keys));
  connect(action, &QAction::triggered, window_, [trigger = std::move(trigger)] { trigger(); });
  window_->addAction(action);
  actions_.push_back(action);
  return action;
}

QAction* ActionRegistry::find(const QString& id) const {
  for (QAction* action : actions_)
    if (action->objectName() == id) return action;
  return nullptr;
}

}  // namespace pliant::shell
