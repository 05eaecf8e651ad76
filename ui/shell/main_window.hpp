#pragma once

#include <QMainWindow>

#include "ui/document/document.hpp"
#include "ui/document/recent_files.hpp"
#include "ui/jobs/cell_session.hpp"
#include "ui/jobs/cloth_session.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/jobs/motion_session.hpp"
#include "ui/jobs/study_runner.hpp"
#include "ui/shell/action_registry.hpp"
#include "ui/shell/theme.hpp"

class QLabel;
class QMenu;
class QStackedWidget;
class QToolButton;
class QVBoxLayout;

namespace pliant::panels {
class CellPanel;
class BoundaryPanel;
class CellTestPanel;
class ChartPanel;
class DesignPanel;
class EnergyPanel;
class LimitPanel;
class LogPanel;
class MessageBar;
class ModesPanel;
class MotionPanel;
class ParameterPanel;
class PrintPanel;
class ResponsePanel;
class SceneTree;
class SheetPanel;
class SizePanel;
class TravelPanel;
}  // namespace pliant::panels

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

class CellBar;
class CommandPalette;
class DrapeGallery;
class ElementGallery;
class Gallery;
class JobStatus;
class LiveBar;
class MakeDialog;
class TargetLink;

/// Puts document, jobs, viewport, plot and panels together. Without `remember` nothing is read from or written to the
/// user's settings.
class MainWindow final : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(bool remember, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Reads a scene in the background and shows it; what is open stays if it is bad. Runs its studies if `run`.
  void openFile(const QString& file, bool run = false);

  document::Document& document() { return document_; }
  jobs::MotionSession& session() { return session_; }
  jobs::ClothSession& live() { return live_; }
  jobs::CellSession& liveCell() { return liveCell_; }
  ActionRegistry& actions() { return actions_; }
  viewport::Viewport& viewport() { return *viewport_; }
  panels::ParameterPanel& parameters() { return *parameters_; }
  panels::ResponsePanel& response() { return *response_; }
  panels::ModesPanel& modes() { return *modes_; }
  panels::MotionPanel& motion() { return *motion_; }
  panels::DesignPanel& design() { return *design_; }
  TargetLink& targets() { return *targets_; }
  panels::MessageBar& messages() { return *messages_; }
  panels::SceneTree& sceneTree() { return *tree_; }
  panels::LimitPanel& limits() { return *limits_; }
  panels::EnergyPanel& energies() { return *energies_; }
  DrapeGallery& drapes() { return *drapes_; }
  panels::CellPanel& cellPanel() { return *cellPanel_; }
  ElementGallery& elements() { return *elements_; }
  CellBar& cellBar() { return *cellBar_; }
  panels::BoundaryPanel& boundary() { return *boundary_; }
  panels::TravelPanel& travel() { return *travel_; }
  panels::PrintPanel& print() { return *print_; }
  panels::SizePanel& sizes() { return *sizes_; }
  panels::SheetPanel& sheets() { return *sheets_; }
  panels::ChartPanel& charts() { return *charts_; }
  panels::CellTestPanel& cellTests() { return *cellTests_; }

  /// See frameExport; a message says what came of it.
  void exportFramesTo(const QString& file);
  /// See writeBoundary; a message says what came of it.
  void exportBoundaryTo(const QString& file);
  /// What the panel for printing says, in the background; a message says what came of it.
  void exportPatchTo(const QString& file);

  /// Bodies to be made, with the sizes of the dialog; a message and the dialog say what came of it.
  void exportPartsTo(const QString& file);
  /// The table of parameters; a message says what came of it.
  void exportParametersTo(const QString& file);
  MakeDialog& makeDialog() { return *make_; }

  QSize sizeHint() const override { return {1280, 800}; }

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void buildCentre();
  void buildDocks();
  void buildStatusBar();
  void connectParts();
  void makeActions();
  void makeClothActions();
  void makeCellActions();
  void makeCellDock();
  void makePrintDock();
  void makeCellViews();
  void showElements(bool shown);
  void chooseFamily(const std::string& type, int cell);
  void fitCellDocks();
  void makeDrapeGallery();
  void showDrapes(bool shown);
  void addShownDrape();
  void makeLiveActions();
  void makePartsActions();
  void openMakeDialog();
  void makeLiveBar();
  void openLive();
  void makeInterlockDocks();
  void connectInterlock();
  void showInterlockDocks(bool shown);
  void showPlaying(bool playing);
  void makeMenus();
  void makeToolBar();
  void fillStudyMenu(QMenu* menu);
  void fillRecentMenu(QMenu* menu);

  void chooseFile();
  void undo();
  void cancel();
  bool save();
  bool saveAs();
  void exportShown();
  void exportFrames();
  void keepUnsaved();
  void showScene();
  void report(base::Severity severity, const QString& sentence);
  void reportUpdate(double predicted, double solved);
  void refreshActions();
  void refreshTitle();
  void resetParameters();
  void selectNextProbe();
  void openPalette();
  void setTheme(Theme theme);
  void setDocksVisible(bool visible);
  /// Docks of cloth and of interlocking materials are there for scenes with one, those of vibrations for all but scenes
  /// with these alone.
  void showFittingDocks();
  void restoreSettings();
  void storeSettings() const;

  bool remember_;
  document::Document document_;
  jobs::JobRunner studyJobs_;
  jobs::JobRunner quickJobs_;
  jobs::JobRunner drapeJobs_;   ///< computes drapes that are compared
  jobs::JobRunner sceneJobs_;   ///< reads scenes and builds models, so that neither waits for a solve
  jobs::JobRunner exportJobs_;  ///< draws videos, which nothing waits for
  jobs::StudyRunner studies_;
  jobs::MotionSession session_;
  jobs::ClothSession live_;
  jobs::CellSession liveCell_;
  document::RecentFiles recent_;
  ActionRegistry actions_;
  Theme theme_ = Theme::system;

  QStackedWidget* pages_ = nullptr;
  Gallery* gallery_ = nullptr;
  DrapeGallery* drapes_ = nullptr;
  ElementGallery* elements_ = nullptr;
  QVBoxLayout* stage_ = nullptr;  ///< the viewport and what stands below it
  viewport::Viewport* viewport_ = nullptr;
  panels::MessageBar* messages_ = nullptr;
  panels::SceneTree* tree_ = nullptr;
  panels::ParameterPanel* parameters_ = nullptr;
  panels::ResponsePanel* response_ = nullptr;
  panels::ModesPanel* modes_ = nullptr;
  panels::MotionPanel* motion_ = nullptr;
  panels::DesignPanel* design_ = nullptr;
  TargetLink* targets_ = nullptr;
  panels::LimitPanel* limits_ = nullptr;
  panels::EnergyPanel* energies_ = nullptr;
  panels::LogPanel* log_ = nullptr;
  panels::CellPanel* cellPanel_ = nullptr;
  QDockWidget* cellDock_ = nullptr;
  CellBar* cellBar_ = nullptr;
  panels::PrintPanel* print_ = nullptr;
  QDockWidget* printDock_ = nullptr;  ///< where pieces for printers are chosen
  panels::BoundaryPanel* boundary_ = nullptr;
  panels::TravelPanel* travel_ = nullptr;
  panels::SizePanel* sizes_ = nullptr;
  panels::SheetPanel* sheets_ = nullptr;
  panels::ChartPanel* charts_ = nullptr;
  QDockWidget* chartDock_ = nullptr;  ///< shown with scenes that have studies for it
  panels::CellTestPanel* cellTests_ = nullptr;
  LiveBar* liveBar_ = nullptr;
  MakeDialog* make_ = nullptr;
  JobStatus* status_ = nullptr;
  QLabel* readout_ = nullptr;
  QToolButton* warnings_ = nullptr;
  CommandPalette* palette_ = nullptr;
  QByteArray docksBefore_;  ///< the drapes had the window to themselves
  std::vector<QDockWidget*> docks_;
  std::vector<QDockWidget*> harmonicDocks_, clothDocks_, interlockDocks_;
};

}  // namespace pliant::shell
