#pragma once

#include <QWidget>

#include "core/base/parameter_spec.hpp"

class QGridLayout;
class QLabel;
class QToolButton;

namespace pliant::panels {

class ParameterSlider;
class ValueField;

/// What rows of numbers look like: name and symbol, the value with its unit, reset, and a slider with its ends.
class SliderRow : public QWidget {
  Q_OBJECT

 public:
  ParameterSlider* slider() const { return slider_; }
  ValueField* field() const { return field_; }

 protected:
  /// Where the numbers of the slider's ends stand; beside it a row is low.
  enum class Ends { below, beside };
  SliderRow(const QString& name, const base::ParameterSpec& spec, Ends ends, QWidget* parent);

  void showEnds(const QString& low, const QString& high);
  /// Shows the button if the value is not that of the file, which `saved` says.
  void showReset(bool differs, const QString& saved);

  ParameterSlider* slider_;
  ValueField* field_;
  QToolButton* reset_;
  QGridLayout* below_;  ///< with the slider, in two or three columns

 private:
  QLabel *low_, *high_;
};

}  // namespace pliant::panels
