#include "ui/render/points.hpp"

namespace pliant::render {

Points toPoints(const Eigen::VectorXd& coordinates, int nodes, int dimension) {
  Points points = Points::Zero(3, nodes);
  points.topRows(dimension) = coordinates.head(nodes * dimension).reshaped(dimension, nodes);
  return points;
}

}  // namespace pliant::render
