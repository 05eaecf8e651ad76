#pragma once

#include <QWidget>

#include "ui/jobs/job_runner.hpp"

class QGridLayout;

class QGridLayout;
class QLabel;
class QPushButton;

namespace pliant::shell {

/// A shipped scene.
struct GalleryScene {
  QString file;
  QString title;
  QString description;
};

/// The scenes below `scenes/`, sorted by title; unreadable ones are left out.
std::vector<GalleryScene> shippedScenes();

/// What an empty window shows: the scenes that come with Pliant, each with a picture of its shape. A click opens one.
class Gallery final : public QWidget {
  Q_OBJECT

 public:
  explicit Gallery(jobs::JobRunner& quick, QWidget* parent = nullptr);

 Q_SIGNALS:
  void sceneChosen(const QString& file);
  void openRequested();
  void materialsRequested();

 protected:
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Card {
    QString file;
    QPushButton* button = nullptr;
    QLabel* picture = nullptr;
  };

  void drawPictures();
  void layOut();

  jobs::JobRunner& quick_;
  std::vector<Card> cards_;
  QGridLayout* grid_ = nullptr;
};

}  // namespace pliant::shell
