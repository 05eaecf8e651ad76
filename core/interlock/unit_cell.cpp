#include "core/interlock/unit_cell.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/error.hpp"
#include "core/interlock/linking_number.hpp"
#include "core/interlock/overlapping_bodies.hpp"

namespace pliant::interlock {

namespace {

[[noreturn]] void failCell(const std::string& problem) { throw base::InputError("", problem); }

std::string shiftText(const std::array<int, 2>& shift) {
  return "moved by (" + std::to_string(shift[0]) + ", " + std::to_string(shift[1]) + ") lattice vectors";
}

std::string linkText(const Link& link) {
  const bool manyHandles = link.handleA > 0 || link.handleB > 0;
  const auto pieceText = [&](int handle, int piece, int element) {
    return (manyHandles ? "handle " + std::to_string(handle) + " of " : std::string()) + "piece " +
           std::to_string(piece) + " of element " + std::to_string(element);
  };
  return pieceText(link.handleA, link.pieceA, link.a) + " and " + pieceText(link.handleB, link.pieceB, link.b) + " " +
         shiftText(link.shift);
}

void checkElements(const UnitCell& cell) {
  if (cell.elements.empty()) failCell("the cell has no elements");
  for (std::size_t i = 0; i < cell.elements.size(); ++i) {
    const auto& [shape, position, rotation] = cell.elements[i];
    const std::string name = "element " + std::to_string(i);
    if (shape < 0 || shape >= static_cast<int>(cell.shapes.size()))
      failCell(name + " has shape " + std::to_string(shape) + ", but there are " + std::to_string(cell.shapes.size()));
    if (!position.allFinite()) failCell("the position of " + name + " is not finite");
    if (!rotation.allFinite() || !(rotation * rotation.transpose()).isIdentity(1e-9) || rotation.determinant() < 0)
      failCell("the rotation of " + name + " is not a rotation");
  }
}

void checkLattice(const Eigen::Matrix2d& lattice) {
  const double lengths = lattice.col(0).norm() * lattice.col(1).norm();
  if (!lattice.allFinite() || !(std::abs(lattice.determinant()) > 1e-6 * lengths))
    failCell("the lattice vectors are parallel or zero, but must span the plane");
}

void checkLinks(const UnitCell& cell, const CellContact& contact) {
  std::vector<Link> declared;
  for (const Link& link : cell.links) {
    const int count = static_cast<int>(cell.elements.size());
    if (link.a < 0 || link.a >= count || link.b < 0 || link.b >= count)
      failCell("a link names element " + std::to_string(std::max(link.a, link.b)) + ", but the cell has " +
               std::to_string(count));
    if (link.number != 0) declared.push_back(canonical(link));
  }
  std::sort(declared.begin(), declared.end());
  const auto found = LinkFinder(contact).linksAt(restState(cell));
  if (!found) failCell("the linking numbers at rest cannot be told, since elements meet");
  const auto placeOf = [](Link link) {
    link.number = 0;
    return link;
  };
  for (const Link& link : declared) {
    const auto same =
        std::find_if(found->begin(), found->end(), [&](const Link& other) { return placeOf(other) == placeOf(link); });
    const int number = same == found->end() ? 0 : same->number;
    if (number != link.number)
      failCell(linkText(link) + " are linked " + std::to_string(number) + " times at rest, but declared are " +
               std::to_string(link.number));
  }
  for (const Link& link : *found)
    if (std::none_of(
            declared.begin(), declared.end(), [&](const Link& other) { return placeOf(other) == placeOf(link); }))
      failCell(linkText(link) + " are linked " + std::to_string(link.number) +
               " times at rest, but this is not declared");
}

}  // namespace

double UnitCell::smallestRadius() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ElementShape& shape : shapes) smallest = std::min(smallest, shape.contactLengthOrThickness());
  return smallest;
}

Link canonical(const Link& link) {
  const std::array<int, 2> back = {-link.shift[0], -link.shift[1]};
  const bool turned = link.a > link.b || (link.a == link.b && back > link.shift);
  return turned ? Link{link.b, link.pieceB, link.a, link.pieceA, back, link.number, link.handleB, link.handleA} : link;
}

UnitCell supercell(const UnitCell& cell, int first, int second) {
  if (first < 1 || second < 1)
    failCell("a supercell needs at least one cell in each direction, but is " + std::to_string(first) + " x " +
             std::to_string(second));
  UnitCell result = cell;
  result.elements.clear();
  result.links.clear();
  result.lattice.col(0) *= first;
  result.lattice.col(1) *= second;
  const int count = static_cast<int>(cell.elements.size());
  const auto indexOf = [&](int i, int j, int element) { return (i * second + j) * count + element; };
  const auto split = [](int place, int size) {
    const int whole = place >= 0 ? place / size : -((size - 1 - place) / size);
    return std::array<int, 2>{whole, place - whole * size};
  };
  for (int i = 0; i < first; ++i)
    for (int j = 0; j < second; ++j) {
      const Eigen::Vector2d shift = cell.lattice * Eigen::Vector2d(i, j);
      for (InterlockingElement element : cell.elements) {
        element.position.head<2>() += shift;
        result.elements.push_back(element);
      }
      for (const Link& link : cell.links) {
        const auto [wholeI, restI] = split(i + link.shift[0], first);
        const auto [wholeJ, restJ] = split(j + link.shift[1], second);
        result.links.push_back(canonical({indexOf(i, j, link.a),
                                          link.pieceA,
                                          indexOf(restI, restJ, link.b),
                                          link.pieceB,
                                          {wholeI, wholeJ},
                                          link.number,
                                          link.handleA,
                                          link.handleB}));
      }
    }
  return result;
}

void checkCellGeometry(const UnitCell& cell) {
  for (const ElementShape& shape : cell.shapes) checkShape(shape);
  checkElements(cell);
  checkLattice(cell.lattice);
}

void checkCell(const UnitCell& cell) {
  checkCellGeometry(cell);
  const CellContact contact(cell);
  PartPair where{};
  const double reach = cell.smallestRadius();
  const double gap = contact.smallestGap(restState(cell), reach, &where);
  if (!(gap > 0)) {
    std::ostringstream text;
    text << "element " << where.a << " and element " << where.b << " " << shiftText(where.shift) << " overlap by "
         << -gap << " m at rest, but must be apart";
    failCell(text.str());
  }
  if (const auto inside = overlappingBodies(contact, restState(cell)))
    failCell("element " + std::to_string(inside->a) + " and element " + std::to_string(inside->b) + " " +
             shiftText(inside->shift) + " overlap at rest, but must be apart");
  checkLinks(cell, contact);
}

}  // namespace pliant::interlock
