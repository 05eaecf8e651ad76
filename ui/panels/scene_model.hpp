#pragma once

#include <QAbstractItemModel>

#include "ui/document/document.hpp"
#include "ui/panels/scene_item.hpp"

namespace pliant::panels {

/// The scene of a document as a tree of two columns, name and value. Editing a value edits the document.
class SceneModel final : public QAbstractItemModel {
  Q_OBJECT

 public:
  explicit SceneModel(document::Document& document, QObject* parent = nullptr);

  const SceneItem* itemAt(const QModelIndex& index) const;
  /// The value column of the line with this pointer; invalid if there is none.
  QModelIndex indexOf(const std::string& pointer) const;
  const document::Document& document() const { return document_; }

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& child) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& = {}) const override { return 2; }
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 private:
  void rebuild();
  void refreshValues();
  QModelIndex indexFor(const SceneItem* item, int column) const;

  document::Document& document_;
  std::unique_ptr<SceneItem> root_;
};

}  // namespace pliant::panels
