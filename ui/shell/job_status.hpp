#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include "ui/jobs/job_runner.hpp"

class QLabel;
class QProgressBar;
class QToolButton;

namespace pliant::shell {

/// What runs, how far it is, how long it will take, and the button that ends it.
class JobStatus final : public QWidget {
  Q_OBJECT

 public:
  explicit JobStatus(QWidget* parent = nullptr);

  void watch(jobs::JobRunner& jobs);
  QString text() const;

 Q_SIGNALS:
  void cancelRequested();

 private:
  void begin(jobs::JobRunner& jobs, jobs::JobRunner::Id id, const QString& title);
  void progress(double fraction, const QString& message);
  void end(jobs::JobOutcome outcome);

  QLabel* text_;
  QProgressBar* bar_;
  QToolButton* cancel_;
  QElapsedTimer clock_;
  const jobs::JobRunner* runner_ = nullptr;  ///< of the job on show
  jobs::JobRunner::Id job_ = 0;
  QString title_;
};

}  // namespace pliant::shell
