#pragma once

#include <QString>
#include <QWidget>

namespace pliant::panels {

/// A bar to the right for a parameter that raises the amplitude, to the left for one that lowers it, long if it matters
/// much beside the others.
class EffectBar final : public QWidget {
 public:
  explicit EffectBar(QWidget* parent = nullptr);

  /// `share` in [-1, 1]: of the largest effect of all parameters.
  void setEffect(double share, const QString& text);
  void clear();
  double share() const { return share_; }
  QString text() const { return text_; }

  QSize sizeHint() const override { return {160, 16}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  double share_ = 0;
  QString text_;
};

}  // namespace pliant::panels
