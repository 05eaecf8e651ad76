#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <vector>

#include "ui/jobs/job_runner.hpp"

class QLabel;
class QProgressBar;
class QToolButton;

namespace pliant::shell {

/// What runs, how far it is, how long it will take, and the button that ends it. Where several jobs run, that of the
/// runner watched first is shown, so that a quick job does not hide a study. Jobs without a title are not shown.
class JobStatus final : public QWidget {
  Q_OBJECT

 public:
  explicit JobStatus(QWidget* parent = nullptr);

  void watch(jobs::JobRunner& jobs);
  QString text() const;

 Q_SIGNALS:
  void cancelRequested();

 private:
  struct Running {
    const jobs::JobRunner* runner = nullptr;
    jobs::JobRunner::Id id = 0;
    QString title;
    QString message;
    double fraction = 0;
    QElapsedTimer clock;
  };

  /// Null if no job is shown.
  Running* shown();
  Running* find(const jobs::JobRunner& runner, jobs::JobRunner::Id id);
  void end(const jobs::JobRunner& runner, jobs::JobRunner::Id id, jobs::JobOutcome outcome);
  void refresh();

  QLabel* text_;
  QProgressBar* bar_;
  QToolButton* cancel_;
  std::vector<const jobs::JobRunner*> runners_;  ///< in the order in which they were watched
  std::vector<Running> running_;
};

}  // namespace pliant::shell
