#include "ui/shell/live_bar.hpp"

#include <QAction>
#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>

#include "ui/jobs/cloth_session.hpp"
#include "ui/panels/text_line.hpp"
#include "ui/plots/plot_style.hpp"
#include "ui/shell/action_registry.hpp"
#include "ui/shell/cloth_link.hpp"

namespace pliant::shell {

namespace {

constexpr double realTime = 0.97;  // from which on it counts as that

QToolButton* buttonOf(QAction* action, Qt::ToolButtonStyle style) {
  auto* button = new QToolButton;
  button->setDefaultAction(action);
  button->setToolButtonStyle(style);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  button->setIconSize({20, 20});
  button->setMinimumHeight(32);
  return button;
}

}  // namespace

LiveBar::LiveBar(document::Document& document, jobs::ClothSession& session, const ActionRegistry& actions,
                 QWidget* parent)
    : QWidget(parent), document_(document), session_(session) {
  studies_ = new QComboBox;
  studies_->setFocusPolicy(Qt::NoFocus);
  studies_->setToolTip(tr("Whose scheme and time step the live cloth has"));
  studies_->setAccessibleName(tr("Study of the live cloth"));
  controls_ = new QWidget;
  auto* buttons = new QHBoxLayout(controls_);
  buttons->setContentsMargins(0, 0, 0, 0);
  buttons->setSpacing(0);
  for (const char* id : {"view.play", "live.step", "live.reset", "live.record"})
    buttons->addWidget(buttonOf(actions.find(QLatin1String(id)), Qt::ToolButtonIconOnly));
  text_ = new panels::TextLine;
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(16, 4, 16, 4);
  row->setSpacing(8);
  row->addWidget(buttonOf(actions.find(QStringLiteral("live.open")), Qt::ToolButtonTextBesideIcon));
  row->addWidget(studies_);
  row->addWidget(controls_);
  row->addWidget(text_, 1);

  connect(studies_, &QComboBox::activated, this, &LiveBar::studyChosen);
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    fillStudies();
    refresh();
  });
  connect(&document_, &document::Document::sceneEdited, this, [this] {
    fillStudies();
    refresh();
  });
  for (auto changed :
       {&jobs::ClothSession::openChanged, &jobs::ClothSession::playingChanged, &jobs::ClothSession::recordingChanged})
    connect(&session_, changed, this, &LiveBar::refresh);
  connect(&session_, &jobs::ClothSession::stateChanged, this, &LiveBar::refresh);
  fillStudies();
  refresh();
}

std::string LiveBar::study() const { return studies_->currentText().toStdString(); }

QString LiveBar::text() const { return text_->text(); }

void LiveBar::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) refresh();
}

void LiveBar::fillStudies() {
  const QSignalBlocker block(studies_);
  const QString before = studies_->currentText();
  studies_->clear();
  int first = -1;  // that keeps limits, or else a hand would tear the cloth
  for (std::size_t i = 0; i < document_.studies().size(); ++i) {
    const document::StudyState& study = document_.studies()[i];
    if (study.type != "cloth_motion") continue;
    const scene::Json scheme = document_.valueAt("/studies/" + std::to_string(i) + "/scheme");
    if (first < 0 && scheme != "implicit_euler" && scheme != "bdf2") first = studies_->count();
    studies_->addItem(QString::fromStdString(study.name));
  }
  const int same = studies_->findText(before);
  studies_->setCurrentIndex(same >= 0 ? same : std::max(first, studies_->count() > 0 ? 0 : -1));
  studies_->setVisible(studies_->count() > 1);
  setVisible(hasCloth(document_));
}

void LiveBar::refresh() {
  const plots::PlotStyle style = plots::plotStyle(palette());
  const bool open = session_.isOpen();
  controls_->setVisible(open);
  if (!open) {
    text_->setText(studies_->count() > 0 ? tr("Let the cloth move, and pull it with the mouse.")
                                         : tr("A study of the type cloth_motion lets you pull the cloth by hand."),
                   style.mutedText);
    text_->setToolTip({});
    return;
  }
  const jobs::LiveState& state = session_.state();
  text_->setToolTip(state.trouble.isEmpty() ? state.obstacle : state.trouble);
  if (!state.problem) {
    text_->setText(state.trouble.isEmpty() ? tr("Getting ready…") : state.trouble,
                   state.trouble.isEmpty() ? style.mutedText : style.warning);
    return;
  }
  QStringList parts{tr("%1 s").arg(state.frame->time, 0, 'f', 2)};
  if (!state.trouble.isEmpty())
    parts << tr("no step is possible");
  else if (!session_.isPlaying())
    parts << tr("paused");
  else if (state.speed > 0)
    parts << (state.speed > realTime ? tr("real time") : tr("%1 × real time").arg(state.speed, 0, 'f', 2));
  if (session_.isRecording()) parts << tr("recorded %1 s").arg(state.recordedSeconds, 0, 'f', 2);
  if (!state.obstacle.isEmpty()) parts << tr("the hand is held back");
  const bool warns = !state.trouble.isEmpty() || !state.obstacle.isEmpty();
  text_->setText(parts.join(QStringLiteral("   ·   ")), warns ? style.warning : style.text);
}

}  // namespace pliant::shell
