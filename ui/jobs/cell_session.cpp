#include "ui/jobs/cell_session.hpp"

#include <QTimer>
#include <mutex>
#include <optional>
#include <utility>

namespace pliant::jobs {

using interlock::CellGrip;
using interlock::LiveCell;

/// What the UI thread and the worker share.
struct CellSession::Shared {
  explicit Shared(std::shared_ptr<const interlock::UnitCell> of) : cell(std::move(of)) {}

  const std::shared_ptr<const interlock::UnitCell> cell;

  std::mutex mutex;
  bool ended = false;
  bool reset = false;                                        ///< is wanted
  bool ordered = false;                                      ///< something is wanted
  std::optional<std::pair<CellGrip, Eigen::Vector3d>> pull;  ///< where the hand is; none: it is open
  bool active = false;                                       ///< a job works or waits to
  base::ExecutionContext* running = nullptr;                 ///< of the step under way
  int steps = 0;                                             ///< begun

  // The worker's.
  std::unique_ptr<LiveCell> live;
  bool settled = true;

  void breakOff(int step) {
    const std::lock_guard lock(mutex);
    if (running && step == steps) running->requestCancel();
  }

  /// No step any more, not even the rest of the one under way.
  void end() {
    const std::lock_guard lock(mutex);
    ended = true;
    if (running) running->requestCancel();
  }

  /// Does what was ordered and a step. Nothing: there is nothing to be done.
  std::optional<LiveCellState> goOn(base::ExecutionContext& job) {
    base::ExecutionContext context;
    bool wantsReset = false;
    std::optional<std::pair<CellGrip, Eigen::Vector3d>> hand;
    {
      const std::lock_guard lock(mutex);
      if (ended || job.cancelRequested() || (!ordered && settled)) {
        active = false;
        return std::nullopt;
      }
      wantsReset = std::exchange(reset, false);
      ordered = false;
      hand = pull;
      running = &context;
      ++steps;
    }
    if (!live) live = std::make_unique<LiveCell>(*cell);
    if (wantsReset) live->reset();
    if (hand)
      live->pull(hand->first, hand->second);
    else
      live->letGo();
    LiveCellState now;
    now.step = live->advance(&context);
    {
      const std::lock_guard lock(mutex);
      running = nullptr;
    }
    settled = now.step.settled || now.step.failed();
    now.cell = cell;
    now.state = live->state();
    now.pulled = hand.has_value();
    if (hand) {
      now.held = live->placeOf(hand->first);
      now.hand = hand->second;
    }
    return now;
  }
};

CellSession::CellSession(QObject* parent) : QObject(parent) {}

CellSession::~CellSession() {
  if (shared_) shared_->end();
}

void CellSession::open(std::shared_ptr<const interlock::UnitCell> cell) {
  if (shared_) shared_->end();
  jobs_.abandonAll();
  shared_ = cell ? std::make_shared<Shared>(cell) : nullptr;
  state_ = LiveCellState();
  state_.cell = cell;
  if (cell) state_.state = interlock::restState(*cell);
  Q_EMIT stateChanged();
  if (cell) order(true, std::nullopt);  // measures its smallest gap
}

void CellSession::pull(const CellGrip& grip, const Eigen::Vector3d& hand) { order(false, std::pair{grip, hand}); }

void CellSession::letGo() { order(false, std::nullopt); }

void CellSession::reset() { order(true, std::nullopt); }

void CellSession::order(bool reset, std::optional<std::pair<CellGrip, Eigen::Vector3d>> pull) {
  if (!shared_) return;
  bool begins = false;
  std::optional<int> step;
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->reset = shared_->reset || reset;
    shared_->pull = std::move(pull);
    shared_->ordered = true;
    begins = !std::exchange(shared_->active, true);
    if (shared_->running) step = shared_->steps;
  }
  if (step)
    QTimer::singleShot(reset ? 0 : patience, this, [shared = shared_, step = *step] { shared->breakOff(step); });
  if (!begins) return;
  Job job;
  job.topic = QStringLiteral("live cell");
  job.work = [this, shared = shared_](base::ExecutionContext& context, const Publish& publish) -> Delivery {
    while (auto now = shared->goOn(context)) publish([this, shared, state = std::move(*now)] { show(shared, state); });
    return {};
  };
  jobs_.submit(std::move(job));
}

void CellSession::show(const std::shared_ptr<Shared>& shared, LiveCellState state) {
  if (shared != shared_) return;
  state_ = std::move(state);
  Q_EMIT stateChanged();
}

}  // namespace pliant::jobs
