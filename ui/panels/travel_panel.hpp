#pragma once

#include <QWidget>
#include <memory>

#include "core/scene/interlock_result.hpp"
#include "ui/document/document.hpp"

class QComboBox;
class QHBoxLayout;
class QLabel;
class QPushButton;
class QStackedLayout;

namespace pliant::plots {
class PolarPlot;
}

namespace pliant::panels {

/// Limits of stretch and compression and the free travel between them over the direction (thesis Fig. 4.6), or limits
/// of curvature (Fig. 4.7), with what was measured; or those that a design of an element is to have, had first, and has
/// found, which may be taken into the scene as one step of undo.
class TravelPanel final : public QWidget {
  Q_OBJECT

 public:
  explicit TravelPanel(document::Document& document, QWidget* parent = nullptr);

  /// Whether it shows results of studies of this type.
  static bool shows(const std::string& type);

  std::string study() const;
  void setStudy(const std::string& name);
  plots::PolarPlot* plot() const { return plot_; }
  /// Takes the element that a design has found.
  QPushButton* take() const { return take_; }
  /// What is said of it.
  QString summary() const;
  /// Throws base::InputError.
  void importMeasured(const QString& file);

 Q_SIGNALS:
  void runRequested(const std::string& study);

 private:
  void fillStudies();
  void refresh();
  void refreshSwitches();
  void chooseMeasured();
  void exportPlot();
  void refreshDesign(bool busy);
  void takeElement();

  document::Document& document_;
  std::shared_ptr<const scene::Result> result_;
  QStackedLayout* pages_;
  QLabel* note_;
  QPushButton* run_;
  QComboBox* studies_;
  QHBoxLayout* switches_;
  plots::PolarPlot* plot_;
  QWidget* designRow_;
  QLabel* summary_;
  QPushButton* take_;
};

}  // namespace pliant::panels
