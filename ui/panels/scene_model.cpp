#include "ui/panels/scene_model.hpp"

#include <QBrush>
#include <QFont>
#include <QGuiApplication>

#include "ui/panels/value_text.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

using document::StudyStatus;

namespace {

/// The same lines with other values?
bool sameShape(const SceneItem& a, const SceneItem& b) {
  if (a.pointer != b.pointer || a.spec != b.spec || a.children.size() != b.children.size()) return false;
  for (std::size_t i = 0; i < a.children.size(); ++i)
    if (!sameShape(*a.children[i], *b.children[i])) return false;
  return true;
}

void copyValues(SceneItem& into, const SceneItem& from) {
  into.name = from.name;
  into.value = from.value;
  into.study = from.study;
  into.missing = from.missing;
  into.editable = from.editable;
  into.removable = from.removable;
  for (std::size_t i = 0; i < into.children.size(); ++i) copyValues(*into.children[i], *from.children[i]);
}

}  // namespace

SceneModel::SceneModel(document::Document& document, QObject* parent)
    : QAbstractItemModel(parent), document_(document), root_(std::make_unique<SceneItem>()) {
  connect(&document_, &document::Document::sceneReplaced, this, &SceneModel::rebuild);
  connect(&document_, &document::Document::sceneEdited, this, &SceneModel::refreshValues);
  connect(&document_, &document::Document::studyChanged, this, [this] {
    if (SceneItem* studies = root_->find("/studies"))
      if (!studies->children.empty())
        Q_EMIT dataChanged(indexFor(studies->children.front().get(), 0), indexFor(studies->children.back().get(), 1));
  });
  if (!document_.isEmpty()) rebuild();
}

void SceneModel::rebuild() {
  beginResetModel();
  root_ = document_.isEmpty() ? std::make_unique<SceneItem>() : makeSceneItems(document_.scene());
  endResetModel();
}

void SceneModel::refreshValues() {
  const auto fresh = makeSceneItems(document_.scene());
  if (!sameShape(*root_, *fresh)) {
    rebuild();
    return;
  }
  copyValues(*root_, *fresh);
  const auto announce = [this](const auto& self, const SceneItem& item) -> void {
    if (item.children.empty()) return;
    Q_EMIT dataChanged(indexFor(item.children.front().get(), 0), indexFor(item.children.back().get(), 1));
    for (const auto& child : item.children) self(self, *child);
  };
  announce(announce, *root_);
}

const SceneItem* SceneModel::itemAt(const QModelIndex& index) const {
  return index.isValid() ? static_cast<const SceneItem*>(index.internalPointer()) : root_.get();
}

QModelIndex SceneModel::indexFor(const SceneItem* item, int column) const {
  return item == root_.get() ? QModelIndex() : createIndex(item->row(), column, item);
}

QModelIndex SceneModel::indexOf(const std::string& pointer) const {
  const SceneItem* found = pointer.empty() ? nullptr : root_->find(pointer);
  return found ? indexFor(found, 1) : QModelIndex();
}

QModelIndex SceneModel::index(int row, int column, const QModelIndex& parent) const {
  const SceneItem* item = itemAt(parent);
  if (row < 0 || column < 0 || column > 1 || row >= static_cast<int>(item->children.size())) return {};
  return createIndex(row, column, item->children[static_cast<std::size_t>(row)].get());
}

QModelIndex SceneModel::parent(const QModelIndex& child) const {
  const SceneItem* item = itemAt(child);
  return child.isValid() && item->parent ? indexFor(item->parent, 0) : QModelIndex();
}

int SceneModel::rowCount(const QModelIndex& parent) const {
  return parent.column() > 0 ? 0 : static_cast<int>(itemAt(parent)->children.size());
}

QVariant SceneModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  return section == 0 ? tr("Property") : tr("Value");
}

QVariant SceneModel::data(const QModelIndex& index, int role) const {
  const SceneItem* item = itemAt(index);
  const bool value = index.column() == 1;
  const document::StudyState* study = item->study.isEmpty() ? nullptr : document_.study(item->study.toStdString());
  const bool isGroup = item->parent == root_.get();
  switch (role) {
    case Qt::DisplayRole:
      if (!value) return item->name;
      if (study && study->status != StudyStatus::none) return document::toString(study->status);
      return item->missing ? QStringLiteral("–") : isGroup ? QString() : item->value;
    case Qt::EditRole: {
      if (item->missing || !item->spec) return QString();
      const Json::json_pointer path(item->pointer);
      const Json& written = document_.scene().json();
      return editText(
          document_.valueAt(item->pointer), written.contains(path) ? written.at(path) : Json(), *item->spec);
    }
    case Qt::ToolTipRole:
      if (value && !item->list.empty()) return tr("Add an entry with the plus or Insert");
      return item->spec ? explanation(*item->spec) : QVariant();
    case Qt::FontRole: {
      QFont font;
      font.setWeight(isGroup && !value ? QFont::DemiBold : QFont::Normal);
      return font;
    }
    case Qt::ForegroundRole: {
      const plots::PlotStyle style = plots::plotStyle(QGuiApplication::palette());
      if (value && study) {
        switch (study->status) {
          case StudyStatus::solved: return QBrush(style.shown);
          case StudyStatus::running: return QBrush(style.curve);
          case StudyStatus::none:
          case StudyStatus::waiting: return QBrush(style.mutedText);
          default: return QBrush(style.warning);
        }
      }
      if (value && (!item->editable || item->missing)) return QBrush(style.mutedText);
      return {};
    }
    default: return {};
  }
}

Qt::ItemFlags SceneModel::flags(const QModelIndex& index) const {
  Qt::ItemFlags flags = QAbstractItemModel::flags(index);
  if (index.column() == 1 && itemAt(index)->editable) flags |= Qt::ItemIsEditable;
  return flags;
}

bool SceneModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  const SceneItem* item = itemAt(index);
  if (role != Qt::EditRole || !item->editable) return false;
  const QString text = value.toString();
  if (text == data(index, Qt::EditRole).toString()) return false;
  const std::string pointer = item->pointer;  // an edit may rebuild the items
  const Json typed = parseText(text, item->missing ? QString() : item->value, *item->spec);
  return document_.setValue(pointer, typed, tr("%1 to %2").arg(item->name, text));
}

}  // namespace pliant::panels
