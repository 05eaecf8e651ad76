#include "core/base/solver_report.hpp"
#include "ui/document/document.hpp"

namespace pliant::document {

void Document::setStudyWaiting(const std::string& name) {
  StudyState* state = findStudy(name);
  if (!state) return;
  state->status = StudyStatus::waiting;
  Q_EMIT studyChanged(name);
}

void Document::setStudyRunning(const std::string& name) {
  StudyState* state = findStudy(name);
  if (!state) return;
  state->status = StudyStatus::running;
  state->message.clear();
  Q_EMIT studyChanged(name);
}

void Document::setPartialResult(const std::string& name, std::shared_ptr<const scene::Result> result,
                                const scene::Scene& solvedScene) {
  StudyState* state = findStudy(name);
  if (!state) return;
  state->result = std::move(result);
  state->solvedScene = solvedScene;
  state->stale = !sameStudy(*scene_, solvedScene, name);
  Q_EMIT studyChanged(name);
}

void Document::setResult(const std::string& name, std::shared_ptr<const scene::Result> result,
                         const scene::Scene& solvedScene) {
  StudyState* state = findStudy(name);
  if (!state) return;
  state->message = QString::fromStdString(result->message);
  switch (result->termination) {
    case base::TerminationType::converged: state->status = StudyStatus::solved; break;
    case base::TerminationType::cancelled: state->status = StudyStatus::cancelled; break;
    default: state->status = StudyStatus::failed; break;
  }
  state->result = std::move(result);
  state->solvedScene = solvedScene;
  state->stale = !sameStudy(*scene_, solvedScene, name);
  if (state->status == StudyStatus::solved && state->stale) state->status = StudyStatus::stale;
  Q_EMIT studyChanged(name);
}

void Document::setStudyEnded(const std::string& name, const QString& sentence) {
  StudyState* state = findStudy(name);
  if (!state) return;
  state->message = sentence;
  if (!sentence.isEmpty())
    state->status = StudyStatus::failed;
  else if (!state->result)
    state->status = StudyStatus::none;
  else if (state->result->termination == base::TerminationType::converged)
    state->status = state->stale ? StudyStatus::stale : StudyStatus::solved;
  else
    state->status = StudyStatus::cancelled;
  Q_EMIT studyChanged(name);
}

}  // namespace pliant::document
