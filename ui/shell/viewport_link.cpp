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
    // What parameters have moved is predicted from the motion on show, in its own shape.
    if (session_.shown() && session_.isComparable()) return;
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
  own_ = true;
  design_ = nullptr;
  const auto& shown = session_.shown();
  drawn_ = shown && session_.isComparable() ? shown->problem->sharedModel() : document_.model();
  viewport_.setModel(drawn_);
  viewport_.setStale(false);
  viewport_.setSelectedNode(session_.node());
  viewport_.setCaption(document_.title());
}

void ViewportLink::showMotion() {
  own_ = true;
  design_ = nullptr;
  viewport_.clearBeside();
  const auto& shown = session_.shown();
  // A design may have put another shape there.
  const auto own = shown && session_.isComparable() ? shown->problem->sharedModel() : document_.model();
  if (own && drawn_ && !looksAlike(*drawn_, *own)) showModel();
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
  own_ = false;
  design_ = nullptr;
  viewport_.clearBeside();
  viewport_.setMotion(problem, z);
  viewport_.setSelectedNode(session_.node());
  viewport_.setCaption(document_.title() + '\n' + caption);
  viewport_.play();
}

void ViewportLink::showDesign(const panels::DesignMotion& design) {
  if (!drawn_ || !looksAlike(design.problem->model(), *drawn_)) {
    drawn_ = design.problem->sharedModel();
    viewport_.setModel(drawn_);
  }
  viewport_.clearPrediction();
  viewport_.setStale(false);
  showMode(design.problem, design.z, design.label);
  design_ = design.problem.get();
}

void ViewportLink::showProgress(const panels::DesignMotion& first, const panels::DesignMotion& best) {
  if (design_ != first.problem.get() || viewport_.pair()) showDesign(first);
  viewport_.setGhost(best.problem, best.z, best.label);
}

void ViewportLink::showComparison(const panels::DesignMotion& left, const panels::DesignMotion& right) {
  if (design_ != left.problem.get() || !viewport_.pair()) showDesign(left);
  viewport_.setCaption(left.label);
  viewport_.setBeside(right.problem, right.z, right.label);
}

void ViewportLink::showPrediction() {
  // A mode or a design stays until parameters are dragged, which is about the session's motion.
  if (!own_ && !session_.isPreviewing()) return;
  if (!own_) {
    showMotion();
    return;
  }
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
  const math::HarmonicBasis& basis = shown.problem->basis();
  QString frequencies = plots::formatFrequency(shown.motion.omega, false);
  if (basis.hasTwoFrequencies())
    frequencies = tr("%1 and %2").arg(frequencies, plots::formatFrequency(basis.ratio() * shown.motion.omega, false));
  text += QStringLiteral("\nω = %1,  H = %2,  residual %3,  correction %4")
              .arg(frequencies)
              .arg(basis.order())
              .arg(shown.motion.report.residual(), 0, 'g', 2)
              .arg(shown.motion.report.correction(), 0, 'g', 2);
  return text;
}

}  // namespace pliant::shell
