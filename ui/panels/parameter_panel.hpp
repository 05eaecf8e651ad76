#pragma once

#include <QWidget>
#include <map>
#include <vector>

#include "ui/jobs/motion_session.hpp"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace pliant::panels {

class ParameterRow;
class TextLine;

/// The sliders of all design parameters, and above them the amplitude of the selected node: solved, and as predicted
/// for the sliders' places, with the button that solves anew.
class ParameterPanel final : public QWidget {
  Q_OBJECT

 public:
  ParameterPanel(document::Document& document, jobs::MotionSession& session, QWidget* parent = nullptr);

  ParameterRow* row(const std::string& pointer) const;
  QString summary() const;
  QPushButton* updateButton() const { return update_; }

  QSize sizeHint() const override { return {304, 360}; }

 private:
  void rebuild();
  void refreshValues();
  void refreshReferences();
  void refreshEffects();
  void refreshSummary();

  document::Document& document_;
  jobs::MotionSession& session_;
  QLabel* of_;
  QLabel* solved_;
  TextLine* predicted_;
  QLabel* note_;
  QPushButton* update_;
  QLabel* empty_;
  QVBoxLayout* list_;
  std::vector<ParameterRow*> rows_;
  std::map<std::string, double> impliedMaxima_;  ///< by the parameter's name; while one scene is open
};

/// "left tip", or "node 57" if the scene has no probe there.
QString nodeName(const mechanics::Model& model, int node);

}  // namespace pliant::panels
