#include "ui/shell/cloth_link.hpp"

#include <algorithm>

#include "ui/panels/energy_panel.hpp"
#include "ui/panels/limit_panel.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

using viewport::Viewport;

namespace {

constexpr int reachedDelay = 60;  ///< milliseconds
constexpr int reachedCount = 90;  ///< directions of half a turn

bool isUnderWay(const document::StudyState& study) { return study.status == document::StudyStatus::running; }

}  // namespace

bool hasCloth(const document::Document& document) {
  if (document.isEmpty()) return false;
  const auto& studies = document.studies();
  const scene::Json limits = document.valueAt("/stretch_limits");
  return (limits.is_array() && !limits.empty()) ||
         std::any_of(studies.begin(), studies.end(), [](const auto& s) { return document::isClothStudy(s.type); });
}

ClothLink::ClothLink(document::Document& document, Viewport& viewport, panels::LimitPanel& limits,
                     panels::EnergyPanel& energies, QObject* parent)
    : QObject(parent), document_(document), viewport_(viewport), limits_(limits), energies_(energies) {
  reachedTimer_.setSingleShot(true);
  reachedTimer_.setInterval(reachedDelay);
  connect(&reachedTimer_, &QTimer::timeout, this, &ClothLink::refreshReached);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    study_.clear();
    result_.reset();
    live_ = false;
    node_ = -1;
    viewport_.setCloth(nullptr);
  });
  connect(&document_, &document::Document::sceneEdited, this, &ClothLink::refresh);
  connect(&document_, &document::Document::studyChanged, this, &ClothLink::follow);
  connect(&energies_, &panels::EnergyPanel::studyChosen, this, &ClothLink::showStudy);
  connect(&energies_, &panels::EnergyPanel::instantChosen, this, [this](double seconds) {
    viewport_.pause();
    viewport_.setTime(seconds);
  });
  connect(&limits_, &panels::LimitPanel::limitShown, this, &ClothLink::refreshReached);
  connect(&viewport_, &Viewport::timeChanged, this, [this](double time) {
    energies_.setInstant(time);
    if (!reachedTimer_.isActive()) reachedTimer_.start();
  });
  connect(&viewport_, &Viewport::nodePicked, this, [this](int node) {
    if (!viewport_.showsCloth()) return;
    node_ = node;
    viewport_.setSelectedNode(node < 0 ? std::nullopt : std::optional(node));
    refreshReached();
  });
}

void ClothLink::follow(const std::string& name) {
  const document::StudyState* study = document_.study(name);
  if (!study || !document::isClothStudy(study->type)) return;
  if (study_.empty() || (isUnderWay(*study) && name != study_))
    showStudy(name);
  else if (name == study_)
    refresh();
}

void ClothLink::showStudy(const std::string& name) {
  study_ = name;
  energies_.setStudy(name);
  refresh();
}

void ClothLink::setLive(bool live) {
  live_ = live;
  result_.reset();
  if (!live) refresh();
}

void ClothLink::refresh() {
  if (live_) return;
  const document::StudyState* study = study_.empty() ? nullptr : document_.study(study_);
  const bool any = study && study->result && study->result->kind() == "cloth";
  const auto result = any ? std::static_pointer_cast<const scene::ClothResult>(study->result) : nullptr;
  const bool growing = study && isUnderWay(*study);
  if (!result || !result->problem) {
    result_.reset();
    viewport_.setCloth(nullptr);
    refreshReached();
    return;
  }
  const bool another = !result_ || result_->problem != result->problem;
  const bool changed = result_ != result || another;
  result_ = result;
  viewport_.setCloth(result->problem);
  if (changed || !growing)
    viewport_.setClothFrames(
        result->frames, growing,
        study->type == "cloth_motion" ? Viewport::FrameClock::seconds : Viewport::FrameClock::steps);
  viewport_.setStale(study->stale);
  viewport_.setCaption(caption());
  // What is complete is played, unless somebody looks at a frame of it.
  const bool atEnd = viewport_.time() >= viewport_.duration();
  if (!growing && study->type == "cloth_motion" && (another || (growing_ && atEnd))) viewport_.play();
  growing_ = growing;
  reachedTimer_.start();
}

/// The largest stretches of the frame on show under the limit on show.
void ClothLink::refreshReached() {
  const int frame = viewport_.showsCloth() ? viewport_.clothView().frame() : -1;
  if (frame >= 0 && !limits_.isVisible()) return;  // it asks again when it is shown
  if (frame < 0 || frame >= static_cast<int>(viewport_.clothFrames().size())) {
    limits_.setReached({}, {});
    return;
  }
  const cloth::LimitedSheet& sheet = viewport_.clothProblem()->sheet;
  std::vector<int> triangles, picked;
  for (std::size_t i = 0; i < sheet.triangles.size(); ++i) {
    const cloth::SheetTriangle& triangle = sheet.triangles[i];
    if (triangle.limit != limits_.shownLimit()) continue;
    triangles.push_back(static_cast<int>(i));
    if (std::find(triangle.nodes.begin(), triangle.nodes.end(), node_) != triangle.nodes.end())
      picked.push_back(static_cast<int>(i));
  }
  if (triangles.empty()) {
    limits_.setReached({}, {});
    return;
  }
  const QString name = picked.empty() ? tr("the worst of all triangles") : tr("the triangles of node %1").arg(node_);
  limits_.setReached(cloth::reachedStretch(sheet, viewport_.clothFrames()[static_cast<std::size_t>(frame)]->positions,
                                           reachedCount, picked.empty() ? triangles : picked),
                     name);
}

QString ClothLink::caption() const {
  QString text = document_.title();
  if (study_.empty() || !result_) return text;
  text += '\n' + QString::fromStdString(study_);
  if (!result_->message.empty()) text += ",  " + QString::fromStdString(result_->message);
  if (!result_->steps.empty()) {
    double violation = 0;
    for (const scene::ClothStepRecord& step : result_->steps) violation = std::max(violation, step.violation);
    text += tr(",  %1 steps,  limits kept to %2").arg(result_->steps.size()).arg(violation, 0, 'g', 2);
  }
  return text;
}

}  // namespace pliant::shell
