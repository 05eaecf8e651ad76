#include "ui/panels/limit_table.hpp"

#include <QHeaderView>
#include <QSignalBlocker>
#include <cmath>
#include <numbers>

namespace pliant::panels {

namespace {

enum LimitColumn { angleColumn, stretchColumn, limitColumns };

/// NaN if it is none.
double numberIn(QString text, const QStringList& units) {
  for (const QString& unit : units)
    if (text.endsWith(unit)) text.chop(unit.size());
  bool isNumber = false;
  const double value = text.trimmed().replace(QStringLiteral("−"), QStringLiteral("-")).toDouble(&isNumber);
  return isNumber ? value : std::nan("");
}

}  // namespace

LimitTable::LimitTable(QWidget* parent) : QTableWidget(0, limitColumns, parent) {
  setAccessibleName(tr("Numbers of the stretch limit"));
  setHorizontalHeaderLabels({tr("direction [°]"), tr("stretch")});
  horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(24);
  setFrameShape(QFrame::NoFrame);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed |
                  QAbstractItemView::AnyKeyPressed);
  setAlternatingRowColors(true);
  setToolTip(tr("Double-click a number to type it; a stretch may be a strain such as “5 %”"));
  connect(this, &QTableWidget::cellChanged, this, &LimitTable::read);
}

void LimitTable::setShape(const plots::LimitShape* shape) {
  const QSignalBlocker block(this);
  handles_ = shape ? shape->handles() : std::vector<cloth::DirectionLimit>();
  const bool anyDirection = shape && shape->kind() == plots::LimitKind::isotropic;
  const int chosen = currentRow();
  setRowCount(static_cast<int>(handles_.size()));
  for (int row = 0; row < rowCount(); ++row) {
    const cloth::DirectionLimit& handle = handles_[static_cast<std::size_t>(row)];
    const auto put = [&](int at, const QString& text, bool editable) {
      QTableWidgetItem* cell = item(row, at);
      if (!cell) {
        cell = new QTableWidgetItem;
        cell->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
        setItem(row, at, cell);
      }
      cell->setText(text);
      cell->setFlags(editable ? cell->flags() | Qt::ItemIsEditable : cell->flags() & ~Qt::ItemIsEditable);
    };
    put(angleColumn, anyDirection ? tr("all") : QString::number(handle.angle * 180 / std::numbers::pi, 'g', 6),
        !anyDirection);
    put(stretchColumn, QString::number(handle.stretch, 'g', 6), true);
  }
  if (chosen >= rowCount()) setCurrentCell(-1, -1);
}

void LimitTable::type(int handle) {
  if (handle < 0 || handle >= rowCount()) return;
  setFocus();
  setCurrentCell(handle, stretchColumn);
  editItem(item(handle, stretchColumn));
}

void LimitTable::read(int row, int column) {
  const QString text = item(row, column)->text().trimmed();
  cloth::DirectionLimit place = handles_.at(static_cast<std::size_t>(row));
  if (column == angleColumn) {
    place.angle = numberIn(text, {QStringLiteral("°"), QStringLiteral("deg")}) * std::numbers::pi / 180;
  } else {
    const double value = numberIn(text, {QStringLiteral("%")});
    place.stretch = text.endsWith('%') ? 1 + value / 100 : value;
  }
  if (std::isfinite(place.angle) && std::isfinite(place.stretch))
    Q_EMIT typed(row, place);
  else
    Q_EMIT refused(tr("“%1” is no number.").arg(text));
}

}  // namespace pliant::panels
