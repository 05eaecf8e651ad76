#include "ui/render/offscreen.hpp"

#include <QTemporaryDir>
#include <QTest>
#include <numbers>

#include "core/base/error.hpp"
#include "tests/ui/render/pixels.hpp"
#include "tests/ui/render/swinging_fork.hpp"
#include "ui/render/offscreen_target.hpp"

namespace pliant::render {

namespace {

PictureOptions smallPicture() {
  PictureOptions options;
  options.width = 480;
  options.height = 320;
  return options;
}

}  // namespace

class TestOffscreen : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void drawsTheSamePixelsEveryTime();
  void drawsAlikeThroughEgl();
  void keepsAllOfTheMotionInTheFrame();
  void followsTheTheme();
  void showsWhatIsAskedFor();
  void shrinksMassesByTheCubeRoot();
  void drawsModelsOfOneDimension();
  void drawsAnEmptyModel();
  void writesPngOrNothing();
  void refusesImpossibleSizes();
};

void TestOffscreen::drawsTheSamePixelsEveryTime() {
  const SwingingFork fork;
  const Image first = renderToImage(fork.model, fork.problem, fork.motion(0.03), 1.2, smallPicture());
  const Image second = renderToImage(fork.model, fork.problem, fork.motion(0.03), 1.2, smallPicture());
  QCOMPARE(first.width, 480);
  QCOMPARE(first.height, 320);
  QVERIFY(first.pixels == second.pixels);
  const Image later = renderToImage(fork.model, fork.problem, fork.motion(0.03), 2.2, smallPicture());
  QVERIFY(first.pixels != later.pixels);
}

void TestOffscreen::drawsAlikeThroughEgl() {
  std::unique_ptr<OffscreenContext> context;
  try {
    context = makeEglContext();
  } catch (const std::runtime_error& error) {
    QSKIP(error.what());
  }
  const SwingingFork fork;
  Image mesa, egl;
  const auto draw = [&](std::unique_ptr<OffscreenContext> with, Image& image) {
    OffscreenTarget target(std::move(with));
    target.setSize(480, 320);
    MotionView view;
    view.attach(target.window());
    view.setModel(fork.model);
    view.setMotion(fork.problem, fork.motion(0.03));
    view.setAxisView(AxisView::isometric);
    target.render(image);
  };
  draw(std::move(context), egl);
  draw(makeMesaContext(), mesa);
  int different = 0;
  for (std::size_t i = 0; i < mesa.pixels.size(); ++i) different += std::abs(mesa.pixels[i] - egl.pixels[i]) > 2;
  QVERIFY2(different < 300, qPrintable(QString::number(different)));
}

void TestOffscreen::keepsAllOfTheMotionInTheFrame() {
  const SwingingFork fork;
  for (const AxisView view : {AxisView::isometric, AxisView::front, AxisView::top}) {
    PictureOptions options = smallPicture();
    options.view = view;
    for (const double tau : {0.0, 0.25, 0.6}) {
      const Image image =
          renderToImage(fork.model, fork.problem, fork.motion(0.05), 2 * std::numbers::pi * tau, options);
      const Blob drawn = findBlob(image, differsFrom(palette(Theme::light).background));
      QVERIFY(drawn.pixels > 500);
      QVERIFY(drawn.left > 2 && drawn.right < image.width - 3);
      QVERIFY(drawn.top > 2 && drawn.bottom < image.height - 3);
    }
  }
}

void TestOffscreen::followsTheTheme() {
  const SwingingFork fork;
  for (const Theme theme : {Theme::light, Theme::dark}) {
    PictureOptions options = smallPicture();
    options.theme = theme;
    const Image image = renderToImage(fork.model, nullptr, {}, 0, options);
    for (int channel = 0; channel < 3; ++channel)
      QVERIFY(std::abs(image.pixels[channel] - 255 * palette(theme).background[channel]) <= 1);
    // WCAG's contrast of text with the background.
    const auto luminance = [](const Color& color) {
      const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
      return 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
    };
    const double a = luminance(palette(theme).text), b = luminance(palette(theme).background);
    QVERIFY((std::max(a, b) + 0.05) / (std::min(a, b) + 0.05) >= 4.5);
  }
}

void TestOffscreen::showsWhatIsAskedFor() {
  const SwingingFork fork;
  const PictureOptions plain = smallPicture();
  PictureOptions labelled = plain;
  labelled.caption = "response, ω = 3.2 rad/s";
  PictureOptions selected = plain;
  selected.selectedNode = 40;
  const mechanics::Vector z = fork.motion(0.03);
  const Image reference = renderToImage(fork.model, fork.problem, z, 1.0, plain);
  QVERIFY(renderToImage(fork.model, fork.problem, z, 1.0, labelled).pixels != reference.pixels);
  QVERIFY(renderToImage(fork.model, fork.problem, z, 1.0, selected).pixels != reference.pixels);
  QVERIFY(renderToImage(fork.model, nullptr, {}, 1.0, plain).pixels != reference.pixels);
}

void TestOffscreen::shrinksMassesByTheCubeRoot() {
  const SwingingFork fork;
  PictureOptions options = smallPicture();
  options.width = 960;
  options.height = 640;
  options.view = AxisView::top;
  const auto diameter = [&](double mass) {
    auto model = std::make_shared<mechanics::Model>(*fork.model);
    model->pointMasses = {{"tip", {fork.leftTip}, mass, 0, 0.02}};
    const Blob ball = findBlob(renderToImage(model, nullptr, {}, 0, options), isMassBlue);
    return std::sqrt(static_cast<double>(ball.pixels));
  };
  const double ratio = diameter(0.02) / diameter(0.0025);
  QVERIFY2(std::abs(ratio - 2.0) < 0.25, qPrintable(QString::number(ratio)));
}

void TestOffscreen::drawsModelsOfOneDimension() {
  mechanics::Model made;
  made.dimension = 1;
  made.restPositions = mechanics::Vector::Zero(1);
  made.gravity = mechanics::Vector::Zero(1);
  made.lockedCoordinates = {0};
  made.pointMasses = {{"mass", {0}, 1.0, 1.0, 1.0}};
  made.probes = {{"mass", 0}};
  made.finish();
  const auto model = std::make_shared<const mechanics::Model>(std::move(made));
  const auto problem = std::make_shared<const harmonic::HarmonicBalanceProblem>(model, math::HarmonicBasis(1, 8));
  mechanics::Vector z(3);
  z << 0.0, 0.7, 0.0;  // x = 0.7 sin τ
  PictureOptions options = smallPicture();
  options.view = AxisView::top;
  const auto place = [&](double tau) { return findBlob(renderToImage(model, problem, z, tau, options), isMassBlue); };
  // The trajectory, a green line, is as long as the swing.
  const Blob path = findBlob(renderToImage(model, problem, z, 0, options),
                             [](int red, int green, int blue) { return green > red + 60 && green > blue + 15; });
  const Blob left = place(-std::numbers::pi / 2), middle = place(0), right = place(std::numbers::pi / 2);
  QVERIFY(left.pixels > 20 && right.pixels > 20);
  QVERIFY(left.x + 100 < right.x);
  QVERIFY(std::abs(path.left - left.x) < 4 && std::abs(path.right - right.x) < 4);
  QVERIFY(std::abs(middle.x - 0.5 * (left.x + right.x)) < 2);
  QVERIFY(std::abs(left.y - right.y) < 2);
}

void TestOffscreen::drawsAnEmptyModel() {
  const Image image = renderToImage(nullptr, nullptr, {}, 0, smallPicture());
  QCOMPARE(findBlob(image, differsFrom(palette(Theme::light).background)).pixels, 0);
}

void TestOffscreen::writesPngOrNothing() {
  const SwingingFork fork;
  const QTemporaryDir folder;
  const std::filesystem::path file = std::filesystem::path(folder.path().toStdString()) / "fork.png";
  renderToPng(fork.model, nullptr, {}, 0, smallPicture(), file);
  const QDir dir(folder.path());
  QCOMPARE(dir.entryList(QDir::Files), QStringList{"fork.png"});
  QFile written(dir.filePath("fork.png"));
  QVERIFY(written.open(QIODevice::ReadOnly));
  QCOMPARE(written.read(8), QByteArray("\x89PNG\r\n\x1a\n", 8));

  const std::filesystem::path nowhere = file.parent_path() / "missing" / "fork.png";
  QVERIFY_EXCEPTION_THROWN(renderToPng(fork.model, nullptr, {}, 0, smallPicture(), nowhere), base::InputError);
}

void TestOffscreen::refusesImpossibleSizes() {
  const SwingingFork fork;
  for (const auto& [width, height] : {std::pair{0, 100}, std::pair{100, -1}, std::pair{1000000, 10}}) {
    PictureOptions options;
    options.width = width;
    options.height = height;
    QVERIFY_EXCEPTION_THROWN(renderToImage(fork.model, nullptr, {}, 0, options), base::InputError);
  }
}

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestOffscreen)
#include "test_offscreen.moc"
