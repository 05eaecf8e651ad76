#include "ui/panels/limit_panel.hpp"

#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QListView>
#include <QMenu>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>

#include "core/base/error.hpp"
#include "ui/panels/limit_table.hpp"
#include "ui/panels/value_text.hpp"
#include "ui/plots/plot_export.hpp"
#include "ui/plots/plot_style.hpp"
#include "ui/plots/polar_editor.hpp"

namespace pliant::panels {

using plots::LimitKind;
using plots::LimitSymmetry;

namespace {

const std::string limitList = "/stretch_limits";
constexpr int controlHeight = 28;

std::string pointerOf(int limit) { return limitList + "/" + std::to_string(limit); }

}  // namespace

LimitPanel::LimitPanel(document::Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  makeWidgets();
  connectParts();
  fillLimits();
  refresh(true);
}

void LimitPanel::makeWidgets() {
  limits_ = new QComboBox;
  limits_->setToolTip(tr("Which of the scene's stretch limits is shown"));
  kinds_ = new QComboBox;
  kinds_->addItems({tr("isotropic"), tr("orthotropic"), tr("free curve")});
  kinds_->setAccessibleName(tr("Kind of stretch limit"));
  kinds_->setToolTip(
      tr("Isotropic: the same in every direction.\nOrthotropic: an ellipse, with two principal values.\n"
         "Free curve: through as many points as you like."));
  mirrored_ = new QToolButton;
  mirrored_->setText(tr("mirrored"));
  mirrored_->setCheckable(true);
  mirrored_->setToolTip(tr("Keep the curve the same mirrored about warp and weft"));
  presets_ = makeMenuButton();
  editor_ = new plots::PolarEditor;
  message_ = new QLabel;
  message_->setWordWrap(true);
  message_->setContentsMargins(16, 0, 16, 0);
  message_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  // Its room is kept, so that what is being dragged does not move when something is refused.
  message_->setFixedHeight(2 * message_->fontMetrics().height() + 4);
  methods_ = new QComboBox;
  methods_->addItems({tr("the better of both"), tr("ellipses"), tr("directions")});
  methods_->setAccessibleName(tr("Constraints that enforce the curve"));
  methods_->setToolTip(
      tr("Ellipses never cut into the curve and let little through beyond it.\n"
         "Directions bound the stretch in those directions alone."));
  count_ = new QSpinBox;
  count_->setRange(1, 90);
  count_->setKeyboardTracking(false);
  count_->setAccessibleName(tr("Number of constraints"));
  table_ = new LimitTable;
  for (QWidget* widget : std::initializer_list<QWidget*>{limits_, kinds_, mirrored_, presets_, methods_, count_})
    widget->setFixedHeight(controlHeight);

  auto* head = new QHBoxLayout;
  head->setContentsMargins(16, 8, 16, 4);
  head->setSpacing(8);
  head->addWidget(kinds_, 1);
  head->addWidget(mirrored_);
  head->addWidget(presets_);
  enforcement_ = new QWidget;
  auto* foot = new QHBoxLayout(enforcement_);
  foot->setContentsMargins(16, 4, 16, 4);
  foot->setSpacing(8);
  foot->addWidget(new QLabel(tr("Enforced by")));
  foot->addWidget(methods_, 1);
  foot->addWidget(count_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  auto* chooser = new QHBoxLayout;
  chooser->setContentsMargins(16, 8, 16, 0);
  chooser->addWidget(limits_);
  column->addLayout(chooser);
  column->addLayout(head);
  column->addWidget(editor_, 1);
  column->addWidget(message_);
  column->addWidget(enforcement_);
  column->addWidget(table_);
}

QToolButton* LimitPanel::makeMenuButton() {
  auto* button = new QToolButton;
  button->setText(tr("Presets"));
  button->setPopupMode(QToolButton::InstantPopup);
  button->setToolTip(tr("Limits to begin with; measured limits; export"));
  auto* menu = new QMenu(button);
  menu->setToolTipsVisible(true);
  for (const plots::LimitPreset& preset : plots::limitPresets())
    menu->addAction(QLatin1String(preset.name), this, [this, &preset] { editor_->takePreset(preset); })
        ->setToolTip(QLatin1String(preset.description));
  menu->addSeparator();
  menu->addAction(tr("Import Measured Limits…"), this, [this] {
    const QString file = QFileDialog::getOpenFileName(
        this, tr("Measured limits: angle [deg], stretch"), {}, tr("Comma-separated values (*.csv)"));
    if (!file.isEmpty()) act([&] { importMeasured(file); });
  });
  menu->addAction(tr("Remove Measured Limits"), this, [this] { editor_->setMeasured({}); });
  menu->addSeparator();
  QAction* percent = menu->addAction(tr("Label Strains in %"));
  percent->setCheckable(true);
  connect(percent, &QAction::toggled, this, [this](bool on) { editor_->setPercent(on); });
  connect(menu, &QMenu::aboutToShow, percent, [this, percent] { percent->setChecked(editor_->picture().percent); });
  menu->addAction(tr("Export Plot…"), this, &LimitPanel::exportPlot);
  button->setMenu(menu);
  return button;
}

void LimitPanel::connectParts() {
  connect(limits_, &QComboBox::activated, this, [this] { refresh(true); });
  connect(kinds_, &QComboBox::activated, this, [this](int kind) { editor_->setKind(static_cast<LimitKind>(kind)); });
  connect(mirrored_, &QToolButton::clicked, this, [this](bool on) {
    editor_->setSymmetry(on ? LimitSymmetry::mirrored : LimitSymmetry::none);
    refreshControls();
  });
  connect(methods_, &QComboBox::activated, this, [this] { write(tr("Constraints of the stretch limit"), -1); });
  connect(count_, &QSpinBox::valueChanged, this, [this] { write(tr("Constraints of the stretch limit"), -1); });
  connect(editor_, &plots::PolarEditor::edited, this, &LimitPanel::write);
  connect(editor_, &plots::PolarEditor::refused, this, &LimitPanel::say);
  connect(editor_, &plots::PolarEditor::exportRequested, this, &LimitPanel::exportPlot);
  connect(editor_, &plots::PolarEditor::activated, table_, &LimitTable::type);
  connect(editor_, &plots::PolarEditor::selectionChanged, this, [this](int handle) {
    const QSignalBlocker block(table_);
    if (handle >= 0)
      table_->setCurrentCell(handle, 1);
    else
      table_->setCurrentCell(-1, -1);
  });
  connect(table_, &LimitTable::typed, this, [this](int handle, const cloth::DirectionLimit& place) {
    editor_->putHandle(handle, place);
    refreshControls();
  });
  connect(table_, &LimitTable::refused, this, [this](const QString& sentence) {
    say(sentence);
    refreshControls();
  });
  connect(table_, &QTableWidget::currentCellChanged, this, [this](int row) { editor_->select(row); });
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    editor_->setMeasured({});
    editor_->setReached({}, {});
    fillLimits();
    refresh(true);
  });
  connect(&document_, &document::Document::sceneEdited, this, [this](const std::string& pointer) {
    if (!pointer.empty() && !pointer.starts_with(limitList)) return;
    const int before = shownLimit();
    fillLimits();
    refresh(shownLimit() != before);
  });
}

void LimitPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  Q_EMIT limitShown(shownLimit());
}

QString LimitPanel::message() const { return message_->text(); }

int LimitPanel::shownLimit() const { return limits_->currentIndex(); }

void LimitPanel::showLimit(int index) {
  if (index == shownLimit() || index < 0 || index >= limits_->count()) return;
  limits_->setCurrentIndex(index);
  refresh(true);
}

void LimitPanel::setReached(Eigen::VectorXd reached, const QString& name) {
  editor_->setReached(std::move(reached), name);
}

void LimitPanel::importMeasured(const QString& file) { editor_->setMeasured(plots::readMeasuredLimits(file)); }

void LimitPanel::fillLimits() {
  const QSignalBlocker block(limits_);
  const int before = std::max(0, limits_->currentIndex());
  limits_->clear();
  const Json entries = document_.valueAt(limitList);
  if (entries.is_array())
    for (std::size_t i = 0; i < entries.size(); ++i) limits_->addItem(entryName(entries[i], static_cast<int>(i)));
  limits_->setCurrentIndex(std::min(before, limits_->count() - 1));
  limits_->setVisible(limits_->count() > 1);
}

ConstraintChoice LimitPanel::choice() const {
  return {static_cast<ConstraintMethod>(methods_->currentIndex()), count_->value()};
}

void LimitPanel::refresh(bool another) {
  const Json entry = shownLimit() < 0 ? Json() : document_.valueAt(pointerOf(shownLimit()));
  editor_->setEmptyText(document_.isEmpty()
                            ? tr("Open a scene to see how far its cloth may stretch.")
                            : tr("Nothing limits how far this cloth may stretch.\nBegin with one of the presets."));
  if (another) say({});
  if (entry.is_null()) {
    editor_->setLimit(std::nullopt);
  } else {
    const ConstraintChoice written = constraintChoiceOf(entry);
    const QSignalBlocker blockMethods(methods_), blockCount(count_);
    methods_->setCurrentIndex(static_cast<int>(written.method));
    count_->setValue(written.count);
    try {
      editor_->setLimit(limitOf(entry), another);
    } catch (const base::InputError& error) {  // two points of the file in one direction, say
      editor_->setLimit(std::nullopt);
      editor_->setEmptyText(QString::fromStdString(error.problem()));
    }
  }
  refreshControls();
  if (another) Q_EMIT limitShown(shownLimit());
}

/// What follows from the limit as the editor has it.
void LimitPanel::refreshControls() {
  const auto& shape = editor_->shape();
  const bool free = shape && shape->kind() == LimitKind::free;
  kinds_->setEnabled(shape.has_value());
  const QSignalBlocker blockCount(count_);
  if (shape) kinds_->setCurrentIndex(static_cast<int>(shape->kind()));
  presets_->setEnabled(!document_.isEmpty());
  mirrored_->setEnabled(free);
  mirrored_->setChecked(free && shape->symmetry() == LimitSymmetry::mirrored);
  // All but a curve is one ellipse, and so enforced exactly unless by directions.
  methods_->setItemText(0, free ? tr("the better of both") : tr("one ellipse, exactly"));
  qobject_cast<QListView*>(methods_->view())->setRowHidden(1, !free);
  if (!free && methods_->currentIndex() == 1) methods_->setCurrentIndex(0);
  const bool directions = choice().method == ConstraintMethod::directions;
  count_->setMinimum(directions ? 2 : 1);
  count_->setVisible(free || directions);
  enforcement_->setVisible(shape.has_value());
  table_->setShape(shape ? &*shape : nullptr);
  table_->setVisible(shape.has_value());
  if (!shape) return;
  try {
    editor_->setConstraints(constraintsOf(shape->limit(), choice()));
  } catch (const base::InputError& error) {
    editor_->setConstraints(std::nullopt);
    say(QString::fromStdString(error.problem()));
  }
}

void LimitPanel::write(const QString& text, int mergeId) {
  if (document_.isEmpty() || !editor_->shape()) return;
  say({});
  refreshControls();
  const cloth::StretchLimit limit = editor_->shape()->limit();
  const int index = shownLimit();
  bool taken = false;
  if (index < 0) {
    taken = document_.setValue(
        limitList, Json::array({entryWith(newEntry(document_.valueAt("/elements")), limit, choice())}), text);
  } else {
    const Json& written = document_.scene().json().at(Json::json_pointer(pointerOf(index)));
    taken = document_.setValue(pointerOf(index), entryWith(written, limit, choice()), text, mergeId);
  }
  if (!taken) refresh(false);
}

void LimitPanel::say(const QString& sentence) {
  QPalette colors = palette();
  colors.setColor(QPalette::WindowText, plots::plotStyle(colors).warning);
  message_->setPalette(colors);
  message_->setText(sentence);
}

void LimitPanel::act(const std::function<void()>& act) {
  try {
    act();
  } catch (const base::InputError& error) {
    say(QString::fromUtf8(error.what()));
  }
}

void LimitPanel::exportPlot() {
  const QString file =
      QFileDialog::getSaveFileName(this, tr("Export the stretch limit"), {}, plots::plotExportFilters());
  if (!file.isEmpty()) act([&] { editor_->exportTo(file); });
}

}  // namespace pliant::panels
