#include "ui/shell/viewport_link.hpp"

#include "ui/plots/plot_style.hpp"

namespace pliant::shell {

namespace {

/// Whether both models put the same lines and triangles at the same places.
bool looksAlike(const mechanics::Model& a, const mechanics::Model& b) {
  if (a.dimension != b.dimension || a.restPositions.size() != b.restPositions.size() ||
      a.restPositions != b.restPositions)
    return false;
  if (a.parts.size() != b.parts.size()) return false;
  for (std::size_t i = 0; i < a.parts.size(); ++i)
    if (a.parts[i].triangles != b.parts[i].triangles || a.parts[i].segments != b.parts[i].segments ||
        a.parts[i].springs != b.parts[i].springs || a.parts[i].arms != b.parts[i].arms)
      return false;
  return true;
}

}  // namespace

ViewportLink::ViewportLink(document::Document& document, jobs::MotionSession& session, viewport::Viewport& viewport,
                           QObject* parent)
    : QObject(parent), document_(document), session_(session), viewport_(viewport) {
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    drawn_.reset();
    showModel();
  });
  connect(&document_, &document::Document::sceneEdited, this, [this] {
    if (!drawn_ || !looksAlike(*drawn_, *document_.model())) {
      showModel();
      showMotion();
    }
  });
  connect(&session_, &jobs::MotionSession::shownChanged, this, &ViewportLink::showMotion);
  connect(&session_, &jobs::MotionSession::predictionChanged, this, &ViewportLink::showPrediction);
  connect(&session_, &jobs::MotionSession::nodeChanged, this, [this](int node) { viewport_.setSelectedNode(node); });
  connect(&viewport_, &viewport::Viewport::nodePicked, this, [this](int node) {
    if (node >= 0) session_.selectNode(node);
  });
}

void ViewportLink::showModel() {
  drawn_ = document_.model();
  viewport_.setModel(drawn_);
  viewport_.setStale(false);
  viewport_.setSelectedNode(session_.node());
  viewport_.setCaption(document_.title());
}

void ViewportLink::showMotion() {
  // A design may have put another shape there.
  if (document_.model() && drawn_ && !looksAlike(*drawn_, *document_.model())) showModel();
  const auto& shown = session_.shown();
  const bool fits = shown && drawn_ && looksAlike(shown->problem->model(), *drawn_);
  if (!fits) {
    viewport_.clearPrediction();
    viewport_.clearMotion();
    viewport_.pause();
    viewport_.setCaption(document_.title());
    return;
  }
  viewport_.setMotion(shown->problem, shown->motion.z);
  viewport_.setSelectedNode(session_.node());
  viewport_.play();
  showPrediction();
}

void ViewportLink::showMode(const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem,
                            const harmonic::Vector& z, const QString& caption) {
  if (!drawn_ || !looksAlike(problem->model(), *drawn_)) return;
  viewport_.setMotion(problem, z);
  viewport_.setSelectedNode(session_.node());
  viewport_.setCaption(document_.title() + '\n' + caption);
  viewport_.play();
}

void ViewportLink::showDesign(const std::shared_ptr<const harmonic::HarmonicBalanceProblem>& problem,
                              const harmonic::Vector& z, const QString& caption) {
  if (!drawn_ || !looksAlike(problem->model(), *drawn_)) {
    drawn_ = std::make_shared<const mechanics::Model>(problem->model());
    viewport_.setModel(drawn_);
  }
  viewport_.clearPrediction();
  viewport_.setStale(false);
  showMode(problem, z, caption);
}

void ViewportLink::showPrediction() {
  const auto& shown = session_.shown();
  if (!shown || !drawn_ || !looksAlike(shown->problem->model(), *drawn_)) return;
  viewport_.setStale(session_.isStale());
  if (session_.prediction())
    viewport_.setPrediction(*session_.prediction(), session_.previewedModel());
  else
    viewport_.clearPrediction();
  viewport_.setCaption(caption());
}

QString ViewportLink::caption() const {
  const jobs::ShownMotion& shown = *session_.shown();
  QString text = document_.title();
  text += QStringLiteral("\nω = %1,  H = %2,  residual %3,  correction %4")
              .arg(plots::formatFrequency(shown.motion.omega, false))
              .arg(shown.problem->basis().harmonics())
              .arg(shown.motion.report.residual(), 0, 'g', 2)
              .arg(shown.motion.report.correction(), 0, 'g', 2);
  return text;
}

}  // namespace pliant::shell
