#pragma once

#include "core/interlock/unit_cell.hpp"

namespace pliant::interlock {

/// Materials with parameters. All lengths in [m], angles in [rad]; `wire` is the radius of the wire's cross-section,
/// `ring` that of a ring's centre line. The defaults are those of materials of the kinds of thesis Fig. 4.5. Functions
/// only build: checkCell tells whether the parameters make sense. The links are those of the kind of material.

/// European 4-in-1 chain mail: two rings a cell, staggered, turned by -tilt and +tilt about x.
struct FourInOne {
  double ring = 5e-3, wire = 0.8e-3;
  double width = 12.2e-3, height = 7.5e-3;  ///< of the rectangular cell
  double tilt = 0.4886921905584123;
  double aspect = 1;  ///< of the wire's cross-section, see ellipticRing
};
UnitCell fourInOne(const FourInOne& parameters = {});

/// Rings fused around a centre at equal angles, each turned out of the plane by `lean` about its radius.
struct Rosette {
  double ring, wire;
  double distance;  ///< of the rings' centres from the element's
  double lean;
  double spacing;     ///< of neighbouring elements
  double aspect = 1;  ///< of the wires' cross-sections, see ellipticRing
};
/// Three rings, hexagonal lattice, six neighbours.
inline constexpr Rosette threefoldDefault{4.8e-3, 1e-3, 5.3e-3, 0.8726646259971648, 14.5e-3};
UnitCell threefold(const Rosette& parameters = threefoldDefault);
/// Four rings, square lattice, four neighbours.
inline constexpr Rosette squareRosetteDefault{3.85e-3, 1e-3, 5.005e-3, 0.7853981633974483, 13.86e-3};
UnitCell squareRosette(const Rosette& parameters = squareRosetteDefault);

/// Closed curves ((A + B cos qt) cos pt, (A + B cos qt) sin pt, C sin qt) on a square lattice.
struct TorusKnot {
  int p = 3, q = 4;
  double a = 4.4e-3, b = 2.2e-3, c = 3.52e-3, wire = 0.6e-3;
  double spacing = 11e-3;
};
UnitCell torusKnot(const TorusKnot& parameters = {});
/// p = 1, q = 4: not knotted.
inline constexpr TorusKnot torusCoilDefault{1, 4, 4.583333333333334e-3, 2.291666666666667e-3, 2.75e-3, 0.8e-3, 11e-3};

/// Six rings around a hub that carries a rounded hexagonal plate; hexagonal lattice.
struct ScaleMail {
  Rosette rings{3.567567567567567e-3, 0.9e-3, 4.6378378378378375e-3, 1.0471975511965976, 13.2e-3};
  double plateHeight = 5.289604143230969e-3;  ///< of its middle plane above the rings'
  double plateInradius = 5.5e-3;              ///< of the hexagon before it is rounded
  double plateRadius = 0.8e-3;                ///< of the rounding, half the thickness
  double hubRadius = 1.2e-3;
};
UnitCell scaleMail(const ScaleMail& parameters = {});

/// Flat rings on a square lattice, joined by upright ones.
struct RingNet {
  double ring = 4e-3, wire = 0.6e-3;
  double spacing = 12e-3;
  double aspect = 1;  ///< of the wire's cross-section, see ellipticRing
};
UnitCell ringNet(const RingNet& parameters = {});

}  // namespace pliant::interlock
