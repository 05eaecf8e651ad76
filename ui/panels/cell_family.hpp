#pragma once

#include <QString>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace pliant::panels {

/// A kind of interlocking material, as the scene's format declares it.
struct CellFamily {
  std::string type;  ///< in the scene
  QString title;
  QString sentence;
};

/// All of which every parameter has a default.
const std::vector<CellFamily>& cellFamilies();
/// "4-in-1 chain mail" of "four_in_one".
QString cellFamilyTitle(const std::string& type);

/// A scene of one such material as it comes, with studies that tell most of it.
scene::Json sceneOfFamily(const CellFamily& family);

}  // namespace pliant::panels
