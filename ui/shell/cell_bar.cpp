#include "ui/shell/cell_bar.hpp"

#include <QAction>
#include <QHBoxLayout>
#include <QToolButton>

#include "ui/jobs/cell_session.hpp"
#include "ui/panels/text_line.hpp"
#include "ui/plots/plot_style.hpp"

namespace pliant::shell {

namespace {

const QString separator = QStringLiteral("   ·   ");

QString percent(double strain) {
  const double value = 100 * strain;
  if (std::abs(value) < 0.005) return QStringLiteral("0.00 %");
  return QStringLiteral("%1%2 %")
      .arg(value < 0 ? QStringLiteral("−") : QStringLiteral("+"))
      .arg(std::abs(value), 0, 'f', 2);
}

/// Three digits: gaps say how near to contact it is, no more.
QString gapText(double metres) {
  const plots::LengthUnit unit = plots::fittingLengthUnit(metres);
  return QStringLiteral("%1 %2").arg(metres * unit.perMetre, 0, 'g', 3).arg(unit.name);
}

}  // namespace

QString strainText(const jobs::LiveCellState& state) {
  const Eigen::Vector3d& strain = state.state.strain;
  const QString gap = QStringLiteral("   ");
  return CellBar::tr("x %1").arg(percent(strain[0] + strain[1])) + gap +
         CellBar::tr("y %1").arg(percent(strain[0] - strain[1])) + gap +
         CellBar::tr("shear %1").arg(percent(2 * strain[2]));
}

QString contactText(const jobs::LiveCellState& state) {
  const int count = static_cast<int>(state.step.contacts.size());
  if (!state.step.message.empty() && state.step.failed()) return QString::fromStdString(state.step.message);
  if (!state.pulled || count == 0) return {};
  const QString contacts = count == 1 ? CellBar::tr("1 contact") : CellBar::tr("%1 contacts").arg(count);
  return state.step.locked ? CellBar::tr("locked: %1").arg(contacts) : contacts;
}

CellBar::CellBar(QAction* reset, QWidget* parent) : QWidget(parent) {
  auto* button = new QToolButton;
  button->setDefaultAction(reset);
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  button->setIconSize({20, 20});
  button->setMinimumHeight(32);
  text_ = new panels::TextLine;
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(16, 4, 16, 4);
  row->setSpacing(8);
  row->addWidget(button);
  row->addWidget(text_, 1);
}

QString CellBar::text() const { return text_->text(); }

void CellBar::showState(const jobs::LiveCellState& state) {
  const plots::PlotStyle style = plots::plotStyle(palette());
  const bool atRest = !state.pulled && state.state.strain.norm() < 1e-9;
  if (atRest) {
    text_->setText(
        tr("Drag an element or a handle of the outline to pull; a right drag turns the view."), style.mutedText);
    return;
  }
  QStringList parts{strainText(state)};
  if (const QString contacts = contactText(state); !contacts.isEmpty()) parts << contacts;
  if (state.cell && state.step.smallestGap > 0) {
    const double widest = 2 * state.cell->smallestRadius();
    parts << (state.step.smallestGap < 0.999 * widest ? tr("gap %1").arg(gapText(state.step.smallestGap))
                                                      : tr("gaps above %1").arg(gapText(widest)));
  }
  text_->setText(parts.join(separator), state.step.locked ? style.warning : style.text);
}

void CellBar::showSentence(const QString& sentence, bool warns) {
  const plots::PlotStyle style = plots::plotStyle(palette());
  text_->setText(sentence, warns ? style.warning : style.mutedText);
}

}  // namespace pliant::shell
