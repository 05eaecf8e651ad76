#pragma once

#include <QStyledItemDelegate>
#include <QTreeView>

#include "ui/panels/scene_model.hpp"

namespace pliant::panels {

/// Edits one value of the scene: a list for choices and names of other entries, a line for all else.
class SceneDelegate final : public QStyledItemDelegate {
  Q_OBJECT

 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  void setEditorData(QWidget* editor, const QModelIndex& index) const override;
  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override;
  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

/// The scene as a tree with editable values.
class SceneTree final : public QTreeView {
  Q_OBJECT

 public:
  explicit SceneTree(document::Document& document, QWidget* parent = nullptr);

  SceneModel& sceneModel() { return model_; }
  QSize sizeHint() const override { return {288, 480}; }

 Q_SIGNALS:
  /// A study was double-clicked or chosen from the context menu.
  void studyActivated(const std::string& name);
  void currentPointerChanged(const std::string& pointer);

 protected:
  void contextMenuEvent(QContextMenuEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void currentChanged(const QModelIndex& current, const QModelIndex& previous) override;

 private:
  void expandDefault();

  document::Document& document_;
  SceneModel model_;
};

}  // namespace pliant::panels
