#pragma once

#include "ui/render/theme.hpp"

class vtkLookupTable;

namespace pliant::render {

/// The colour map viridis at `fraction` in [0, 1].
Color viridis(double fraction);

/// `color` mixed with grey of the same lightness: what a stale result looks like.
Color faded(const Color& color);

/// Fills `table` with viridis over [minimum, maximum], faded if `stale`.
void setViridis(vtkLookupTable* table, double minimum, double maximum, bool stale);

}  // namespace pliant::render
