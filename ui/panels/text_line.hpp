#pragma once

#include <QWidget>

namespace pliant::panels {

/// One line of text that changes many times a second: unlike a QLabel it keeps its size, so that a new text never lays
/// out the window anew. Elided where it does not fit.
class TextLine final : public QWidget {
 public:
  explicit TextLine(QWidget* parent = nullptr);

  const QString& text() const { return text_; }
  void setText(const QString& text, const QColor& color);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {0, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString text_;
  QColor color_;
};

}  // namespace pliant::panels
