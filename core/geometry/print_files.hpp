#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/geometry/surface_mesh.hpp"

namespace pliant::geometry {

/// A copy of a body, turned and moved.
struct BodyCopy {
  int body = 0;  ///< index in the list of bodies
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
};

/// All copies as one mesh [m].
SurfaceMesh assembled(const std::vector<SurfaceMesh>& bodies, const std::vector<BodyCopy>& copies);

/// Binary STL in millimetres, as printers read it. False once cancelled, without a file. Throws base::InputError with
/// the file's name as location.
bool writePrintStl(const std::vector<SurfaceMesh>& bodies, const std::vector<BodyCopy>& copies,
                   const std::filesystem::path& file, const base::ExecutionContext* context = nullptr);

/// 3MF in millimetres: each body once as an object, and each copy as an item of the build, so that files stay small and
/// copies separate ("3D Manufacturing Format, Core Specification", 1.3). Bodies may have names, which must not hold
/// quotes, "<" or "&". Throws base::InputError as above.
void writePrint3mf(const std::vector<SurfaceMesh>& bodies, const std::vector<BodyCopy>& copies,
                   const std::filesystem::path& file, const std::vector<std::string>& names = {});

}  // namespace pliant::geometry
