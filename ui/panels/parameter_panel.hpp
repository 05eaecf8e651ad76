#pragma once

#include <QWidget>
#include <map>
#include <set>
#include <vector>

#include "ui/jobs/compound_direction.hpp"
#include "ui/jobs/motion_session.hpp"
#include "ui/jobs/trusted_ranges.hpp"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace pliant::panels {

class CompoundRow;
class ParameterRow;
class TextLine;

/// The sliders of all design parameters, and above them the amplitude of the selected node: solved, and as predicted
/// for the sliders' places, with the button that solves anew; and a slider that moves all of them that are not locked
/// along the gradient of what is chosen.
class ParameterPanel final : public QWidget {
  Q_OBJECT

 public:
  ParameterPanel(document::Document& document, jobs::MotionSession& session, QWidget* parent = nullptr);

  ParameterRow* row(const std::string& pointer) const;
  QString summary() const;
  QPushButton* updateButton() const { return update_; }
  CompoundRow* compound() const { return compound_; }
  const jobs::TrustedRanges& trust() const { return trust_; }

  QSize sizeHint() const override { return {304, 360}; }

 private:
  void rebuild();
  void refreshValues();
  void refreshReferences();
  void refreshEffects();
  void refreshSummary();
  void refreshTrust();
  void connectCompound();
  void refreshGoals();
  void refreshDirection();
  void showGoal();
  void dragAll(double share);
  void commitAll(double share);
  void endAll();

  document::Document& document_;
  jobs::MotionSession& session_;
  jobs::TrustedRanges trust_;
  QLabel* of_;
  QLabel* solved_;
  TextLine* predicted_;
  QLabel* note_;
  QPushButton* update_;
  CompoundRow* compound_;
  QLabel* empty_;
  QVBoxLayout* list_;
  std::vector<ParameterRow*> rows_;
  jobs::CompoundDirection direction_;
  bool movingAll_ = false;                       ///< by the compound slider, until the scene has what it was moved to
  std::set<std::string> locked_;                 ///< names of parameters; while one scene is open
  std::map<std::string, double> impliedMaxima_;  ///< by the parameter's name; while one scene is open
};

/// "left tip", or "node 57" if the scene has no probe there.
QString nodeName(const mechanics::Model& model, int node);

}  // namespace pliant::panels
