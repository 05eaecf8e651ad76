#include "ui/shell/live_link.hpp"

#include "ui/plots/plot_style.hpp"
#include "ui/shell/cloth_link.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::shell {

using viewport::Viewport;

LiveLink::LiveLink(document::Document& document, jobs::ClothSession& session, Viewport& viewport, ClothLink& studies,
                   QObject* parent)
    : QObject(parent), document_(document), session_(session), viewport_(viewport), studies_(studies) {
  connect(&session_, &jobs::ClothSession::openChanged, this, &LiveLink::showOpen);
  connect(&session_, &jobs::ClothSession::stateChanged, this, &LiveLink::showState);
  connect(&viewport_, &Viewport::nodePulled, this, [this](int node, const Eigen::Vector3d& hand) {
    if (viewport_.pulledNode() != pulled_) {
      pulled_ = viewport_.pulledNode();
      pulledFrom_ = hand;
      toldOfObstacle_ = false;
    }
    session_.pull(node, hand);
  });
  connect(&viewport_, &Viewport::nodeLetGo, this, [this](int node, bool stay) {
    pulled_.reset();
    session_.letGo(node, stay);
  });
}

void LiveLink::showOpen(bool open) {
  pulled_.reset();
  if (open) {
    studies_.showStudy(session_.study());
    studies_.setLive(true);
  } else {
    viewport_.setLive(false);
    studies_.setLive(false);
  }
}

void LiveLink::showState() {
  const jobs::LiveState& state = session_.state();
  if (!state.problem) return;
  if (viewport_.clothProblem() != state.problem) {
    const std::optional<int> selected = viewport_.selectedNode();
    viewport_.setCloth(state.problem);
    viewport_.setStale(false);
    viewport_.setSelectedNode(selected);
  }
  viewport_.setLive(true);
  std::vector<render::Hand> hands;
  for (const jobs::HeldNode& held : state.held) hands.push_back({held.node, held.hand});
  viewport_.showLive(state.frame, std::move(hands));
  viewport_.setCaption(caption());
  if (!state.obstacle.isEmpty() && pulled_ && !toldOfObstacle_) {
    toldOfObstacle_ = true;
    document_.raise(base::Severity::information,
                    state.problem->sheet.limits.empty()
                        ? tr("Node %1 cannot follow the hand: %2").arg(*pulled_).arg(state.obstacle)
                        : tr("Node %1 cannot follow the hand: limits and pins hold it back.").arg(*pulled_));
  }
}

QString LiveLink::caption() const {
  const jobs::LiveState& state = session_.state();
  QString text = document_.title() + '\n' + tr("%1, live").arg(QString::fromStdString(session_.study()));
  if (!state.problem->sheet.limits.empty())
    text += tr(",  at most %1 % above the limit").arg(100 * state.violation, 0, 'g', 2);
  if (pulled_ && *pulled_ < state.frame->positions.cols())
    text += '\n' + tr("node %1 moved by %2")
                       .arg(*pulled_)
                       .arg(plots::formatLength((state.frame->positions.col(*pulled_) - pulledFrom_).norm()));
  return text;
}

}  // namespace pliant::shell
