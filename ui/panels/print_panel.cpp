#include "ui/panels/print_panel.hpp"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace pliant::panels {

namespace {

enum Outline { cellCount, rectangle, circle };

const QString inspectTopic = QStringLiteral("patch to print");
constexpr double metresPerMillimetre = 1e-3;

QString lengthText(double length) {
  return QString::fromStdString(base::formatQuantity(length, base::dimensions::length));
}

QString reportText(const scene::PatchReport& report, const scene::PatchRequest& request) {
  QString text = report.elements == 1 ? QObject::tr("1 element,  %1 clearance").arg(lengthText(report.clearance))
                                      : QObject::tr("%1 elements,  clearance between them %2")
                                            .arg(report.elements)
                                            .arg(lengthText(report.clearance));
  if (report.clearance < request.minimumClearance)
    text += '\n' + QObject::tr("They are nearer to each other than is asked for.");
  else if (report.clearance <= 2 * request.tolerance)
    text += '\n' + QObject::tr("Meshes may touch: the clearance is below twice the tolerance.");
  if (report.leftOut > 0)
    text += '\n' +
            QObject::tr("%1 more inside the outline are left out: nothing links them to the rest.").arg(report.leftOut);
  return text;
}

}  // namespace

PrintPanel::PrintPanel(document::Document& document, jobs::JobRunner& quick, QWidget* parent)
    : QWidget(parent), document_(document), quick_(quick) {
  form_ = new QFormLayout(this);
  form_->setContentsMargins(16, 12, 16, 12);
  form_->setHorizontalSpacing(12);
  form_->setVerticalSpacing(8);
  form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  const auto combo = [&](const QString& label, const QString& tooltip) {
    auto* made = new QComboBox;
    made->setToolTip(tooltip);
    made->setAccessibleName(label);
    made->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    form_->addRow(label, made);
    return made;
  };
  const auto number = [&](const QString& label, const QString& tooltip) {
    auto* made = new QDoubleSpinBox;
    made->setKeyboardTracking(false);
    made->setToolTip(tooltip);
    made->setAccessibleName(label);
    form_->addRow(label, made);
    return made;
  };
  cells_ = combo(tr("Material"), tr("What is printed"));
  states_ = combo(tr("State"), tr("At rest, or at the limit that a study of one direction finds"));
  outlines_ = combo(tr("Outline"), tr("Elements with their origins inside belong to the patch"));
  outlines_->addItems({tr("number of cells"), tr("rectangle"), tr("circle")});
  first_ = number(tr("Width"), tr("Along the first axis"));
  second_ = number(tr("Height"), tr("Along the second axis"));
  tolerance_ = number(tr("Tolerance"), tr("How far chords of the meshes may be from the exact surfaces"));
  tolerance_->setSuffix(QStringLiteral(" mm"));
  tolerance_->setDecimals(3);
  tolerance_->setRange(0.001, 1);
  tolerance_->setSingleStep(0.005);
  clearance_ = number(tr("Clearance"), tr("Between elements at least, so that the printer does not fuse them"));
  clearance_->setSuffix(QStringLiteral(" mm"));
  clearance_->setDecimals(2);
  clearance_->setRange(0, 10);
  clearance_->setSingleStep(0.05);
  const scene::PatchRequest usual;
  tolerance_->setValue(usual.tolerance / metresPerMillimetre);
  clearance_->setValue(usual.minimumClearance / metresPerMillimetre);
  findings_ = new QLabel;
  findings_->setWordWrap(true);
  findings_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  findings_->setMinimumHeight(4 * findings_->fontMetrics().lineSpacing());
  form_->addRow(findings_);
  export_ = new QPushButton(tr("Export STL or 3MF…"));
  export_->setToolTip(tr("One closed mesh for each element, lengths in millimetres"));
  form_->addRow(export_);
  connect(export_, &QPushButton::clicked, this, &PrintPanel::exportRequested);
  connect(cells_, &QComboBox::activated, this, [this] {
    fillStates();
    inspect();
  });
  connect(states_, &QComboBox::activated, this, &PrintPanel::inspect);
  connect(outlines_, &QComboBox::activated, this, [this] {
    fitOutline();
    inspect();
  });
  const auto renew = [this] {
    fill();
    inspect();
  };
  connect(&document_, &document::Document::sceneReplaced, this, renew);
  connect(&document_, &document::Document::sceneEdited, this, renew);
  fitOutline();
  fill();
  for (const QDoubleSpinBox* box : {first_, second_, tolerance_, clearance_})
    connect(box, &QDoubleSpinBox::valueChanged, this, &PrintPanel::inspect);
}

void PrintPanel::fill() {
  const QString before = cells_->currentText();
  cells_->clear();
  if (!document_.isEmpty())
    for (const scene::Json& cell : document_.scene().normalized().value("interlocking_cells", scene::Json::array()))
      cells_->addItem(QString::fromStdString(cell["name"]));
  cells_->setCurrentIndex(std::max(0, cells_->findText(before)));
  fillStates();
}

void PrintPanel::fillStates() {
  const QString before = states_->currentData().toString();
  states_->clear();
  states_->addItem(tr("at rest"), QString());
  if (!document_.isEmpty())
    for (const scene::Json& study : document_.scene().normalized().value("studies", scene::Json::array()))
      if (study["type"] == "cell_test" && QString::fromStdString(study["cell"]) == cells_->currentText()) {
        const QString name = QString::fromStdString(study["name"]);
        states_->addItem(tr("limit of %1").arg(name), name);
      }
  states_->setCurrentIndex(std::max(0, states_->findData(before)));
}

/// Units, ranges and usual values of the outline.
void PrintPanel::fitOutline() {
  const int outline = outlines_->currentIndex();
  const bool cells = outline == cellCount;
  for (QDoubleSpinBox* box : {first_, second_}) {
    const QSignalBlocker block(box);
    box->setSuffix(cells ? QString() : QStringLiteral(" mm"));
    box->setDecimals(cells ? 0 : 1);
    box->setRange(1, cells ? 1000 : 10000);
    box->setValue(cells ? 3 : 60);
  }
  auto* label = qobject_cast<QLabel*>(form_->labelForField(first_));
  label->setText(cells ? tr("Cells along a₁") : outline == rectangle ? tr("Width") : tr("Diameter"));
  qobject_cast<QLabel*>(form_->labelForField(second_))->setText(cells ? tr("Cells along a₂") : tr("Height"));
  form_->labelForField(second_)->setVisible(outline != circle);
  second_->setVisible(outline != circle);
}

void PrintPanel::choose(int outline, double first, double second) {
  outlines_->setCurrentIndex(outline);
  fitOutline();
  first_->setValue(first);
  second_->setValue(second);
  inspect();
}

scene::PatchRequest PrintPanel::request() const {
  scene::PatchRequest request;
  request.cell = cells_->currentText().toStdString();
  request.study = states_->currentData().toString().toStdString();
  const QString first = first_->locale().c().toString(first_->value(), 'f', first_->decimals());
  const QString second = first_->locale().c().toString(second_->value(), 'f', second_->decimals());
  switch (outlines_->currentIndex()) {
    case cellCount: request.outline = (first + 'x' + second).toStdString(); break;
    case rectangle: request.outline = (first + " mm x " + second + " mm").toStdString(); break;
    default: request.outline = (first + " mm").toStdString();
  }
  request.tolerance = metresPerMillimetre * tolerance_->value();
  request.minimumClearance = metresPerMillimetre * clearance_->value();
  return request;
}

QString PrintPanel::findings() const { return findings_->text(); }

void PrintPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  inspect();
}

void PrintPanel::inspect() {
  quick_.abandonTopic(inspectTopic);
  takeFindings(QString(), false);
  if (!isVisible()) return;
  if (cells_->count() == 0) {
    takeFindings(tr("This scene has no interlocking material to print."), false);
    return;
  }
  jobs::Job job;
  job.topic = inspectTopic;
  job.work = [panel = QPointer<PrintPanel>(this), scene = document_.scene(), request = request()](
                 base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
    QString text;
    bool ready = false;
    try {
      const scene::PatchReport report = scene::inspectPatch(scene, request, context);
      text = reportText(report, request);
      ready = report.clearance >= request.minimumClearance;
    } catch (const base::InputError& error) {
      text = QString::fromStdString(error.problem());
    }
    if (context.cancelRequested()) return {};
    return [panel, text, ready] {
      if (PrintPanel* self = panel.data()) self->takeFindings(text, ready);
    };
  };
  quick_.submit(std::move(job));
}

void PrintPanel::takeFindings(const QString& text, bool ready) {
  ready_ = ready;
  findings_->setText(text);
  export_->setEnabled(ready);
}

}  // namespace pliant::panels
