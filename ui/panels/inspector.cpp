#include "ui/panels/inspector.hpp"

#include <QFormLayout>
#include <QLabel>
#include <algorithm>

#include "core/harmonic/amplitude.hpp"
#include "ui/panels/parameter_panel.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

namespace {

QString kindOf(const mechanics::Model& model, int node) {
  const std::vector<int> driven = model.drivenNodes();
  if (std::binary_search(driven.begin(), driven.end(), node)) return Inspector::tr("driven");
  int free = 0;
  for (int axis = 0; axis < model.dimension; ++axis)
    if (model.dofs.freeIndex[static_cast<std::size_t>(node * model.dimension + axis)] >= 0) ++free;
  double mass = 0;
  for (const auto& point : model.pointMasses)
    mass += point.mass * static_cast<double>(std::count(point.nodes.begin(), point.nodes.end(), node));
  QString text = free == model.dimension ? Inspector::tr("free")
                 : free == 0             ? Inspector::tr("locked")
                                         : Inspector::tr("partly locked");
  if (mass > 0) text += Inspector::tr(", mass %1").arg(base::formatQuantity(mass, base::dimensions::mass).c_str());
  return text;
}

}  // namespace

Inspector::Inspector(document::Document& document, jobs::MotionSession& session, QWidget* parent)
    : QWidget(parent), document_(document), session_(session) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(16, 8, 16, 16);
  form->setHorizontalSpacing(16);
  form->setVerticalSpacing(4);
  form->setLabelAlignment(Qt::AlignLeft);
  const auto row = [&](const QString& title) {
    auto* label = new QLabel(title);
    label->setForegroundRole(QPalette::PlaceholderText);
    auto* value = new QLabel;
    value->setTextInteractionFlags(Qt::TextSelectableByMouse);
    form->addRow(label, value);
    return value;
  };
  node_ = row(tr("Node"));
  place_ = row(tr("Rests at"));
  kind_ = row(tr("Is"));
  path_ = row(tr("Path length"));
  reach_ = row(tr("Displacement"));
  connect(&session_, &jobs::MotionSession::shownChanged, this, &Inspector::refresh);
  connect(&session_, &jobs::MotionSession::nodeChanged, this, &Inspector::refresh);
  connect(&document_, &document::Document::sceneReplaced, this, &Inspector::refresh);
  connect(&document_, &document::Document::sceneEdited, this, &Inspector::refresh);
  refresh();
}

QString Inspector::text() const {
  return QStringList{node_->text(), place_->text(), kind_->text(), path_->text(), reach_->text()}.join(
      QLatin1Char('\n'));
}

void Inspector::refresh() {
  const QString none = QStringLiteral("–");
  for (QLabel* label : {node_, place_, kind_, path_, reach_}) label->setText(none);
  if (document_.isEmpty()) return;
  const mechanics::Model& model = *document_.model();
  const int node = session_.node();
  if (node >= model.nodeCount()) return;
  const QString name = nodeName(model, node);
  const QString number = QStringLiteral("node %1").arg(node);
  node_->setText(name == number ? QString::number(node) : QStringLiteral("%1 (%2)").arg(name, number));
  const auto rest = model.restPositions.segment(node * model.dimension, model.dimension);
  const plots::LengthUnit unit = plots::fittingLengthUnit(rest.cwiseAbs().maxCoeff());
  QStringList place;
  for (const double coordinate : rest) place << QString::number(coordinate * unit.perMetre, 'g', 4);
  place_->setText(QStringLiteral("%1 %2").arg(place.join(QStringLiteral(", ")), unit.name));
  kind_->setText(kindOf(model, node));
  const auto& shown = session_.shown();
  if (!shown || node >= shown->problem->model().nodeCount()) return;
  const harmonic::Amplitude solved = harmonic::amplitude(*shown->problem, shown->motion.z, node);
  path_->setText(plots::formatLength(solved.pathLength));
  reach_->setText(plots::formatLength(solved.maximumDisplacement));
}

}  // namespace pliant::panels
