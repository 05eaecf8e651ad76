#include "ui/jobs/job_runner.hpp"

#include <QMetaObject>
#include <algorithm>
#include <optional>

#include "core/base/error.hpp"

namespace pliant::jobs {

namespace {

struct Message {
  base::Severity severity;
  std::string text;
};

struct Progress {
  double fraction = 0;
  std::string message;
};

}  // namespace

/// A job with its mailbox. The mailbox keeps only the newest of everything but messages, and at most one event is under
/// way to the UI thread, so that a fast solver cannot flood the event loop.
struct JobRunner::Entry {
  Id id = 0;
  Job job;
  std::unique_ptr<base::ExecutionContext> context;
  bool begun = false;       // UI thread: `started` was signalled
  bool superseded = false;  // UI thread

  std::mutex mutex;
  bool posted = false;
  bool ended = false;
  std::optional<Progress> progress;
  std::vector<Message> messages;
  Delivery snapshot;
  Delivery answer;
  JobOutcome outcome = JobOutcome::done;
  std::string sentence;
};

JobRunner::JobRunner(QObject* parent) : QObject(parent) {
  thread_ = std::thread([this] { work(); });
}

JobRunner::~JobRunner() {
  for (const auto& entry : entries_) entry->context->requestCancel();
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    queue_.clear();
  }
  wake_.notify_one();
  thread_.join();
}

JobRunner::Id JobRunner::submit(Job job) {
  for (const auto& earlier : std::vector(entries_)) {
    if (earlier->job.topic != job.topic) continue;
    earlier->superseded = true;
    cancel(earlier->id);
  }
  auto entry = std::make_shared<Entry>();
  entry->id = ++lastId_;
  entry->job = std::move(job);
  const std::weak_ptr<Entry> weak = entry;
  entry->context = std::make_unique<base::ExecutionContext>(
      [this, weak](double fraction, const std::string& message) {
        const auto self = weak.lock();
        if (!self) return;
        {
          const std::lock_guard lock(self->mutex);
          self->progress = Progress{fraction, message};
        }
        post(self);
      },
      [this, weak](base::Severity severity, const std::string& message) {
        const auto self = weak.lock();
        if (!self) return;
        {
          const std::lock_guard lock(self->mutex);
          self->messages.push_back({severity, message});
        }
        post(self);
      });
  entries_.push_back(entry);
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(entry);
  }
  wake_.notify_one();
  return entry->id;
}

void JobRunner::cancel(Id id) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [id](const auto& entry) { return entry->id == id; });
  if (found == entries_.end()) return;
  const auto entry = *found;
  entry->context->requestCancel();
  bool waiting = false;
  {
    const std::lock_guard lock(mutex_);
    waiting = std::erase(queue_, entry) > 0;
  }
  if (waiting) drop(entry);
}

void JobRunner::cancelTopic(const QString& topic) {
  for (const auto& entry : std::vector(entries_))
    if (entry->job.topic == topic) cancel(entry->id);
}

void JobRunner::cancelAll() {
  for (const auto& entry : std::vector(entries_)) cancel(entry->id);
}

void JobRunner::abandonTopic(const QString& topic) {
  for (const auto& entry : entries_)
    if (entry->job.topic == topic) entry->superseded = true;
  cancelTopic(topic);
}

void JobRunner::abandonAll() {
  for (const auto& entry : entries_) entry->superseded = true;
  cancelAll();
}

bool JobRunner::isActive(const QString& topic) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const auto& entry) { return entry->job.topic == topic && !entry->superseded; });
}

void JobRunner::work() {
  while (true) {
    std::shared_ptr<Entry> entry;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return quit_ || !queue_.empty(); });
      if (quit_) return;
      entry = queue_.front();
      queue_.pop_front();
    }
    post(entry);
    Delivery answer;
    JobOutcome outcome = JobOutcome::done;
    std::string sentence;
    try {
      answer = entry->job.work(*entry->context, [&](Delivery snapshot) {
        {
          const std::lock_guard lock(entry->mutex);
          entry->snapshot = std::move(snapshot);
        }
        post(entry);
      });
      if (entry->context->cancelRequested()) outcome = JobOutcome::cancelled;
    } catch (const std::exception& error) {
      outcome = JobOutcome::failed;
      sentence = error.what();
    }
    {
      const std::lock_guard lock(entry->mutex);
      entry->ended = true;
      entry->answer = std::move(answer);
      entry->outcome = outcome;
      entry->sentence = sentence;
    }
    post(entry);
  }
}

void JobRunner::post(const std::shared_ptr<Entry>& entry) {
  {
    const std::lock_guard lock(entry->mutex);
    if (entry->posted) return;
    entry->posted = true;
  }
  QMetaObject::invokeMethod(
      this, [this, entry] { drain(entry); }, Qt::QueuedConnection);
}

void JobRunner::drain(const std::shared_ptr<Entry>& entry) {
  std::optional<Progress> progress;
  std::vector<Message> messages;
  Delivery snapshot, answer;
  bool ended = false;
  {
    const std::lock_guard lock(entry->mutex);
    entry->posted = false;
    std::swap(progress, entry->progress);
    std::swap(messages, entry->messages);
    std::swap(snapshot, entry->snapshot);
    std::swap(answer, entry->answer);
    ended = entry->ended;
  }
  const auto current = [&] { return !entry->superseded; };
  if (current() && !entry->begun) {
    entry->begun = true;
    Q_EMIT started(entry->id, entry->job.topic, entry->job.title);
  }
  if (current())
    for (const Message& message : messages) Q_EMIT logged(message.severity, QString::fromStdString(message.text));
  if (current() && progress)
    Q_EMIT progressed(entry->id, progress->fraction, QString::fromStdString(progress->message));
  // A snapshot is older than the answer: with both at hand only the answer is worth showing.
  if (current() && snapshot && !answer) snapshot();
  if (!ended) return;
  std::erase(entries_, entry);
  if (current() && answer) answer();
  Q_EMIT finished(entry->id, entry->job.topic, current() ? entry->outcome : JobOutcome::cancelled,
                  QString::fromStdString(entry->sentence));
}

void JobRunner::drop(const std::shared_ptr<Entry>& entry) {
  std::erase(entries_, entry);
  Q_EMIT finished(entry->id, entry->job.topic, JobOutcome::cancelled, {});
}

}  // namespace pliant::jobs
