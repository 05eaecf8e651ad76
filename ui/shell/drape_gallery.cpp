#include "ui/shell/drape_gallery.hpp"

#include <QEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPointer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/cloth_result.hpp"
#include "ui/document/document.hpp"
#include "ui/panels/icon.hpp"
#include "ui/plots/plot_style.hpp"
#include "ui/shell/shipped_files.hpp"

namespace pliant::shell {

namespace {

constexpr int exportedColumn = 680, exportedRow = 1240;  ///< pixels of each drape

const QString figureTopic = QStringLiteral("drape figure");

render::Theme themeOf(const QPalette& palette) {
  return plots::isDark(palette) ? render::Theme::dark : render::Theme::light;
}

QImage asImage(const render::Image& image) {
  return QImage(image.pixels.data(), image.width, image.height, 4 * image.width, QImage::Format_RGBA8888).copy();
}

std::string drapeStudy(const scene::Scene& scene) {
  for (const char* type : {"cloth_drape", "cloth_motion"})
    for (const scene::Json& study : scene.normalized()["studies"])
      if (study["type"] == type) return study["name"];
  throw base::InputError(scene.name(), "The scene has no study of the type cloth_drape or cloth_motion.");
}

render::Drape asDrape(const std::string& title, const scene::Result& result) {
  const auto& cloth = dynamic_cast<const scene::ClothResult&>(result);
  return {title, cloth.problem, cloth.frames.empty() ? nullptr : cloth.frames.back()};
}

}  // namespace

DrapeGallery::DrapeGallery(jobs::JobRunner& studies, jobs::JobRunner& quick, QWidget* parent)
    : QWidget(parent), studies_(studies), quick_(quick) {
  setAutoFillBackground(true);
  auto* title = new QLabel(tr("Drapes side by side"));
  QFont large = font();
  large.setPointSizeF(font().pointSizeF() * 1.4);
  title->setFont(large);
  head_ = new QWidget;
  auto* row = new QHBoxLayout(head_);
  row->setContentsMargins(24, 12, 16, 12);
  row->setSpacing(8);
  row->addWidget(title);
  row->addStretch();
  const auto button = [&](const QString& text, const QString& tooltip, auto signal) {
    auto* made = new QToolButton;
    made->setText(text);
    made->setToolTip(tooltip);
    made->setMinimumHeight(32);
    connect(made, &QToolButton::clicked, this, signal);
    row->addWidget(made);
    return made;
  };
  button(tr("Add what is shown"), tr("Add the cloth as it is in the viewport"), &DrapeGallery::addRequested);
  button(tr("Add scene…"), tr("Compute the drape of a scene and add it"), &DrapeGallery::chooseScene);
  exporter_ = button(tr("Export…"), tr("Write the figure as a PNG picture"), &DrapeGallery::exportRequested);
  QToolButton* close = button(QString(), tr("Back to the scene"), &DrapeGallery::closeRequested);
  close->setIcon(panels::icon(QStringLiteral("close")));
  close->setAutoRaise(true);
  close->setAccessibleName(tr("Back to the scene"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(head_);
  column->addStretch();
  connect(&studies_, &jobs::JobRunner::finished, this, &DrapeGallery::finish);
  connect(&quick_, &jobs::JobRunner::finished, this,
          [this](jobs::JobRunner::Id id, const QString&, jobs::JobOutcome outcome, const QString& sentence) {
            if (id == export_ && outcome == jobs::JobOutcome::failed)
              Q_EMIT messageRaised(base::Severity::warning, sentence);
          });
}

QStringList DrapeGallery::shippedDrapes() {
  QStringList files;
  for (const char* name : {"drape_isotropic", "drape_orthotropic", "drape_curve"})
    files << shippedFile(QStringLiteral("scenes/cloth/%1.json").arg(QLatin1String(name)));
  return files;
}

void DrapeGallery::fillAtFirst(const QStringList& scenes) {
  if (filled_ || !entries_.empty()) return;
  filled_ = true;
  for (const QString& file : scenes) addScene(file);
}

DrapeGallery::Entry& DrapeGallery::append(const render::Drape& drape) {
  Entry entry;
  entry.number = ++lastNumber_;
  entry.drape = drape;
  entry.close = new QToolButton(this);
  entry.close->setIcon(panels::icon(QStringLiteral("close")));
  entry.close->setAutoRaise(true);
  entry.close->setFixedSize(28, 28);
  entry.close->setToolTip(tr("Remove “%1”").arg(QString::fromStdString(drape.title)));
  entry.close->setAccessibleName(entry.close->toolTip());
  connect(entry.close, &QToolButton::clicked, this, [this, number = entry.number] {
    for (std::size_t i = 0; i < entries_.size(); ++i)
      if (entries_[i].number == number) {
        remove(static_cast<int>(i));
        return;
      }
  });
  entry.close->show();
  entries_.push_back(entry);
  return entries_.back();
}

void DrapeGallery::add(const render::Drape& drape) {
  filled_ = true;
  append(drape);
  placeButtons();
  redraw();
}

void DrapeGallery::addScene(const QString& file) {
  Entry& entry = append({QFileInfo(file).completeBaseName().toStdString(), nullptr, nullptr});
  entry.computing = true;
  const int number = entry.number;
  jobs::Job job;
  job.topic = QStringLiteral("drape %1").arg(number);
  job.title = QFileInfo(file).completeBaseName();
  job.work = [this, file, number](base::ExecutionContext& context, const jobs::Publish& publish) -> jobs::Delivery {
    const document::LoadedScene loaded = document::loadScene(file);
    const auto study = scene::StudyRegistry::instance().make(loaded.scene, loaded.model, drapeStudy(loaded.scene));
    std::string title = loaded.scene.normalized()["title"];
    if (title.empty()) title = QFileInfo(file).completeBaseName().toStdString();
    const auto result = study->run(context, [&](const std::shared_ptr<const scene::Result>& partial) {
      publish([this, number, drape = asDrape(title, *partial)] { change(number, drape, true); });
    });
    return [this, number, drape = asDrape(title, *result)] { change(number, drape, false); };
  };
  entry.job = studies_.submit(std::move(job));
  placeButtons();
  redraw();
}

/// A drape whose computation failed before there was anything to show goes.
void DrapeGallery::finish(jobs::JobRunner::Id id, const QString&, jobs::JobOutcome outcome, const QString& sentence) {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& each) { return each.job == id; });
  if (found == entries_.end()) return;
  found->computing = false;
  if (outcome == jobs::JobOutcome::failed) Q_EMIT messageRaised(base::Severity::warning, sentence);
  if (found->drape.problem)
    redraw();
  else
    remove(static_cast<int>(found - entries_.begin()));
}

void DrapeGallery::remove(int index) {
  const Entry entry = entries_.at(static_cast<std::size_t>(index));
  entries_.erase(entries_.begin() + index);
  entry.close->deleteLater();
  entry.close->hide();
  studies_.abandonTopic(QStringLiteral("drape %1").arg(entry.number));
  placeButtons();
  redraw();
}

void DrapeGallery::cancel() {
  for (const Entry& entry : entries_) studies_.cancelTopic(QStringLiteral("drape %1").arg(entry.number));
}

DrapeGallery::Entry* DrapeGallery::find(int number) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.number == number; });
  return found == entries_.end() ? nullptr : &*found;
}

void DrapeGallery::change(int number, const render::Drape& drape, bool computing) {
  Entry* entry = find(number);
  if (!entry) return;
  entry->drape = drape;
  entry->computing = computing;
  redraw();
}

std::vector<render::Drape> DrapeGallery::drapes() const {
  std::vector<render::Drape> all;
  for (const Entry& entry : entries_) all.push_back(entry.drape);
  return all;
}

bool DrapeGallery::isComputing() const {
  return std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.computing; });
}

QRect DrapeGallery::figurePlace() const {
  const int top = head_->sizeHint().height();
  return {0, top, width(), std::max(1, height() - top)};
}

void DrapeGallery::redraw() {
  exporter_->setEnabled(!entries_.empty());
  if (entries_.empty() || width() < 50) {
    quick_.abandonTopic(figureTopic);
    figure_ = {};
    update();
    return;
  }
  std::vector<render::Drape> shown = drapes();
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (entries_[i].computing) shown[i].title += tr(" – computing…").toStdString();
  const double screen = devicePixelRatioF();
  const QSize size = figurePlace().size() * screen;
  const double ratio = std::min(screen, render::fittingPixelRatio(shown.size(), size.width(), size.height()));
  jobs::Job job;
  job.topic = figureTopic;
  job.work = [gallery = QPointer<DrapeGallery>(this), shown, size, ratio, screen, theme = themeOf(palette())](
                 base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
    if (context.cancelRequested()) return {};
    QImage image = asImage(render::drawDrapes(shown, size.width(), size.height(), ratio, theme));
    image.setDevicePixelRatio(screen);
    return [gallery, image] {
      if (!gallery) return;
      gallery->figure_ = image;
      gallery->update();
    };
  };
  quick_.submit(std::move(job));
}

void DrapeGallery::exportTo(const QString& file) {
  const std::vector<render::Drape> shown = drapes();
  if (shown.empty()) return;
  const render::DrapeGrid grid = render::drapeGrid(shown.size());
  jobs::Job job;
  job.topic = QStringLiteral("drape export");
  job.title = tr("Export %1").arg(QFileInfo(file).fileName());
  job.work = [this, file, shown, width = exportedColumn * grid.columns, height = exportedRow * grid.rows,
              theme = themeOf(palette())](base::ExecutionContext&, const jobs::Publish&) -> jobs::Delivery {
    const double ratio = render::fittingPixelRatio(shown.size(), width, height);
    render::writePng(render::drawDrapes(shown, width, height, ratio, theme), file.toStdString());
    return [this, file] { Q_EMIT messageRaised(base::Severity::information, tr("Exported to %1.").arg(file)); };
  };
  export_ = quick_.submit(std::move(job));
}

void DrapeGallery::chooseScene() {
  const QString file = QFileDialog::getOpenFileName(
      this, tr("Add a scene"), shippedFile(QStringLiteral("scenes/cloth")), tr("Scenes (*.json)"));
  if (!file.isEmpty()) addScene(file);
}

void DrapeGallery::placeButtons() {
  if (entries_.empty()) return;
  const render::DrapeGrid grid = render::drapeGrid(entries_.size());
  const QRect place = figurePlace();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const int column = static_cast<int>(i) % grid.columns, row = static_cast<int>(i) / grid.columns;
    QToolButton* button = entries_[i].close;
    button->move(place.left() + place.width() * (column + 1) / grid.columns - button->width() - 8,
                 place.top() + place.height() * row / grid.rows + 4);
    button->raise();
  }
}

void DrapeGallery::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const QRect place = figurePlace();
  if (!figure_.isNull()) {
    painter.drawImage(QRectF(place), figure_);
    return;
  }
  painter.setPen(plots::plotStyle(palette()).mutedText);
  painter.drawText(place, Qt::AlignCenter,
                   entries_.empty() ? tr("Add the cloth that is shown, or the drape of a scene, to compare them here.")
                                    : tr("Drawing…"));
}

void DrapeGallery::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  placeButtons();
  redraw();
}

void DrapeGallery::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) redraw();
}

}  // namespace pliant::shell
