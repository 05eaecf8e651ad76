#pragma once

#include "ui/panels/slider_row.hpp"

namespace pliant::panels {

/// One number of a material. What it means, its unit and its range come from the scene's format. Where that gives no
/// end, the slider goes to twice the default, and angles to a right angle; a value typed beyond an end moves that end
/// to a round number some way beyond it, as far as the format goes.
class CellParameterRow final : public SliderRow {
  Q_OBJECT

 public:
  explicit CellParameterRow(base::ParameterSpec spec, QWidget* parent = nullptr);

  /// Whether there is a row for such a value.
  static bool fits(const base::ParameterSpec& spec);

  const std::string& key() const { return spec_.key; }
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
  void widenTo(double value);
  void showBounds();

  base::ParameterSpec spec_;
  double low_ = 0, high_ = 1;
  double value_ = 0, saved_ = 0;
};

}  // namespace pliant::panels
