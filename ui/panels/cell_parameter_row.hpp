#pragma once

#include <QWidget>

#include "core/base/parameter_spec.hpp"

class QLabel;
class QToolButton;

namespace pliant::panels {

class ParameterSlider;
class ValueField;

/// One number of a material: name, symbol, value with its unit, slider with its ends, reset. What it means, its unit
/// and its range come from the scene's format. Where that gives no end, the slider goes to twice the default, or to
/// twice what was typed beyond; angles go to a right angle.
class CellParameterRow final : public QWidget {
  Q_OBJECT

 public:
  explicit CellParameterRow(base::ParameterSpec spec, QWidget* parent = nullptr);

  /// Whether there is a row for such a value.
  static bool fits(const base::ParameterSpec& spec);

  const std::string& key() const { return spec_.key; }
  ParameterSlider* slider() const { return slider_; }
  ValueField* field() const { return field_; }
  /// The value in SI, and that in the file, to which reset goes back (NaN: none).
  void setValue(double value, double saved);

 Q_SIGNALS:
  /// The handle moves; the value is what would be written.
  void dragged(const std::string& key, const pliant::base::Json& value);
  void dragEnded();
  /// `text` says it for the undo list; `nudge`: a key was pressed, and more may follow.
  void committed(const std::string& key, const pliant::base::Json& value, const QString& text, bool nudge);

 private:
  base::Json written(double value) const;
  QString shown(double value) const;
  void commit(double value, bool nudge);
  void type(const QString& text);
  void showBounds();

  base::ParameterSpec spec_;
  double low_ = 0, high_ = 1;
  double value_ = 0, saved_ = 0;
  ParameterSlider* slider_;
  ValueField* field_;
  QToolButton* reset_;
  QLabel* lowText_;
  QLabel* highText_;
};

}  // namespace pliant::panels
