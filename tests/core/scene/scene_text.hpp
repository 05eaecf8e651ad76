#pragma once

#include <string>

#include "core/scene/scene.hpp"

namespace pliant::test {

/// A scene that has an entry of nearly every kind, as a starting point for edits.
inline const std::string fullScene = R"({
  "schema_version": 1,
  "title": "Everything",
  "geometry": [
    {"name": "sheet", "type": "grid", "length": "100 mm", "width": "40 mm", "length_cells": 4, "width_cells": 2,
     "position": [0, "1 cm", 0], "rotation": {"axis": [0, 1, 0], "angle": "90 deg"}},
    {"name": "hooks", "type": "points", "points": [[0, 0, 0.3], ["1 mm", 0, 0.4]]}
  ],
  "materials": [{"name": "pet", "type": "isotropic", "density": "1.38 g/cm^3", "young_modulus": "3.3 GPa", "poisson_ratio": 0.36}],
  "elements": [{"name": "skin", "type": "shell", "geometry": "sheet", "thickness": "0.2 mm"}],
  "point_masses": [{"name": "tip", "at": {"geometry": "sheet", "group": "end"}, "mass": "2 g"},
                   {"name": "hook", "at": {"geometry": "hooks", "nodes": [0, 1]}, "mass": "10 g"}],
  "springs": [
    {"name": "tie", "type": "between", "from": {"geometry": "sheet", "nodes": [3]}, "to": {"geometry": "hooks", "nodes": [0]},
     "coefficients": ["10 N/m", 0, "5 N/m^3"]},
    {"name": "wall", "type": "anchored", "at": {"geometry": "hooks", "nodes": [1]}, "anchor": [0, 0, 1], "rest_length": "50 cm",
     "coefficients": [3]},
    {"name": "down", "type": "grounded", "at": {"geometry": "hooks", "nodes": [0, 1]}, "direction": [0, 0, 2], "coefficients": [20]}
  ],
  "boundary_conditions": [{"name": "rail", "type": "locked", "at": {"geometry": "hooks", "nodes": [0]}, "coordinates": ["x", "y"]}],
  "drives": [
    {"name": "shake", "type": "rotation", "at": {"geometry": "sheet", "box": {"minimum": [-1, -1, -0.03], "maximum": [1, 1, 0.001]}}, "axis": [0, 1, 0],
     "harmonics": [{"amplitude": "1 deg"}, {"order": 2, "amplitude": "0.1 deg", "phase": "90 deg"}]}
  ],
  "loads": [
    {"name": "weight", "type": "gravity", "acceleration": [0, 0, -9.81]},
    {"name": "push", "type": "harmonic_force", "at": {"geometry": "hooks", "nodes": [1]}, "direction": [1, 0, 0],
     "harmonics": [{"amplitude": "2 mN"}]}
  ],
  "damping": {"mass_proportional": 0.5, "stiffness_proportional": "0.05 ms"},
  "probes": [{"name": "corner", "at": {"geometry": "sheet", "nearest": [0, 0, -0.1]}}],
  "studies": [
    {"name": "motion", "type": "periodic_motion", "frequency": "2.5 Hz"},
    {"name": "response", "type": "frequency_response", "from": 8, "to": 14}
  ],
  "expected": [{"study": "motion", "pointer": "/frequency", "value": 15.707963, "relative_tolerance": 1e-6}]
})";

inline scene::Scene parse(const std::string& text) { return scene::Scene::parse(text, "/nowhere", "test.json"); }

}  // namespace pliant::test
