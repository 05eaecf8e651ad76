#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "core/interlock/cell_inspection.hpp"
#include "core/scene/scene.hpp"
#include "ui/jobs/job_runner.hpp"

namespace pliant::jobs {

/// What came of one inspection of a material.
struct InspectedCell {
  scene::Json entry;                                ///< of "interlocking_cells", as it was asked for
  scene::Json normalized;                           ///< the same in SI; null if the scene's format refuses it
  std::shared_ptr<const interlock::UnitCell> cell;  ///< to be drawn; null if there is nothing to draw
  interlock::CellInspection inspection;             ///< of a single cell
  QString fault;                                    ///< one sentence; empty: it can be computed with
};

/// Tells on another thread what is right and wrong with a material while it is edited. Where requests come faster than
/// answers, the newest is answered next and those between are left out.
class CellInspector final : public QObject {
  Q_OBJECT

 public:
  explicit CellInspector(QObject* parent = nullptr);

  /// What the scene would have with this entry at `index` of "interlocking_cells".
  void inspect(const scene::Scene& scene, int index, const scene::Json& entry);
  /// Nothing that was asked for is answered any more.
  void forget();
  bool isBusy() const { return busy_; }

 Q_SIGNALS:
  void inspected(const pliant::jobs::InspectedCell& cell);

 private:
  struct Request {
    scene::Scene scene;
    int index;
    scene::Json entry;
  };
  void begin(Request request);

  std::optional<Request> next_;
  bool busy_ = false;
  JobRunner jobs_;
};

/// The same at once, on any thread.
InspectedCell inspectEntry(const scene::Scene& scene, int index, const scene::Json& entry);

}  // namespace pliant::jobs
