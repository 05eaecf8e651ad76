#pragma once

#include <QObject>
#include <map>
#include <string>
#include <vector>

#include "ui/document/document.hpp"
#include "ui/jobs/job_runner.hpp"

namespace pliant::jobs {

/// Runs studies of a document in the background, on snapshots of its scene, and puts what they find into the document:
/// partial results as they grow, the half of a cancelled one too. Another scene drops everything that still runs.
class StudyRunner final : public QObject {
  Q_OBJECT

 public:
  StudyRunner(document::Document& document, JobRunner& jobs, QObject* parent = nullptr);

  /// Runs these studies one after another, single motions first since they are quick to show.
  void run(std::vector<std::string> names);
  void runAll();
  /// The studies whose results are stale, and those under way, from the beginning.
  void runOutdated();
  void cancel();
  bool isRunning() const { return !running_.empty(); }

 Q_SIGNALS:
  void runningChanged(bool running);

 private:
  void submit(const std::string& name);
  void finish(JobRunner::Id id, JobOutcome outcome, const QString& sentence);

  document::Document& document_;
  JobRunner& jobs_;
  std::map<JobRunner::Id, std::string> running_;  ///< waiting ones too
};

}  // namespace pliant::jobs
