#pragma once

#include <QObject>
#include <optional>

#include "core/scene/target_path.hpp"
#include "ui/jobs/motion_session.hpp"
#include "ui/viewport/target_tool.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::panels {
class TargetBar;
}

namespace pliant::shell {

/// Shows the target paths of design studies in a viewport, has them drawn there by hand, and puts what was drawn, read
/// from a table or taken from a motion into the scene, each as one step of undo.
class TargetLink final : public QObject {
  Q_OBJECT

 public:
  TargetLink(document::Document& document, jobs::MotionSession& session, viewport::Viewport& viewport,
             panels::TargetBar& bar, QObject* parent = nullptr);

  bool isDrawing() const { return drawing_.has_value(); }
  /// What is drawn [m]; none if nothing is.
  const render::Points& drawnPoints() const { return tool_.points(); }
  void setDrawing(bool on);
  void takeTable(const QString& file);
  void takeMotion(const std::string& probe);

 private:
  void refresh();
  void showTargets();
  void showState();
  void beginDrawing();
  void endDrawing();
  void loadTool(const scene::TargetPath& target);
  void commit(viewport::TargetTool::Edit edit);
  /// Puts a path of the chosen probe into the scene, in the place of the one it has.
  bool put(const char* form, const render::Points& places, const QString& text);
  void chooseTable();
  const scene::TargetPath* targetOf(const std::string& probe) const;
  int nodeOf(const std::string& probe) const;
  /// Of a node of the motion on show, at even times; its place at rest if there is none.
  render::Points presentPath(int node) const;
  Eigen::Vector3d planeNormal(int node) const;
  Eigen::Vector3d offsetOf(const scene::TargetPath& target, const render::Points& curve) const;
  render::TargetCurve curveOf(const scene::TargetPath& target) const;

  document::Document& document_;
  jobs::MotionSession& session_;
  viewport::Viewport& viewport_;
  panels::TargetBar& bar_;
  viewport::TargetTool tool_;
  std::vector<scene::TargetPath> targets_;
  std::optional<std::string> drawing_;                     ///< the probe whose target is drawn
  Eigen::Vector3d drawnOffset_ = Eigen::Vector3d::Zero();  ///< of what is drawn from what the scene has
};

}  // namespace pliant::shell
