#include "core/interlock/cell_inspection.hpp"

#include <algorithm>
#include <cstdio>

#include "core/base/error.hpp"
#include "core/interlock/linking_number.hpp"
#include "core/interlock/overlapping_bodies.hpp"

namespace pliant::interlock {

namespace {

std::string capitalised(std::string sentence) {
  if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z') sentence[0] = static_cast<char>(sentence[0] - 32);
  return sentence;
}

/// "Elements 1 and 2", "An element and its neighbour", "Element 1 and element 2 of the neighbouring cell (0, -1)".
std::string pairText(const UnitCell& cell, int a, int b, const std::array<int, 2>& shift) {
  const std::string place = " at (" + std::to_string(shift[0]) + ", " + std::to_string(shift[1]) + ")";
  if (cell.elements.size() == 1) return "An element and its neighbour" + place;
  if (shift == std::array{0, 0}) return "Elements " + std::to_string(a + 1) + " and " + std::to_string(b + 1);
  return "Element " + std::to_string(a + 1) + " and element " + std::to_string(b + 1) + " of the neighbouring cell" +
         place;
}

/// Two digits are enough to say how far something is off: "0.12 mm".
std::string sizeText(double metres) {
  char text[32];
  const bool tiny = metres < 1e-5;
  std::snprintf(text, sizeof text, tiny ? "%.2g µm" : "%.2g mm", metres * (tiny ? 1e6 : 1e3));
  return text;
}

std::string timesText(int number) {
  const int times = std::abs(number);
  return times == 0 ? "not" : times == 1 ? "once" : times == 2 ? "twice" : std::to_string(times) + " times";
}

std::string linkSentence(const UnitCell& cell, const std::vector<ChangedLink>& changed) {
  const auto& [link, found] = changed.front();
  const std::string pair = pairText(cell, link.a, link.b, link.shift);
  std::string sentence;
  if (found == 0)
    sentence = pair + " are not linked, but should be";
  else if (link.number == 0)
    sentence = pair + " are linked " + timesText(found) + ", but should not be";
  else if (found == -link.number)
    sentence = pair + " are linked the other way round";
  else
    sentence = pair + " are linked " + timesText(found) + " instead of " + timesText(link.number);
  if (changed.size() > 1) {
    const std::size_t others = changed.size() - 1;
    sentence += others == 1 ? "; one other link has changed as well"
                            : "; " + std::to_string(others) + " other links have changed as well";
  }
  return sentence + ".";
}

std::vector<ChangedLink> changedLinks(const UnitCell& cell, const std::vector<Link>& found) {
  const auto samePlace = [](Link x, Link y) {
    x.number = y.number = 0;
    return x == y;
  };
  std::vector<ChangedLink> changed;
  std::vector<Link> declared;
  for (const Link& link : cell.links)
    if (link.number != 0) declared.push_back(canonical(link));
  std::sort(declared.begin(), declared.end());
  for (const Link& link : declared) {
    const auto same =
        std::find_if(found.begin(), found.end(), [&](const Link& other) { return samePlace(link, other); });
    const int number = same == found.end() ? 0 : same->number;
    if (number != link.number) changed.push_back({link, number});
  }
  for (const Link& other : found) {
    if (std::any_of(declared.begin(), declared.end(), [&](const Link& link) { return samePlace(link, other); }))
      continue;
    changed.push_back({other, other.number});
    changed.back().link.number = 0;
  }
  return changed;
}

/// Midway between the surfaces of two parts, whether they overlap or not.
Eigen::Vector3d placeBetween(const UnitCell& cell, const PartPair& pair, double gap) {
  // Both surfaces drawn back by the same leave the place where it is, and forces are known only of parts that are
  // apart.
  const double radius = cell.smallestRadius(), back = std::max(0.0, 0.1 * radius - 0.5 * gap);
  UnitCell thinner = cell;
  for (ElementShape& shape : thinner.shapes)
    for (DilatedPiece& piece : shape.pieces) piece.radius -= back;
  std::vector<CellContactForce> forces;
  CellContact(thinner).energy(restState(cell), {pair}, {1, 2 * (gap + 2 * back)}, nullptr, nullptr, nullptr, &forces);
  return forces.empty() ? Eigen::Vector3d(restState(cell).positions.col(pair.a)) : forces.front().place;
}

}  // namespace

CellInspection inspectCell(const UnitCell& cell, double reachInRadii) {
  CellInspection result;
  result.declaredLinks = static_cast<int>(
      std::count_if(cell.links.begin(), cell.links.end(), [](const Link& l) { return l.number != 0; }));
  try {
    checkCellGeometry(cell);
  } catch (const base::InputError& error) {
    result.fault = capitalised(error.problem()) + ".";
    return result;
  }
  result.radius = cell.smallestRadius();
  result.reach = reachInRadii * result.radius;
  const CellContact contact(cell);
  PartPair where{};
  const double gap = contact.smallestGap(restState(cell), result.reach, &where);
  if (gap < result.reach)
    result.nearest = NearestElements{where.a, where.b, where.shift, gap, placeBetween(cell, where, gap)};
  if (result.overlaps()) {
    result.fault = pairText(cell, where.a, where.b, where.shift) + " overlap by " + sizeText(-gap) + ".";
    return result;
  }
  if (const auto inside = overlappingBodies(contact, restState(cell))) {
    result.fault = pairText(cell, inside->a, inside->b, inside->shift) + " overlap.";
    return result;
  }
  const auto found = LinkFinder(contact).linksAt(restState(cell));
  if (!found) {
    result.fault = "The linking numbers at rest cannot be told, since elements meet.";
    return result;
  }
  result.changedLinks = changedLinks(cell, *found);
  if (!result.changedLinks.empty()) result.fault = linkSentence(cell, result.changedLinks);
  return result;
}

}  // namespace pliant::interlock
