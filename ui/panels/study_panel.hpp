#pragma once

#include <QWidget>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/study.hpp"
#include "ui/document/document.hpp"
#include "ui/panels/study_choice.hpp"

class QHBoxLayout;
class QLabel;
class QPushButton;
class QStackedLayout;
class QToolButton;

namespace pliant::panels {

/// A plot of what studies of some types have found, which one is chosen above it, or a button to run it while there is
/// nothing to show.
class StudyPanel : public QWidget {
  Q_OBJECT

 public:
  /// Whether it shows results of studies of this type.
  bool shows(const std::string& type) const;
  std::string study() const { return studies_->name(); }
  void setStudy(const std::string& name);
  /// A table, or a picture, by the extension. Throws base::InputError.
  virtual void exportTo(const QString& file) = 0;

 Q_SIGNALS:
  /// Somebody chose which one is shown.
  void studyChosen(const std::string& study);
  void runRequested(const std::string& study);

 protected:
  /// `types` of studies, in the order in which they are offered.
  StudyPanel(document::Document& document, std::vector<std::string> types, QWidget* parent);

  /// What stands where nothing has been computed: without such a study, and with one of this name.
  virtual QString absentNote() const = 0;
  virtual QString waitingNote(const QString& study) const = 0;
  /// Puts what the study, or null, has found into the plot; whether there is something to see.
  virtual bool present(const document::StudyState* study) = 0;
  static bool isBusy(const document::StudyState& study);
  /// Presents anew.
  void refresh();

  /// Below the head; to be called once, at the end of a constructor.
  void setPlot(QWidget* plot);
  /// Where controls of the plot go, right of the choice of the study.
  QHBoxLayout* switches() const { return switches_; }
  /// In the head's right end.
  QToolButton* addButton(const QString& text, const QString& tooltip);
  /// Runs something that may throw base::InputError, which is told.
  void attempt(const std::function<void()>& act);

  document::Document& document_;

 private:
  void chooseExport();

  std::vector<std::string> types_;
  QStackedLayout* pages_;
  QLabel *note_, *stale_;
  QPushButton* run_;
  StudyChoice* studies_;
  QHBoxLayout *head_, *switches_;
  QWidget* shown_;
};

}  // namespace pliant::panels
