#pragma once

#include <QWidget>

#include "ui/document/document.hpp"
#include "ui/jobs/job_runner.hpp"

class QGridLayout;
class QLabel;
class QPushButton;
class QRadioButton;

namespace pliant::shell {

/// The kinds of interlocking material, each with a picture of it, its name and a sentence. A click puts one in the
/// place of the scene's material, or opens a scene of it.
class ElementGallery final : public QWidget {
  Q_OBJECT

 public:
  ElementGallery(document::Document& document, jobs::JobRunner& quick, QWidget* parent = nullptr);

  /// Which of the scene's materials a click replaces; -1: none, a scene is opened.
  void setTarget(int cell);
  /// The card of a kind, as the scene's format calls it; null: there is none.
  QPushButton* card(const std::string& type) const;
  QRadioButton* opensScene() const { return opens_; }

 Q_SIGNALS:
  /// A kind was chosen; `target` is the entry of "interlocking_cells" to be replaced, or -1.
  void familyChosen(const std::string& type, int target);
  void closeRequested();

 protected:
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Card {
    std::string type;
    QPushButton* button = nullptr;
    QLabel* picture = nullptr;
  };
  void drawPictures();
  void layOut();

  document::Document& document_;
  jobs::JobRunner& quick_;
  QRadioButton* replaces_;
  QRadioButton* opens_;
  QPushButton* close_;
  QGridLayout* grid_;
  std::vector<Card> cards_;
  int target_ = -1;
};

/// Opens a scene of one kind of material that is no file yet. Throws base::InputError.
document::LoadedScene familyScene(const std::string& type);

}  // namespace pliant::shell
