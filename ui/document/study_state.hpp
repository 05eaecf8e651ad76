#pragma once

#include <QString>
#include <memory>
#include <optional>
#include <string>

#include "core/scene/study.hpp"

namespace pliant::document {

/// What a designer sees of a study.
enum class StudyStatus { none, waiting, running, solved, stale, cancelled, failed };

/// One study of the scene with what has been computed of it.
struct StudyState {
  std::string name;
  std::string type;  ///< "type" of the study, such as "periodic_motion"
  StudyStatus status = StudyStatus::none;
  /// Whether the scene says something else by now than when `result` was computed.
  bool stale = false;
  std::shared_ptr<const scene::Result> result;  ///< what there is, complete or not; null: nothing yet
  QString message;                              ///< why it ended early; else empty
  std::optional<scene::Scene> solvedScene;      ///< what `result` was computed from
};

/// Whether both scenes have the same model: everything is equal but texts, studies, and what only cloth reads.
bool sameModel(const scene::Scene& a, const scene::Scene& b);

/// The same of normalised scenes.
bool sameModel(const scene::Json& a, const scene::Json& b);

/// Whether the model depends on the value at this pointer.
bool mattersToModel(const std::string& pointer);

/// Whether a study of this name gives the same result in both scenes.
bool sameStudy(const scene::Scene& a, const scene::Scene& b, const std::string& study);

/// Whether a study of this type is one of a cloth.
bool isClothStudy(const std::string& type);

/// "not run", "waiting", "running", "solved", "stale", "cancelled", "failed".
QString toString(StudyStatus status);

}  // namespace pliant::document
