#include "ui/panels/cell_test_panel.hpp"

#include <QHeaderView>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/interlock/holding_contacts.hpp"

namespace pliant::panels {

namespace {

enum Column {
  nameColumn,
  loadColumn,
  limitColumn,
  remainingColumn,
  contactColumn,
  gapColumn,
  stateColumn,
  columnCount
};

QString signedPercent(double strain) {
  return (strain < 0 ? QStringLiteral("−") : QStringLiteral("+")) +
         QStringLiteral("%1 %").arg(100 * std::abs(strain), 0, 'f', 3);
}

/// "stretch 0°, free across", from the study's normalised entry.
QString loadText(const scene::Json& options) {
  return QObject::tr("%1 at %2°, %3 across")
      .arg(QString::fromStdString(options.value("load", "stretch")))
      .arg(options.value("direction", 0.0) * 180 / std::numbers::pi, 0, 'g', 4)
      .arg(QString::fromStdString(options.value("lateral", "free")));
}

/// Where the elements of a cell touch; parts of a curve each have a share in a contact.
std::size_t placesOf(const scene::CellTestResult& result) {
  return interlock::distinctContacts(result.limit.equilibrium.contacts, 0.5 * result.cell->smallestRadius()).size();
}

std::shared_ptr<const scene::CellTestResult> resultOf(const document::StudyState& study) {
  return std::dynamic_pointer_cast<const scene::CellTestResult>(study.result);
}

}  // namespace

CellTestPanel::CellTestPanel(document::Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  table_ = new QTableWidget(0, columnCount);
  table_->setAccessibleName(tr("Limits of single directions"));
  table_->setHorizontalHeaderLabels(
      {tr("study"), tr("load"), tr("limit"), tr("at most more"), tr("contacts"), tr("mean gap / r"), tr("state")});
  table_->horizontalHeaderItem(remainingColumn)->setToolTip(tr("What smaller gaps could add, to first order"));
  table_->horizontalHeaderItem(gapColumn)->setToolTip(tr("Mean gap of the contacts that hold, in wire radii"));
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(nameColumn, QHeaderView::Stretch);
  table_->verticalHeader()->hide();
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setAlternatingRowColors(true);
  table_->setShowGrid(false);
  table_->setToolTip(tr("Choose a limit to see it in the viewport; double-click runs its study"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(table_);
  connect(table_, &QTableWidget::currentCellChanged, this, [this](int row) {
    if (row >= 0 && row <= static_cast<int>(names_.size()))
      Q_EMIT studyChosen(row == 0 ? std::string() : names_[static_cast<std::size_t>(row - 1)]);
  });
  connect(table_, &QTableWidget::cellDoubleClicked, this, [this](int row) {
    if (row > 0 && row <= static_cast<int>(names_.size()))
      Q_EMIT runRequested(names_[static_cast<std::size_t>(row - 1)]);
  });
  connect(&document_, &document::Document::sceneReplaced, this, &CellTestPanel::refresh);
  connect(&document_, &document::Document::sceneEdited, this, &CellTestPanel::refresh);
  connect(&document_, &document::Document::studyChanged, this, &CellTestPanel::refresh);
  refresh();
}

void CellTestPanel::setShown(const std::optional<std::string>& study) {
  const QSignalBlocker block(table_);
  const auto found = study ? std::find(names_.begin(), names_.end(), *study) : names_.end();
  const int row = study && study->empty() ? 0
                  : found == names_.end() ? -1
                                          : 1 + static_cast<int>(found - names_.begin());
  table_->setCurrentCell(row, row < 0 ? -1 : 0);
  if (row < 0) table_->clearSelection();
}

void CellTestPanel::refresh() {
  const QSignalBlocker block(table_);
  const int current = table_->currentRow();
  std::vector<const document::StudyState*> tests;
  for (const document::StudyState& study : document_.studies())
    if (study.type == "cell_test") tests.push_back(&study);
  names_.clear();
  table_->setRowCount(1 + static_cast<int>(tests.size()));
  const auto put = [&](int row, int column, const QString& text, bool number = true) {
    auto* item = new QTableWidgetItem(text);
    item->setTextAlignment((number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    table_->setItem(row, column, item);
  };
  for (int column = 0; column < columnCount; ++column) put(0, column, column == 0 ? tr("at rest") : QString(), false);
  const scene::Json studies = document_.valueAt("/studies");
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const document::StudyState& study = *tests[i];
    const int row = static_cast<int>(i) + 1;
    names_.push_back(study.name);
    put(row, nameColumn, QString::fromStdString(study.name), false);
    for (const scene::Json& entry : studies)
      if (entry.value("name", "") == study.name) put(row, loadColumn, loadText(entry), false);
    const auto result = resultOf(study);
    const bool any = result && !result->limit.equilibrium.state.rotations.empty();
    const interlock::CellEquilibrium* rest = any ? &result->limit.equilibrium : nullptr;
    const bool limited = any && rest->converged() && rest->kind != interlock::RestKind::unlimited;
    put(row, limitColumn, limited ? signedPercent(result->limit.strain) : QString());
    put(row, remainingColumn, limited ? QStringLiteral("%1 %").arg(100 * rest->remaining, 0, 'g', 2) : QString());
    put(row, contactColumn, limited ? QString::number(placesOf(*result)) : QString());
    put(row, gapColumn, limited ? QString::number(rest->meanGap / result->cell->smallestRadius(), 'g', 2) : QString());
    put(row, stateColumn,
        any && rest->kind == interlock::RestKind::unlimited ? tr("unlimited") : toString(study.status), false);
    if (!study.message.isEmpty()) table_->item(row, stateColumn)->setToolTip(study.message);
  }
  if (current < table_->rowCount()) table_->setCurrentCell(current, current < 0 ? -1 : 0);
}

}  // namespace pliant::panels
