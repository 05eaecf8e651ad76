#pragma once

#include <Eigen/Core>

namespace pliant::harmonic {

/// The closed curve through `points` (dimension x n, n >= 3), one after the other at even steps of time: the cubic
/// spline with even knots whose first and second derivatives are continuous everywhere, also where it closes (de Boor,
/// A Practical Guide to Splines, chapter IV). Its places at even times, `perPiece` a piece: dimension x (n · perPiece),
/// the first at the first point.
Eigen::MatrixXd closedSpline(const Eigen::MatrixXd& points, int perPiece);

}  // namespace pliant::harmonic
