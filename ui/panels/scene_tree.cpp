#include "ui/panels/scene_tree.hpp"

#include <QClipboard>
#include <QComboBox>
#include <QContextMenuEvent>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QScrollBar>

#include "ui/panels/icon.hpp"
#include "ui/panels/value_text.hpp"

namespace pliant::panels {

using base::ValueKind;

namespace {

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
  connect(&model_, &QAbstractItemModel::modelReset, this, &SceneTree::expandDefault);
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

void SceneTree::resizeEvent(QResizeEvent* event) {
  QTreeView::resizeEvent(event);
  header()->resizeSection(0, viewport()->width() * 58 / 100);
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
