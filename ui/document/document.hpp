#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/execution_context.hpp"
#include "core/mechanics/model.hpp"
#include "core/scene/scene.hpp"
#include "ui/document/study_state.hpp"

namespace pliant::document {

using scene::Json;

/// A scene with the model it describes, both of them valid.
struct LoadedScene {
  scene::Scene scene;
  std::shared_ptr<const mechanics::Model> model;
};

/// Reads a scene file and builds its model, on any thread. Throws base::InputError.
LoadedScene loadScene(const QString& file);

/// Work for another thread; what it returns is called on the UI thread.
using BackgroundWork = std::function<std::function<void()>()>;

/// The open scene, its edits, and the results of its studies. Lives on the UI thread.
///
/// The scene is a value. An edit puts another value at one JSON pointer and is one undo step; the scene checks it, and
/// what it refuses changes nothing and raises a message. Scene and model always belong together: an edit that needs
/// another model waits until that is built, in the background where `setBackground` says how, and later edits wait
/// behind it. A design parameter or a study is edited at once. Results remember the scene they were computed from: an
/// edit makes them stale, and undoing it makes them fresh again.
class Document final : public QObject {
  Q_OBJECT

 public:
  explicit Document(QObject* parent = nullptr);

  bool isEmpty() const { return !scene_.has_value(); }
  /// Not empty.
  const scene::Scene& scene() const { return *scene_; }
  /// The model of the scene as it is now; null if empty.
  std::shared_ptr<const mechanics::Model> model() const { return model_; }
  QUndoStack& undoStack() { return undoStack_; }

  QString file() const { return file_; }
  /// The scene's title, or its file's name.
  QString title() const;
  bool isModified() const { return !undoStack_.isClean(); }

  /// Shows another scene. What was open is dropped, edits and results included.
  void adopt(LoadedScene loaded, const QString& file);
  /// Reads `file` and adopts it. On bad input raises a message, keeps what is open and returns false.
  bool open(const QString& file);
  /// Writes the scene to `file` and takes that as its file. Raises a message and returns false if it cannot be written.
  bool saveAs(const QString& file);

  /// How models are built beside the UI thread; without it they are built where the edit is made.
  void setBackground(std::function<void(BackgroundWork)> run) { background_ = std::move(run); }

  /// Puts `value` at `pointer` as one undo step described by `text`. Successive edits of the same pointer with the same
  /// `mergeId` (not -1) become one step. Returns false, having raised a message, if the scene refuses the value; what
  /// is refused in the background raises it later.
  bool setValue(const std::string& pointer, const Json& value, const QString& text, int mergeId = -1);
  /// Whether an edit waits for its model.
  bool isEditing() const { return !pending_.empty(); }
  /// Drops the edits that still wait.
  void cancelEdits();

  /// The normalised value (SI) at `pointer`, or null.
  Json valueAt(const std::string& pointer) const;
  /// The same in the scene as it was opened or last saved.
  Json savedValueAt(const std::string& pointer) const;

  const std::vector<StudyState>& studies() const { return studies_; }
  /// Null if the scene has no such study.
  const StudyState* study(const std::string& name) const;

  void setStudyWaiting(const std::string& name);
  void setStudyRunning(const std::string& name);
  /// What a running study has so far.
  void setPartialResult(const std::string& name, std::shared_ptr<const scene::Result> result,
                        const scene::Scene& solvedScene);
  /// The status follows from the result's termination.
  void setResult(const std::string& name, std::shared_ptr<const scene::Result> result, const scene::Scene& solvedScene);
  /// A study that ended without a result, or was dropped before it began (empty sentence); keeps what there was before.
  void setStudyEnded(const std::string& name, const QString& sentence);

  void raise(base::Severity severity, const QString& sentence) { Q_EMIT messageRaised(severity, sentence); }

 Q_SIGNALS:
  /// Another scene is open.
  void sceneReplaced();
  /// An edit, an undo or a redo changed the value at `pointer`. Comes after the model was rebuilt.
  void sceneEdited(const std::string& pointer);
  /// Edits begin to wait for a model, or no edit waits any more.
  void editingChanged(bool editing);
  void studyChanged(const std::string& name);
  void fileChanged();
  void messageRaised(pliant::base::Severity severity, const QString& sentence);

 private:
  friend class EditCommand;
  class EditCommand;

  struct Edit {
    std::string pointer;
    Json value;
    QString text;
    int mergeId = -1;
  };

  bool isQuick(const std::string& pointer) const;
  bool apply(const Edit& edit);
  void applyNext();
  void push(LoadedScene after, const Edit& edit, bool keepModels);
  void replaceScene(const scene::Scene& scene, std::shared_ptr<const mechanics::Model> model,
                    const std::string& pointer);
  void refreshStudies();
  StudyState* findStudy(const std::string& name);

  std::optional<scene::Scene> scene_;
  std::optional<scene::Scene> savedScene_;
  std::shared_ptr<const mechanics::Model> model_;
  QString file_;
  std::function<void(BackgroundWork)> background_;
  std::deque<Edit> pending_;  ///< the first is being built
  int ticket_ = 0;            ///< of the build under way; others come too late
  QUndoStack undoStack_;
  std::vector<StudyState> studies_;
};

}  // namespace pliant::document
