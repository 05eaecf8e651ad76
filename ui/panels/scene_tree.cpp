#include "ui/panels/scene_tree.hpp"

#include <QClipboard>
#include <QComboBox>
#include <QContextMenuEvent>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QPainter>
#include <QScrollBar>
#include <utility>

#include "ui/document/scene_entries.hpp"
#include "ui/panels/icon.hpp"
#include "ui/panels/value_text.hpp"

namespace pliant::panels {

using base::ValueKind;

namespace {

QRect plusRect(const QRect& line) { return {line.right() - 22, line.center().y() - 8, 16, 16}; }

/// "grounded spring", "point mass".
QString humanType(const std::string& list, const std::string& type) {
  const QString name = humanName(type).toLower();
  if (list == "materials") return name + SceneTree::tr(" material");
  if (list == "elements") return name + SceneTree::tr(" element");
  if (list == "springs")
    return type == "between" ? SceneTree::tr("spring between two nodes") : name + SceneTree::tr(" spring");
  if (list == "boundary_conditions") return name + SceneTree::tr(" nodes");
  if (list == "drives") return name + SceneTree::tr(" drive");
  return name;
}

/// The pointer of the list and the number of the entry at `pointer`.
std::pair<std::string, std::size_t> listAndIndex(const std::string& pointer) {
  const std::size_t slash = pointer.rfind('/');
  return {pointer.substr(0, slash), std::stoul(pointer.substr(slash + 1))};
}

QStringList choicesOf(const ParameterSpec& spec, const document::Document& document) {
  QStringList choices;
  if (spec.kind == ValueKind::boolean) return {"yes", "no"};
  for (const std::string& choice : spec.choices) choices << QString::fromStdString(choice);
  if (spec.kind == ValueKind::reference)
    for (const Json& entry : document.valueAt("/" + spec.target))
      choices << entryName(entry, static_cast<int>(choices.size()));
  return choices;
}

}  // namespace

QWidget* SceneDelegate::createEditor(QWidget* parent, const QStyleOptionViewItem&, const QModelIndex& index) const {
  const auto* model = static_cast<const SceneModel*>(index.model());
  const QStringList choices = choicesOf(*model->itemAt(index)->spec, model->document());
  if (choices.isEmpty()) {
    auto* line = new QLineEdit(parent);
    line->setFrame(false);
    return line;
  }
  auto* box = new QComboBox(parent);
  box->addItems(choices);
  connect(box, &QComboBox::activated, this, [this, box] {
    auto* self = const_cast<SceneDelegate*>(this);
    Q_EMIT self->commitData(box);
    Q_EMIT self->closeEditor(box);
  });
  return box;
}

void SceneDelegate::setEditorData(QWidget* editor, const QModelIndex& index) const {
  const QString text = index.data(Qt::EditRole).toString();
  if (auto* box = qobject_cast<QComboBox*>(editor)) {
    box->setCurrentText(text);
  } else if (auto* line = qobject_cast<QLineEdit*>(editor)) {
    line->setText(text);
    line->selectAll();
  }
}

void SceneDelegate::setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const {
  if (const auto* box = qobject_cast<QComboBox*>(editor)) model->setData(index, box->currentText(), Qt::EditRole);
  if (const auto* line = qobject_cast<QLineEdit*>(editor)) model->setData(index, line->text(), Qt::EditRole);
}

QSize SceneDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  return {QStyledItemDelegate::sizeHint(option, index).width(), std::max(24, option.fontMetrics.height() + 8)};
}

void SceneDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const {
  QStyledItemDelegate::paint(painter, option, index);
  const auto* model = static_cast<const SceneModel*>(index.model());
  if (index.column() == 1 && !model->itemAt(index)->list.empty())
    icon(QStringLiteral("add")).paint(painter, plusRect(option.rect));
}

SceneTree::SceneTree(document::Document& document, QWidget* parent)
    : QTreeView(parent), document_(document), model_(document) {
  setModel(&model_);
  setItemDelegate(new SceneDelegate(this));
  setUniformRowHeights(true);
  setFrameShape(QFrame::NoFrame);
  setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  setIndentation(16);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setHeaderHidden(true);
  header()->setSectionResizeMode(0, QHeaderView::Fixed);
  header()->setStretchLastSection(true);
  setTextElideMode(Qt::ElideRight);
  setAccessibleName(tr("Scene"));
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    expanded_.clear();
    awaited_.clear();
    expandDefault();
  });
  connect(&model_, &QAbstractItemModel::modelAboutToBeReset, this, [this] {
    expanded_.clear();
    const auto walk = [this](const auto& self, const QModelIndex& above) -> void {
      for (int row = 0; row < model_.rowCount(above); ++row) {
        const QModelIndex index = model_.index(row, 0, above);
        if (!isExpanded(index)) continue;
        expanded_.insert(model_.itemAt(index)->pointer);
        self(self, index);
      }
    };
    walk(walk, {});
  });
  connect(&model_, &QAbstractItemModel::modelReset, this, &SceneTree::restoreExpanded);
  connect(this, &QTreeView::doubleClicked, this, [this](const QModelIndex& index) {
    const SceneItem* item = model_.itemAt(index);
    if (!item->study.isEmpty()) Q_EMIT studyActivated(item->study.toStdString());
  });
  expandDefault();
}

void SceneTree::expandDefault() {
  // What a designer looks for first: the masses and the studies.
  for (const char* pointer : {"/point_masses", "/studies"}) {
    const QModelIndex index = model_.indexOf(pointer);
    if (index.isValid()) expand(index.siblingAtColumn(0));
  }
}

void SceneTree::restoreExpanded() {
  for (const std::string& pointer : expanded_) {
    const QModelIndex index = pointer.empty() ? model_.index(0, 0) : model_.indexOf(pointer);
    if (index.isValid()) expand(index.siblingAtColumn(0));
  }
  const QModelIndex index = model_.indexOf(std::exchange(awaited_, {}));
  if (!index.isValid()) return;
  expand(index.parent());
  if (!model_.itemAt(index)->children.empty()) expand(index.siblingAtColumn(0));
  setCurrentIndex(index);
  scrollTo(index);
}

void SceneTree::insertEntry(const std::string& list, const Json& entry, std::size_t place, const QString& text) {
  const Json::json_pointer path(list);
  const Json before = document_.valueAt(list);
  // Others may mean the only entry of a list without naming it; a second one makes them name it.
  const bool second = before.size() == 1 && (list == "/geometry" || list == "/materials");
  Json whole = second ? document::withReferencesWritten(document_.scene(), list.substr(1)) : document_.scene().json();
  Json& entries = whole[path];
  if (entries.is_null()) entries = Json::array();
  entries.insert(entries.begin() + static_cast<long>(place), entry);
  awaited_ = list + "/" + std::to_string(place);
  bool taken = false;
  if (list == "/geometry") {
    document::addBodyOf(whole, entry, document_.model()->dimension);
    taken = document_.setValue({}, whole, text);
  } else {
    taken = document_.setValue(second ? std::string() : list, second ? whole : entries, text);
  }
  if (!taken) awaited_.clear();
}

void SceneTree::addEntry(const std::string& list, const std::string& type) {
  if (document_.isEmpty()) return;
  const Json entry = document::defaultEntry(document_.scene(), *document_.model(), list, type, node_);
  insertEntry(
      "/" + list, std::move(entry), document_.valueAt("/" + list).size(), tr("Add %1").arg(humanType(list, type)));
}

void SceneTree::duplicateEntry(const std::string& pointer) {
  const auto [list, index] = listAndIndex(pointer);
  const Json& entries = document_.scene().json().at(Json::json_pointer(list));
  insertEntry(list, document::copiedEntry(entries, index), index + 1,
              tr("Duplicate %1").arg(entryName(entries[index], static_cast<int>(index))));
}

void SceneTree::removeEntry(const std::string& pointer) {
  const auto [list, index] = listAndIndex(pointer);
  const Json& before = document_.scene().json();
  const QString name = entryName(before.at(Json::json_pointer(list))[index], static_cast<int>(index));
  const Json after = document::withoutEntry(document_.scene(), list.substr(1), index);
  // An edit of one list is checked more quickly than one of the whole scene.
  const bool alone = after.value("expected", Json()) == before.value("expected", Json());
  awaited_ = list;
  if (!document_.setValue(
          alone ? list : std::string(), alone ? after.at(list.substr(1)) : after, tr("Remove %1").arg(name)))
    awaited_.clear();
}

void SceneTree::addActionsFor(QMenu& menu, const std::string& list) {
  for (const std::string& type : document::entryTypes(list))
    menu.addAction(icon(QStringLiteral("add")), tr("Add %1").arg(humanType(list, type)),
                   [this, list, type] { addEntry(list, type); });
}

void SceneTree::offerEntries(const std::string& list, const QPoint& place) {
  const auto types = document::entryTypes(list);
  if (types.size() == 1) {
    addEntry(list, types.front());
    return;
  }
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  addActionsFor(*menu, list);
  menu->popup(place);
}

void SceneTree::keyPressEvent(QKeyEvent* event) {
  const QModelIndex index = currentIndex();
  const SceneItem* item = index.isValid() ? model_.itemAt(index) : nullptr;
  const bool copies = event->key() == Qt::Key_D && event->modifiers() == Qt::ControlModifier;
  if (item && event->key() == Qt::Key_Insert) {
    while (item && item->list.empty()) item = item->parent;
    if (item) offerEntries(item->list, viewport()->mapToGlobal(visualRect(index).bottomLeft()));
  } else if (item && item->removable && event->key() == Qt::Key_Delete) {
    removeEntry(std::string(item->pointer));
  } else if (item && item->removable && copies) {
    duplicateEntry(std::string(item->pointer));
  } else {
    QTreeView::keyPressEvent(event);
  }
}

void SceneTree::mouseReleaseEvent(QMouseEvent* event) {
  const QModelIndex index = indexAt(event->pos());
  const std::string list = index.isValid() && index.column() == 1 ? model_.itemAt(index)->list : std::string();
  const bool hit = !list.empty() && plusRect(visualRect(index)).adjusted(-4, -4, 4, 4).contains(event->pos());
  if (hit && event->button() == Qt::LeftButton)
    offerEntries(list, event->globalPosition().toPoint());
  else
    QTreeView::mouseReleaseEvent(event);
}

void SceneTree::resizeEvent(QResizeEvent* event) {
  QTreeView::resizeEvent(event);
  header()->resizeSection(0, viewport()->width() * 60 / 100);
}

void SceneTree::currentChanged(const QModelIndex& current, const QModelIndex& previous) {
  QTreeView::currentChanged(current, previous);
  Q_EMIT currentPointerChanged(current.isValid() ? model_.itemAt(current)->pointer : std::string());
}

void SceneTree::contextMenuEvent(QContextMenuEvent* event) {
  const QModelIndex index = indexAt(event->pos());
  if (!index.isValid()) return;
  const SceneItem* item = model_.itemAt(index);
  QMenu menu(this);
  if (!item->study.isEmpty())
    menu.addAction(icon(QStringLiteral("run")), tr("Run %1").arg(item->study),
                   [this, name = item->study.toStdString()] { Q_EMIT studyActivated(name); });
  if (!item->list.empty()) addActionsFor(menu, item->list);
  if (item->removable) {
    const auto add = [&](const char* name, const QString& text, const QKeySequence& keys, auto function) {
      QAction* action = menu.addAction(icon(QLatin1String(name)), text, function);
      action->setShortcut(keys);
    };
    add("add", tr("Duplicate"), Qt::CTRL | Qt::Key_D, [this, pointer = item->pointer] { duplicateEntry(pointer); });
    add("close", tr("Remove"), Qt::Key_Delete, [this, pointer = item->pointer] { removeEntry(pointer); });
  }
  if (item->editable) menu.addAction(tr("Edit"), [this, index] { edit(index.siblingAtColumn(1)); });
  const Json value = document_.valueAt(item->pointer);
  if (item->editable && !value.is_null())
    menu.addAction(tr("Copy exact value"), [value] {
      QGuiApplication::clipboard()->setText(value.is_string() ? QString::fromStdString(value.get<std::string>())
                                                              : QString::fromStdString(value.dump()));
    });
  if (!item->pointer.empty())
    menu.addAction(tr("Copy JSON pointer"), [pointer = QString::fromStdString(item->pointer)] {
      QGuiApplication::clipboard()->setText(pointer);
    });
  if (!menu.isEmpty()) menu.exec(event->globalPos());
}

}  // namespace pliant::panels
