#pragma once

#include <QWidget>
#include <memory>
#include <string>

#include "core/scene/study.hpp"
#include "ui/document/document.hpp"

class QComboBox;
class QLabel;
class QPushButton;
class QStackedLayout;

namespace pliant::plots {
class LinePlot;
}

namespace pliant::panels {

/// How limits of curvature depend on the size of a patch (thesis Fig. 4.8), while they are computed as well.
class SizePanel final : public QWidget {
  Q_OBJECT

 public:
  /// The type of the studies that it shows.
  static constexpr const char* shownType = "bending_size";

  explicit SizePanel(document::Document& document, QWidget* parent = nullptr);

  std::string study() const;
  void setStudy(const std::string& name);
  plots::LinePlot* plot() const { return plot_; }
  /// CSV, or a picture, by the extension. Throws base::InputError.
  void exportTo(const QString& file);

 Q_SIGNALS:
  void runRequested(const std::string& study);

 private:
  void fillStudies();
  void refresh();
  void chooseExport();

  document::Document& document_;
  std::shared_ptr<const scene::Result> result_;
  QStackedLayout* pages_;
  QLabel *note_, *stale_;
  QPushButton* run_;
  QComboBox* studies_;
  plots::LinePlot* plot_;
};

}  // namespace pliant::panels
