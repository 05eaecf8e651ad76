#pragma once

#include <array>
#include <vector>

namespace pliant::geometry {

/// The triangles turned so that neighbours run along their common edge in opposite directions; in each connected part
/// the first triangle keeps its orientation. Throws base::InputError if an edge has more than two triangles or the
/// surface is one-sided.
std::vector<std::array<int, 3>> orientTriangles(std::vector<std::array<int, 3>> triangles);

}  // namespace pliant::geometry
