#pragma once

#include <QWidget>

#include "ui/jobs/motion_session.hpp"

class QFormLayout;
class QLabel;

namespace pliant::panels {

/// What is known of the selected node: where it rests, whether it is free, how it swings.
class Inspector final : public QWidget {
  Q_OBJECT

 public:
  Inspector(document::Document& document, jobs::MotionSession& session, QWidget* parent = nullptr);

  QString text() const;

 private:
  void refresh();

  document::Document& document_;
  jobs::MotionSession& session_;
  QLabel* node_;
  QLabel* place_;
  QLabel* kind_;
  QLabel* path_;
  QLabel* reach_;
};

}  // namespace pliant::panels
