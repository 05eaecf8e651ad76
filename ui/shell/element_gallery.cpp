#include "ui/shell/element_gallery.hpp"

#include <QEvent>
#include <QGridLayout>
#include <QImage>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QRadioButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>

#include "core/base/error.hpp"
#include "core/scene/model_builder.hpp"
#include "ui/panels/cell_family.hpp"
#include "ui/plots/shape_image.hpp"
#include "ui/shell/card.hpp"

namespace pliant::shell {

document::LoadedScene familyScene(const std::string& type) {
  for (const panels::CellFamily& family : panels::cellFamilies()) {
    if (family.type != type) continue;
    scene::Scene scene = scene::Scene::parse(
        panels::sceneOfFamily(family).dump(2), std::filesystem::current_path(), family.title.toStdString());
    auto model = scene::buildModel(scene);
    return {std::move(scene), std::move(model)};
  }
  throw base::InputError("", "there is no interlocking material of the type \"" + type + "\"");
}

ElementGallery::ElementGallery(document::Document& document, jobs::JobRunner& quick, QWidget* parent)
    : QWidget(parent), document_(document), quick_(quick) {
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::Base);
  auto* head = new QLabel(tr("Interlocking materials"));
  QFont large = font();
  large.setPointSizeF(font().pointSizeF() * 1.8);
  head->setFont(large);
  replaces_ = new QRadioButton;
  opens_ = new QRadioButton(tr("Open a new scene of it"));
  close_ = new QPushButton(tr("Back"));
  connect(close_, &QPushButton::clicked, this, &ElementGallery::closeRequested);
  auto* line = new QHBoxLayout;
  line->setSpacing(24);
  line->addWidget(replaces_);
  line->addWidget(opens_);
  line->addStretch();
  line->addWidget(close_);

  auto* cards = new QWidget;
  grid_ = new QGridLayout(cards);
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setSpacing(cardGap);
  for (const panels::CellFamily& family : panels::cellFamilies()) {
    Card card{family.type, nullptr, nullptr};
    card.button = makeCard(family.title, family.sentence, card.picture);
    connect(card.button, &QPushButton::clicked, this, [this, type = family.type] {
      Q_EMIT familyChosen(type, replaces_->isChecked() && replaces_->isEnabled() ? target_ : -1);
    });
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
  setTarget(-1);
}

void ElementGallery::setTarget(int cell) {
  target_ = cell;
  replaces_->setEnabled(cell >= 0);
  for (QRadioButton* button : {replaces_, opens_}) button->setVisible(cell >= 0);
  replaces_->setText(tr("Replace the material of “%1”").arg(document_.title()));
  (cell >= 0 ? replaces_ : opens_)->setChecked(true);
}

QPushButton* ElementGallery::card(const std::string& type) const {
  const auto found = std::find_if(cards_.begin(), cards_.end(), [&](const Card& card) { return card.type == type; });
  return found == cards_.end() ? nullptr : found->button;
}

void ElementGallery::drawPictures() {
  for (const Card& card : cards_) {
    jobs::Job job;
    job.topic = QStringLiteral("material: ") + QString::fromStdString(card.type);
    job.work = [type = card.type, picture = QPointer<QLabel>(card.picture), palette = palette(),
                ratio = devicePixelRatioF()](base::ExecutionContext& context, const jobs::Publish&) -> jobs::Delivery {
      if (context.cancelRequested()) return {};
      const auto model = familyScene(type).model;
      const QImage image = plots::shapeImage(*model, model->restPositions, cardPictureSize, ratio, palette);
      return [picture, image] {
        if (picture) picture->setPixmap(QPixmap::fromImage(image));
      };
    };
    quick_.submit(std::move(job));
  }
}

void ElementGallery::layOut() {
  std::vector<QPushButton*> buttons;
  for (const Card& card : cards_) buttons.push_back(card.button);
  layOutCards(*grid_, buttons, width());
}

void ElementGallery::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) drawPictures();
}

void ElementGallery::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  layOut();
}

}  // namespace pliant::shell
