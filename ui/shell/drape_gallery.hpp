#pragma once

#include <QImage>
#include <QStringList>
#include <QWidget>
#include <vector>

#include "ui/jobs/job_runner.hpp"
#include "ui/render/drape_figure.hpp"

class QToolButton;

namespace pliant::shell {

/// Drapes side by side, their stretch limits above (thesis Fig. 3.2): at first those of the shipped drapes, which are
/// computed when they are first seen. What is on the screen is the figure that is exported.
class DrapeGallery final : public QWidget {
  Q_OBJECT

 public:
  /// Computes in `studies`, draws in `quick`.
  DrapeGallery(jobs::JobRunner& studies, jobs::JobRunner& quick, QWidget* parent = nullptr);

  /// A cloth as it is.
  void add(const render::Drape& drape);
  /// The first drape, or motion, of a scene; computes it.
  void addScene(const QString& file);
  void remove(int index);
  /// The scenes of Fig. 3.2 that come with Pliant.
  static QStringList shippedDrapes();
  /// Adds scenes, unless there is something already or this was done before.
  void fillAtFirst(const QStringList& scenes);
  /// Ends what is being computed; what there is stays.
  void cancel();

  std::vector<render::Drape> drapes() const;
  /// Whether any of them is still being computed.
  bool isComputing() const;
  /// Draws the figure into a PNG file in the background.
  void exportTo(const QString& file);

 Q_SIGNALS:
  void addRequested();
  void exportRequested();
  void closeRequested();
  void messageRaised(pliant::base::Severity severity, const QString& sentence);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  struct Entry {
    int number = 0;  ///< unique
    render::Drape drape;
    bool computing = false;
    jobs::JobRunner::Id job = 0;
    QToolButton* close = nullptr;
  };

  Entry& append(const render::Drape& drape);
  void finish(jobs::JobRunner::Id id, const QString& topic, jobs::JobOutcome outcome, const QString& sentence);
  Entry* find(int number);
  void change(int number, const render::Drape& drape, bool computing);
  void redraw();
  void placeButtons();
  QRect figurePlace() const;
  void chooseScene();

  jobs::JobRunner& studies_;
  jobs::JobRunner& quick_;
  QWidget* head_;
  QToolButton* exporter_;
  std::vector<Entry> entries_;
  int lastNumber_ = 0;
  jobs::JobRunner::Id export_ = 0;  ///< the last
  bool filled_ = false;
  QImage figure_;
};

}  // namespace pliant::shell
