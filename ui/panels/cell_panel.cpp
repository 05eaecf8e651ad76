#include "ui/panels/cell_panel.hpp"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>

#include "ui/panels/cell_family.hpp"
#include "ui/panels/cell_parameter_row.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

using document::Json;

namespace {

const std::string cellList = "/interlocking_cells";

QLabel* paragraph() {
  auto* label = new QLabel;
  label->setWordWrap(true);
  label->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

/// Nudges of one number in a row are one undo step.
int mergeIdOf(const std::string& pointer) {
  return static_cast<int>(qHash(QString::fromStdString(pointer)) & 0x3fffffff);
}

}  // namespace

CellPanel::CellPanel(document::Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  cells_ = new QComboBox;
  cells_->setToolTip(tr("Which of the scene's materials is shown"));
  title_ = new QLabel;
  QFont strong = title_->font();
  strong.setWeight(QFont::DemiBold);
  title_->setFont(strong);
  auto* change = new QPushButton(tr("Change…"));
  change->setToolTip(tr("Choose another kind of material"));
  change->setFocusPolicy(Qt::NoFocus);
  sentence_ = paragraph();
  sentence_->setForegroundRole(QPalette::PlaceholderText);
  auto* head = new QVBoxLayout;
  head->setContentsMargins(16, 8, 16, 8);
  head->setSpacing(4);
  auto* first = new QHBoxLayout;
  first->addWidget(title_, 1);
  first->addWidget(change);
  head->addWidget(cells_);
  head->addLayout(first);
  head->addWidget(sentence_);

  auto* content = new QWidget;
  list_ = new QVBoxLayout(content);
  list_->setContentsMargins(0, 0, 0, 0);
  list_->setSpacing(0);
  supercell_ = new QWidget;
  auto* counts = new QHBoxLayout(supercell_);
  counts->setContentsMargins(16, 8, 40, 8);
  counts->addWidget(new QLabel(tr("Supercell")), 1);
  for (QSpinBox*& count : counts_) {
    count = new QSpinBox;
    count->setRange(1, 16);
    count->setKeyboardTracking(false);
    count->setAccessibleName(tr("Cells along a lattice vector"));
    if (&count == &counts_[1]) counts->addWidget(new QLabel(QStringLiteral("×")));
    counts->addWidget(count);
  }
  list_->addWidget(supercell_);
  list_->addStretch();
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(content);

  links_ = paragraph();
  gap_ = paragraph();
  gap_->setForegroundRole(QPalette::PlaceholderText);
  // Their room is kept, so that what is being dragged does not move when something is refused.
  links_->setFixedHeight(3 * links_->fontMetrics().lineSpacing());
  gap_->setFixedHeight(2 * gap_->fontMetrics().lineSpacing() + 4);
  back_ = new QPushButton(tr("Back to what fits"));
  back_->setToolTip(tr("Set all numbers as they are in the scene"));
  QSizePolicy keepsPlace = back_->sizePolicy();
  keepsPlace.setRetainSizeWhenHidden(true);
  back_->setSizePolicy(keepsPlace);
  back_->hide();
  auto* foot = new QVBoxLayout;
  foot->setContentsMargins(16, 8, 16, 8);
  foot->setSpacing(2);
  foot->addWidget(links_);
  foot->addWidget(gap_);
  foot->addWidget(back_, 0, Qt::AlignLeft);

  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addLayout(head);
  column->addWidget(scroll, 1);
  column->addLayout(foot);

  connect(change, &QPushButton::clicked, this, &CellPanel::familyRequested);
  connect(back_, &QPushButton::clicked, this, &CellPanel::takeBack);
  connect(cells_, &QComboBox::activated, this, [this](int index) {
    index_ = index;
    refresh(true);
  });
  for (QSpinBox* count : counts_)
    connect(count, &QSpinBox::valueChanged, this, [this] {
      draft("supercell", Json::array({counts_[0]->value(), counts_[1]->value()}));
      commit(tr("Supercell of %1 × %2").arg(counts_[0]->value()).arg(counts_[1]->value()), -1);
    });
  connect(&inspector_, &jobs::CellInspector::inspected, this, &CellPanel::showInspected);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    index_ = 0;
    refresh(true);
  });
  connect(&document_, &document::Document::sceneEdited, this, [this](const std::string& edited) {
    if ((edited.empty() || edited.starts_with(cellList)) && !isAhead()) refresh(false);
  });
  connect(&document_, &document::Document::editingChanged, this, [this](bool editing) {
    // Edits that waited may have been dropped.
    if (!editing && !isAhead() && !refused_ && index_ >= 0 && draft_ != entryOfScene()) refresh(false);
  });
  connect(&document_, &document::Document::fileChanged, this, [this] { showValues(document_.valueAt(pointer())); });
  refresh(true);
}

std::string CellPanel::pointer() const { return cellList + "/" + std::to_string(index_); }

Json CellPanel::entryOfScene() const {
  return index_ < 0 ? Json() : document_.scene().json().at(Json::json_pointer(pointer()));
}

bool CellPanel::isAhead() const { return dragging_ || !commitText_.isEmpty() || document_.isEditing(); }

CellParameterRow* CellPanel::row(const std::string& key) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](auto* row) { return row->key() == key; });
  return found == rows_.end() ? nullptr : *found;
}

QString CellPanel::findings() const { return links_->text() + '\n' + gap_->text(); }

void CellPanel::refresh(bool another) {
  const Json entries = document_.valueAt(cellList);
  const int count = entries.is_array() ? static_cast<int>(entries.size()) : 0;
  index_ = count == 0 ? -1 : std::clamp(index_, 0, count - 1);
  const QSignalBlocker block(cells_);
  cells_->clear();
  for (int i = 0; i < count; ++i) cells_->addItem(entryName(entries[static_cast<std::size_t>(i)], i));
  cells_->setCurrentIndex(index_);
  cells_->setVisible(count > 1);
  if (another) {
    inspector_.forget();
    family_.clear();  // sliders of another scene have ends of their own
  }
  if (index_ < 0) {
    draft_ = Json();
    family_.clear();
    Q_EMIT cellLost();
    return;
  }
  draft_ = entryOfScene();
  refused_ = false;
  commitText_.clear();
  dragging_ = false;
  rebuild();
  showValues(document_.valueAt(pointer()));
  inspector_.inspect(document_.scene(), index_, draft_);
}

void CellPanel::rebuild() {
  const std::string type = document_.valueAt(pointer() + "/type").get<std::string>();
  if (type == family_) return;
  family_ = type;
  for (CellParameterRow* row : rows_) delete row;
  rows_.clear();
  const base::ParameterSpec* spec = scene::specAt(document_.scene(), pointer());
  title_->setText(cellFamilyTitle(type));
  sentence_->setText(QString::fromStdString(spec->description));
  for (const base::ParameterSpec& field : spec->fields) {
    if (!CellParameterRow::fits(field)) continue;
    auto* row = new CellParameterRow(field);
    connect(row, &CellParameterRow::dragged, this, [this](const std::string& key, const Json& value) {
      if (!dragging_) before_ = draft_;
      dragging_ = true;
      draft(key, value);
    });
    connect(row, &CellParameterRow::dragEnded, this, [this] {
      dragging_ = false;
      draft_ = before_;
      inspector_.inspect(document_.scene(), index_, draft_);
    });
    connect(row, &CellParameterRow::committed, this,
            [this](const std::string& key, const Json& value, const QString& text, bool nudge) {
              dragging_ = false;
              draft(key, value);
              commit(text, nudge ? mergeIdOf(pointer() + "/" + key) : -1);
            });
    list_->insertWidget(static_cast<int>(rows_.size()), row);
    rows_.push_back(row);
  }
}

void CellPanel::showValues(const Json& normalized) {
  if (index_ < 0 || normalized.is_null()) return;
  for (CellParameterRow* row : rows_) {
    const Json value = normalized.value(row->key(), Json()),
               saved = document_.savedValueAt(pointer() + "/" + row->key());
    if (!value.is_number()) continue;
    row->setValue(value.get<double>(), saved.is_number() ? saved.get<double>() : value.get<double>());
  }
  const Json counts = normalized.value("supercell", Json());
  supercell_->setVisible(counts.is_array() && counts.size() == 2);
  for (std::size_t i = 0; i < 2 && counts.is_array(); ++i) {
    const QSignalBlocker block(counts_[i]);
    counts_[i]->setValue(counts[i].get<int>());
  }
}

void CellPanel::draft(const std::string& key, const Json& value) {
  if (index_ < 0) return;
  draft_[key] = value;
  commitText_.clear();
  inspector_.inspect(document_.scene(), index_, draft_);
}

void CellPanel::commit(const QString& text, int mergeId) {
  commitText_ = text;
  commitMergeId_ = mergeId;
}

void CellPanel::takeBack() {
  if (index_ >= 0) refresh(false);
}

void CellPanel::showInspected(const jobs::InspectedCell& cell) {
  if (index_ < 0 || cell.entry != draft_) return;
  const bool fits = cell.fault.isEmpty();
  const bool isDraft = draft_ != entryOfScene();
  const bool ended = !commitText_.isEmpty();
  showFindings(cell);
  if (!dragging_) showValues(cell.normalized);
  refused_ = isDraft && !fits && !dragging_;
  back_->setVisible(refused_);
  Q_EMIT cellInspected(cell, isDraft);
  if (!ended) return;
  const QString text = commitText_;
  commitText_.clear();
  if (!fits) {
    document_.raise(base::Severity::warning, cell.fault);
    return;
  }
  if (isDraft) document_.setValue(pointer(), draft_, text, commitMergeId_);
}

void CellPanel::showFindings(const jobs::InspectedCell& cell) {
  const interlock::CellInspection& found = cell.inspection;
  const plots::PlotStyle style = plots::plotStyle(palette());
  QPalette colors = palette();
  colors.setColor(QPalette::WindowText, cell.fault.isEmpty() ? style.text : style.warning);
  links_->setPalette(colors);
  if (!cell.fault.isEmpty())
    links_->setText(cell.fault);
  else if (found.declaredLinks == 1)
    links_->setText(tr("Linked as it should be: one link a cell."));
  else
    links_->setText(tr("Linked as it should be: %1 links a cell.").arg(found.declaredLinks));
  if (found.radius <= 0 || found.overlaps())
    gap_->clear();
  else if (!found.nearest)
    gap_->setText(tr("All gaps at rest are above %1").arg(plots::formatLength(found.reach)));
  else
    gap_->setText(tr("Smallest gap at rest: %1 mm, which is %2 wire radii")
                      .arg(1e3 * found.nearest->gap, 0, 'g', 3)
                      .arg(found.nearest->gap / found.radius, 0, 'g', 3));
}

}  // namespace pliant::panels
