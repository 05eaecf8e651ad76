#pragma once

#include <QString>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace pliant::panels {

/// One line of the scene tree: a property with its value, or a group of them.
struct SceneItem {
  std::string pointer;
  QString name;
  QString value;  ///< as shown; empty for groups
  QString study;  ///< name, if this is a study
  const base::ParameterSpec* spec = nullptr;
  bool editable = false;
  bool missing = false;  ///< optional and not in the file
  SceneItem* parent = nullptr;
  std::vector<std::unique_ptr<SceneItem>> children;

  int row() const;
  /// The item itself or one below it with this pointer; null if there is none.
  SceneItem* find(const std::string& wanted);
};

/// The lines of a scene, from its declaration: every key that the file may have, empty lists left out.
std::unique_ptr<SceneItem> makeSceneItems(const scene::Scene& scene);

}  // namespace pliant::panels
