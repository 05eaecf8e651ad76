#include "ui/panels/study_choice.hpp"

#include <QSignalBlocker>
#include <algorithm>

namespace pliant::panels {

StudyChoice::StudyChoice(document::Document& document, Belongs belongs, QWidget* parent)
    : QComboBox(parent), document_(document), belongs_(std::move(belongs)) {
  setToolTip(tr("Which study is shown"));
  setAccessibleName(tr("Study on show"));
  setSizeAdjustPolicy(AdjustToContents);
  connect(this, &QComboBox::activated, this, &StudyChoice::chosen);
  connect(&document_, &document::Document::sceneReplaced, this, &StudyChoice::fill);
  connect(&document_, &document::Document::sceneEdited, this, &StudyChoice::fill);
  fill();
}

void StudyChoice::choose(const std::string& name) {
  const int index = findText(QString::fromStdString(name));
  if (index < 0 || index == currentIndex()) return;
  setCurrentIndex(index);
  Q_EMIT chosen();
}

void StudyChoice::fill() {
  const QString before = currentText();
  {
    const QSignalBlocker block(this);
    clear();
    for (const document::StudyState& study : document_.studies())
      if (belongs_(study)) addItem(QString::fromStdString(study.name));
    setCurrentIndex(count() > 0 ? std::max(0, findText(before)) : -1);
    setVisible(count() > 1);
  }
  if (currentText() != before) Q_EMIT chosen();
}

}  // namespace pliant::panels
