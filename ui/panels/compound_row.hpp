#pragma once

#include <QWidget>
#include <functional>
#include <vector>

#include "ui/jobs/compound_direction.hpp"

class QComboBox;

namespace pliant::panels {

class ParameterSlider;
class TextLine;

/// One slider for many parameters: to the right towards what is chosen, to the left away from it.
class CompoundRow final : public QWidget {
  Q_OBJECT

 public:
  explicit CompoundRow(QWidget* parent = nullptr);

  /// What can be moved along; keeps the choice as long as there are as many.
  void setGoals(std::vector<jobs::CompoundGoal> goals);
  /// Null if there are none.
  const jobs::CompoundGoal* goal() const;
  /// Empty text: nothing can be moved, and `note` says why.
  void setPrediction(const QString& text, bool moved);
  void setMovable(bool movable, const QString& note);
  /// What parts of the way towards the goal and away from it predictions can be trusted for.
  void setTrusted(double towards, double away);
  void clearTrusted();
  /// Back in the middle.
  void rest();

  QComboBox* choice() const { return choice_; }
  ParameterSlider* slider() const { return slider_; }
  QString text() const;

 Q_SIGNALS:
  void goalChosen();
  /// Of the way towards the goal, in [-1, 1].
  void dragged(double share);
  void committed(double share);
  void dragCancelled();

 private:
  std::vector<jobs::CompoundGoal> goals_;
  QComboBox* choice_;
  ParameterSlider* slider_;
  TextLine* text_;
};

}  // namespace pliant::panels
