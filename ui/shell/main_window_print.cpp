#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "ui/panels/print_panel.hpp"
#include "ui/shell/main_window.hpp"

namespace pliant::shell {

namespace {

QString lengthText(double length) {
  return QString::fromStdString(base::formatQuantity(length, base::dimensions::length));
}

QString exportedText(const QString& file, const scene::PatchReport& report) {
  return QObject::tr("Exported to %1: %2 elements, %3 x %4 x %5, %6 cm³.")
      .arg(file)
      .arg(report.elements)
      .arg(lengthText(report.size[0]), lengthText(report.size[1]), lengthText(report.size[2]))
      .arg(1e6 * report.volume, 0, 'g', 4);
}

}  // namespace

void MainWindow::makePrintDock() {
  print_ = new panels::PrintPanel(document_, quickJobs_);
  printDock_ = new QDockWidget(tr("Print patch"), this);
  printDock_->setObjectName(QStringLiteral("print"));
  printDock_->setWidget(print_);
  addDockWidget(Qt::RightDockWidgetArea, printDock_);
  docks_.push_back(printDock_);
  tabifyDockWidget(docks_[1], printDock_);
  actions_.add({QStringLiteral("model.print"),
                tr("&Print Patch…"),
                QStringLiteral("export"),
                {},
                tr("Export a piece of the interlocking material for a printer")},
               [this] {
                 printDock_->show();
                 printDock_->raise();
               });
  connect(print_, &panels::PrintPanel::exportRequested, this, [this] {
    const QString name = QFileInfo(document_.file()).completeBaseName() + QStringLiteral(".3mf");
    const QString file =
        QFileDialog::getSaveFileName(this, tr("Export the patch"), name, tr("For printers (*.3mf *.stl)"));
    if (!file.isEmpty()) exportPatchTo(file);
  });
}

void MainWindow::exportPatchTo(const QString& file) {
  jobs::Job job;
  job.topic = QStringLiteral("print ") + file;
  job.title = tr("Export %1").arg(QFileInfo(file).fileName());
  job.work = [this, file, scene = document_.scene(), request = print_->request()](
                 base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
    const scene::PatchReport report = scene::exportPatch(scene, request, file.toStdString(), context);
    context.reportProgress(1);
    if (report.cancelled) return {};
    return [this, file, report] { this->report(base::Severity::information, exportedText(file, report)); };
  };
  exportJobs_.submit(std::move(job));
}

}  // namespace pliant::shell
