#include "ui/panels/value_field.hpp"

#include <QKeyEvent>

namespace pliant::panels {

ValueField::ValueField(QWidget* parent) : QLineEdit(parent) {
  setAlignment(Qt::AlignRight);
  setFrame(false);
  setFocusPolicy(Qt::ClickFocus);
  endEditing();
}

void ValueField::setTexts(const QString& shown, const QString& exact) {
  shown_ = shown;
  exact_ = exact;
  if (isReadOnly()) setText(shown);
}

void ValueField::showTransient(const QString& text) {
  if (isReadOnly()) setText(text);
}

void ValueField::beginEditing() {
  setReadOnly(false);
  setFrame(true);
  setCursor(Qt::IBeamCursor);
  setText(exact_);
  setFocus();
  selectAll();
}

void ValueField::endEditing() {
  setReadOnly(true);
  setFrame(false);
  setCursor(Qt::ArrowCursor);
  setText(shown_);
  deselect();
}

void ValueField::mouseDoubleClickEvent(QMouseEvent* event) {
  if (isReadOnly())
    beginEditing();
  else
    QLineEdit::mouseDoubleClickEvent(event);
}

void ValueField::keyPressEvent(QKeyEvent* event) {
  const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (isReadOnly()) {
    if (enter)
      beginEditing();
    else
      QLineEdit::keyPressEvent(event);
    return;
  }
  if (enter) {
    const QString entered = text();
    endEditing();
    if (entered != exact_) Q_EMIT typed(entered);
  } else if (event->key() == Qt::Key_Escape) {
    endEditing();
  } else {
    QLineEdit::keyPressEvent(event);
  }
}

void ValueField::focusOutEvent(QFocusEvent* event) {
  QLineEdit::focusOutEvent(event);
  if (!isReadOnly()) endEditing();
}

}  // namespace pliant::panels
