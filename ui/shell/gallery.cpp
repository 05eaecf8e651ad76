#include "ui/shell/gallery.hpp"

#include <QDir>
#include <QDirIterator>
#include <QEvent>
#include <QFile>
#include <QFileInfo>
#include <QGridLayout>
#include <QImage>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>

#include "core/scene/scene.hpp"
#include "ui/shell/card.hpp"
#include "ui/shell/shipped_files.hpp"
#include "ui/shell/thumbnail.hpp"

namespace pliant::shell {

std::vector<GalleryScene> shippedScenes() {
  std::vector<GalleryScene> scenes;
  QDirIterator files(
      shippedFile(QStringLiteral("scenes")), {QStringLiteral("*.json")}, QDir::Files, QDirIterator::Subdirectories);
  while (files.hasNext()) {
    const QString path = files.next();
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) continue;
    const auto json = scene::Json::parse(file.readAll().toStdString(), nullptr, false);
    if (!json.is_object() || !json.contains("schema_version")) continue;
    const auto text = [&](const char* key) {
      const auto found = json.find(key);
      return found != json.end() && found->is_string() ? QString::fromStdString(found->get<std::string>()) : QString();
    };
    QString title = text("title");
    if (title.isEmpty()) title = QFileInfo(path).completeBaseName();
    scenes.push_back({path, title, text("description")});
  }
  std::sort(scenes.begin(), scenes.end(),
            [](const GalleryScene& a, const GalleryScene& b) { return a.title.localeAwareCompare(b.title) < 0; });
  return scenes;
}

Gallery::Gallery(jobs::JobRunner& quick, QWidget* parent) : QWidget(parent), quick_(quick) {
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::Base);
  auto* head = new QLabel(tr("Begin with a scene"));
  QFont large = font();
  large.setPointSizeF(font().pointSizeF() * 1.8);
  head->setFont(large);
  auto* text = new QLabel(tr("Choose one of these, drop a scene file here, or"));
  text->setForegroundRole(QPalette::PlaceholderText);
  auto* open = new QPushButton(tr("Open…"));
  connect(open, &QPushButton::clicked, this, &Gallery::openRequested);
  auto* materials = new QPushButton(tr("Interlocking Materials…"));
  materials->setToolTip(tr("Begin with a kind of chain mail and change its numbers"));
  connect(materials, &QPushButton::clicked, this, &Gallery::materialsRequested);
  auto* line = new QHBoxLayout;
  line->setSpacing(8);
  line->addWidget(text);
  line->addWidget(open);
  line->addWidget(materials);
  line->addStretch();

  auto* cards = new QWidget;
  auto* grid = new QGridLayout(cards);
  grid_ = grid;
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(cardGap);
  for (const GalleryScene& scene : shippedScenes()) {
    Card card{scene.file, nullptr, nullptr};
    card.button = makeCard(scene.title, scene.description, card.picture);
    card.button->setToolTip(scene.file);
    connect(card.button, &QPushButton::clicked, this, [this, file = scene.file] { Q_EMIT sceneChosen(file); });
    cards_.push_back(card);
  }
  layOut();
  drawPictures();

  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(galleryMargin, 40, galleryMargin, 40);
  column->setSpacing(16);
  column->addWidget(head);
  column->addLayout(line);
  column->addWidget(makeCardArea(cards), 1);
}

void Gallery::drawPictures() {
  for (const Card& card : cards_) {
    jobs::Job job;
    job.topic = QStringLiteral("thumbnail: ") + card.file;
    job.work = [file = card.file, picture = QPointer<QLabel>(card.picture), palette = palette(),
                ratio = devicePixelRatioF()](base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
      if (context.cancelRequested()) return {};
      const QImage image = thumbnail(file, cardPictureSize, ratio, palette);
      return [picture, image] {
        if (picture) picture->setPixmap(QPixmap::fromImage(image));
      };
    };
    quick_.submit(std::move(job));
  }
}

void Gallery::layOut() {
  std::vector<QPushButton*> buttons;
  for (const Card& card : cards_) buttons.push_back(card.button);
  layOutCards(*grid_, buttons, width());
}

void Gallery::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) drawPictures();
}

void Gallery::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layOut();
}

}  // namespace pliant::shell
