#pragma once

#include <QWidget>

#include "core/mechanics/model.hpp"

class QComboBox;
class QPushButton;
class QToolButton;

namespace pliant::panels {

class TextLine;

/// The row with which target paths are made: of which probe, drawn by hand, from a table, or from a computed motion.
class TargetBar final : public QWidget {
  Q_OBJECT

 public:
  explicit TargetBar(QWidget* parent = nullptr);

  /// Lists the probes; keeps the chosen one if it is still there.
  void setProbes(const std::vector<mechanics::Probe>& probes);
  void setProbe(const std::string& name);
  std::string probe() const;
  void setDrawing(bool drawing);
  void setMotionAvailable(bool available);
  void setState(const QString& text);
  QString state() const;

  QComboBox* probeChoice() const { return probe_; }
  QPushButton* drawButton() const { return draw_; }
  QToolButton* motionButton() const { return motion_; }

 Q_SIGNALS:
  void probeChosen(const std::string& probe);
  void drawToggled(bool on);
  void tableRequested();
  /// The present path of this probe.
  void motionRequested(const std::string& probe);

 private:
  QComboBox* probe_;
  QPushButton* draw_;
  QPushButton* table_;
  QToolButton* motion_;
  TextLine* state_;
};

}  // namespace pliant::panels
