#include "ui/document/document.hpp"

#include <QFileInfo>
#include <QUndoCommand>
#include <algorithm>

#include "core/base/error.hpp"
#include "core/mechanics/design_parameter.hpp"
#include "core/mechanics/drive_frequency.hpp"
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

namespace {

/// The model of `after`, made from that of `before` by what changed at `pointer`. Throws base::InputError.
std::shared_ptr<const mechanics::Model> changedModel(const LoadedScene& before, const scene::Scene& after,
                                                     const std::string& pointer) {
  for (const auto& parameter : before.model->parameters) {
    if (parameter->pointer() != pointer) continue;
    return std::make_shared<mechanics::Model>(
        parameter->withValue(*before.model, valueIn(after, pointer).get<double>()));
  }
  // Drive frequencies are parameters that stand in studies, which may come, go, or change places.
  const bool mayMoveParameters = pointer.starts_with("/studies") &&
                                 std::count(pointer.begin(), pointer.end(), '/') <= 2 &&
                                 mechanics::driveFrequency(*before.model);
  return sameModel(after, before.scene) && !mayMoveParameters ? before.model : scene::buildModel(after);
}

/// The scene with `value` at `pointer`, on any thread. Throws base::InputError.
LoadedScene edited(const LoadedScene& before, const std::string& pointer, const Json& value) {
  scene::Scene after = before.scene.withValue(pointer, value);
  auto model = changedModel(before, after, pointer);
  return {std::move(after), std::move(model)};
}

}  // namespace

/// Puts one scene in the place of another; both are values, so undo cannot fail.
class Document::EditCommand final : public QUndoCommand {
 public:
  /// With `keepModels` both models are kept; without, the one is quickly made from the other.
  EditCommand(Document& document, LoadedScene after, std::string pointer, const QString& text, int mergeId,
              bool keepModels)
      : QUndoCommand(text),
        document_(document),
        before_{document.scene(), keepModels ? document.model() : nullptr},
        after_(std::move(after)),
        pointer_(std::move(pointer)),
        mergeId_(mergeId),
        keepModels_(keepModels) {}

  void undo() override { put(before_); }
  void redo() override {
    put(after_);
    if (!keepModels_) after_.model.reset();
  }
  int id() const override { return mergeId_; }

  bool mergeWith(const QUndoCommand* other) override {
    const auto* next = static_cast<const EditCommand*>(other);
    if (next->pointer_ != pointer_ || next->keepModels_ != keepModels_) return false;
    after_ = next->after_;
    if (valueIn(before_.scene, pointer_) == valueIn(after_.scene, pointer_)) setObsolete(true);
    return true;
  }

 private:
  void put(const LoadedScene& to) {
    const auto model = to.model ? to.model : changedModel({document_.scene(), document_.model()}, to.scene, pointer_);
    document_.replaceScene(to.scene, model, pointer_);
  }

  Document& document_;
  LoadedScene before_;
  LoadedScene after_;
  std::string pointer_;
  int mergeId_;
  bool keepModels_;
};

Document::Document(QObject* parent) : QObject(parent) { undoStack_.setUndoLimit(500); }

QString Document::title() const {
  if (isEmpty()) return {};
  const std::string title = scene_->json().value("title", std::string());
  if (!title.empty()) return QString::fromStdString(title);
  return file_.isEmpty() ? QString::fromStdString(scene_->name()) : QFileInfo(file_).completeBaseName();
}

void Document::adopt(LoadedScene loaded, const QString& file) {
  cancelEdits();
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

/// Whether no new model has to be built for an edit there: of a parameter the old one is changed, and what a study says
/// is none of its business.
bool Document::isQuick(const std::string& pointer) const {
  const auto& parameters = model_->parameters;
  return !mattersToModel(pointer) ||
         std::any_of(parameters.begin(), parameters.end(), [&](const auto& p) { return p->pointer() == pointer; });
}

bool Document::setValue(const std::string& pointer, const Json& value, const QString& text, int mergeId) {
  if (isEmpty()) return false;
  Edit edit{pointer, value, text, mergeId};
  if (pending_.empty() && (!background_ || isQuick(pointer))) return apply(edit);
  pending_.push_back(std::move(edit));
  if (pending_.size() > 1) return true;
  Q_EMIT editingChanged(true);
  applyNext();
  return true;
}

bool Document::apply(const Edit& edit) {
  try {
    push(edited({*scene_, model_}, edit.pointer, edit.value), edit, !isQuick(edit.pointer));
    return true;
  } catch (const base::InputError& error) {
    raise(base::Severity::warning, sentenceOf(error));
    return false;
  }
}

void Document::push(LoadedScene after, const Edit& edit, bool keepModels) {
  if (after.scene.json() == scene_->json()) return;
  undoStack_.push(new EditCommand(*this, std::move(after), edit.pointer, edit.text, edit.mergeId, keepModels));
}

void Document::applyNext() {
  while (!pending_.empty()) {
    const Edit edit = pending_.front();
    if (!isQuick(edit.pointer)) {
      background_([this, edit, ticket = ++ticket_, before = LoadedScene{*scene_, model_}]() -> std::function<void()> {
        std::optional<LoadedScene> after;
        QString sentence;
        try {
          after = edited(before, edit.pointer, edit.value);
        } catch (const std::exception& error) {
          sentence = QString::fromStdString(error.what());
        }
        return [this, edit, ticket, after, sentence] {
          if (ticket != ticket_ || pending_.empty()) return;
          pending_.pop_front();
          if (after)
            push(*after, edit, true);
          else
            raise(base::Severity::warning, sentence);
          applyNext();
        };
      });
      return;
    }
    pending_.pop_front();
    apply(edit);
  }
  Q_EMIT editingChanged(false);
}

void Document::cancelEdits() {
  if (pending_.empty()) return;
  ++ticket_;
  pending_.clear();
  Q_EMIT editingChanged(false);
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

void Document::replaceScene(const scene::Scene& scene, std::shared_ptr<const mechanics::Model> model,
                            const std::string& pointer) {
  model_ = std::move(model);
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
