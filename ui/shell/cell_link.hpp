#pragma once

#include <QObject>
#include <memory>

#include "ui/document/document.hpp"
#include "ui/jobs/cell_inspector.hpp"
#include "ui/jobs/cell_session.hpp"

namespace pliant::panels {
class CellPanel;
}
namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

class CellBar;

/// Shows the scene's interlocking material in the viewport: what the panel edits as it is edited, and the live cell
/// that the mouse pulls. A draft that cannot be computed with is seen while it is dragged, its overlap marked; then the
/// last one that can comes back.
class CellLink final : public QObject {
  Q_OBJECT

 public:
  CellLink(document::Document& document, jobs::CellSession& session, viewport::Viewport& viewport,
           panels::CellPanel& panel, CellBar& bar, QObject* parent = nullptr);

 private:
  void showInspected(const jobs::InspectedCell& cell, bool draft);
  void showLive();
  void lose();

  document::Document& document_;
  jobs::CellSession& session_;
  viewport::Viewport& viewport_;
  panels::CellPanel& panel_;
  CellBar& bar_;
  std::shared_ptr<const interlock::UnitCell> sound_;  ///< the scene's
  scene::Json soundEntry_;
  bool drafting_ = false;  ///< the viewport shows a draft, which nobody can pull
};

/// Whether the scene has an interlocking material, and nothing that moves.
bool showsCells(const document::Document& document);

}  // namespace pliant::shell
