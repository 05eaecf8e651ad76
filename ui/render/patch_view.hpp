#pragma once

#include <memory>

#include "ui/render/patch_configuration.hpp"
#include "ui/render/view.hpp"

namespace pliant::render {

/// A finite patch at native scale: its elements, linked ones in different tints and clamped ones dark, a mark at each
/// contact, the paraboloid on which they lie faintly behind them, an arrow for their weight, and what the colours mean.
class PatchView final : public View {
 public:
  PatchView();
  ~PatchView() override;

  /// Null: an empty view.
  void setConfiguration(std::shared_ptr<const PatchConfiguration> configuration);
  const std::shared_ptr<const PatchConfiguration>& configuration() const;
  void setContactsVisible(bool visible);
  /// How many contacts are marked.
  int markCount() const;
  /// Greys the elements: inputs have changed since.
  void setStale(bool stale);

  /// Nothing can be picked.
  std::optional<int> pickNode(double x, double y, double radius) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
