#pragma once

#include <QTimer>
#include <optional>
#include <utility>

#include "core/scene/macro_strains.hpp"
#include "ui/panels/sheet_outline.hpp"
#include "ui/panels/study_panel.hpp"
#include "ui/render/boundary_view.hpp"
#include "ui/render/macro_field.hpp"

class QButtonGroup;
class QDoubleSpinBox;
class QLabel;
class QToolButton;

namespace pliant::plots {
class LinePlot;
}
namespace pliant::viewport {
class Viewport;
}

namespace pliant::panels {

/// What there is to know of a large piece of interlocking material: how near its triangles are to their limits (thesis
/// Fig. 4.13), or how far all sheets of the scene have moved (Figs. 4.10, 4.11); where its triangles stand in the space
/// of its limits; and what is clamped and loaded, which is changed by clicks at the sheet.
class SheetPanel final : public StudyPanel {
  Q_OBJECT

 public:
  explicit SheetPanel(document::Document& document, QWidget* parent = nullptr);

  plots::LinePlot* plot() const { return plot_; }
  const render::BoundaryView& space() const { return *space_; }
  QString readout() const;
  void exportTo(const QString& file) override;

  render::MacroField field() const;
  /// The elements instead of the sheet, where a study has placed them.
  bool showsElements() const;
  /// The native patch beside the sheet, where it was computed as well.
  bool showsNative() const;
  /// What a click at the sheet is for.
  enum class Clicks { read, clamp, load, paint };
  Clicks clicks() const;
  void setClicks(Clicks clicks);
  std::optional<int> selectedTriangle() const { return triangle_; }
  /// The frame of a motion that is looked at, and its time [s].
  void setFrame(int frame, double seconds);
  /// A click at the sheet: a triangle that is to be read out, or a node to be clamped, loaded or freed; -1: beside it.
  void take(int picked);

  /// Adds the same sheet with twice and four times as many triangles along its sides, or with a base 4 and 16 times as
  /// stiff, to the scene, unless they are there, and asks for all of them to be run.
  enum class Family { refinement, youngModulus };
  void addFamily(Family family);
  /// Whether strokes may be painted: the sheet that was computed last has the outline that its study has now.
  bool canPaint() const;
  /// The material of each triangle as the study has it now, and what the materials are called.
  std::pair<std::vector<int>, std::vector<std::string>> materials() const;
  /// As if the mouse had painted them, with the material that is chosen, or wiped off what was painted.
  std::pair<std::vector<int>, std::vector<std::string>> paintedWith(const std::vector<int>& stroke, bool wipes) const;
  /// The same for good, as one undo step; the study has to run again, without native patch and placed elements.
  void paint(const std::vector<int>& stroke, bool wipes);
  /// Another outline, as far across as the present one, as one undo step; the study has to run again.
  void setOutline(SheetOutline outline);
  /// From a file, see withOutlineFrom().
  void setOutlineFrom(const QString& file);
  /// Lets the loads of this study come in steps, so that they can be watched, and asks for it to be run.
  void addLoadSteps();

 Q_SIGNALS:
  void viewChanged();
  /// A click at a plot over time [s].
  void instantChosen(double seconds);
  void studiesRequested(const std::vector<std::string>& studies);

 private:
  /// Numbers of the entries of `plots_`; the last is there for what has frames.
  enum Plot { nearnessPlot, deflectionPlot, motionPlot };
  QString absentNote() const override;
  QString waitingNote(const QString& study) const override;
  bool present(const document::StudyState* study) override;
  QWidget* makeSpace();
  void makeControls();
  void refreshPlot();
  void plotNearness();
  void plotMotion();
  double instantScale() const;
  void plotDeflections();
  void showDeflections();
  void refreshSpace();
  std::string pointer(const char* key) const;
  void setStudyJson(const scene::Json& study, const QString& text);
  void chooseOutlineFile();
  void fillPaints();
  scene::Json regionsWith(const std::vector<int>& stroke, bool wipes) const;
  std::pair<std::vector<int>, std::vector<std::string>> materialsOf(const scene::Json& regions) const;
  void toggleAt(int node, const char* key, const scene::Json& entry, const QString& text);

  std::shared_ptr<const scene::MacroResult> result_;
  scene::SheetMoment moment_;  ///< what is shown of it
  int frame_ = -1;
  double instant_ = 0;  ///< [s]
  QTimer frameTimer_;
  std::optional<int> triangle_;
  plots::LinePlot* plot_;
  std::shared_ptr<render::BoundaryView> space_;
  viewport::Viewport* spaceViewport_;
  std::shared_ptr<const scene::BoundarySurface> surface_;
  QLabel* readout_;
  QComboBox *fields_, *plots_, *spaces_;
  QButtonGroup* clicks_;
  QToolButton* native_;
  QDoubleSpinBox* force_;
  QComboBox* paints_;  ///< materials
};

}  // namespace pliant::panels
