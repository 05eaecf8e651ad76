#pragma once

#include <QObject>

#include "ui/jobs/cloth_session.hpp"

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

class ClothLink;

/// Shows the live cloth in the viewport, in the place of what studies found, and brings the mouse's hand to it.
class LiveLink final : public QObject {
  Q_OBJECT

 public:
  LiveLink(document::Document& document, jobs::ClothSession& session, viewport::Viewport& viewport, ClothLink& studies,
           QObject* parent = nullptr);

 private:
  void showOpen(bool open);
  void showState();
  QString caption() const;

  document::Document& document_;
  jobs::ClothSession& session_;
  viewport::Viewport& viewport_;
  ClothLink& studies_;
  std::optional<int> pulled_;  ///< by the mouse
  Eigen::Vector3d pulledFrom_;
  bool toldOfObstacle_ = false;  ///< since the mouse took a node
};

}  // namespace pliant::shell
