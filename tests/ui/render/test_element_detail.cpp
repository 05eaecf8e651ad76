#include <QTest>

#include "tests/ui/render/element_bowl.hpp"
#include "ui/render/macro_view.hpp"
#include "ui/render/offscreen_target.hpp"

namespace pliant::render {

/// Many elements while the camera moves: coarser, but the same piece.
class TestElementDetail : public QObject {
  Q_OBJECT

  OffscreenTarget target_;
  std::unique_ptr<MacroView> view_;

  Image picture(bool fine) {
    view_->setFineQuality(fine);
    Image image;
    target_.render(image);
    return image;
  }
  /// Pixels that are not background, which the first one is.
  static std::vector<char> covered(const Image& image) {
    std::vector<char> mask;
    for (std::size_t i = 0; i < image.pixels.size(); i += 4)
      mask.push_back(!std::equal(image.pixels.begin() + static_cast<long>(i),
                                 image.pixels.begin() + static_cast<long>(i) + 3, image.pixels.begin()));
    return mask;
  }
  static double shareOf(const std::vector<char>& mask, const std::vector<char>& within) {
    double both = 0, all = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
      all += within[i];
      both += mask[i] && within[i];
    }
    return both / all;
  }

 private Q_SLOTS:
  void init() {
    target_.setSize(600, 400);
    view_ = std::make_unique<MacroView>();
    view_->attach(target_.window());
    view_->setElementsVisible(true);
  }
  void cleanup() { view_.reset(); }

  void coversTheSamePixels_data() {
    QTest::addColumn<int>("count");
    QTest::newRow("few") << 200;
    QTest::newRow("coarser") << 3000;
    QTest::newRow("dots") << 20000;
  }
  void coversTheSamePixels() {
    QFETCH(int, count);
    view_->setResult(elementBowl(count));
    view_->setAxisView(AxisView::isometric);
    const std::vector<char> fine = covered(picture(true)), moving = covered(picture(false));
    qInfo("%.3f of the fine picture, and %.3f of the moving one is in the other", shareOf(moving, fine),
          shareOf(fine, moving));
    QVERIFY(shareOf(moving, fine) > 0.8);
    QVERIFY(shareOf(fine, moving) > 0.8);
    QVERIFY(covered(picture(true)) == fine);  // as before, when the camera rests again
  }
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestElementDetail)
#include "test_element_detail.moc"
