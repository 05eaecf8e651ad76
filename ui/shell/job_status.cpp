#include "ui/shell/job_status.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "ui/panels/icon.hpp"

namespace pliant::shell {

using jobs::JobOutcome;
using jobs::JobRunner;

JobStatus::JobStatus(QWidget* parent) : QWidget(parent) {
  text_ = new QLabel(tr("Ready"));
  bar_ = new QProgressBar;
  bar_->setFixedSize(160, 8);
  bar_->setTextVisible(false);
  bar_->setRange(0, 1000);
  cancel_ = new QToolButton;
  cancel_->setIcon(panels::icon(QStringLiteral("cancel")));
  cancel_->setText(tr("Cancel"));
  cancel_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  cancel_->setAutoRaise(true);
  cancel_->setFocusPolicy(Qt::NoFocus);
  cancel_->setToolTip(tr("End it; what has been found stays (Ctrl+.)"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 0, 0, 0);
  row->setSpacing(8);
  row->addWidget(text_);
  row->addWidget(bar_);
  row->addWidget(cancel_);
  // As high with a job as without, or the whole window would be laid out anew when the first one begins.
  setMinimumHeight(std::max(bar_->sizeHint().height(), cancel_->sizeHint().height()));
  bar_->hide();
  cancel_->hide();
  connect(cancel_, &QToolButton::clicked, this, &JobStatus::cancelRequested);
}

QString JobStatus::text() const { return text_->text(); }

void JobStatus::watch(JobRunner& jobs) {
  const JobRunner* runner = &jobs;
  runners_.push_back(runner);
  connect(&jobs, &JobRunner::started, this, [this, runner](JobRunner::Id id, const QString&, const QString& title) {
    if (title.isEmpty()) return;
    running_.push_back({runner, id, title, {}, 0, {}});
    running_.back().clock.start();
    refresh();
  });
  connect(
      &jobs, &JobRunner::progressed, this, [this, runner](JobRunner::Id id, double fraction, const QString& message) {
        Running* job = find(*runner, id);
        if (!job) return;
        job->fraction = fraction;
        job->message = message;
        refresh();
      });
  connect(&jobs, &JobRunner::finished, this,
          [this, runner](JobRunner::Id id, const QString&, JobOutcome outcome) { end(*runner, id, outcome); });
}

JobStatus::Running* JobStatus::shown() {
  for (const JobRunner* runner : runners_)
    for (Running& job : running_)
      if (job.runner == runner) return &job;
  return nullptr;
}

JobStatus::Running* JobStatus::find(const JobRunner& runner, JobRunner::Id id) {
  for (Running& job : running_)
    if (job.runner == &runner && job.id == id) return &job;
  return nullptr;
}

void JobStatus::refresh() {
  const Running* job = shown();
  bar_->setVisible(job);
  cancel_->setVisible(job);
  if (!job) return;
  bar_->setValue(static_cast<int>(std::lround(1000 * job->fraction)));
  const double elapsed = static_cast<double>(job->clock.elapsed()) / 1000;
  QString text = job->message.isEmpty() ? job->title : QStringLiteral("%1: %2").arg(job->title, job->message);
  if (job->fraction > 0.05 && elapsed > 2) {
    const double left = elapsed * (1 - job->fraction) / job->fraction;
    text += tr(", about %1 s left").arg(std::max(1.0, std::round(left)), 0, 'f', 0);
  }
  text_->setText(text);
}

void JobStatus::end(const JobRunner& runner, JobRunner::Id id, JobOutcome outcome) {
  Running* job = find(runner, id);
  if (!job) return;
  const bool wasShown = job == shown();
  const QString title = job->title;
  const QString seconds = tr("%1 s").arg(static_cast<double>(job->clock.elapsed()) / 1000, 0, 'f', 1);
  running_.erase(running_.begin() + (job - running_.data()));
  if (wasShown) {
    switch (outcome) {
      case JobOutcome::done: text_->setText(tr("%1: done in %2").arg(title, seconds)); break;
      case JobOutcome::cancelled: text_->setText(tr("%1: cancelled after %2").arg(title, seconds)); break;
      case JobOutcome::failed: text_->setText(tr("%1: failed").arg(title)); break;
    }
  }
  refresh();
}

}  // namespace pliant::shell
