#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QPointer>

#include "ui/panels/boundary_panel.hpp"
#include "ui/viewport/viewport.hpp"

namespace pliant::panels {

/// None, the other studies that have a boundary, files that were read, and a file to choose.
void BoundaryPanel::fillComparisons() {
  const QString before = comparisons_->currentText();
  comparisons_->clear();
  comparisons_->addItem(tr("none"));
  for (const document::StudyState& study : document_.studies())
    if (study.name != this->study() && resultOf(study.name) && resultOf(study.name)->space().unit == space().unit)
      comparisons_->addItem(QString::fromStdString(study.name));
  for (const auto& [name, surface] : files_)
    if (surface->space.unit == space().unit) comparisons_->addItem(name);
  comparisons_->addItem(tr("from disk…"));
  comparisons_->setCurrentIndex(std::max(0, comparisons_->findText(before)));
}

void BoundaryPanel::chooseComparison(int index) {
  if (index != comparisons_->count() - 1) {
    refreshCompared();
    return;
  }
  const QString file = QFileDialog::getOpenFileName(this, tr("Compare with a boundary"), {}, tr("Boundaries (*.ply)"));
  comparisons_->setCurrentIndex(0);
  refreshCompared();
  if (!file.isEmpty()) compareWithFile(file);
}

void BoundaryPanel::compareWithStudy(const std::string& name) {
  comparisons_->setCurrentIndex(std::max(0, comparisons_->findText(QString::fromStdString(name))));
  refreshCompared();
}

void BoundaryPanel::compareWithFile(const QString& file) {
  wanted_ = file;
  jobs::Job job;
  job.topic = QStringLiteral("boundary file");
  job.title = tr("Read %1").arg(QFileInfo(file).fileName());
  job.work = [panel = QPointer<BoundaryPanel>(this), file](
                 base::ExecutionContext&, const jobs::Publish&) -> jobs::Delivery {
    QString problem;
    std::shared_ptr<const scene::BoundarySurface> surface;
    try {
      surface = std::make_shared<scene::BoundarySurface>(scene::readBoundarySurface(file.toStdString()));
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    return [panel, file, surface, problem] {
      if (BoundaryPanel* self = panel.data()) self->takeFile(file, surface, problem);
    };
  };
  quick_.submit(std::move(job));
}

void BoundaryPanel::takeFile(const QString& file, const std::shared_ptr<const scene::BoundarySurface>& surface,
                             const QString& problem) {
  if (wanted_ != file) return;
  wanted_.clear();
  if (!surface) {
    document_.raise(base::Severity::warning, problem);
    return;
  }
  if (surface->space.unit != space().unit) {
    document_.raise(base::Severity::warning, tr("Of the two boundaries one is of stretch, the other one of bending."));
    return;
  }
  const QString name = QString::fromStdString(surface->name);
  files_[name] = surface;
  fillComparisons();
  comparisons_->setCurrentIndex(comparisons_->findText(name));
  refreshCompared();
}

void BoundaryPanel::refreshCompared() {
  const QString name = comparisons_->currentText();
  const auto file = files_.find(name);
  const auto other = comparisons_->currentIndex() > 0 ? resultOf(name.toStdString()) : nullptr;
  compared_ = file != files_.end() ? file->second
              : other ? std::make_shared<scene::BoundarySurface>(scene::boundarySurface(*other, name.toStdString()))
                      : nullptr;
  view_->setCompared(predicted_ ? predicted_ : compared_);
  viewport_->redrawGuest(true);
}

void BoundaryPanel::showPredicted(std::shared_ptr<const scene::BoundarySurface> surface) {
  if (!surface && !predicted_) return;
  predicted_ = std::move(surface);
  view_->setCompared(predicted_ ? predicted_ : compared_);
  if (const document::StudyState* state = document_.study(study()); state && surface_)
    view_->setCaption(caption(*state).toStdString());
  viewport_->redrawGuest(false);
}

}  // namespace pliant::panels
