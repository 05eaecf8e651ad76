#pragma once

#include <QObject>
#include <QString>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/execution_context.hpp"

namespace pliant::jobs {

/// Something that a job hands to the UI thread, where it is called.
using Delivery = std::function<void()>;

/// Hands over what a running job has so far. Only the newest that the UI thread has not taken yet is kept.
using Publish = std::function<void(Delivery)>;

/// One computation on its own copies of what it reads.
struct Job {
  QString topic;  ///< a newer job of the same topic supersedes this one
  QString title;  ///< what the status bar says while it runs; empty: nothing, since nobody asked for it
  /// Runs on the worker thread; its answer is called on the UI thread (may be empty).
  std::function<Delivery(base::ExecutionContext&, const Publish&)> work;
};

enum class JobOutcome { done, cancelled, failed };

/// Runs jobs one after another on one worker thread and brings what they deliver back to the thread that owns the
/// runner.
///
/// Newest wins: submitting a job cancels every earlier job of the same topic, and nothing that those deliver is called
/// any more. A job cancelled by `cancel` still delivers what it returns, so that a half-traced curve can stay on
/// screen. Nothing is called or signalled after the runner is destroyed; its destructor cancels and waits for the
/// worker.
class JobRunner final : public QObject {
  Q_OBJECT

 public:
  using Id = std::uint64_t;

  explicit JobRunner(QObject* parent = nullptr);
  ~JobRunner() override;

  Id submit(Job job);
  /// Requests cancellation; a job that has not begun is dropped and finishes as cancelled.
  void cancel(Id id);
  void cancelTopic(const QString& topic);
  void cancelAll();
  /// Cancels, and nothing of it delivers any more: for when the data it was about is gone.
  void abandonTopic(const QString& topic);
  void abandonAll();

  /// Whether a job of this topic waits or runs.
  bool isActive(const QString& topic) const;
  bool isIdle() const { return entries_.empty(); }

 Q_SIGNALS:
  void started(pliant::jobs::JobRunner::Id id, const QString& topic, const QString& title);
  /// The fraction lies in [0, 1] and never falls within one job.
  void progressed(pliant::jobs::JobRunner::Id id, double fraction, const QString& message);
  void logged(pliant::base::Severity severity, const QString& message);
  /// `sentence` says what went wrong if the job failed. Comes after the job's last delivery.
  void finished(pliant::jobs::JobRunner::Id id, const QString& topic, pliant::jobs::JobOutcome outcome,
                const QString& sentence);

 private:
  struct Entry;

  void work();
  void post(const std::shared_ptr<Entry>& entry);
  void drain(const std::shared_ptr<Entry>& entry);
  void drop(const std::shared_ptr<Entry>& entry);

  std::vector<std::shared_ptr<Entry>> entries_;  ///< waiting and running jobs; UI thread only
  Id lastId_ = 0;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::shared_ptr<Entry>> queue_;
  bool quit_ = false;
  std::thread thread_;
};

}  // namespace pliant::jobs
