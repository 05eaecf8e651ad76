#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/cloth/stretch_limit.hpp"
#include "core/solvers/cone_program.hpp"

namespace pliant::cloth {

/// A triangle of a sheet with what its material directions are at rest.
struct SheetTriangle {
  std::array<int, 3> nodes;
  std::array<Eigen::Vector2d, 3> gradients;  ///< g_k [1/m]: F = Σ x_k g_kᵀ, in material coordinates
  int limit = -1;                            ///< index into LimitedSheet::limits, -1: none
};

/// Triangles that share stretch limits.
struct LimitedSheet {
  int nodeCount = 0;
  std::vector<SheetTriangle> triangles;
  std::vector<StretchLimit> limits;
  std::vector<LimitConstraints> constraints;  ///< of each limit
  Eigen::VectorXd masses;                     ///< lumped, per node [kg]
  std::vector<char> fixed;                    ///< per node
};

/// g_k of a triangle whose corners at rest are p (3 x 3, a column a corner) and whose material's first direction is the
/// projection of `direction` onto its plane. Throws base::InputError (location empty) if the triangle has no area, or
/// the direction is normal to it.
std::array<Eigen::Vector2d, 3> shapeGradients(const Eigen::Matrix3d& corners, const Eigen::Vector3d& direction);

/// F (3 x 2) of a triangle.
Eigen::Matrix<double, 3, 2> deformationGradient(const SheetTriangle& triangle, const Eigen::Matrix3Xd& positions);

/// The largest stretch over its limit, over all directions, per triangle (0 where there is no limit): 1 is at the
/// limit.
Eigen::VectorXd stretchRatios(const LimitedSheet& sheet, const Eigen::Matrix3Xd& positions);

/// The largest stretch in the directions α = π i / count over the chosen triangles (all if empty), size count.
Eigen::VectorXd reachedStretch(const LimitedSheet& sheet, const Eigen::Matrix3Xd& positions, int count,
                               const std::vector<int>& triangles = {});

/// The limits of a sheet as a cone program's constraints: an element for each limited triangle, in their order.
enum class ProjectionNorm { mass, identity };
struct SheetCones {
  solvers::ConeConstraints constraints;
  std::vector<int> triangles;  ///< of each element
};
SheetCones sheetCones(const LimitedSheet& sheet, ProjectionNorm norm);

struct ProjectionOptions {
  solvers::ConeProgramOptions cone;
  double violation = 1e-6;  ///< Gauss-Seidel: at which it stops
  int sweeps = 100'000;     ///< Gauss-Seidel: after which it gives up
};

/// Positions that keep the limits, near those that are asked for. What every method returns is a ConeSolution, so that
/// they can be compared; multipliers and the bound are those of the method, or empty and -infinity if it has none.
class StrainLimiter {
 public:
  virtual ~StrainLimiter() = default;
  virtual std::string_view name() const = 0;
  virtual solvers::ConeSolution project(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                        base::ExecutionContext& context) = 0;
};

/// "cone" (the global optimum: solvers::ConeProgram), "gauss_seidel" (triangle after triangle, thesis 3.5.1 after
/// Thomaszewski et al. 2009), "nonlinear_program" (Ipopt). Throws base::InputError for another name.
std::unique_ptr<StrainLimiter> makeStrainLimiter(std::string_view method, const solvers::ConeConstraints& constraints,
                                                 const ProjectionOptions& options);

}  // namespace pliant::cloth
