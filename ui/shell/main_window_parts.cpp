#include <QFileDialog>
#include <QFileInfo>

#include "core/base/error.hpp"
#include "core/scene/parameter_table.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/shell/make_dialog.hpp"
#include "ui/shell/parts_exporter.hpp"

namespace pliant::shell {

void MainWindow::makePartsActions() {
  make_ = new MakeDialog(this);
  actions_.add({QStringLiteral("file.make"),
                tr("Export to &Make…"),
                {},
                {},
                tr("Closed bodies for a printer, a saw or a mill, and a table of the parameters")},
               [this] { openMakeDialog(); });
  const auto nameFor = [this](const char* ending) {
    return QFileInfo(document_.file()).completeBaseName() + QLatin1String(ending);
  };
  connect(make_, &MakeDialog::bodiesRequested, this, [this, nameFor] {
    const QString file =
        QFileDialog::getSaveFileName(make_, tr("Export bodies"), nameFor(".stl"),
                                     tr("Millimetres (*.stl *.3mf);;Metres (*.obj *.ply *.gltf *.glb)"));
    if (!file.isEmpty()) exportPartsTo(file);
  });
  connect(make_, &MakeDialog::tableRequested, this, [this, nameFor] {
    const QString file =
        QFileDialog::getSaveFileName(make_, tr("Export parameters"), nameFor("_parameters.csv"), tr("Table (*.csv)"));
    if (!file.isEmpty()) exportParametersTo(file);
  });
  connect(&document_, &document::Document::sceneReplaced, this, [this] {
    if (make_->isVisible()) openMakeDialog();
  });
}

void MainWindow::openMakeDialog() {
  make_->setScene(document_.scene(), !document_.model()->parameters.empty());
  make_->show();
  make_->raise();
}

void MainWindow::exportPartsTo(const QString& file) {
  try {
    jobs::Job job;
    job.topic = QStringLiteral("export ") + file;
    job.title = tr("Export %1").arg(QFileInfo(file).fileName());
    job.work = [this, file, work = partsExport(file, document_, session_, *viewport_, make_->request())](
                   base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
      const QStringList lines = work(context);
      if (lines.isEmpty()) return {};
      return [this, file, lines] {
        make_->showLines(lines);
        report(base::Severity::information, tr("Exported to %1.").arg(file));
      };
    };
    exportJobs_.submit(std::move(job));
  } catch (const base::InputError& error) {
    report(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

void MainWindow::exportParametersTo(const QString& file) {
  try {
    scene::writeParameterTable(*document_.model(), make_->request(), file.toStdString());
    report(base::Severity::information, tr("Exported to %1.").arg(file));
  } catch (const base::InputError& error) {
    report(base::Severity::warning, QString::fromStdString(error.what()));
  }
}

}  // namespace pliant::shell
