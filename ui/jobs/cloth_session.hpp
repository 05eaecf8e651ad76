#pragma once

#include <QObject>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ui/document/document.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/jobs/live_cloth.hpp"

namespace pliant::jobs {

/// A node that a hand holds.
struct HeldNode {
  int node = -1;
  Eigen::Vector3d hand;  ///< where it is to be [m]
};

/// What is to be seen of a live cloth.
struct LiveState {
  std::shared_ptr<const cloth::ClothProblem> problem;
  std::shared_ptr<const scene::ClothFrame> frame;
  std::vector<HeldNode> held;
  QString obstacle;            ///< why pulled nodes cannot go on; else empty
  QString trouble;             ///< why it stands still though it was to go on; else empty
  int standstills = 0;         ///< how often that has happened
  double violation = 0;        ///< of the last step: largest stretch over limit - 1
  double speed = 0;            ///< simulated over real time, of the last steps; 0: not known
  double recordedSeconds = 0;  ///< [s]; 0: does not record
};

/// A cloth of the document that goes on while it is watched, pulled and edited: steps of a study of the type
/// cloth_motion on a thread of its own, in real time where that is fast enough and never faster. Whatever is asked for
/// takes effect with the next step; nothing here waits
/// for one. A recording becomes the study's result. Edits of the
/// scene are taken over as they come; another scene closes it.
class ClothSession final : public QObject {
  Q_OBJECT

 public:
  explicit ClothSession(document::Document& document, QObject* parent = nullptr);
  ~ClothSession() override;

  bool isOpen() const { return cloth_ != nullptr; }
  /// Empty: none.
  const std::string& study() const { return study_; }
  bool isPlaying() const { return playing_; }
  bool isRecording() const { return recording_; }
  /// Its problem is null until there is something to show.
  const LiveState& state() const { return state_; }

  /// Begins at rest, standing still.
  void open(const std::string& study);
  /// A recording under way is kept.
  void close();
  void setPlaying(bool playing);
  /// One step; stands still after it.
  void step();
  /// At rest again, without hands. A recording under way is kept.
  void reset();
  void setRecording(bool recording);
  /// See cloth::Dragging.
  void pull(int node, const Eigen::Vector3d& hand);
  void letGo(int node, bool stay);

 Q_SIGNALS:
  void openChanged(bool open);
  void playingChanged(bool playing);
  void recordingChanged(bool recording);
  /// There is something new to show.
  void stateChanged();

 private:
  struct Shared;

  void forget();
  void order(std::function<void(LiveCloth&)> what);
  void wake();
  void show(const std::shared_ptr<Shared>& cloth, LiveState state);
  void keepRecordings(const std::shared_ptr<Shared>& cloth);

  document::Document& document_;
  std::shared_ptr<Shared> cloth_;  ///< null: closed
  std::string study_;
  int opened_ = 0;  ///< how often
  bool playing_ = false;
  bool recording_ = false;
  LiveState state_;
  JobRunner jobs_;  ///< last: its end waits for the step under way
};

}  // namespace pliant::jobs
