#include "ui/panels/target_bar.hpp"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>

#include "ui/panels/text_line.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::panels {

TargetBar::TargetBar(QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 4, 8, 0);
  probe_ = new QComboBox;
  probe_->setAccessibleName(tr("Probe with a target"));
  probe_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  draw_ = new QPushButton(tr("Draw"));
  draw_->setCheckable(true);
  draw_->setToolTip(
      tr("Draw the target in the viewport: drag its points, press on the curve for a new one, right-click "
         "one to remove it; Esc ends."));
  table_ = new QPushButton(tr("From CSV…"));
  table_->setToolTip(tr("Take the target from a table with the columns \"x [m]\", \"y [m]\", …"));
  motion_ = new QToolButton;
  motion_->setText(tr("From Motion"));
  motion_->setToolTip(tr("Take the target from how a probe moves now"));
  motion_->setPopupMode(QToolButton::InstantPopup);
  motion_->setMenu(new QMenu(motion_));
  state_ = new TextLine;
  row->addWidget(new QLabel(tr("Target of")));
  row->addWidget(probe_);
  row->addWidget(draw_);
  row->addWidget(table_);
  row->addWidget(motion_);
  row->addWidget(state_, 1);
  connect(probe_, &QComboBox::currentIndexChanged, this, [this] { Q_EMIT probeChosen(probe()); });
  connect(draw_, &QPushButton::toggled, this, &TargetBar::drawToggled);
  connect(table_, &QPushButton::clicked, this, &TargetBar::tableRequested);
}

void TargetBar::setProbes(const std::vector<mechanics::Probe>& probes) {
  const QSignalBlocker block(probe_);
  const QString before = probe_->currentText();
  probe_->clear();
  motion_->menu()->clear();
  for (const mechanics::Probe& each : probes) {
    const QString name = QString::fromStdString(each.name);
    probe_->addItem(name);
    motion_->menu()->addAction(
        tr("of %1").arg(name), this, [this, probe = each.name] { Q_EMIT motionRequested(probe); });
  }
  probe_->setCurrentIndex(std::max(0, probe_->findText(before)));
  for (QWidget* part : std::initializer_list<QWidget*>{draw_, table_}) part->setEnabled(!probes.empty());
}

void TargetBar::setProbe(const std::string& name) {
  const QSignalBlocker block(probe_);
  if (const int index = probe_->findText(QString::fromStdString(name)); index >= 0) probe_->setCurrentIndex(index);
}

std::string TargetBar::probe() const { return probe_->currentText().toStdString(); }

void TargetBar::setDrawing(bool drawing) {
  const QSignalBlocker block(draw_);
  draw_->setChecked(drawing);
}

void TargetBar::setMotionAvailable(bool available) { motion_->setEnabled(available && probe_->count() > 0); }

void TargetBar::setState(const QString& text) {
  state_->setText(text, plots::plotStyle(palette()).mutedText);
  state_->setToolTip(text);
}

QString TargetBar::state() const { return state_->text(); }

}  // namespace pliant::panels
