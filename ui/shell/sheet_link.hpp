#pragma once

#include <QObject>
#include <memory>
#include <string>

#include "core/scene/macro_result.hpp"
#include "ui/document/document.hpp"

namespace pliant::panels {
class SheetPanel;
}
namespace pliant::render {
class MacroView;
}
namespace pliant::viewport {
class SheetBrush;
class Viewport;
}  // namespace pliant::viewport

namespace pliant::shell {

/// Shows large pieces of interlocking materials in the viewport as their panel says: coloured, picked, in motion, with
/// their elements beside them.
class SheetLink final : public QObject {
  Q_OBJECT

 public:
  SheetLink(document::Document& document, viewport::Viewport& viewport, panels::SheetPanel& sheets,
            QObject* parent = nullptr);
  ~SheetLink() override;

  /// `growing`: its study runs, and there are to be more frames.
  void show(const std::shared_ptr<const scene::MacroResult>& sheet, bool growing);
  bool isShown() const;
  void setStale(bool stale);
  /// Another scene: its sheets are fitted anew.
  void forget() { framed_ = false; }

 private:
  void showCaption();
  void showPaint();
  /// Colours, picks and marks as the panel says.
  void refresh();

  document::Document& document_;
  viewport::Viewport& viewport_;
  panels::SheetPanel& sheets_;
  std::shared_ptr<render::MacroView> view_;
  viewport::SheetBrush* brush_;
  bool growing_ = false;
  bool framed_ = false;  ///< the view has been turned once for this scene
};

}  // namespace pliant::shell
