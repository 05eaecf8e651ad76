#pragma once

/// A sheet of fabric that hangs from two corners and a patch from one, each with a stretch limit, a study of cloth that
/// swings it for a fifth of a second by two methods, and linear modes.
inline constexpr char sheetScene[] = R"json({
  "schema_version": 1,
  "title": "Small sheet",
  "geometry": [
    {"name": "square", "type": "strip", "length": 0.5, "width": 0.5, "length_cells": 8, "width_cells": 8},
    {"name": "small", "type": "strip", "length": 0.2, "width": 0.2, "length_cells": 2, "width_cells": 2,
     "position": [1, 0, 0]}],
  "materials": [{"name": "cotton", "type": "isotropic", "density": 200, "young_modulus": 1800, "poisson_ratio": 0.41}],
  "elements": [
    {"name": "sheet", "geometry": "square", "type": "shell", "thickness": "0.5 mm"},
    {"name": "patch", "geometry": "small", "type": "shell", "thickness": "0.5 mm"}],
  "stretch_limits": [
    {"name": "all", "element": "sheet", "type": "isotropic", "stretch": 1.01},
    {"name": "bias", "type": "curve", "element": "patch", "points": [
      {"angle": 0, "stretch": 1.05}, {"angle": "45 deg", "stretch": 1.17}, {"angle": "100 deg", "stretch": 1.04},
      {"angle": "140 deg", "stretch": 1.12}]}
  ],
  "boundary_conditions": [
    {"name": "corners", "type": "pin", "at": {"geometry": "square", "nodes": [0, 8]}},
    {"name": "corner", "type": "pin", "at": {"geometry": "small", "nodes": [0]}}],
  "bodies": [{"name": "ball", "type": "sphere", "center": [0.25, 0, -0.3], "radius": 0.08}],
  "loads": [{"name": "gravity", "type": "gravity", "acceleration": [0, 0, -9.81]}],
  "studies": [
    {"name": "swing", "type": "cloth_motion", "duration": 0.2, "time_step": 0.02},
    {"name": "project", "type": "cloth_motion", "duration": 0.2, "time_step": 0.02, "scheme": "step_and_project"},
    {"name": "modes", "type": "linear_modes"}
  ]
})json";
