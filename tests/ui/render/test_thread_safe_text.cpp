#include "ui/render/thread_safe_text.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <QTest>
#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "ui/render/stage.hpp"
#include "ui/render/vtk_text.hpp"

namespace pliant::render {

namespace {

/// The pixels of a text, as VTK draws it for labels.
std::vector<unsigned char> drawn(const std::string& text, int size) {
  vtkNew<vtkTextProperty> style;
  setTextStyle(style, size, {0, 0, 0});
  vtkNew<vtkImageData> image;
  int dimensions[2];
  if (!vtkTextRenderer::GetInstance()->RenderString(style, vtkStdString(text), image, dimensions, 72)) return {};
  const auto* pixels = static_cast<const unsigned char*>(image->GetScalarPointer());
  return {pixels, pixels + image->GetNumberOfPoints() * image->GetNumberOfScalarComponents()};
}

std::vector<std::vector<unsigned char>> drawnTexts() {
  std::vector<std::vector<unsigned char>> all;
  for (int i = 0; i < 300; ++i) all.push_back(drawn("ω = " + std::to_string(i * 7919) + " rad/s", 9 + i % 23));
  return all;
}

}  // namespace

class TestThreadSafeText : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void everyStageSeesToIt() {
    const Stage stage;
    QCOMPARE(vtkTextRenderer::GetInstance()->GetClassName(), "LockedTextRenderer");
  }

  void threadsDrawTheSameText() {
    makeTextThreadSafe();
    const auto alone = drawnTexts();
    QVERIFY(std::none_of(alone.begin(), alone.end(), [](const auto& pixels) { return pixels.empty(); }));
    std::vector<std::vector<unsigned char>> beside[3];
    std::vector<std::thread> threads;
    for (auto& texts : beside) threads.emplace_back([&texts] { texts = drawnTexts(); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& texts : beside) QVERIFY(texts == alone);
  }
};

}  // namespace pliant::render

QTEST_GUILESS_MAIN(pliant::render::TestThreadSafeText)
#include "test_thread_safe_text.moc"
