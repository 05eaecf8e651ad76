#pragma once

#include <QWidget>

#include "core/scene/patch_export.hpp"
#include "ui/document/document.hpp"
#include "ui/jobs/job_runner.hpp"

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace pliant::panels {

/// Chooses a piece of an interlocking material to be printed: its outline, at rest or at a limit, and how fine its
/// meshes are. How many elements that takes, and how far apart they are, is found while it is chosen.
class PrintPanel final : public QWidget {
  Q_OBJECT

 public:
  /// Looks at what is chosen in `quick`.
  PrintPanel(document::Document& document, jobs::JobRunner& quick, QWidget* parent = nullptr);

  scene::PatchRequest request() const;
  /// As if it had been chosen: 0: cells, 1: a rectangle, 2: a circle; lengths in mm.
  void choose(int outline, double first, double second);
  QString findings() const;
  /// Whether there is something to print.
  bool isReady() const { return ready_; }

 Q_SIGNALS:
  void exportRequested();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void fill();
  void fillStates();
  void fitOutline();
  void inspect();
  void takeFindings(const QString& text, bool ready);

  document::Document& document_;
  jobs::JobRunner& quick_;
  bool ready_ = false;
  QFormLayout* form_;
  QComboBox *cells_, *states_, *outlines_;
  QDoubleSpinBox *first_, *second_, *tolerance_, *clearance_;
  QLabel* findings_;
  QPushButton* export_;
};

}  // namespace pliant::panels
