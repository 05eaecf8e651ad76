#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/interlock/cell_contact.hpp"
#include "ui/render/view.hpp"

namespace pliant::render {

/// A cell at rest or at one of its limits, and the contacts that hold it there.
struct CellConfiguration {
  std::shared_ptr<const interlock::UnitCell> cell;
  interlock::CellState state;
  std::vector<interlock::CellContactForce> contacts;
};

/// Three by three cells of an interlocking material, shaded smoothly, neighbours in different tints, with a mark at
/// each contact that holds them. The outlines of the cells at rest and as they are lie below.
class LimitView final : public View {
 public:
  LimitView();
  ~LimitView() override;

  /// Null: an empty view.
  void setConfiguration(std::shared_ptr<const CellConfiguration> configuration);
  const std::shared_ptr<const CellConfiguration>& configuration() const;
  void setContactsVisible(bool visible);
  bool contactsVisible() const;
  /// How many marks there are, one a contact of two elements that are both drawn.
  int markCount() const;
  void setStale(bool stale);

  /// Nothing can be picked.
  std::optional<int> pickNode(double x, double y, double radius) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pliant::render
