#pragma once

#include <QImage>
#include <QPalette>

#include "core/mechanics/model.hpp"

namespace pliant::plots {

/// A small picture of a model in one configuration (positions of its nodes [m]), seen from above at an angle, a plane
/// one from straight above; transparent around it. May be called from any thread.
QImage shapeImage(const mechanics::Model& model, const Eigen::VectorXd& positions, const QSize& size, double pixelRatio,
                  const QPalette& palette);

}  // namespace pliant::plots
