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
  bool missing = false;    ///< optional and not in the file
  std::string list;        ///< key, if this is a list to which entries can be added
  bool removable = false;  ///< an entry of a list that can go
  SceneItem* parent = nullptr;
  std::vector<std::unique_ptr<SceneItem>> children;

  int row() const;
  /// The item itself or one below it with this pointer; null if there is none.
  SceneItem* find(const std::string& wanted);
};

/// The lines of a scene, from its declaration: every key that the file may have. Of empty lists only those are there to
/// which entries can be added.
std::unique_ptr<SceneItem> makeSceneItems(const scene::Scene& scene);

}  // namespace pliant::panels
