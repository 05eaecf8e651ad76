#include "ui/panels/cell_test_panel.hpp"

#include <QHeaderView>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/interlock/holding_contacts.hpp"
#include "core/scene/bending_result.hpp"
#include "core/scene/macro_result.hpp"

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

QString signedNumber(double value, const QString& digits) {
  return (value < 0 ? QStringLiteral("−") : QStringLiteral("+")) + digits;
}

QString signedPercent(double strain) {
  return signedNumber(strain, QStringLiteral("%1 %").arg(100 * std::abs(strain), 0, 'f', 3));
}

QString degrees(const scene::Json& options) {
  return QString::number(options.value("direction", 0.0) * 180 / std::numbers::pi, 'g', 4);
}

/// "stretch at 0°, free across", from the study's normalised entry.
QString loadText(const scene::Json& options) {
  const std::string type = options.value("type", "");
  if (type == "gravity_bending") return QObject::tr("weight, free towards %1°").arg(degrees(options));
  if (type == "macro_motion") return QObject::tr("sheet in motion");
  if (type == "macro_equilibrium") {
    const auto counted = [&](const char* key, const QString& one, const QString& many) {
      const std::size_t count = options.contains(key) ? options[key].size() : 0;
      return count == 1 ? one : many.arg(count);
    };
    return QObject::tr("sheet, %1, %2")
        .arg(counted("loads", QObject::tr("one load"), QObject::tr("%1 loads")),
             counted("clamps", QObject::tr("one clamp"), QObject::tr("%1 clamps")));
  }
  const bool bends = type == "bending_test";
  const QString load = QString::fromStdString(bends ? options.value("bend", "up") : options.value("load", "stretch"));
  return (bends ? QObject::tr("bend %1 at %2°, %3 across") : QObject::tr("%1 at %2°, %3 across"))
      .arg(load, degrees(options), QString::fromStdString(options.value("lateral", "free")));
}

/// What a row says of a result.
struct LimitRow {
  QString limit, remaining, outcome;  ///< outcome: in the place of the state; empty: the state
  const interlock::CellEquilibrium* rest = nullptr;
  double radius = 1;  ///< of the thinnest wire [m]
};

std::optional<LimitRow> rowOf(const scene::Result* result) {
  LimitRow row;
  if (const auto* sheet = dynamic_cast<const scene::MacroResult*>(result)) {
    if (sheet->termination != base::TerminationType::converged) return std::nullopt;
    const auto rest = sheet->sheet->mesh.points.reshaped();
    const double farthest = (sheet->state.positions - rest).reshaped(3, rest.size() / 3).colwise().norm().maxCoeff();
    row.outcome = QObject::tr("moved by up to %1 mm").arg(1e3 * farthest, 0, 'f', 2);
    return row;
  }
  if (const auto* stretched = dynamic_cast<const scene::CellTestResult*>(result)) {
    row.rest = &stretched->limit.equilibrium;
    row.radius = stretched->cell->smallestRadius();
    if (row.rest->kind == interlock::RestKind::unlimited)
      row.outcome = QObject::tr("unlimited");
    else
      row.limit = signedPercent(stretched->limit.strain);
    row.remaining = QStringLiteral("%1 %").arg(100 * row.rest->remaining, 0, 'g', 2);
  } else if (const auto* bent = dynamic_cast<const scene::BendingTestResult*>(result)) {
    row.rest = &bent->limit.equilibrium;
    row.radius = bent->patch->smallestRadius();
    if (bent->limit.kind == interlock::BendingKind::folded)
      row.outcome = QObject::tr("folds");
    else
      row.limit =
          signedNumber(bent->limit.curvature, QStringLiteral("%1 1/m").arg(std::abs(bent->limit.curvature), 0, 'f', 2));
    row.remaining = QStringLiteral("%1 1/m").arg(row.rest->remaining, 0, 'g', 2);
  } else if (const auto* hanging = dynamic_cast<const scene::GravityBendingResult*>(result)) {
    row.rest = &hanging->rest;
    row.radius = hanging->patch->smallestRadius();
    const double drop = hanging->summary()["tip_displacement"]["z"];
    row.limit = QObject::tr("tip %1 mm").arg(signedNumber(drop, QString::number(1e3 * std::abs(drop), 'f', 2)));
  }
  if (!row.rest || row.rest->state.rotations.empty() || !row.rest->converged()) return std::nullopt;
  return row;
}

/// Where elements touch; parts of a curve each have a share in a contact.
std::size_t placesOf(const LimitRow& row) {
  return interlock::distinctContacts(row.rest->contacts, 0.5 * row.radius).size();
}

}  // namespace

bool CellTestPanel::shows(const std::string& type) {
  return type == "cell_test" || type == "bending_test" || type == "gravity_bending" || type == "macro_equilibrium" ||
         type == "macro_motion";
}

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
    if (shows(study.type)) tests.push_back(&study);
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
    const auto found = rowOf(study.result.get());
    const bool limited = found && found->outcome.isEmpty();
    put(row, limitColumn, limited ? found->limit : QString());
    put(row, remainingColumn, limited ? found->remaining : QString());
    put(row, contactColumn, limited ? QString::number(placesOf(*found)) : QString());
    put(row, gapColumn, limited ? QString::number(found->rest->meanGap / found->radius, 'g', 2) : QString());
    put(row, stateColumn, found && !limited ? found->outcome : toString(study.status), false);
    if (!study.message.isEmpty()) table_->item(row, stateColumn)->setToolTip(study.message);
  }
  if (current < table_->rowCount()) table_->setCurrentCell(current, current < 0 ? -1 : 0);
}

}  // namespace pliant::panels
