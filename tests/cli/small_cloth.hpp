#pragma once

namespace pliant::test {

/// A sheet that hangs from two corners, may stretch by 5 %, and moves for a tenth of a second.
inline constexpr char smallClothScene[] = R"json({
  "schema_version": 1,
  "title": "Small cloth",
  "geometry": [{"name": "cloth", "type": "grid", "length": 0.5, "width": 0.5, "length_cells": 4, "width_cells": 4}],
  "materials": [{"name": "fabric", "density": 200, "young_modulus": 1800, "poisson_ratio": 0.41}],
  "elements": [{"name": "sheet", "type": "shell", "thickness": "0.5 mm"}],
  "stretch_limits": [{"name": "all", "type": "isotropic", "stretch": 1.05}],
  "boundary_conditions": [
    {"name": "first", "type": "pin", "at": {"nearest": [0, -0.25, 0]}},
    {"name": "second", "type": "pin", "at": {"nearest": [0, 0.25, 0]}}],
  "loads": [{"name": "weight", "type": "gravity", "acceleration": [0, 0, -9.81]}],
  "studies": [{"name": "swing", "type": "cloth_motion", "duration": 0.1, "time_step": 0.01},
              {"name": "drape", "type": "cloth_drape", "frame_every": 1}]
})json";

}  // namespace pliant::test
