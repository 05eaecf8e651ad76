#pragma once

#include <optional>

#include "core/scene/macro_strains.hpp"
#include "ui/panels/study_panel.hpp"
#include "ui/render/boundary_view.hpp"
#include "ui/render/macro_view.hpp"

class QButtonGroup;
class QDoubleSpinBox;
class QLabel;

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
  /// What a click at the sheet is for.
  enum class Clicks { read, clamp, load };
  Clicks clicks() const;
  void setClicks(Clicks clicks);
  std::optional<int> selectedTriangle() const { return triangle_; }
  /// A click at the sheet: a triangle that is to be read out, or a node to be clamped, loaded or freed; -1: beside it.
  void take(int picked);

  /// Adds the same sheet with twice and four times as many triangles along its sides, or with a base 4 and 16 times as
  /// stiff, to the scene, unless they are there, and asks for all of them to be run.
  enum class Family { refinement, youngModulus };
  void addFamily(Family family);

 Q_SIGNALS:
  void viewChanged();
  void studiesRequested(const std::vector<std::string>& studies);

 private:
  QString absentNote() const override;
  QString waitingNote(const QString& study) const override;
  bool present(const document::StudyState* study) override;
  QWidget* makeSpace();
  void makeControls();
  void refreshPlot();
  void refreshSpace();
  std::string pointer(const char* key) const;
  void toggleAt(int node, const char* key, const scene::Json& entry, const QString& text);

  std::shared_ptr<const scene::MacroResult> result_;
  std::optional<int> triangle_;
  plots::LinePlot* plot_;
  std::shared_ptr<render::BoundaryView> space_;
  viewport::Viewport* spaceViewport_;
  std::shared_ptr<const scene::BoundarySurface> surface_;
  QLabel* readout_;
  QComboBox *fields_, *plots_, *spaces_;
  QButtonGroup* clicks_;
  QDoubleSpinBox* force_;
};

}  // namespace pliant::panels
