#include "ui/jobs/cloth_session.hpp"

#include <chrono>
#include <cmath>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace pliant::jobs {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double speedMemory = 0.5;  ///< over which the speed is averaged [s]

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

}  // namespace

/// What the UI thread and the worker share.
struct ClothSession::Shared {
  std::string study;
  QString topic;

  std::mutex mutex;
  std::deque<std::function<void(LiveCloth&)>> orders;
  bool playing = false;
  int singleSteps = 0;
  bool active = false;                        ///< a job works or waits to
  base::ExecutionContext* running = nullptr;  ///< of the job that works
  std::vector<RecordedMotion> recorded;

  // The worker's.
  std::function<std::unique_ptr<LiveCloth>()> build;
  std::unique_ptr<LiveCloth> cloth;
  QString trouble;
  int standstills = 0;
  double violation = 0;
  double simulated = 0, real = 0;  ///< fading sums of steps [s]

  void stand(const QString& why) {
    trouble = why;
    ++standstills;
    const std::lock_guard lock(mutex);
    playing = false;
    singleSteps = 0;
  }

  /// No step any more, not even the rest of the one under way.
  void end() {
    const std::lock_guard lock(mutex);
    playing = false;
    singleSteps = 0;
    if (running) running->requestCancel();
  }

  void work(base::ExecutionContext& context, const std::function<void()>& tell) {
    {
      const std::lock_guard lock(mutex);
      running = &context;
    }
    while (goOn(context)) tell();
  }

  void keepRecording(LiveCloth& from) {
    if (auto made = from.stopRecording()) {
      const std::lock_guard lock(mutex);
      recorded.push_back(std::move(*made));
    }
  }

  /// Does what was ordered and a step, if it is to go on. False: nothing is to be done any more.
  bool goOn(base::ExecutionContext& context) {
    std::deque<std::function<void(LiveCloth&)>> now;
    bool steps = false;
    {
      const std::lock_guard lock(mutex);
      std::swap(now, orders);
      steps = (playing || singleSteps > 0) && !context.cancelRequested();
      if (steps && !playing) --singleSteps;
      active = steps || !now.empty() || (!cloth && trouble.isEmpty());
      if (!active) {
        running = nullptr;
        return false;
      }
    }
    if (!cloth) attempt([this] { cloth = build(); });
    if (!cloth) return true;
    for (const auto& each : now) attempt([&] { each(*cloth); });
    if (steps) attempt([&] { stepOnce(context); });
    return true;
  }

  void attempt(const std::function<void()>& what) {
    try {
      what();
    } catch (const std::exception& error) {
      stand(QString::fromUtf8(error.what()));
    }
  }

  void stepOnce(base::ExecutionContext& context) {
    const Clock::time_point begin = Clock::now();
    const double before = cloth->simulation().state().time, timeStep = cloth->simulation().options().timeStep;
    const cloth::StepRecord record = cloth->step(context);
    if (record.termination == base::TerminationType::cancelled) return;
    if (!record.done()) {
      stand(QStringLiteral("The cloth stands still: no step is possible from here. %1")
                .arg(QString::fromStdString(record.message)));
      return;
    }
    trouble.clear();
    violation = record.violation;
    std::this_thread::sleep_for(std::chrono::duration<double>(timeStep - secondsSince(begin)));
    const double took = secondsSince(begin), fade = std::exp(-took / speedMemory);
    simulated = fade * simulated + (cloth->simulation().state().time - before);
    real = fade * real + took;
  }

  LiveState state() const {
    LiveState state;
    state.trouble = trouble;
    state.standstills = standstills;
    if (!cloth) return state;
    state.problem = cloth->simulation().sharedProblem();
    state.frame = cloth->frame();
    for (const auto& [node, hand] : cloth->dragging().hands()) state.held.push_back({node, hand});
    state.obstacle = QString::fromStdString(cloth->dragging().obstacle());
    state.violation = violation;
    state.speed = real > 0 ? simulated / real : 0;
    state.recordedSeconds = cloth->recordedSeconds();
    return state;
  }
};

ClothSession::ClothSession(document::Document& document, QObject* parent) : QObject(parent), document_(document) {
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    jobs_.abandonAll();
    forget();
  });
  connect(&document_, &document::Document::sceneEdited, this, [this](const std::string& pointer) {
    if (!isOpen()) return;
    if (!document_.study(study_)) {
      close();
      return;
    }
    // Frames of another model are not of one recording.
    if (document::mattersToModel(pointer)) setRecording(false);
    order([scene = document_.scene(), model = document_.model()](LiveCloth& cloth) { cloth.setScene(scene, model); });
  });
}

ClothSession::~ClothSession() { jobs_.abandonAll(); }

void ClothSession::open(const std::string& study) {
  close();
  cloth_ = std::make_shared<Shared>();
  cloth_->study = study_ = study;
  cloth_->topic = QStringLiteral("live cloth %1").arg(++opened_);
  cloth_->build = [scene = document_.scene(), model = document_.model(), study] {
    return std::make_unique<LiveCloth>(scene, model, study);
  };
  state_ = {};
  Q_EMIT openChanged(true);
  wake();
}

void ClothSession::close() {
  if (!isOpen()) return;
  setRecording(false);
  cloth_->end();  // what was recorded is still handed over
  forget();
}

void ClothSession::forget() {
  if (!isOpen()) return;
  const bool played = std::exchange(playing_, false), recorded = std::exchange(recording_, false);
  cloth_.reset();
  study_.clear();
  state_ = {};
  if (played) Q_EMIT playingChanged(false);
  if (recorded) Q_EMIT recordingChanged(false);
  Q_EMIT openChanged(false);
}

void ClothSession::setPlaying(bool playing) {
  if (!isOpen() || playing == playing_) return;
  playing_ = playing;
  {
    const std::lock_guard lock(cloth_->mutex);
    cloth_->playing = playing;
  }
  wake();
  Q_EMIT playingChanged(playing);
}

void ClothSession::step() {
  if (!isOpen()) return;
  setPlaying(false);
  {
    const std::lock_guard lock(cloth_->mutex);
    ++cloth_->singleSteps;
  }
  wake();
}

void ClothSession::reset() {
  if (!isOpen()) return;
  setRecording(false);
  order([](LiveCloth& cloth) { cloth.reset(); });
}

void ClothSession::setRecording(bool recording) {
  if (!isOpen() || recording == recording_) return;
  recording_ = recording;
  if (recording)
    order([](LiveCloth& cloth) { cloth.startRecording(); });
  else
    order([shared = cloth_.get()](LiveCloth& cloth) { shared->keepRecording(cloth); });
  Q_EMIT recordingChanged(recording);
}

void ClothSession::pull(int node, const Eigen::Vector3d& hand) {
  order([node, hand](LiveCloth& cloth) { cloth.dragging().pull(node, hand); });
}

void ClothSession::letGo(int node, bool stay) {
  order([node, stay](LiveCloth& cloth) { cloth.dragging().letGo(node, stay); });
}

void ClothSession::order(std::function<void(LiveCloth&)> what) {
  if (!isOpen()) return;
  {
    const std::lock_guard lock(cloth_->mutex);
    cloth_->orders.push_back(std::move(what));
  }
  wake();
}

void ClothSession::wake() {
  {
    const std::lock_guard lock(cloth_->mutex);
    if (cloth_->active) return;
    cloth_->active = true;
  }
  Job job;
  job.topic = cloth_->topic;
  job.work = [this, cloth = cloth_](base::ExecutionContext& context, const Publish& publish) -> Delivery {
    cloth->work(context, [&] { publish([this, cloth, state = cloth->state()] { show(cloth, state); }); });
    return [this, cloth, state = cloth->state()] { show(cloth, state); };
  };
  jobs_.submit(std::move(job));
}

void ClothSession::show(const std::shared_ptr<Shared>& cloth, LiveState state) {
  keepRecordings(cloth);
  if (cloth != cloth_) return;
  const bool stoodStill = state.standstills != state_.standstills;
  state_ = std::move(state);
  if (stoodStill) {
    document_.raise(base::Severity::warning, state_.trouble);
    if (playing_) {
      playing_ = false;
      Q_EMIT playingChanged(false);
    }
  }
  Q_EMIT stateChanged();
}

void ClothSession::keepRecordings(const std::shared_ptr<Shared>& cloth) {
  std::vector<RecordedMotion> recorded;
  {
    const std::lock_guard lock(cloth->mutex);
    std::swap(recorded, cloth->recorded);
  }
  for (const RecordedMotion& each : recorded) document_.setResult(cloth->study, each.result, each.scene);
}

}  // namespace pliant::jobs
