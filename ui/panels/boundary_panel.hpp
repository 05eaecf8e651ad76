#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <optional>

#include "core/scene/boundary_surface.hpp"
#include "ui/document/document.hpp"
#include "ui/jobs/job_runner.hpp"
#include "ui/render/boundary_view.hpp"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSlider;
class QStackedLayout;

namespace pliant::viewport {
class Viewport;
}

namespace pliant::panels {

/// "E_x 8.317 %,  E_y −3.1 %,  E_xy 0.02 %" and the stretches that it means.
QString strainText(const Eigen::Vector3d& greenStrain);

/// The boundaries of stretch and of bending that studies of the document find (thesis Fig. 4.4), which fill in while
/// they run:
/// turned with the mouse, cut, compared with another one, read out under the pointer. A click examines a limit.
class BoundaryPanel final : public QWidget {
  Q_OBJECT

 public:
  /// Reads files in `quick`.
  BoundaryPanel(document::Document& document, jobs::JobRunner& quick, QWidget* parent = nullptr);

  /// Whose boundary is shown; empty: none.
  std::string study() const;
  void setStudy(const std::string& name);
  /// Null: nothing to show yet.
  const std::shared_ptr<const scene::LimitSurface>& result() const { return result_; }
  /// Whether it shows results of studies of this type.
  static bool shows(const std::string& type);
  const std::shared_ptr<const scene::BoundarySurface>& surface() const { return surface_; }
  render::BoundaryView& view() { return *view_; }
  viewport::Viewport& viewport() { return *viewport_; }
  QString readout() const;

  /// Another study of the document; empty: none.
  void compareWithStudy(const std::string& name);
  /// A result's folder or a boundary.ply, read in the background.
  void compareWithFile(const QString& file);
  const std::shared_ptr<const scene::BoundarySurface>& compared() const { return compared_; }
  /// Drawn over the solved one in place of what it is compared with; null: none.
  void showPredicted(std::shared_ptr<const scene::BoundarySurface> surface);
  const std::shared_ptr<const scene::BoundarySurface>& predicted() const { return predicted_; }
  /// As if it had been clicked; -1: none.
  void examine(int state);

 Q_SIGNALS:
  void runRequested(const std::string& study);
  /// A limit was chosen, or none any more (-1).
  void stateExamined(int state);
  void exportRequested();
  /// Another result is on show.
  void resultShown();

 protected:
  void showEvent(QShowEvent* event) override;
  /// The keys that turn and fit a view are this one's while it has the focus.
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  static constexpr int sliceSteps = 400;
  void makeWidgets();
  QWidget* makeControls();
  void connectParts();
  void fillStudies();
  void fillComparisons();
  void chooseComparison(int index);
  /// What became of reading a file: its boundary, or what is wrong with it.
  void takeFile(const QString& file, const std::shared_ptr<const scene::BoundarySurface>& surface,
                const QString& problem);
  void refresh();
  void refreshCompared();
  void refreshQuantities();
  void refreshSlice();
  void refreshSliceAxes();
  void applyStyle();
  void hover(std::optional<QPointF> place);
  QString caption(const document::StudyState& study) const;
  QString describe(int state) const;
  std::shared_ptr<const scene::LimitSurface> resultOf(const std::string& name) const;
  /// A distance in the unit of the space, such as "8.317 %".
  QString distanceText(double value, int digits = 4) const;
  const scene::BoundarySpace& space() const;
  double factor() const;
  QString placeText(const Eigen::Vector3d& place) const;

  document::Document& document_;
  jobs::JobRunner& quick_;
  std::shared_ptr<const scene::LimitSurface> result_;
  std::shared_ptr<const scene::BoundarySurface> surface_, compared_, predicted_;
  std::map<QString, std::shared_ptr<const scene::BoundarySurface>> files_;  ///< that were read, by name
  QString wanted_;                                                          ///< file that is being read
  std::shared_ptr<render::BoundaryView> view_;
  std::optional<int> hovered_;
  std::string shownStudy_;

  QStackedLayout* pages_;
  QLabel* note_;
  QPushButton* run_;
  viewport::Viewport* viewport_;
  QLabel* readout_;
  QComboBox *studies_, *quantities_, *comparisons_, *sliceAxes_;
  QSlider *opacity_, *slice_;
  QDoubleSpinBox* sliceValue_;
  QCheckBox *shadows_, *states_;
};

}  // namespace pliant::panels
