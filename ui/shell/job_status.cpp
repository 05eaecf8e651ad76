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
  bar_->hide();
  cancel_->hide();
  connect(cancel_, &QToolButton::clicked, this, &JobStatus::cancelRequested);
}

QString JobStatus::text() const { return text_->text(); }

void JobStatus::watch(JobRunner& jobs) {
  const JobRunner* watched = &jobs;
  connect(&jobs, &JobRunner::started, this,
          [this, &jobs](JobRunner::Id id, const QString&, const QString& title) { begin(jobs, id, title); });
  connect(
      &jobs, &JobRunner::progressed, this, [this, watched](JobRunner::Id id, double fraction, const QString& message) {
        if (runner_ == watched && job_ == id) progress(fraction, message);
      });
  connect(&jobs, &JobRunner::finished, this, [this, watched](JobRunner::Id id, const QString&, JobOutcome outcome) {
    if (runner_ == watched && job_ == id) end(outcome);
  });
}

void JobStatus::begin(JobRunner& jobs, JobRunner::Id id, const QString& title) {
  runner_ = &jobs;
  job_ = id;
  title_ = title;
  clock_.start();
  bar_->setValue(0);
  text_->setText(title);
  bar_->show();
  cancel_->show();
}

void JobStatus::progress(double fraction, const QString& message) {
  bar_->setValue(static_cast<int>(std::lround(1000 * fraction)));
  const double elapsed = static_cast<double>(clock_.elapsed()) / 1000;
  QString text = message.isEmpty() ? title_ : QStringLiteral("%1: %2").arg(title_, message);
  if (fraction > 0.05 && elapsed > 2)
    text += tr(", about %1 s left").arg(std::max(1.0, std::round(elapsed * (1 - fraction) / fraction)), 0, 'f', 0);
  text_->setText(text);
}

void JobStatus::end(JobOutcome outcome) {
  runner_ = nullptr;
  bar_->hide();
  cancel_->hide();
  const QString seconds = tr("%1 s").arg(static_cast<double>(clock_.elapsed()) / 1000, 0, 'f', 1);
  switch (outcome) {
    case JobOutcome::done: text_->setText(tr("%1: done in %2").arg(title_, seconds)); break;
    case JobOutcome::cancelled: text_->setText(tr("%1: cancelled after %2").arg(title_, seconds)); break;
    case JobOutcome::failed: text_->setText(tr("%1: failed").arg(title_)); break;
  }
}

}  // namespace pliant::shell
