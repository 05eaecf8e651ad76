#pragma once

#include <QFont>
#include <QPalette>
#include <QRectF>

#include "ui/plots/polar_picture.hpp"

class QPainter;

namespace pliant::plots {

/// Puts the axis' circle into `area`, so that labels and the legend have room, for `layOut` and `paint` alike.
void layOutPolar(PolarAxis& axis, const QRectF& area, const PolarPicture& picture, const QFont& font);

/// Draws it in the colours of the palette.
void paintPolar(QPainter& painter, const QRectF& area, const PolarAxis& axis, const PolarPicture& picture,
                const QPalette& palette, const QFont& font);

}  // namespace pliant::plots
