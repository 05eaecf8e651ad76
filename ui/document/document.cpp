#include "ui/document/document.hpp"

#include <QFileInfo>
#include <QUndoCommand>
#include <algorithm>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/scene/model_builder.hpp"
#include "ui/document/relocation.hpp"

namespace pliant::document {

namespace {

QString sentenceOf(const base::InputError& error) { return QString::fromStdString(error.what()); }

Json valueIn(const scene::Scene& scene, const std::string& pointer) {
  const Json::json_pointer path(pointer);
  return scene.normalized().contains(path) ? scene.normalized().at(path) : Json();
}

}  // namespace

LoadedScene loadScene(const QString& file) {
  scene::Scene scene = scene::Scene::load(file.toStdString());
  auto model = scene::buildModel(scene);
  return {std::move(scene), std::move(model)};
}

/// Puts one scene in the place of another; both are values, so undo cannot fail.
class Document::EditCommand final : public QUndoCommand {
 public:
  EditCommand(Document& document, scene::Scene after, std::string pointer, const QString& text, int mergeId)
      : QUndoCommand(text),
        document_(document),
        before_(document.scene()),
        after_(std::move(after)),
        pointer_(std::move(pointer)),
        mergeId_(mergeId) {}

  void undo() override { document_.replaceScene(before_, pointer_); }
  void redo() override { document_.replaceScene(after_, pointer_); }
  int id() const override { return mergeId_; }

  bool mergeWith(const QUndoCommand* other) override {
    const auto* next = static_cast<const EditCommand*>(other);
    if (next->pointer_ != pointer_) return false;
    after_ = next->after_;
    if (valueIn(before_, pointer_) == valueIn(after_, pointer_)) setObsolete(true);
    return true;
  }

 private:
  Document& document_;
  scene::Scene before_;
  scene::Scene after_;
  std::string pointer_;
  int mergeId_;
};

Document::Document(QObject* parent) : QObject(parent) { undoStack_.setUndoLimit(500); }

QString Document::title() const {
  if (isEmpty()) return {};
  const std::string title = scene_->json().value("title", std::string());
  if (!title.empty()) return QString::fromStdString(title);
  return file_.isEmpty() ? QString::fromStdString(scene_->name()) : QFileInfo(file_).completeBaseName();
}

void Document::adopt(LoadedScene loaded, const QString& file) {
  undoStack_.clear();
  studies_.clear();
  scene_ = std::move(loaded.scene);
  savedScene_ = scene_;
  model_ = std::move(loaded.model);
  file_ = file;
  refreshStudies();
  Q_EMIT sceneReplaced();
  Q_EMIT fileChanged();
}

bool Document::open(const QString& file) {
  try {
    adopt(loadScene(file), file);
    return true;
  } catch (const base::InputError& error) {
    raise(base::Severity::warning, sentenceOf(error));
    return false;
  }
}

bool Document::saveAs(const QString& file) {
  try {
    const auto target = std::filesystem::absolute(file.toStdString());
    scene::Scene moved = relocated(*scene_, target.parent_path());
    moved.save(target);
    savedScene_ = scene_;
  } catch (const std::exception& error) {
    raise(base::Severity::warning, QString::fromStdString(error.what()));
    return false;
  }
  file_ = file;
  undoStack_.setClean();
  Q_EMIT fileChanged();
  return true;
}

bool Document::setValue(const std::string& pointer, const Json& value, const QString& text, int mergeId) {
  if (isEmpty()) return false;
  try {
    scene::Scene after = scene_->withValue(pointer, value);
    if (after.json() == scene_->json()) return true;
    rebuiltModel(after, pointer);  // refuses what cannot be built before anything changes
    undoStack_.push(new EditCommand(*this, std::move(after), pointer, text, mergeId));
    return true;
  } catch (const base::InputError& error) {
    raise(base::Severity::warning, sentenceOf(error));
    return false;
  }
}

QString Document::refusal(const std::string& pointer, const Json& value) const {
  try {
    scene_->withValue(pointer, value);
    return {};
  } catch (const base::InputError& error) {
    return QString::fromStdString(error.problem());
  }
}

Json Document::valueAt(const std::string& pointer) const { return isEmpty() ? Json() : valueIn(*scene_, pointer); }

Json Document::savedValueAt(const std::string& pointer) const {
  return savedScene_ ? valueIn(*savedScene_, pointer) : Json();
}

const StudyState* Document::study(const std::string& name) const {
  const auto found =
      std::find_if(studies_.begin(), studies_.end(), [&](const auto& study) { return study.name == name; });
  return found == studies_.end() ? nullptr : &*found;
}

StudyState* Document::findStudy(const std::string& name) { return const_cast<StudyState*>(study(name)); }

std::shared_ptr<const mechanics::Model> Document::rebuiltModel(const scene::Scene& scene,
                                                               const std::string& pointer) const {
  for (const auto& parameter : model_->parameters) {
    if (parameter->pointer() != pointer) continue;
    return std::make_shared<mechanics::Model>(parameter->withValue(*model_, valueIn(scene, pointer).get<double>()));
  }
  return sameModel(scene, *scene_) ? model_ : scene::buildModel(scene);
}

void Document::replaceScene(const scene::Scene& scene, const std::string& pointer) {
  try {
    model_ = rebuiltModel(scene, pointer);
  } catch (const base::InputError& error) {
    // A mesh file beside the scene may have changed since this scene was last built.
    raise(base::Severity::warning, sentenceOf(error));
  }
  scene_ = scene;
  refreshStudies();
  Q_EMIT sceneEdited(pointer);
}

void Document::refreshStudies() {
  std::vector<StudyState> before = std::move(studies_);
  studies_.clear();
  for (const std::string& name : scene::studyNames(*scene_)) {
    const auto known =
        std::find_if(before.begin(), before.end(), [&](const auto& study) { return study.name == name; });
    StudyState state;
    if (known != before.end()) state = std::move(*known);
    state.name = name;
    for (const Json& entry : scene_->normalized().at("studies"))
      if (entry.value("name", "") == name) state.type = entry.value("type", "");
    state.stale = state.result && state.solvedScene && !sameStudy(*scene_, *state.solvedScene, name);
    if (state.status == StudyStatus::solved && state.stale) state.status = StudyStatus::stale;
    if (state.status == StudyStatus::stale && !state.stale) state.status = StudyStatus::solved;
    studies_.push_back(std::move(state));
  }
}

}  // namespace pliant::document
