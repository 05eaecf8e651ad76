#include "ui/shell/make_dialog.hpp"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <cstring>

#include "core/base/units.hpp"

namespace pliant::shell {

namespace {

constexpr int fieldHeight = 28;
constexpr int resultHeight = 160;

}  // namespace

MakeDialog::MakeDialog(QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("Export to make"));
  setModal(false);
  intro_ = new QLabel;
  intro_->setWordWrap(true);
  auto* form = new QFormLayout;
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  const scene::PartsRequest usual;
  for (const scene::PartsNumber& number : scene::partsNumbers()) {
    auto* field = new QDoubleSpinBox;
    field->setDecimals(3);
    field->setRange(0.001, 10000);
    field->setSuffix(QStringLiteral(" %1").arg(QLatin1String(number.unit)));
    field->setValue(inOwnUnit(usual, number));
    field->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    field->setFixedHeight(fieldHeight);
    field->setToolTip(tr(number.description));
    auto* label = new QLabel(tr(number.label));
    label->setBuddy(field);
    label->setFixedHeight(fieldHeight);
    form->addRow(label, field);
    rows_.push_back({number, label, field});
  }
  flat_ = new QCheckBox(tr("Links side by side"));
  flat_->setToolTip(tr("To be printed, instead of in layers as they are mounted"));
  form->addRow(QString(), flat_);

  result_ = new QLabel;
  result_->setWordWrap(true);
  result_->setMargin(4);
  result_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  result_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* area = new QScrollArea;
  area->setWidgetResizable(true);
  area->setWidget(result_);
  area->setMinimumHeight(resultHeight);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  bodies_ = buttons->addButton(tr("Export &Bodies…"), QDialogButtonBox::ActionRole);
  bodies_->setToolTip(tr("STL, 3MF, OBJ, PLY or glTF; STL and 3MF in millimetres"));
  table_ = buttons->addButton(tr("Export &Parameters…"), QDialogButtonBox::ActionRole);
  table_->setToolTip(tr("A table with the diameters of balls and cylinders that weigh what the masses do"));
  for (QAbstractButton* button : buttons->buttons()) qobject_cast<QPushButton*>(button)->setAutoDefault(false);
  bodies_->setDefault(true);
  connect(bodies_, &QPushButton::clicked, this, &MakeDialog::bodiesRequested);
  connect(table_, &QPushButton::clicked, this, &MakeDialog::tableRequested);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);

  auto* column = new QVBoxLayout(this);
  column->addWidget(intro_);
  column->addLayout(form);
  column->addWidget(area, 1);
  column->addWidget(buttons);
  resize(480, 560);
}

void MakeDialog::setScene(const scene::Scene& scene, bool hasParameters) {
  const bool links = hasElements(scene, "link"), rods = hasElements(scene, "rod") || hasElements(scene, "flat_rod");
  const bool sheets = hasElements(scene, "shell") || hasElements(scene, "membrane") || hasElements(scene, "bending");
  const bool solids = hasElements(scene, "solid");
  for (const Row& row : rows_) {
    const scene::PartsNumber& number = row.number;
    const bool matters = (links && number.links) || (rods && number.rods) || (hasParameters && number.table);
    row.label->setVisible(matters);
    row.field->setVisible(matters);
  }
  flat_->setVisible(links);
  bodies_->setEnabled(links || rods || sheets || solids);
  table_->setEnabled(hasParameters);
  QStringList sentences;
  if (sheets) sentences += tr("Shells are thickened to solids with the thickness of their elements.");
  if (solids) sentences += tr("Of solids the surface is written.");
  if (links) sentences += tr("Links become plates with holes, in layers that do not meet.");
  if (rods) sentences += tr("Rods become wires with sockets for balls that weigh what the masses do.");
  if (sentences.isEmpty()) sentences += tr("This scene has no shells, solids, links or rods that could be made.");
  intro_->setText(sentences.join(QLatin1Char(' ')));
  result_->setText(tr("What is exported will be listed here, with its size and volume."));
}

scene::PartsRequest MakeDialog::request() const {
  scene::PartsRequest request;
  request.flat = flat_->isChecked();
  for (const Row& row : rows_)
    request.*row.number.value =
        base::parseQuantity(std::to_string(row.field->value()) + " " + row.number.unit, row.number.dimension);
  return request;
}

void MakeDialog::showLines(const QStringList& lines) { result_->setText(lines.join(QLatin1Char('\n'))); }

QString MakeDialog::shownText() const { return result_->text(); }

QDoubleSpinBox* MakeDialog::field(const char* key) const {
  for (const Row& row : rows_)
    if (std::strcmp(row.number.key, key) == 0) return row.field;
  return nullptr;
}

}  // namespace pliant::shell
