#include "ui/shell/interlock_link.hpp"

#include <QPointer>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/interlock/holding_contacts.hpp"
#include "ui/panels/boundary_panel.hpp"
#include "ui/panels/cell_test_panel.hpp"
#include "ui/panels/sheet_panel.hpp"
#include "ui/panels/size_panel.hpp"
#include "ui/panels/travel_panel.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

using document::StudyStatus;

namespace {

const QString contactTopic = QStringLiteral("contacts of a limit");
constexpr double apart = 0.5;  ///< contacts of two elements nearer than this are one [smallest radii]

QString percent(double strain, int digits = 4) {
  return (strain < 0 ? QStringLiteral("−") : QString()) +
         QStringLiteral("%1 %").arg(100 * std::abs(strain), 0, 'g', digits);
}

QString held(std::size_t contacts, double meanGap, double remaining) {
  return QObject::tr("held at %1 places of a cell,  mean gap %2 wire radii;  smaller gaps could add %3")
      .arg(contacts)
      .arg(meanGap, 0, 'g', 2)
      .arg(percent(remaining, 2));
}

/// What a limit of a cell test holds for.
QString holdsFor(const scene::CellTestResult& result) {
  const scene::Json& options = result.provenance.options;
  const auto elements = result.cell->elements.size();
  if (options.value("load", "stretch") != "compress")
    return QObject::tr("a stretch limit holds for any number of cells");
  return QObject::tr("holds for cells of %1 %2,  perturbed by %3 wire radii,  the farthest of %4 tries")
      .arg(elements)
      .arg(elements == 1 ? QObject::tr("element") : QObject::tr("elements"))
      .arg(options.value("perturbation", 0.0), 0, 'g', 3)
      .arg(options.value("trials", 1));
}

QString testCaption(const scene::CellTestResult& result, std::size_t contacts) {
  const interlock::CellEquilibrium& rest = result.limit.equilibrium;
  const scene::Json& options = result.provenance.options;
  const QString direction = QString::number(result.limit.angle * 180 / std::numbers::pi, 'g', 4);
  QString text = QString::fromStdString(result.provenance.study);
  if (rest.kind == interlock::RestKind::unlimited)
    return text + '\n' + QObject::tr("nothing limits this deformation at %1°").arg(direction);
  if (!rest.converged()) return text + '\n' + QString::fromStdString(rest.message);
  text += QObject::tr(":  %1%2 at %3°,  %4 across")
              .arg(result.limit.strain > 0 ? QStringLiteral("+") : QString(), percent(result.limit.strain), direction,
                   QString::fromStdString(options.value("lateral", "free")));
  text += '\n' + held(contacts, rest.meanGap / result.cell->smallestRadius(), rest.remaining);
  return text + '\n' + holdsFor(result);
}

}  // namespace

bool isInterlockStudy(const document::Document& document, const std::string& study) {
  const scene::Json studies = document.valueAt("/studies");
  if (!studies.is_array()) return false;
  for (const scene::Json& each : studies)
    if (each.value("name", "") == study) return each.contains("cell");
  return false;
}

bool hasInterlock(const document::Document& document) {
  if (document.isEmpty()) return false;
  const scene::Json cells = document.valueAt("/interlocking_cells");
  return cells.is_array() && !cells.empty();
}

InterlockLink::InterlockLink(document::Document& document, jobs::JobRunner& quick, viewport::Viewport& viewport,
                             panels::BoundaryPanel& boundary, panels::TravelPanel& travel, panels::SizePanel& sizes,
                             panels::SheetPanel& sheets, panels::CellTestPanel& tests, QObject* parent)
    : QObject(parent),
      document_(document),
      quick_(quick),
      viewport_(viewport),
      boundary_(boundary),
      travel_(travel),
      sizes_(sizes),
      sheets_(sheets),
      tests_(tests),
      view_(std::make_shared<render::LimitView>()),
      patchView_(std::make_shared<render::PatchView>()),
      sheetLink_(document, viewport, sheets) {
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    grows_.clear();
    framed_ = patchFramed_ = false;
    sheetLink_.forget();
    leave();
  });
  connect(&document_, &document::Document::sceneEdited, this, &InterlockLink::refreshStale);
  connect(&document_, &document::Document::studyChanged, this, &InterlockLink::follow);
  connect(&boundary_, &panels::BoundaryPanel::stateExamined, this, &InterlockLink::showState);
  connect(&tests_, &panels::CellTestPanel::studyChosen, this, &InterlockLink::showTest);
  connect(&sheets_, &panels::SheetPanel::studyChosen, this, &InterlockLink::showTest);
}

bool InterlockLink::isShown() const {
  return viewport_.guest() == view_ || viewport_.guest() == patchView_ || sheetLink_.isShown();
}

void InterlockLink::follow(const std::string& name) {
  const document::StudyState* study = document_.study(name);
  if (!study || !study->result || study->result->kind() != "interlock") return;
  const bool ended = study->status != StudyStatus::running && study->status != StudyStatus::waiting;
  const bool plotted = travel_.shows(study->type) || sizes_.shows(study->type);
  if (sheets_.shows(study->type) && !ended) {
    // A sheet that moves is seen while it does, unless something else has been looked at since.
    const bool begins = grows_ != name;
    if (begins || study_ == name) showTest(name);
    if (begins) Q_EMIT resultGrows(study->type);
  } else if (panels::CellTestPanel::shows(study->type) && ended) {
    if (!study->stale) showTest(name);
    if (sheets_.shows(study->type)) Q_EMIT resultGrows(study->type);
  } else if (grows_ != name && (!ended || plotted)) {
    if (panels::BoundaryPanel::shows(study->type)) boundary_.setStudy(name);
    if (travel_.shows(study->type)) travel_.setStudy(name);
    if (sizes_.shows(study->type)) sizes_.setStudy(name);
    Q_EMIT resultGrows(study->type);
  }
  if (!ended) grows_ = name;
  if (ended && grows_ == name) grows_.clear();
  refreshStale();
}

void InterlockLink::showTest(const std::string& name) {
  quick_.abandonTopic(contactTopic);
  const document::StudyState* study = document_.study(name);
  const scene::Result* found = study ? study->result.get() : nullptr;
  const auto showPatch = [&](const auto& result) {
    const auto configuration = render::patchConfiguration(result);
    if (!configuration) return leave();
    study_ = name;
    tests_.setShown(name);
    show(configuration, QString::fromStdString(render::patchCaption(result)));
  };
  if (const auto* bent = dynamic_cast<const scene::BendingTestResult*>(found)) return showPatch(*bent);
  if (const auto* hanging = dynamic_cast<const scene::GravityBendingResult*>(found)) return showPatch(*hanging);
  if (const auto sheet = std::dynamic_pointer_cast<const scene::MacroResult>(study ? study->result : nullptr)) {
    study_ = name;
    tests_.setShown(name);
    sheets_.setStudy(name);
    sheetLink_.show(sheet, study->status == StudyStatus::running);
    refreshStale();
    return;
  }
  const auto* result = dynamic_cast<const scene::CellTestResult*>(found);
  if (!result || result->limit.equilibrium.state.rotations.empty()) {
    leave();
    return;
  }
  study_ = name;
  auto configuration = std::make_shared<render::CellConfiguration>();
  configuration->cell = result->cell;
  configuration->state = result->limit.equilibrium.state;
  configuration->contacts =
      interlock::distinctContacts(result->limit.equilibrium.contacts, apart * result->cell->smallestRadius());
  tests_.setShown(name);
  show(configuration, testCaption(*result, configuration->contacts.size()));
}

template <class Find>
void InterlockLink::showLater(Find find) {
  jobs::Job job;
  job.topic = contactTopic;
  job.work = [link = QPointer<InterlockLink>(this), find = std::move(find)](
                 base::ExecutionContext&, const jobs::Publish&) -> jobs::Delivery {
    return [link, found = find()] {
      InterlockLink* self = link.data();
      if (!self) return;
      self->tests_.setShown(std::nullopt);
      self->show(found.first, found.second);
    };
  };
  quick_.submit(std::move(job));
}

void InterlockLink::showState(int state) {
  const auto limits = boundary_.result();
  if (state < 0 || !limits || !boundary_.surface()) {
    if (isShown() && study_ == boundary_.study()) leave();
    return;
  }
  study_ = boundary_.study();
  if (const auto bent = std::dynamic_pointer_cast<const scene::BendingBoundaryResult>(limits)) {
    showLater([bent, state] {
      return std::pair(
          render::patchConfiguration(*bent, state), QString::fromStdString(render::patchCaption(*bent, state)));
    });
    return;
  }
  const auto result = std::dynamic_pointer_cast<const scene::StretchBoundaryResult>(limits);
  if (!result) return;
  const Eigen::Vector3d strain = boundary_.surface()->points.col(state);
  const QString name = QStringLiteral("%1,  limit %2").arg(QString::fromStdString(study_)).arg(state);
  showLater([result, state, strain, name] {
    const interlock::BoundaryState& limit = result->boundary.states.at(static_cast<std::size_t>(state));
    const double radius = result->cell->smallestRadius();
    const interlock::EquilibriumOptions defaults;
    const double range =
        defaults.rangeRatio * result->provenance.options.value("final_gap", defaults.finalGap) * radius;
    auto configuration = std::make_shared<render::CellConfiguration>();
    configuration->cell = result->cell;
    configuration->state = limit.cell;
    configuration->contacts = interlock::distinctContacts(
        interlock::holdingContacts(interlock::CellContact(*result->cell), limit.cell, range), apart * radius);
    const QString caption = name + '\n' + panels::strainText(strain) + '\n' +
                            held(configuration->contacts.size(), limit.meanGap / radius, limit.remaining);
    return std::pair(std::shared_ptr<const render::CellConfiguration>(configuration), caption);
  });
}

void InterlockLink::show(std::shared_ptr<const render::CellConfiguration> configuration, const QString& caption) {
  view_->setConfiguration(std::move(configuration));
  showGuest(view_, caption);
  if (!std::exchange(framed_, true)) viewport_.setAxisView(render::AxisView::isometric);
  viewport_.redrawGuest(true);
}

void InterlockLink::show(std::shared_ptr<const render::PatchConfiguration> configuration, const QString& caption) {
  const auto before = patchView_->configuration();
  const bool another = !before || before->patch != configuration->patch || before->gravity != configuration->gravity;
  patchView_->setConfiguration(std::move(configuration));
  showGuest(patchView_, caption);
  if (!std::exchange(patchFramed_, true))
    viewport_.setAxisView(render::AxisView::isometric);
  else if (another)
    viewport_.fit();
  viewport_.redrawGuest(true);
}

void InterlockLink::showGuest(const std::shared_ptr<render::View>& view, const QString& caption) {
  view->setCaption((document_.title() + '\n' + caption).toStdString());
  viewport_.setGuest(view);
  refreshStale();
}

void InterlockLink::leave() {
  quick_.abandonTopic(contactTopic);
  study_.clear();
  if (isShown()) viewport_.setGuest(nullptr);
  tests_.setShown(std::string());
}

void InterlockLink::refreshStale() {
  if (!isShown()) return;
  const document::StudyState* study = document_.study(study_);
  if (!study) {
    leave();
    return;
  }
  view_->setStale(study->stale);
  patchView_->setStale(study->stale);
  sheetLink_.setStale(study->stale);
  viewport_.redrawGuest();
}

}  // namespace pliant::shell
