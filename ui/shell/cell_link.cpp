#include "ui/shell/cell_link.hpp"

#include "ui/panels/cell_panel.hpp"
#include "ui/shell/cell_bar.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

using viewport::Viewport;

bool showsCells(const document::Document& document) {
  if (document.isEmpty()) return false;
  const scene::Json cells = document.valueAt("/interlocking_cells"), geometry = document.valueAt("/geometry");
  return cells.is_array() && !cells.empty() && (!geometry.is_array() || geometry.empty());
}

CellLink::CellLink(document::Document& document, jobs::CellSession& session, Viewport& viewport,
                   panels::CellPanel& panel, CellBar& bar, QObject* parent)
    : QObject(parent), document_(document), session_(session), viewport_(viewport), panel_(panel), bar_(bar) {
  connect(&panel_, &panels::CellPanel::cellInspected, this, &CellLink::showInspected);
  connect(&panel_, &panels::CellPanel::cellLost, this, &CellLink::lose);
  connect(&session_, &jobs::CellSession::stateChanged, this, &CellLink::showLive);
  connect(&viewport_, &Viewport::gripPulled, this, [this](const render::CellPick& grip, const Eigen::Vector3d& hand) {
    if (!drafting_) session_.pull(grip.grip, hand);
  });
  connect(&viewport_, &Viewport::gripLetGo, &session_, &jobs::CellSession::letGo);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    if (!showsCells(document_)) lose();
  });
  bar_.hide();
}

void CellLink::lose() {
  sound_.reset();
  soundEntry_ = scene::Json();
  drafting_ = false;
  session_.open(nullptr);
  viewport_.setCell(nullptr);
  bar_.hide();
}

void CellLink::showInspected(const jobs::InspectedCell& cell, bool draft) {
  if (!showsCells(document_)) return;
  bar_.setVisible(true);
  const bool sound = cell.fault.isEmpty();
  if (sound && !draft) {
    if (drafting_ || cell.entry != soundEntry_ || session_.state().cell != sound_) {
      sound_ = cell.cell;
      soundEntry_ = cell.entry;
      drafting_ = false;
      viewport_.setCell(sound_);
      viewport_.cellView().setHandlesVisible(true);
      viewport_.setStale(false);
      session_.open(sound_);
    }
    return;
  }
  if (panel_.isRefused() && sound_) {
    drafting_ = false;
    viewport_.setCell(sound_);
    viewport_.cellView().setHandlesVisible(true);
    showLive();
    return;
  }
  if (cell.cell) {
    drafting_ = true;
    viewport_.setCell(cell.cell);
    viewport_.cellView().setHandlesVisible(false);
    viewport_.cellView().setOverlap(cell.inspection.overlaps() ? cell.inspection.nearest : std::nullopt);
    viewport_.setCaption(sound ? document_.title() : document_.title() + '\n' + cell.fault);
  }
  bar_.showSentence(sound ? tr("As it would be with these numbers.") : cell.fault, !sound);
}

void CellLink::showLive() {
  const jobs::LiveCellState& live = session_.state();
  if (drafting_ || !live.cell || live.cell != viewport_.cellView().cell()) return;
  viewport_.cellView().setHand(live.pulled ? std::optional(std::pair(live.held, live.hand)) : std::nullopt);
  viewport_.showCellState(live.state, live.step.contacts);
  QString caption = document_.title();
  if (live.pulled) {
    caption += '\n' + strainText(live);
    if (const QString contacts = contactText(live); !contacts.isEmpty()) caption += '\n' + contacts;
  }
  viewport_.setCaption(caption);
  bar_.showState(live);
}

}  // namespace pliant::shell
