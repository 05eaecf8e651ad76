#include "ui/render/theora_video.hpp"

#include <signal.h>
#include <sys/resource.h>

#include <QDir>
#include <QTemporaryDir>
#include <QTest>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"
#include "tests/ui/render/decoded_video.hpp"
#include "tests/ui/render/ogg_pages.hpp"

namespace pliant::render {

namespace {

constexpr int width = 150, height = 86;  // no multiples of Theora's blocks
constexpr int pictures = 70;             // more than between two key frames

/// Quarters in red, green, blue and white that meet where blocks do, so that colours do not mix, with a black square
/// that moves to the right over the upper ones.
Image quarters(int number) {
  Image image;
  image.width = width;
  image.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool left = x < 80, upper = y < 48, square = y >= 8 && y < 24 && x / 2 >= number && x / 2 < number + 8;
      const std::uint8_t red = !square && (left ? upper : !upper) ? 255 : 0;
      const std::uint8_t green = !square && !left ? 255 : 0;
      const std::uint8_t blue = !square && !upper ? 255 : 0;
      image.pixels.insert(image.pixels.end(), {red, green, blue, 255});
    }
  return image;
}

void writeQuarters(const std::string& file, int count, FrameRate rate) {
  TheoraVideo video(file, width, height, rate);
  for (int i = 0; i < count; ++i) video.add(quarters(i));
  video.commit();
}

bool isNear(const std::array<double, 3>& found, const std::array<double, 3>& expected) {
  constexpr double most = 8;  // of 255: what is lost on purpose, and rounding of three planes to bytes
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(found[c] - expected[c]) > most) return false;
  return true;
}

/// Of the colours that there are.
bool isNearestToBlack(const std::array<double, 3>& found) {
  const auto distance = [&](double red, double green, double blue) {
    return std::hypot(found[0] - red, found[1] - green, found[2] - blue);
  };
  const double black = distance(0, 0, 0);
  return black < distance(255, 0, 0) && black < distance(0, 255, 0) && black < distance(0, 0, 255) &&
         black < distance(255, 255, 255);
}

}  // namespace

/// Video files, looked at by a decoder that has nothing to do with their encoder, and byte by byte.
class TestTheoraVideo : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;

  std::string file(const char* name) const { return folder_.filePath(name).toStdString(); }

 private Q_SLOTS:
  void ratesAreFractions() {
    const auto check = [](double perSecond, int numerator, int denominator) {
      const FrameRate rate = frameRate(perSecond);
      return rate.numerator == numerator && rate.denominator == denominator;
    };
    QVERIFY(check(50, 50, 1));
    QVERIFY(check(1 / 0.02, 50, 1));
    QVERIFY(check(1 / 0.03, 100, 3));
    QVERIFY(check(29.97, 2997, 100));
    QVERIFY(check(0.01, 1, 100));
    QVERIFY(check(1000, 1000, 1));
    for (const double perSecond : {0.0, -1.0, 0.009, 1001.0, double(INFINITY), double(NAN)})
      QVERIFY_EXCEPTION_THROWN(frameRate(perSecond), base::InputError);
  }

  void aDecoderFindsThePictures() {
    writeQuarters(file("quarters.ogv"), pictures, frameRate(1 / 0.03));
    const test::DecodedVideo video = test::decodeVideo(file("quarters.ogv"));
    QVERIFY2(video.problem.empty(), video.problem.c_str());
    QCOMPARE(video.frames.size(), std::size_t(pictures));
    QCOMPARE(video.rate.num, 100);
    QCOMPARE(video.rate.den, 3);
    for (int i = 0; i < pictures; ++i) {
      const auto& frame = video.frames[static_cast<std::size_t>(i)];
      QCOMPARE(frame.width, width);
      QCOMPARE(frame.height, height);
      QVERIFY(isNear(frame.color(width - 4, height - 4), {255, 255, 255}));
      QVERIFY(isNear(frame.color(4, height - 4), {0, 0, 255}));
      QVERIFY(isNear(frame.color(4, height / 2 - 8), {255, 0, 0}));
      QVERIFY(isNear(frame.color(width - 4, height / 2 - 8), {0, 255, 0}));
      // What moves over other colours keeps less of its own.
      if (2 * i + 8 < width) QVERIFY(isNearestToBlack(frame.color(2 * i + 8, 16)));
      if (i >= 8) QVERIFY(!isNearestToBlack(frame.color(2 * i - 8, 16)));
    }
  }

  void pagesAreWhole() {
    writeQuarters(file("pages.ogv"), pictures, {50, 1});
    const std::string bytes = scene::readTextFile(file("pages.ogv"));
    const std::vector<test::OggPage> pages = test::oggPages(bytes);
    QVERIFY(pages.size() > 3);
    for (std::size_t i = 0; i < pages.size(); ++i) {
      QVERIFY(pages[i].sumHolds);
      QCOMPARE(pages[i].number, static_cast<std::uint32_t>(i));
      QCOMPARE((pages[i].flags & 2) != 0, i == 0);
      QCOMPARE((pages[i].flags & 4) != 0, i + 1 == pages.size());
    }
    // The identification header (Theora specification, 6.2): sizes in blocks and pixels, rate, bits of the shift.
    const std::string& head = pages[0].body;
    const auto big = [&](std::size_t at, int size) {
      unsigned value = 0;
      for (int i = 0; i < size; ++i) value = value << 8 | static_cast<std::uint8_t>(head[at + i]);
      return value;
    };
    QCOMPARE(head.substr(0, 7), std::string("\x80theora"));
    QCOMPARE(big(10, 2), 10u);
    QCOMPARE(big(12, 2), 6u);
    QCOMPARE(big(14, 3), unsigned(width));
    QCOMPARE(big(17, 3), unsigned(height));
    QCOMPARE(big(22, 4), 50u);
    QCOMPARE(big(26, 4), 1u);
    const unsigned shift = big(40, 2) >> 5 & 31;
    // The last page tells how many pictures there are: those before the last key frame, and those since.
    const std::int64_t granule = pages.back().granule;
    QCOMPARE((granule >> shift) + (granule & ((1 << shift) - 1)), std::int64_t(pictures));
    // The same pictures give the same bytes.
    writeQuarters(file("again.ogv"), pictures, {50, 1});
    QVERIFY(scene::readTextFile(file("again.ogv")) == bytes);
  }

  void whatIsNotCommittedLeavesNothing() {
    scene::writeTextFile(file("old.ogv"), "older");
    const QStringList before = QDir(folder_.path()).entryList(QDir::Files | QDir::Hidden);
    {
      TheoraVideo video(file("old.ogv"), width, height, {25, 1});
      video.add(quarters(0));
      video.add(quarters(1));
    }
    QCOMPARE(QDir(folder_.path()).entryList(QDir::Files | QDir::Hidden), before);
    QCOMPARE(scene::readTextFile(file("old.ogv")), std::string("older"));
    QVERIFY_EXCEPTION_THROWN(TheoraVideo(file("nowhere/a.ogv"), width, height, FrameRate{25, 1}), base::InputError);
  }

  /// As a disk that fills up would, a limit of the file's size ends writing half way.
  void aFullDiskIsAnErrorAndLeavesNothing() {
    writeQuarters(file("whole.ogv"), pictures, {25, 1});
    rlimit usual{};
    QCOMPARE(::getrlimit(RLIMIT_FSIZE, &usual), 0);
    const QStringList before = QDir(folder_.path()).entryList(QDir::Files | QDir::Hidden);
    const auto usualHandler = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{std::filesystem::file_size(file("whole.ogv")) / 2, usual.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    QString sentence;
    try {
      writeQuarters(file("large.ogv"), pictures, {25, 1});
    } catch (const base::InputError& error) {
      sentence = error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &usual);
    ::signal(SIGXFSZ, usualHandler);
    QVERIFY2(
        sentence.contains("large.ogv") && sentence.contains("cannot be written: File too large"), qPrintable(sentence));
    QCOMPARE(QDir(folder_.path()).entryList(QDir::Files | QDir::Hidden), before);
  }
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestTheoraVideo)
#include "test_theora_video.moc"
