#pragma once

#include <QStyledItemDelegate>
#include <QTreeView>
#include <set>

#include "ui/panels/scene_model.hpp"

class QMenu;

namespace pliant::panels {

using scene::Json;

/// Edits one value of the scene: a list for choices and names of other entries, a line for all else.
class SceneDelegate final : public QStyledItemDelegate {
  Q_OBJECT

 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  void setEditorData(QWidget* editor, const QModelIndex& index) const override;
  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  /// Lists that can grow have a plus at the end of their line.
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

/// The scene as a tree with editable values. Entries of lists are added (plus, Insert), duplicated (Ctrl+D) and removed
/// (Delete), each as one undo step.
class SceneTree final : public QTreeView {
  Q_OBJECT

 public:
  explicit SceneTree(document::Document& document, QWidget* parent = nullptr);

  SceneModel& sceneModel() { return model_; }
  QSize sizeHint() const override { return {288, 480}; }

  /// Where new masses, drives, probes and the like are put.
  void setSelectedNode(int node) { node_ = node; }
  /// Adds an entry of this kind (see document::entryTypes) with sensible values.
  void addEntry(const std::string& list, const std::string& type);
  /// The entry at this pointer.
  void duplicateEntry(const std::string& pointer);
  void removeEntry(const std::string& pointer);

 Q_SIGNALS:
  /// A study was double-clicked or chosen from the context menu.
  void studyActivated(const std::string& name);
  void currentPointerChanged(const std::string& pointer);

 protected:
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void currentChanged(const QModelIndex& current, const QModelIndex& previous) override;

 private:
  void expandDefault();
  void restoreExpanded();
  void insertEntry(const std::string& list, const Json& entry, std::size_t place, const QString& text);
  void addActionsFor(QMenu& menu, const std::string& list);
  /// Adds at once where there is one kind of entry, else asks for the kind in a menu.
  void offerEntries(const std::string& list, const QPoint& place);

  document::Document& document_;
  SceneModel model_;
  int node_ = 0;
  std::set<std::string> expanded_;  ///< pointers of open lines while the lines are made anew
  std::string awaited_;             ///< pointer of the entry that will come into being
};

}  // namespace pliant::panels
