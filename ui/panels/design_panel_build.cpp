#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QSpinBox>
#include <QTableWidget>
#include <QVBoxLayout>

#include "ui/panels/design_panel.hpp"
#include "ui/plots/line_plot.hpp"

namespace pliant::panels {

QWidget* DesignPanel::makeEmptyPage() {
  auto* empty = new QWidget;
  auto* column = new QVBoxLayout(empty);
  note_ = new QLabel;
  note_->setAlignment(Qt::AlignCenter);
  note_->setWordWrap(true);
  run_ = new QPushButton(tr("Design"));
  column->addStretch();
  column->addWidget(note_);
  column->addWidget(run_, 0, Qt::AlignHCenter);
  column->addStretch();
  return empty;
}

QWidget* DesignPanel::makePage() {
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(6, 6, 6, 6);
  summary_ = new QLabel;
  summary_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  summary_->setWordWrap(true);
  column->addWidget(summary_);
  auto* middle = new QHBoxLayout;
  plot_ = new plots::LinePlot;
  table_ = new QTableWidget(0, columnCount);
  table_->setAccessibleName(tr("Parameters of the design"));
  table_->setHorizontalHeaderLabels({tr("parameter"), tr("before"), tr("this design"), tr("of its range")});
  table_->horizontalHeaderItem(rangeColumn)->setToolTip(tr("0 %: at its lower bound, 100 %: at its upper bound"));
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(nameColumn, QHeaderView::Stretch);
  table_->verticalHeader()->hide();
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setFocusPolicy(Qt::NoFocus);
  table_->setAlternatingRowColors(true);
  table_->setShowGrid(false);
  middle->addWidget(plot_, 1);
  middle->addWidget(table_, 1);
  column->addLayout(middle, 1);
  column->addLayout(makeBottomRow());
  return page;
}

QHBoxLayout* DesignPanel::makeBottomRow() {
  auto* bottom = new QHBoxLayout;
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setAccessibleName(tr("Design on show"));
  slider_->setToolTip(tr("From the first design to the best; its motion plays in the viewport"));
  position_ = new QLabel;
  compare_ = new QPushButton(tr("Side by Side"));
  compare_->setCheckable(true);
  compare_->setToolTip(tr("Plays another design to the left of this one, in step and from the same side"));
  compared_ = new QSpinBox;
  compared_->setPrefix(tr("with "));
  compared_->setAccessibleName(tr("Design on the left"));
  compared_->setToolTip(tr("The design on the left; 0 is the first"));
  compared_->setEnabled(false);
  take_ = new QPushButton(tr("Take This Design"));
  take_->setToolTip(tr("Puts its parameters into the scene; undo brings the old ones back"));
  bottom->addWidget(new QLabel(tr("Design")));
  bottom->addWidget(slider_, 1);
  bottom->addWidget(position_);
  bottom->addWidget(compare_);
  bottom->addWidget(compared_);
  bottom->addWidget(take_);
  return bottom;
}

}  // namespace pliant::panels
