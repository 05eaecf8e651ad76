#include "ui/jobs/study_runner.hpp"

#include <algorithm>

#include "core/scene/resumable_study.hpp"

namespace pliant::jobs {

using document::StudyStatus;

StudyRunner::StudyRunner(document::Document& document, JobRunner& jobs, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs) {
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    running_.clear();
    jobs_.abandonAll();
    Q_EMIT runningChanged(false);
  });
  connect(&jobs_, &JobRunner::started, this, [this](JobRunner::Id id) {
    if (const auto found = running_.find(id); found != running_.end()) document_.setStudyRunning(found->second);
  });
  connect(&jobs_, &JobRunner::finished, this,
          [this](JobRunner::Id id, const QString&, JobOutcome outcome, const QString& sentence) {
            finish(id, outcome, sentence);
          });
}

void StudyRunner::run(std::vector<std::string> names) {
  if (document_.isEmpty()) return;
  const auto isCurve = [this](const std::string& name) {
    const document::StudyState* study = document_.study(name);
    return study && (study->type.ends_with("_response") || study->type == "backbone");
  };
  std::stable_partition(names.begin(), names.end(), [&](const std::string& name) { return !isCurve(name); });
  for (const std::string& name : names)
    if (document_.study(name)) submit(name);
  if (isRunning()) Q_EMIT runningChanged(true);
}

void StudyRunner::runAll() {
  std::vector<std::string> names;
  for (const auto& study : document_.studies()) names.push_back(study.name);
  run(std::move(names));
}

void StudyRunner::runOutdated() {
  std::vector<std::string> names;
  for (const auto& study : document_.studies())
    if ((study.result && study.stale) || study.status == StudyStatus::running || study.status == StudyStatus::waiting)
      names.push_back(study.name);
  run(std::move(names));
}

void StudyRunner::cancel() {
  for (const auto& [id, name] : std::map(running_)) jobs_.cancel(id);
}

void StudyRunner::submit(const std::string& name) {
  const scene::Scene scene = document_.scene();
  const auto model = document_.model();
  const auto before = document_.study(name)->result;
  Job job;
  job.topic = QStringLiteral("study: %1").arg(QString::fromStdString(name));
  job.title = QString::fromStdString(name);
  job.work = [this, scene, model, name, before](base::ExecutionContext& context, const Publish& publish) -> Delivery {
    const auto study = scene::StudyRegistry::instance().make(scene, model, name);
    if (auto* resumable = dynamic_cast<scene::ResumableStudy*>(study.get()); resumable && before)
      resumable->goOnFrom(*before);
    auto result = study->run(context, [&](std::shared_ptr<const scene::Result> partial) {
      publish([this, name, scene, partial] { document_.setPartialResult(name, partial, scene); });
    });
    return [this, name, scene, result] { document_.setResult(name, result, scene); };
  };
  const JobRunner::Id id = jobs_.submit(std::move(job));
  running_[id] = name;
  document_.setStudyWaiting(name);
}

void StudyRunner::finish(JobRunner::Id id, JobOutcome outcome, const QString& sentence) {
  const auto found = running_.find(id);
  if (found == running_.end()) return;
  const std::string name = found->second;
  running_.erase(found);
  const bool again =
      std::any_of(running_.begin(), running_.end(), [&](const auto& other) { return other.second == name; });
  const document::StudyState* study = document_.study(name);
  const bool unfinished = study && (study->status == StudyStatus::waiting || study->status == StudyStatus::running);
  if (!again && unfinished) document_.setStudyEnded(name, sentence);
  if (outcome == JobOutcome::failed) document_.raise(base::Severity::warning, sentence);
  if (!isRunning()) Q_EMIT runningChanged(false);
}

}  // namespace pliant::jobs
