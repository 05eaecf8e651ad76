#include "core/cloth/projection_program.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace pliant::cloth {

ProjectionProgram::ProjectionProgram(const solvers::ConeConstraints& constraints, const Eigen::Matrix3Xd& candidate,
                                     const Eigen::Matrix3Xd& start, base::ExecutionContext& context)
    : constraints_(constraints), candidate_(candidate), positions_(start), context_(context) {
  for (int node = 0; node < constraints.nodeCount; ++node) {
    variable_.push_back(constraints.fixed[node] ? -1 : variableCount_);
    if (constraints.fixed[node])
      positions_.col(node) = candidate.col(node);
    else
      variableCount_ += 3;
  }
  for (const solvers::MetricBounds& bounds : constraints.bounds) {
    scalings_.emplace_back();
    for (const Eigen::Matrix2d& ellipse : bounds.ellipses)
      scalings_.back().push_back(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(ellipse).operatorInverseSqrt());
  }
  const double size = (candidate.rowwise().maxCoeff() - candidate.rowwise().minCoeff()).norm();
  // Ipopt's tolerances are absolute, so the objective is brought to the order of 1.
  const double offset = (positions_ - candidate).norm();
  std::size_t rows = 0;
  for (const solvers::ConeElement& element : constraints.elements) rows += static_cast<std::size_t>(rowsOf(element));
  lambda_.assign(rows, 0);  // what it stays if Ipopt does not even begin
  scale_ = 1 / (constraints.masses.mean() * (offset > 0 ? offset * offset : size * size));
}

void ProjectionProgram::multipliers(solvers::ConeSolution& solution) const {
  std::vector<double> ellipses, directions;
  std::size_t row = 0;
  for (const solvers::ConeElement& element : constraints_.elements) {
    const Map f = mapOf(element);
    for (const Eigen::Matrix2d& t : scalings_[element.bounds]) {
      // The gradient F' (2 λ_tr I - 2 λ_det adj(I - C')) w' of the Lagrangian is F' Λ w'.
      const Eigen::Matrix2d rest = Eigen::Matrix2d::Identity() - (f * t).transpose() * (f * t);
      const double byTrace = std::max(0.0, lambda_[row]), byDeterminant = std::max(0.0, -lambda_[row + 1]);
      ellipses.insert(ellipses.end(), {2 / scale_ * (byTrace + byDeterminant * std::max(0.0, rest(1, 1))),
                                       2 / scale_ * (byTrace + byDeterminant * std::max(0.0, rest(0, 0))),
                                       -2 / scale_ * byDeterminant * rest(0, 1)});
      row += 2;
    }
    for (std::size_t k = 0; k < constraints_.bounds[element.bounds].directions.size(); ++k)
      directions.push_back(2 / scale_ * std::max(0.0, lambda_[row++]));
  }
  solution.ellipseMultipliers =
      Eigen::Map<const Eigen::Matrix3Xd>(ellipses.data(), 3, static_cast<Eigen::Index>(ellipses.size() / 3));
  solution.directionMultipliers =
      Eigen::Map<const Eigen::VectorXd>(directions.data(), static_cast<Eigen::Index>(directions.size()));
}

bool ProjectionProgram::get_nlp_info(Ipopt::Index& variables, Ipopt::Index& rows, Ipopt::Index& jacobian,
                                     Ipopt::Index& hessian, Ipopt::TNLP::IndexStyleEnum& style) {
  variables = variableCount_;
  rows = jacobian = 0;
  hessian = variableCount_;
  for (const solvers::ConeElement& element : constraints_.elements) {
    const int own = rowsOf(element);
    rows += own;
    for (int a = 0; a < 3; ++a) {
      if (variable_[element.nodes[a]] < 0) continue;
      jacobian += 3 * own;
      for (int b = 0; b <= a; ++b)
        if (variable_[element.nodes[b]] >= 0) hessian += a == b ? 6 : 9;
    }
  }
  style = C_STYLE;
  return true;
}

bool ProjectionProgram::get_bounds_info(Ipopt::Index variables, double* low, double* high, Ipopt::Index, double* rowLow,
                                        double* rowHigh) {
  std::fill_n(low, variables, -2e19);
  std::fill_n(high, variables, 2e19);
  for (const solvers::ConeElement& element : constraints_.elements) {
    for (std::size_t k = 0; k < scalings_[element.bounds].size(); ++k) {
      *rowLow++ = -2e19;
      *rowHigh++ = 2;
      *rowLow++ = 0;
      *rowHigh++ = 2e19;
    }
    for (std::size_t k = 0; k < constraints_.bounds[element.bounds].directions.size(); ++k) {
      *rowLow++ = -2e19;
      *rowHigh++ = 1;
    }
  }
  return true;
}

bool ProjectionProgram::get_starting_point(Ipopt::Index, bool, double* x, bool, double*, double*, Ipopt::Index, bool,
                                           double*) {
  for (int node = 0; node < constraints_.nodeCount; ++node)
    if (variable_[node] >= 0) Eigen::Map<Eigen::Vector3d>(x + variable_[node]) = positions_.col(node);
  return true;
}

bool ProjectionProgram::eval_f(Ipopt::Index, const double* x, bool, double& value) {
  take(x);
  value = 0.5 * scale_ * ((positions_ - candidate_).colwise().squaredNorm() * constraints_.masses).value();
  return true;
}

bool ProjectionProgram::eval_grad_f(Ipopt::Index, const double* x, bool, double* gradient) {
  take(x);
  for (int node = 0; node < constraints_.nodeCount; ++node)
    if (variable_[node] >= 0)
      Eigen::Map<Eigen::Vector3d>(gradient + variable_[node]) =
          scale_ * constraints_.masses[node] * (positions_.col(node) - candidate_.col(node));
  return true;
}

bool ProjectionProgram::eval_g(Ipopt::Index, const double* x, bool, Ipopt::Index, double* g) {
  take(x);
  for (const solvers::ConeElement& element : constraints_.elements) {
    const Map f = mapOf(element);
    for (const Eigen::Matrix2d& t : scalings_[element.bounds]) {
      const Eigen::Matrix2d metric = (f * t).transpose() * (f * t);
      *g++ = metric.trace();
      *g++ = (1 - metric(0, 0)) * (1 - metric(1, 1)) - metric(0, 1) * metric(0, 1);
    }
    for (const Eigen::Vector2d& v : constraints_.bounds[element.bounds].directions) *g++ = (f * v).squaredNorm();
  }
  return true;
}

bool ProjectionProgram::eval_jac_g(Ipopt::Index, const double* x, bool, Ipopt::Index, Ipopt::Index, Ipopt::Index* rows,
                                   Ipopt::Index* columns, double* values) {
  if (x) take(x);
  int row = 0;
  for (const solvers::ConeElement& element : constraints_.elements) {
    if (!values) {
      for (int r = 0; r < rowsOf(element); ++r, ++row)
        for (const int node : element.nodes)
          for (int i = 0; variable_[node] >= 0 && i < 3; ++i) {
            *rows++ = row;
            *columns++ = variable_[node] + i;
          }
      continue;
    }
    const Map f = mapOf(element);
    const auto add = [&](const Map& derivative) {  // of the function by F
      for (int k = 0; k < 3; ++k) {
        if (variable_[element.nodes[k]] < 0) continue;
        const Eigen::Vector3d part = derivative * element.weights[k];
        for (int i = 0; i < 3; ++i) *values++ = part[i];
      }
    };
    for (const Eigen::Matrix2d& t : scalings_[element.bounds]) {
      const Map scaled = f * t;
      add(2 * scaled * t);
      add(-2 * scaled * adjugateOfRest(scaled) * t);
    }
    for (const Eigen::Vector2d& v : constraints_.bounds[element.bounds].directions) add(2 * (f * v) * v.transpose());
  }
  return true;
}

bool ProjectionProgram::eval_h(Ipopt::Index, const double* x, bool, double factor, Ipopt::Index, const double* lambda,
                               bool, Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns, double* values) {
  if (x) take(x);
  for (int node = 0; node < constraints_.nodeCount; ++node)
    for (int i = 0; variable_[node] >= 0 && i < 3; ++i) {
      if (values)
        *values++ = factor * scale_ * constraints_.masses[node];
      else
        *rows++ = *columns++ = variable_[node] + i;
    }
  for (const solvers::ConeElement& element : constraints_.elements) {
    Eigen::Matrix<double, 6, 6> h = Eigen::Matrix<double, 6, 6>::Zero();
    if (values) h = hessianByMap(element, lambda);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b) {
        const int p = variable_[element.nodes[a]], q = variable_[element.nodes[b]];
        if (p < 0 || q < 0) continue;
        Eigen::Matrix3d block;
        if (values) {
          block.setZero();
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              block += element.weights[a][i] * element.weights[b][j] * h.block<3, 3>(3 * i, 3 * j);
        }
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j <= (a == b ? i : 2); ++j) {
            if (values) {
              *values++ = block(i, j);
            } else {
              *rows++ = std::max(p + i, q + j);
              *columns++ = std::min(p + i, q + j);
            }
          }
      }
  }
  return true;
}

bool ProjectionProgram::intermediate_callback(Ipopt::AlgorithmMode, Ipopt::Index iteration, double, double primal,
                                              double dual, double, double, double, double step, double, Ipopt::Index,
                                              const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) {
  iterations.push_back({iteration, dual, step, primal});
  return !context_.cancelRequested();
}

void ProjectionProgram::finalize_solution(Ipopt::SolverReturn status, Ipopt::Index, const double* x, const double*,
                                          const double*, Ipopt::Index rows, const double*, const double* lambda, double,
                                          const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) {
  take(x);
  lambda_.assign(lambda, lambda + rows);
  switch (status) {
    case Ipopt::SUCCESS: termination = base::TerminationType::converged; return;
    case Ipopt::STOP_AT_ACCEPTABLE_POINT:
      termination = base::TerminationType::iterationLimit;
      message = "Ipopt could not come nearer than what it calls acceptable.";
      return;
    case Ipopt::MAXITER_EXCEEDED:
    case Ipopt::CPUTIME_EXCEEDED:
      termination = base::TerminationType::iterationLimit;
      message = "Ipopt did not converge within its iterations.";
      return;
    case Ipopt::LOCAL_INFEASIBILITY:
      termination = base::TerminationType::infeasible;
      message = "Ipopt converged to a point that breaks the limits.";
      return;
    case Ipopt::USER_REQUESTED_STOP:
      termination = base::TerminationType::cancelled;
      message = "The projection was cancelled.";
      return;
    default: message = "Ipopt failed (status " + std::to_string(static_cast<int>(status)) + ").";
  }
}

int ProjectionProgram::rowsOf(const solvers::ConeElement& element) const {
  return static_cast<int>(2 * scalings_[element.bounds].size() + constraints_.bounds[element.bounds].directions.size());
}

void ProjectionProgram::take(const double* x) {
  for (int node = 0; node < constraints_.nodeCount; ++node)
    if (variable_[node] >= 0) positions_.col(node) = Eigen::Map<const Eigen::Vector3d>(x + variable_[node]);
}

ProjectionProgram::Map ProjectionProgram::mapOf(const solvers::ConeElement& element) const {
  Map f = Map::Zero();
  for (int k = 0; k < 3; ++k) f += positions_.col(element.nodes[k]) * element.weights[k].transpose();
  return f;
}

Eigen::Matrix2d ProjectionProgram::adjugateOfRest(const Map& scaled) {
  const Eigen::Matrix2d metric = scaled.transpose() * scaled;
  return Eigen::Matrix2d{{1 - metric(1, 1), metric(0, 1)}, {metric(0, 1), 1 - metric(0, 0)}};
}

ProjectionProgram::Square ProjectionProgram::hessianByMap(const solvers::ConeElement& element,
                                                          const double*& lambda) const {
  const auto spread = [](const Eigen::Matrix2d& m) {  // m ⊗ I
    Square result = Square::Zero();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) result.block<3, 3>(3 * i, 3 * j) = m(i, j) * Eigen::Matrix3d::Identity();
    return result;
  };
  const Map f = mapOf(element);
  Square sum = Square::Zero();
  for (const Eigen::Matrix2d& t : scalings_[element.bounds]) {
    const Map scaled = f * t;
    const Eigen::Vector3d first = scaled.col(0), second = scaled.col(1);
    Square h = 2 * lambda[0] * Square::Identity() - 2 * lambda[1] * spread(adjugateOfRest(scaled));
    h.topLeftCorner<3, 3>() -= 2 * lambda[1] * second * second.transpose();
    h.bottomRightCorner<3, 3>() -= 2 * lambda[1] * first * first.transpose();
    const Eigen::Matrix3d across = lambda[1] * (4 * first * second.transpose() - 2 * second * first.transpose());
    h.topRightCorner<3, 3>() += across;
    h.bottomLeftCorner<3, 3>() += across.transpose();
    sum += spread(t) * h * spread(t);
    lambda += 2;
  }
  for (const Eigen::Vector2d& v : constraints_.bounds[element.bounds].directions)
    sum += spread(2 * *lambda++ * v * v.transpose());
  return sum;
}

}  // namespace pliant::cloth
