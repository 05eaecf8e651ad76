#pragma once

#include <QObject>
#include <memory>
#include <string>

#include "ui/document/document.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/render/limit_view.hpp"
#include "ui/render/patch_view.hpp"
#include "ui/shell/sheet_link.hpp"

namespace pliant::panels {
class BoundaryPanel;
class CellTestPanel;
class SheetPanel;
class SizePanel;
class TravelPanel;
}  // namespace pliant::panels

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

/// Shows the elements at limits of interlocking materials in the viewport, of cells and of patches: the limit of a
/// boundary that was clicked, the test that was chosen or has just been computed. Brings what runs to the panel that
/// shows it.
class InterlockLink final : public QObject {
  Q_OBJECT

 public:
  /// Finds contacts in `quick`.
  InterlockLink(document::Document& document, jobs::JobRunner& quick, viewport::Viewport& viewport,
                panels::BoundaryPanel& boundary, panels::TravelPanel& travel, panels::SizePanel& sizes,
                panels::SheetPanel& sheets, panels::CellTestPanel& tests, QObject* parent = nullptr);

  /// The configuration at the limit of a `cell_test` or `bending_test`, or at rest of a `gravity_bending` or
  /// `macro_equilibrium`; empty: the material at rest.
  void showTest(const std::string& study);
  /// The configuration at a limit of the boundary on show; -1: the material at rest.
  void showState(int state);
  render::LimitView& view() { return *view_; }
  /// Shows the material as it is pulled again, no limit.
  void leave();
  bool isShown() const;

 Q_SIGNALS:
  /// A study of this type begins to show something.
  void resultGrows(const std::string& type);

 private:
  void follow(const std::string& name);
  void show(std::shared_ptr<const render::CellConfiguration> configuration, const QString& caption);
  void show(std::shared_ptr<const render::PatchConfiguration> configuration, const QString& caption);
  void showGuest(const std::shared_ptr<render::View>& view, const QString& caption);
  /// Finds a configuration and its caption in the background, then shows it.
  template <class Find>
  void showLater(Find find);
  void refreshStale();

  document::Document& document_;
  jobs::JobRunner& quick_;
  viewport::Viewport& viewport_;
  panels::BoundaryPanel& boundary_;
  panels::TravelPanel& travel_;
  panels::SizePanel& sizes_;
  panels::SheetPanel& sheets_;
  panels::CellTestPanel& tests_;
  std::shared_ptr<render::LimitView> view_;
  std::shared_ptr<render::PatchView> patchView_;
  SheetLink sheetLink_;
  std::string study_;                          ///< whose limit is shown, or asked for
  std::string grows_;                          ///< study that was brought to its panel while it ran
  bool framed_ = false, patchFramed_ = false;  ///< the views have been turned once for this scene
};

/// Whether a study is one of an interlocking cell.
bool isInterlockStudy(const document::Document& document, const std::string& study);
/// Whether the scene has an interlocking material.
bool hasInterlock(const document::Document& document);

}  // namespace pliant::shell
