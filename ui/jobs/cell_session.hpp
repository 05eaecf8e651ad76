#pragma once

#include <QObject>
#include <memory>

#include "core/interlock/live_cell.hpp"
#include "ui/jobs/job_runner.hpp"

namespace pliant::jobs {

/// What is to be seen of a live cell.
struct LiveCellState {
  std::shared_ptr<const interlock::UnitCell> cell;  ///< null: none is open
  interlock::CellState state;
  interlock::LiveStep step;                                                        ///< the last
  bool pulled = false;                                                             ///< a hand holds it
  Eigen::Vector3d held = Eigen::Vector3d::Zero(), hand = Eigen::Vector3d::Zero();  ///< its place, and where it is to go
};

/// A cell that a hand pulls: steps of interlock::LiveCell on a thread of its own. Nothing here waits for one. Where the
/// hand goes meanwhile, the newest place counts; a step that takes longer than `patience` is broken off for it, within
/// one iteration, and what it has done stays.
class CellSession final : public QObject {
  Q_OBJECT

 public:
  static constexpr int patience = 50;  ///< milliseconds

  explicit CellSession(QObject* parent = nullptr);
  ~CellSession() override;

  /// Another cell, at rest; null: none. It must have passed checkCell.
  void open(std::shared_ptr<const interlock::UnitCell> cell);
  const LiveCellState& state() const { return state_; }
  /// See interlock::LiveCell.
  void pull(const interlock::CellGrip& grip, const Eigen::Vector3d& hand);
  void letGo();
  /// At rest again, without a hand.
  void reset();

 Q_SIGNALS:
  /// There is something new to show.
  void stateChanged();

 private:
  struct Shared;

  void order(bool reset, std::optional<std::pair<interlock::CellGrip, Eigen::Vector3d>> pull);
  void show(const std::shared_ptr<Shared>& shared, LiveCellState state);

  std::shared_ptr<Shared> shared_;
  LiveCellState state_;
  JobRunner jobs_;  ///< last: its end waits for the step under way
};

}  // namespace pliant::jobs
