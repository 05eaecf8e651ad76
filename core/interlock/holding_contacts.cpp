#include "core/interlock/holding_contacts.hpp"

#include <algorithm>

namespace pliant::interlock {

namespace {
constexpr int splitOfArcs = 4;  // as in the last stage of an equilibrium
}

std::vector<CellContactForce> distinctContacts(std::vector<CellContactForce> contacts, double apart) {
  std::stable_sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
  std::vector<CellContactForce> kept;
  for (const CellContactForce& each : contacts) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const CellContactForce& other) {
      return other.pair.a == each.pair.a && other.pair.b == each.pair.b && other.pair.shift == each.pair.shift &&
             (other.place - each.place).norm() < apart;
    });
    if (!known) kept.push_back(each);
  }
  return kept;
}

std::vector<CellContactForce> holdingContacts(const CellContact& contact, const CellState& state, double range) {
  std::vector<CellContactForce> contacts;
  contact.energy(state, contact.nearParts(state, range), {1, range, splitOfArcs}, nullptr, nullptr, nullptr, &contacts);
  return contacts;
}

}  // namespace pliant::interlock
