#include "ui/render/film.hpp"

#include <QDir>
#include <QImage>
#include <QTemporaryDir>
#include <QTest>
#include <numbers>
#include <thread>

#include "core/base/error.hpp"
#include "core/scene/json_text.hpp"
#include "tests/ui/render/decoded_video.hpp"
#include "tests/ui/render/hanging_sheet.hpp"
#include "tests/ui/render/swinging_fork.hpp"

namespace pliant::render {

namespace {

FilmOptions smallFilm() {
  FilmOptions film;
  film.picture.width = 320;
  film.picture.height = 240;
  film.picture.caption = "Film";
  return film;
}

bool same(const QImage& picture, const Image& image) {
  return picture.convertToFormat(QImage::Format_RGBA8888) ==
         QImage(image.pixels.data(), image.width, image.height, QImage::Format_RGBA8888);
}

}  // namespace

/// Clothes and motions become videos and numbered pictures.
class TestFilm : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void everyFrameOfAClothHasItsPicture() {
    const auto film = filmed("sheet.ogv", smallFilm());
    QVERIFY(film);
    QCOMPARE(film->pictures, 11);
    QCOMPARE(film->files, 1);
    const test::DecodedVideo video = test::decodeVideo(file("sheet.ogv"));
    QVERIFY2(video.problem.empty(), video.problem.c_str());
    QCOMPARE(video.rate.num, 10);  // frames are 0.1 s apart
    QCOMPARE(video.rate.den, 1);
    QCOMPARE(video.frames.size(), std::size_t(11));
    for (std::size_t i = 0; i < 11; ++i) {
      QCOMPARE(video.frames[i].width, 320);
      QCOMPARE(video.frames[i].height, 240);
      if (i > 0) QVERIFY(video.frames[i].differenceTo(video.frames[i - 1]) > 0.5);
    }
  }

  void picturesAreThoseOfStills() {
    const auto film = filmed("sheet.png", smallFilm());
    QVERIFY(film);
    QCOMPARE(film->files, 11);
    QCOMPARE(QDir(folder_->path()).entryList(QDir::Files | QDir::Hidden).size(), 11);
    PictureOptions still = smallFilm().picture;
    still.caption += "\nt = 1.000 s";
    QVERIFY(same(picture("sheet", 10), renderToImage(sheet_.problem, sheet_.frames, still)));
  }

  void anotherRateKeepsRealTime() {
    FilmOptions film = smallFilm();
    film.picturesPerSecond = 20;
    QCOMPARE(filmed("twice.png", film)->pictures, 21);
    for (int i = 0; i < 20; i += 2) {
      QVERIFY(picture("twice", i) == picture("twice", i + 1));
      QVERIFY(picture("twice", i) != picture("twice", i + 2));
    }
    film.picturesPerSecond = 5;
    QCOMPARE(filmed("half.png", film)->pictures, 6);
    for (int i = 0; i <= 5; ++i) QVERIFY(picture("half", i) == picture("twice", 4 * i));
    // Half as fast as life: the same pictures, shown for longer.
    film.picturesPerSecond.reset();
    film.speed = 0.5;
    const auto slow = filmed("slow.png", film);
    QCOMPARE(slow->pictures, 11);
    QCOMPARE(slow->rate.numerator, 5);
    QCOMPARE(slow->rate.denominator, 1);
    QVERIFY(picture("slow", 3) == picture("twice", 6));
  }

  void unevenFramesKeepTheirTimes() {
    auto frames = sheet_.frames;
    frames.erase(frames.begin() + 5);
    frames.back() = std::make_shared<scene::ClothFrame>(*frames.back());
    const_cast<scene::ClothFrame&>(*frames.back()).time = 0.95;
    base::ExecutionContext context;
    const auto film = filmCloth(sheet_.problem, frames, FrameClock::seconds, smallFilm(), file("uneven.png"), context);
    QCOMPARE(film->rate.numerator, 20);  // the shortest time between two frames is 0.05 s
    QCOMPARE(film->pictures, 20);
    QVERIFY(picture("uneven", 10) == picture("uneven", 9));  // of 0.4 s
    QVERIFY(picture("uneven", 11) == picture("uneven", 9));
    QVERIFY(picture("uneven", 12) != picture("uneven", 11));
    QVERIFY(picture("uneven", 19) != picture("uneven", 18));
    // Whatever the rate, it ends with the last frame.
    FilmOptions coarse = smallFilm();
    coarse.picturesPerSecond = 2;
    QCOMPARE(filmCloth(sheet_.problem, frames, FrameClock::seconds, coarse, file("coarse.png"), context)->pictures, 3);
    QVERIFY(picture("coarse", 2) == picture("uneven", 19));
  }

  void drapesPlayStepByStep() {
    base::ExecutionContext context;
    auto frames = sheet_.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      auto step = std::make_shared<scene::ClothFrame>(*frames[i]);
      step->time = static_cast<double>(i);
      frames[i] = step;
    }
    const auto film = filmCloth(sheet_.problem, frames, FrameClock::steps, smallFilm(), file("drape.ogv"), context);
    QCOMPARE(film->pictures, 11);
    QCOMPARE(film->rate.perSecond(), drapeStepsPerSecond);
  }

  void aPeriodIsRepeated() {
    FilmOptions options = smallFilm();
    options.picturesPerSecond = 4;  // a period takes two seconds
    options.periods = 2;
    base::ExecutionContext context;
    const mechanics::Vector z = fork_.motion(0.03);
    const auto film = filmMotion(fork_.problem, z, 0.01, options, file("fork.png"), context);
    QCOMPARE(film->pictures, 16);
    for (int i = 0; i < 8; ++i) {
      const double tau = 2 * std::numbers::pi * i / 8;
      QVERIFY(same(picture("fork", i), renderToImage(fork_.model, fork_.problem, z, tau, options.picture)));
      QVERIFY(picture("fork", i) == picture("fork", i + 8));
    }
    QVERIFY(picture("fork", 0) != picture("fork", 4));
    QCOMPARE(filmMotion(fork_.problem, z, 0.01, options, file("fork.ogv"), context)->rate.perSecond(), 4.0);
    QCOMPARE(test::decodeVideo(file("fork.ogv")).frames.size(), std::size_t(16));
    // A thousand times slower than life.
    options.speed = 1e-3;
    options.periods = 1;
    QCOMPARE(filmMotion(fork_.problem, z, 0.01, options, file("slow.ogv"), context)->pictures, 40);
  }

  void cancelledFilmsLeaveNothing_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("video") << "sheet.ogv";
    QTest::newRow("pictures") << "sheet.png";
  }
  void cancelledFilmsLeaveNothing() {
    QFETCH(QString, name);
    scene::writeTextFile(file("sheet.ogv"), "older");
    base::ExecutionContext context([&](double fraction, const std::string&) {
      if (fraction > 0.5) cancelled_->requestCancel();
    });
    cancelled_ = &context;
    QVERIFY(!filmCloth(sheet_.problem, sheet_.frames, FrameClock::seconds, smallFilm(),
                       folder_->filePath(name).toStdString(), context));
    QVERIFY(context.progress() > 0.5 && context.progress() < 1);
    QCOMPARE(QDir(folder_->path()).entryList(QDir::Files | QDir::Hidden), QStringList("sheet.ogv"));
    QCOMPARE(scene::readTextFile(file("sheet.ogv")), std::string("older"));
  }

  void badInputIsRefused() {
    const auto refused = [&](const char* name, const FilmOptions& options) {
      try {
        filmed(name, options);
      } catch (const base::InputError&) {
        return QDir(folder_->path()).isEmpty();
      }
      return false;
    };
    QVERIFY(refused("sheet.avi", smallFilm()));
    QVERIFY(refused("nowhere/sheet.ogv", smallFilm()));
    QVERIFY(refused("nowhere/sheet.png", smallFilm()));
    FilmOptions bad = smallFilm();
    bad.picture.width = 0;
    QVERIFY(refused("sheet.ogv", bad));
    bad = smallFilm();
    bad.picturesPerSecond = 0;
    QVERIFY(refused("sheet.ogv", bad));
    bad = smallFilm();
    bad.speed = -1;
    QVERIFY(refused("sheet.ogv", bad));
    bad.speed = 1e-9;
    bad.picturesPerSecond = 1000;
    QVERIFY(refused("sheet.ogv", bad));
    base::ExecutionContext context;
    QVERIFY_EXCEPTION_THROWN(
        filmCloth(sheet_.problem, {}, FrameClock::seconds, smallFilm(), file("none.ogv"), context), base::InputError);
  }

  /// While a film is made, the window draws as well.
  void filmsAreMadeBesideOtherDrawing() {
    QVERIFY(filmed("alone.png", smallFilm()));
    PictureOptions still = smallFilm().picture;
    std::vector<Image> alone, beside;
    for (int i = 0; i < 11; ++i) {
      still.caption = "number " + std::to_string(i);
      alone.push_back(renderToImage(sheet_.problem, {sheet_.frames[5]}, still));
    }
    std::thread worker([&] { filmed("beside.png", smallFilm()); });
    for (int i = 0; i < 11; ++i) {
      still.caption = "number " + std::to_string(i);
      beside.push_back(renderToImage(sheet_.problem, {sheet_.frames[5]}, still));
    }
    worker.join();
    for (int i = 0; i < 11; ++i) {
      QVERIFY(alone[static_cast<std::size_t>(i)].pixels == beside[static_cast<std::size_t>(i)].pixels);
      QVERIFY(picture("alone", i) == picture("beside", i));
    }
  }

 private:
  std::string file(const char* name) const { return folder_->filePath(name).toStdString(); }
  QImage picture(const char* name, int number) const {
    return QImage(folder_->filePath(QStringLiteral("%1_%2.png").arg(name).arg(number, 5, 10, QLatin1Char('0'))));
  }
  std::optional<Film> filmed(const char* name, const FilmOptions& options) const {
    base::ExecutionContext context;
    return filmCloth(sheet_.problem, sheet_.frames, FrameClock::seconds, options, file(name), context);
  }

  const HangingSheet sheet_;
  const SwingingFork fork_;
  std::unique_ptr<QTemporaryDir> folder_;
  base::ExecutionContext* cancelled_ = nullptr;
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestFilm)
#include "test_film.moc"
