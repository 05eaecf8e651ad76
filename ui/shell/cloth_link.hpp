#pragma once

#include <QObject>
#include <QTimer>
#include <memory>
#include <string>

#include "core/scene/cloth_result.hpp"
#include "ui/document/document.hpp"

namespace pliant::panels {
class EnergyPanel;
class LimitPanel;
}  // namespace pliant::panels

namespace pliant::viewport {
class Viewport;
}

namespace pliant::shell {

/// Shows what cloth studies find in the viewport: the study that runs, else the one that was chosen. The limit panel
/// shows what the frame on show reaches, of the picked node's triangles or of all, and the charts its instant.
class ClothLink final : public QObject {
  Q_OBJECT

 public:
  ClothLink(document::Document& document, viewport::Viewport& viewport, panels::LimitPanel& limits,
            panels::EnergyPanel& energies, QObject* parent = nullptr);

  /// Empty: none.
  const std::string& study() const { return study_; }
  void showStudy(const std::string& name);
  /// A live cloth has the viewport, and what studies find is not shown.
  void setLive(bool live);

 private:
  void follow(const std::string& name);
  void refresh();
  void refreshReached();
  QString caption() const;

  document::Document& document_;
  viewport::Viewport& viewport_;
  panels::LimitPanel& limits_;
  panels::EnergyPanel& energies_;
  std::string study_;
  std::shared_ptr<const scene::ClothResult> result_;
  QTimer reachedTimer_;  ///< a frame that is played past is not worth the work
  int node_ = -1;        ///< picked
  bool growing_ = false;
  bool live_ = false;
};

/// Whether the scene has a cloth: limits of stretch, or a study of one.
bool hasCloth(const document::Document& document);

}  // namespace pliant::shell
