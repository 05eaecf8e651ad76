#include "ui/jobs/cell_inspector.hpp"

#include "core/base/error.hpp"
#include "core/scene/interlock_builder.hpp"

namespace pliant::jobs {

namespace {
const QString topic = QStringLiteral("inspect cell");
}

InspectedCell inspectEntry(const scene::Scene& scene, int index, const scene::Json& entry) {
  InspectedCell result;
  result.entry = entry;
  try {
    const scene::Scene changed = scene.withValue("/interlocking_cells/" + std::to_string(index), entry);
    result.normalized = changed.normalized().at("interlocking_cells").at(static_cast<std::size_t>(index));
    const scene::DraftCell draft = scene::draftCell(changed, static_cast<std::size_t>(index));
    result.inspection = interlock::inspectCell(draft.cell);
    result.fault = QString::fromStdString(result.inspection.fault);
    // Of a shape or a lattice that is none there is nothing to draw.
    if (result.inspection.radius > 0) result.cell = std::make_shared<interlock::UnitCell>(draft.supercell);
  } catch (const base::InputError& error) {
    result.fault = QString::fromStdString(error.problem());
  }
  return result;
}

CellInspector::CellInspector(QObject* parent) : QObject(parent) {}

void CellInspector::inspect(const scene::Scene& scene, int index, const scene::Json& entry) {
  Request request{scene, index, entry};
  if (busy_)
    next_ = std::move(request);
  else
    begin(std::move(request));
}

void CellInspector::forget() {
  jobs_.abandonTopic(topic);
  next_.reset();
  busy_ = false;
}

void CellInspector::begin(Request request) {
  busy_ = true;
  Job job;
  job.topic = topic;
  job.work = [this, request = std::move(request)](base::ExecutionContext&, const Publish&) -> Delivery {
    return [this, result = inspectEntry(request.scene, request.index, request.entry)] {
      busy_ = false;
      if (next_) {
        Request next = std::move(*next_);
        next_.reset();
        begin(std::move(next));
      }
      Q_EMIT inspected(result);
    };
  };
  jobs_.submit(std::move(job));
}

}  // namespace pliant::jobs
