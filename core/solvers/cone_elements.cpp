#include "core/solvers/cone_elements.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace pliant::solvers {

namespace {

Packet absolute(const Packet& p) { return maximum(p, -p); }

/// The larger eigenvalue.
Packet largestEigenvalue(const SymmetricPacket& p) {
  const Packet half = 0.5 * (p.a - p.b);
  return 0.5 * p.trace() + sqrt(half * half + p.c * p.c);
}

SymmetricPacket identityMinus(const SymmetricPacket& p) { return {1.0 - p.a, 1.0 - p.b, -p.c}; }

SymmetricPacket inverse(const SymmetricPacket& p) { return (1.0 / p.determinant()) * p.adjugate(); }

/// Σ ‖F T Λ‖_* - ⟨F T Λ, F T⟩ by the metric of F T: ‖A‖_* of a matrix with two columns is sqrt(tr AᵀA + 2 sqrt det
/// AᵀA).
Packet supportGap(const SymmetricPacket& scaledMetric, const SymmetricPacket& multiplier) {
  return sqrt(dot(scaledMetric, congruence(multiplier, {1.0, 1.0, 0.0})) +
              2.0 * sqrt(maximum(scaledMetric.determinant(), 0.0)) * multiplier.determinant()) -
         dot(multiplier, scaledMetric);
}

Packet supportGap(const Packet& squaredStretch, const Packet& multiplier) {
  return multiplier * (sqrt(squaredStretch) - squaredStretch);
}

}  // namespace

ConeElements::ConeElements(const ConeConstraints& constraints, const std::vector<int>& vertexOfNode,
                           const math::BlockCholesky& cholesky)
    : ellipseOf_{0}, directionOf_{0} {
  std::vector<std::vector<int>> members(constraints.bounds.size());
  for (std::size_t e = 0; e < constraints.elements.size(); ++e) {
    const int own = constraints.elements[e].bounds;
    members[own].push_back(static_cast<int>(e));
    ellipseOf_.push_back(ellipseOf_.back() + static_cast<int>(constraints.bounds[own].ellipses.size()));
    directionOf_.push_back(directionOf_.back() + static_cast<int>(constraints.bounds[own].directions.size()));
  }
  for (const MetricBounds& bounds : constraints.bounds) {
    Bounds& own = bounds_.emplace_back();
    for (const Eigen::Matrix2d& ellipse : bounds.ellipses) {
      const Eigen::Matrix2d t = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(ellipse).operatorInverseSqrt();
      own.scalings.push_back({t(0, 0), t(1, 1), t(0, 1)});
    }
    for (const Eigen::Vector2d& v : bounds.directions) own.directions.push_back({v[0], v[1]});
  }
  for (std::size_t b = 0; b < members.size(); ++b) {
    for (std::size_t first = 0; first < members[b].size(); first += lanes) {
      Group& group = groups_.emplace_back();
      group.bounds = static_cast<int>(b);
      group.firstEllipse = static_cast<int>(ellipses_.size());
      group.firstDirection = static_cast<int>(directions_.size());
      ellipses_.resize(ellipses_.size() + bounds_[b].scalings.size());
      directions_.resize(directions_.size() + bounds_[b].directions.size());
      double weights[3][2][lanes] = {}, mask[lanes] = {};
      for (int lane = 0; lane < lanes; ++lane) {
        const bool real = first + lane < members[b].size();
        const int e = members[b][real ? first + lane : first];
        const ConeElement& element = constraints.elements[e];
        group.element[lane] = real ? e : -1;
        mask[lane] = real ? 1 : 0;
        for (int k = 0; k < 3; ++k) {
          group.nodes[k][lane] = element.nodes[k];
          for (int i = 0; i < 2; ++i) weights[k][i][lane] = real ? element.weights[k][i] : 0;
        }
      }
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 2; ++i) math::load(weights[k][i], group.weights[k][i]);
      math::load(mask, group.mask);
    }
    boundCount_ += static_cast<int>(members[b].size()) *
                   static_cast<int>(2 * bounds_[b].scalings.size() + bounds_[b].directions.size());
  }
  locate(vertexOfNode, cholesky);
}

void ConeElements::locate(const std::vector<int>& vertexOfNode, const math::BlockCholesky& cholesky) {
  constexpr int rows[6] = {0, 1, 2, 1, 2, 2}, columns[6] = {0, 1, 2, 0, 0, 1};
  for (Group& group : groups_)
    for (int k = 0; k < 6; ++k)
      for (int lane = 0; lane < lanes; ++lane) {
        const int row = vertexOfNode[group.nodes[rows[k]][lane]], column = vertexOfNode[group.nodes[columns[k]][lane]];
        group.place[k][lane] = -1;
        if (group.element[lane] < 0 || row < 0 || column < 0) continue;
        const math::BlockCholesky::Place place = cholesky.place(row, column);
        group.place[k][lane] = place.offset;
        group.stride[k][lane] = place.stride;
        group.transposed[k][lane] = place.transposed;
      }
}

MapPacket ConeElements::mapOf(const Group& group, const Positions& x) const {
  alignas(64) double gathered[3][3][lanes];
  for (int k = 0; k < 3; ++k)
    for (int lane = 0; lane < lanes; ++lane) {
      const double* from = x.data() + Eigen::Index{3} * group.nodes[k][lane];
      for (int i = 0; i < 3; ++i) gathered[k][i][lane] = from[i];
    }
  MapPacket f;
  for (int i = 0; i < 3; ++i) {
    Packet first = 0.0, second = 0.0;
    for (int k = 0; k < 3; ++k) {
      Packet at;
      math::load(gathered[k][i], at);
      first += group.weights[k][0] * at;
      second += group.weights[k][1] * at;
    }
    f.first[i] = first;
    f.second[i] = second;
  }
  return f;
}

void ConeElements::addForce(const Group& group, const MapPacket& f, const SymmetricPacket& y,
                            Packet (&nodeForces)[3][3]) {
  for (int i = 0; i < 3; ++i) {
    const Packet first = f.first[i] * y.a + f.second[i] * y.c, second = f.first[i] * y.c + f.second[i] * y.b;
    for (int k = 0; k < 3; ++k) nodeForces[k][i] += group.weights[k][0] * first + group.weights[k][1] * second;
  }
}

void ConeElements::scatter(const Group& group, const Packet (&nodeForces)[3][3], Positions& forces) {
  alignas(64) double stored[3][3][lanes];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) math::store(stored[k][i], nodeForces[k][i]);
  for (int k = 0; k < 3; ++k)
    for (int lane = 0; lane < lanes; ++lane) {
      double* to = forces.data() + Eigen::Index{3} * group.nodes[k][lane];
      for (int i = 0; i < 3; ++i) to[i] += stored[k][i][lane];
    }
}

void ConeElements::addLaplacian(double stiffness, const Positions& x, Positions& forces,
                                math::BlockCholesky& cholesky) const {
  const Packet none[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  for (const Group& group : groups_) {
    const SymmetricPacket multiplier{stiffness, stiffness, 0.0};
    Packet nodeForces[3][3];
    addForce(group, mapOf(group, x), multiplier, nodeForces);
    scatter(group, nodeForces, forces);
    assemble(group, multiplier, none, cholesky);
  }
}

void ConeElements::start(const Positions& x, double barrier, bool keep, const StartingSlack& least) {
  for (Group& group : groups_) {
    const SymmetricPacket metric = mapOf(group, x).metric();
    const Bounds& bounds = bounds_[group.bounds];
    for (std::size_t k = 0; k < bounds.scalings.size(); ++k) {
      Ellipse& cone = ellipses_[group.firstEllipse + k];
      cone.s = mapEigenvalues(0.5 * identityMinus(congruence(bounds.scalings[k], metric)),
                              [&](const Packet& slack) { return maximum(slack, least.ellipses); });
      const SymmetricPacket own = barrier * inverse(cone.s);
      cone.l = keep ? cone.l + own : own;
    }
    for (std::size_t k = 0; k < bounds.directions.size(); ++k) {
      Direction& cone = directions_[group.firstDirection + k];
      cone.s = maximum(0.5 * (1.0 - along(metric, bounds.directions[k])), least.directions);
      const Packet own = barrier / cone.s;
      cone.l = keep ? cone.l + own : own;
    }
  }
}

ConeElements::Linearization ConeElements::linearize(const Positions& x, Positions& forces, Positions& predictorForces,
                                                    math::BlockCholesky& cholesky) {
  Linearization result;
  Packet complementarity = 0.0, residual = 0.0, squaredStretch = 0.0, gap = 0.0;
  for (Group& group : groups_) {
    group.f = mapOf(group, x);
    const SymmetricPacket metric = group.f.metric();
    const Bounds& bounds = bounds_[group.bounds];
    SymmetricPacket multiplier{0.0, 0.0, 0.0}, predictor = multiplier;
    Packet c[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};  // 00, 11, 22, 10, 20, 21 in the coordinates (E00, E11, E01)
    for (std::size_t k = 0; k < bounds.scalings.size(); ++k) {
      Ellipse& cone = ellipses_[group.firstEllipse + k];
      const SymmetricPacket& t = bounds.scalings[k];
      const SymmetricPacket scaled = congruence(t, metric);
      cone.r = cone.s - 0.5 * identityMinus(scaled);
      const Packet rootS = sqrt(cone.s.determinant()), rootL = sqrt(cone.l.determinant());
      const SymmetricPacket sum = (1.0 / rootS) * cone.s + (1.0 / rootL) * cone.l.adjugate();
      const Packet rootW = sqrt(rootS / rootL);  // √|W|
      const SymmetricPacket w = (rootW / sqrt(sum.determinant())) * sum;
      cone.u = (1.0 / (rootW * rootW)) * w.adjugate();
      const Packet scale = 1.0 / sqrt(w.trace() + 2.0 * rootW);
      cone.g = {scale * (w.a + rootW), scale * (w.b + rootW), scale * w.c};
      cone.inverseG = (1.0 / rootW) * cone.g.adjugate();
      cone.v = congruence(cone.g, cone.l);
      const SymmetricPacket l = congruence(t, cone.l), u = congruence(t, cone.u);
      multiplier += l;
      predictor += congruence(t, congruence(cone.u, cone.r));
      c[0] += u.a * u.a;
      c[1] += u.b * u.b;
      c[2] += 2.0 * (u.a * u.b + u.c * u.c);
      c[3] += u.c * u.c;
      c[4] += 2.0 * (u.a * u.c);
      c[5] += 2.0 * (u.b * u.c);
      complementarity += group.mask * dot(cone.l, cone.s);
      residual = maximum(residual, maximum(maximum(absolute(cone.r.a), absolute(cone.r.b)), absolute(cone.r.c)));
      squaredStretch = maximum(squaredStretch, largestEigenvalue(scaled));
      gap += supportGap(scaled, cone.l);
    }
    for (std::size_t k = 0; k < bounds.directions.size(); ++k) {
      Direction& cone = directions_[group.firstDirection + k];
      const std::array<double, 2>& v = bounds.directions[k];
      const Packet squared = along(metric, v);
      cone.r = cone.s - 0.5 * (1.0 - squared);
      const Packet ratio = cone.l / cone.s;
      multiplier += scaledOuter(cone.l, v);
      predictor += scaledOuter(ratio * cone.r, v);
      const double e[3] = {v[0] * v[0], v[1] * v[1], 2 * v[0] * v[1]};
      c[0] += ratio * (e[0] * e[0]);
      c[1] += ratio * (e[1] * e[1]);
      c[2] += ratio * (e[2] * e[2]);
      c[3] += ratio * (e[1] * e[0]);
      c[4] += ratio * (e[2] * e[0]);
      c[5] += ratio * (e[2] * e[1]);
      complementarity += group.mask * cone.l * cone.s;
      residual = maximum(residual, absolute(cone.r));
      squaredStretch = maximum(squaredStretch, squared);
      gap += supportGap(squared, cone.l);
    }
    Packet nodeForces[3][3], nodePredictor[3][3];
    addForce(group, group.f, multiplier, nodeForces);
    addForce(group, group.f, predictor, nodePredictor);
    scatter(group, nodeForces, forces);
    scatter(group, nodePredictor, predictorForces);
    assemble(group, multiplier, c, cholesky);
  }
  result.complementarity = sumOf(complementarity);
  result.residual = largestOf(residual);
  result.largestStretch = std::sqrt(largestOf(squaredStretch));
  result.supportGap = sumOf(gap);
  return result;
}

ConeElements::Multipliers ConeElements::multipliers() const {
  Multipliers result;
  for (const Ellipse& cone : ellipses_) result.ellipses.push_back(cone.l);
  for (const Direction& cone : directions_) result.directions.push_back(cone.l);
  return result;
}

void ConeElements::setMultipliers(const Multipliers& multipliers, double factor) {
  for (std::size_t k = 0; k < ellipses_.size(); ++k) ellipses_[k].l = factor * multipliers.ellipses[k];
  for (std::size_t k = 0; k < directions_.size(); ++k) directions_[k].l = factor * multipliers.directions[k];
}

double ConeElements::addForces(const Multipliers& multipliers, const Positions& x, Positions& forces) const {
  Packet gap = 0.0;
  for (const Group& group : groups_) {
    const MapPacket f = mapOf(group, x);
    const SymmetricPacket metric = f.metric();
    const Bounds& bounds = bounds_[group.bounds];
    SymmetricPacket sum{0.0, 0.0, 0.0};
    for (std::size_t k = 0; k < bounds.scalings.size(); ++k) {
      const SymmetricPacket& own = multipliers.ellipses[group.firstEllipse + k];
      sum += congruence(bounds.scalings[k], own);
      gap += supportGap(congruence(bounds.scalings[k], metric), own);
    }
    for (std::size_t k = 0; k < bounds.directions.size(); ++k) {
      const Packet& own = multipliers.directions[group.firstDirection + k];
      sum += scaledOuter(own, bounds.directions[k]);
      gap += supportGap(along(metric, bounds.directions[k]), own);
    }
    Packet nodeForces[3][3];
    addForce(group, f, sum, nodeForces);
    scatter(group, nodeForces, forces);
  }
  return sumOf(gap);
}

void ConeElements::assemble(const Group& group, const SymmetricPacket& l, const Packet (&c)[6],
                            math::BlockCholesky& cholesky) {
  // The Hessian by the columns of dF, in 3 x 3 blocks. E00 = F₀·dF₀, E11 = F₁·dF₁, E01 = ½ (F₀·dF₁ + F₁·dF₀).
  Packet h00[6], h11[6], h01[3][3];  // symmetric ones packed by rows of the lower triangle
  const Packet quarter = 0.25 * c[2], half4 = 0.5 * c[4], half5 = 0.5 * c[5];
  const MapPacket& f = group.f;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Packet p00 = f.first[i] * f.first[j], p11 = f.second[i] * f.second[j];
      const Packet p01 = f.first[i] * f.second[j], p10 = f.second[i] * f.first[j];
      h01[i][j] = c[3] * p01 + half4 * p00 + half5 * p11 + quarter * p10;
      if (i == j) h01[i][j] += l.c;
      if (j > i) continue;
      Packet& own00 = h00[i * (i + 1) / 2 + j];
      Packet& own11 = h11[i * (i + 1) / 2 + j];
      own00 = c[0] * p00 + half4 * (p01 + p10) + quarter * p11;
      own11 = c[1] * p11 + half5 * (p01 + p10) + quarter * p00;
      if (i == j) {
        own00 += l.a;
        own11 += l.b;
      }
    }
  constexpr int rows[6] = {0, 1, 2, 1, 2, 2}, columns[6] = {0, 1, 2, 0, 0, 1};
  double* values = cholesky.values();
  for (int k = 0; k < 6; ++k) {
    const auto& [a0, a1] = group.weights[rows[k]];
    const auto& [b0, b1] = group.weights[columns[k]];
    const Packet w00 = a0 * b0, w11 = a1 * b1, w01 = a0 * b1, w10 = a1 * b0;
    alignas(64) double block[3][3][lanes];  // [column][row]
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int packed = i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
        math::store(block[j][i], w00 * h00[packed] + w11 * h11[packed] + w01 * h01[i][j] + w10 * h01[j][i]);
      }
    for (int lane = 0; lane < lanes; ++lane) {
      if (group.place[k][lane] < 0) continue;
      double* to = values + group.place[k][lane];
      const int stride = group.stride[k][lane];
      if (group.transposed[k][lane]) {
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) to[Eigen::Index{j} * stride + i] += block[i][j][lane];
      } else {
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) to[Eigen::Index{j} * stride + i] += block[j][i][lane];
      }
    }
  }
}

double ConeElements::largestStretch(const Positions& x) const {
  Packet squared = 0.0;
  for (const Group& group : groups_) {
    const SymmetricPacket metric = mapOf(group, x).metric();
    const Bounds& bounds = bounds_[group.bounds];
    for (const SymmetricPacket& t : bounds.scalings)
      squared = maximum(squared, largestEigenvalue(congruence(t, metric)));
    for (const auto& v : bounds.directions) squared = maximum(squared, along(metric, v));
  }
  return std::sqrt(largestOf(squared));
}

void ConeElements::report(ConeSolution& solution) const {
  solution.multipliers.resize(3, static_cast<Eigen::Index>(ellipseOf_.size()) - 1);
  solution.ellipseMultipliers.resize(3, ellipseOf_.back());
  solution.directionMultipliers.resize(directionOf_.back());
  for (const Group& group : groups_) {
    const Bounds& bounds = bounds_[group.bounds];
    SymmetricPacket sum{0.0, 0.0, 0.0};
    for (std::size_t k = 0; k < bounds.scalings.size(); ++k) {
      const SymmetricPacket& own = ellipses_[group.firstEllipse + k].l;
      sum += congruence(bounds.scalings[k], own);
      for (int lane = 0; lane < lanes; ++lane)
        if (const int e = group.element[lane]; e >= 0)
          solution.ellipseMultipliers.col(ellipseOf_[e] + static_cast<int>(k)) << own.a[lane], own.b[lane], own.c[lane];
    }
    for (std::size_t k = 0; k < bounds.directions.size(); ++k) {
      const Packet& own = directions_[group.firstDirection + k].l;
      sum += scaledOuter(own, bounds.directions[k]);
      for (int lane = 0; lane < lanes; ++lane)
        if (const int e = group.element[lane]; e >= 0)
          solution.directionMultipliers[directionOf_[e] + static_cast<int>(k)] = own[lane];
    }
    for (int lane = 0; lane < lanes; ++lane)
      if (const int e = group.element[lane]; e >= 0)
        solution.multipliers.col(e) << sum.a[lane], sum.b[lane], sum.c[lane];
  }
}

}  // namespace pliant::solvers
