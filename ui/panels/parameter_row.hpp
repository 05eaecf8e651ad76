#pragma once

#include <optional>

#include "core/harmonic/prediction_error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "ui/document/document.hpp"
#include "ui/panels/slider_row.hpp"

namespace pliant::panels {

class EffectBar;

/// One design parameter: name, symbol, value, slider with bounds, reset, and what it does to the amplitude.
///
/// The slider ends at the scene's `maximum`. Where the scene gives none, it ends where it ended when the scene was
/// opened, whatever the value has become since; only a value typed beyond that moves the end, to what the scene implies
/// for that value.
class ParameterRow final : public SliderRow {
  Q_OBJECT

 public:
  /// `impliedMaximum` outlives the row and keeps the slider's end where the scene gives none; 0: not known yet.
  ParameterRow(document::Document& document, std::shared_ptr<const mechanics::DesignParameter> parameter,
               double& impliedMaximum, QWidget* parent = nullptr);

  const std::string& pointer() const { return pointer_; }
  const std::string& name() const { return name_; }
  EffectBar* effectBar() const { return effect_; }

  /// Value and bounds as the scene has them now.
  void refresh();
  /// The value that the shown motion was solved with.
  void setReference(double value);
  /// d(amplitude)/d(parameter), SI, and the largest effect |slope · value| of all parameters.
  void setSlope(double slope, double largestEffect);
  void clearSlope();
  /// Up to where predictions can be trusted; none: not known.
  void setTrusted(const std::optional<harmonic::ParameterRange>& range);
  /// Where it would go with others: shown until `refresh`.
  void showPreview(double value);
  /// Puts `value` into a scene's JSON as `commit` would.
  void writeTo(base::Json& scene, double value) const;
  /// A locked one keeps its value: nothing here and no compound slider moves it.
  void setLocked(bool locked);
  bool isLocked() const;
  QToolButton* lockButton() const { return lock_; }

 Q_SIGNALS:
  void lockChanged(bool locked);
  /// The handle moves; the value has the digits that would be written.
  void dragged(const std::string& pointer, double value);
  void dragEnded();

 private:
  void commit(double value, bool nudge);
  bool givesMaximum() const;
  std::string entryPointer() const;
  void type(const QString& text);
  void resetValue();

  document::Document& document_;
  std::shared_ptr<const mechanics::DesignParameter> parameter_;
  std::string pointer_;
  std::string name_;  ///< when the row was made
  double& impliedMaximum_;
  base::ParameterSpec spec_;
  EffectBar* effect_;
  QToolButton* lock_;
};

}  // namespace pliant::panels
