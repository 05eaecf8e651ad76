#include "ui/panels/value_card.hpp"

#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

namespace pliant::panels {

ValueCard::ValueCard(QWidget* parent) : QWidget(parent) {
  title_ = new QLabel;
  title_->setWordWrap(true);
  title_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  table_ = new QTableWidget;
  table_->setAccessibleName(tr("Values of parameters"));
  table_->verticalHeader()->hide();
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setFocusPolicy(Qt::NoFocus);
  table_->setAlternatingRowColors(true);
  table_->setShowGrid(false);
  take_ = new QPushButton;
  take_->setFocusPolicy(Qt::NoFocus);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 0, 6, 6);
  column->addWidget(title_);
  column->addWidget(table_, 1);
  column->addWidget(take_, 0, Qt::AlignRight);
}

void ValueCard::setTitle(const QString& text) { title_->setText(text); }

QString ValueCard::title() const { return title_->text(); }

void ValueCard::setTable(const QStringList& headers, const std::vector<QStringList>& rows) {
  table_->setColumnCount(static_cast<int>(headers.size()));
  table_->setHorizontalHeaderLabels(headers);
  table_->setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < table_->rowCount(); ++row)
    for (int column = 0; column < table_->columnCount(); ++column) {
      auto* item = new QTableWidgetItem(rows[static_cast<std::size_t>(row)].at(column));
      item->setTextAlignment((column == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
      table_->setItem(row, column, item);
    }
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
}

}  // namespace pliant::panels
