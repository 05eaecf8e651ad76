#pragma once

#include <QObject>
#include <memory>
#include <string>

#include "ui/document/document.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/render/limit_view.hpp"

namespace pliant::panels {
class BoundaryPanel;
class CellTestPanel;
class TravelPanel;
}  // namespace pliant::panels

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

/// Shows the elements at limits of interlocking materials in the viewport: the limit of a boundary that was clicked,
/// the direction that was chosen or has just been computed. Brings what runs to the panel that shows it.
class InterlockLink final : public QObject {
  Q_OBJECT

 public:
  /// Finds contacts in `quick`.
  InterlockLink(document::Document& document, jobs::JobRunner& quick, viewport::Viewport& viewport,
                panels::BoundaryPanel& boundary, panels::TravelPanel& travel, panels::CellTestPanel& tests,
                QObject* parent = nullptr);

  /// The configuration at the limit of a `cell_test`; empty: the material at rest.
  void showTest(const std::string& study);
  /// The configuration at a limit of the boundary on show; -1: the material at rest.
  void showState(int state);
  render::LimitView& view() { return *view_; }
  /// Shows the material as it is pulled again, no limit.
  void leave();
  bool isShown() const;

 Q_SIGNALS:
  /// A study of this type begins to show something: "stretch_boundary", "free_travel", "cell_test".
  void resultGrows(const std::string& type);

 private:
  void follow(const std::string& name);
  void show(std::shared_ptr<const render::CellConfiguration> configuration, const QString& caption);
  void refreshStale();

  document::Document& document_;
  jobs::JobRunner& quick_;
  viewport::Viewport& viewport_;
  panels::BoundaryPanel& boundary_;
  panels::TravelPanel& travel_;
  panels::CellTestPanel& tests_;
  std::shared_ptr<render::LimitView> view_;
  std::string study_;    ///< whose limit is shown, or asked for
  std::string grows_;    ///< study that was brought to its panel while it ran
  bool framed_ = false;  ///< the view has been fitted to this material
};

/// Whether a study is one of an interlocking cell.
bool isInterlockStudy(const document::Document& document, const std::string& study);
/// Whether the scene has an interlocking material.
bool hasInterlock(const document::Document& document);

}  // namespace pliant::shell
