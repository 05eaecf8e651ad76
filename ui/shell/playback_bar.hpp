#pragma once

#include <QWidget>

class QAction;
class QComboBox;
class QLabel;
class QSlider;

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

/// Plays the motion of a viewport, and shows and sets the place in its period; of a cloth, the time.
class PlaybackBar final : public QWidget {
  Q_OBJECT

 public:
  PlaybackBar(viewport::Viewport& viewport, QAction* playAction, QWidget* parent = nullptr);

 private:
  void showTau(double tau);
  void showTime(double time);
  /// Of a motion, or of a cloth.
  void fillSpeeds();

  viewport::Viewport& viewport_;
  QSlider* scrub_;
  QLabel* place_;
  QComboBox* speed_;
  bool ofFrames_ = false;
};

}  // namespace pliant::shell
