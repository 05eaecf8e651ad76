#include "ui/render/image.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <cstring>

#include "core/base/pending_file.hpp"

namespace pliant::render {

Image beside(const Image& left, const Image& right) {
  Image all{left.width + right.width, right.height, {}};
  all.pixels.reserve(4 * static_cast<std::size_t>(all.width) * all.height);
  for (int y = 0; y < all.height; ++y)
    for (const Image* part : {&left, &right}) {
      const auto row = part->pixels.begin() + std::ptrdiff_t{4} * part->width * y;
      all.pixels.insert(all.pixels.end(), row, row + std::ptrdiff_t{4} * part->width);
    }
  return all;
}

std::string pngOf(const Image& image) {
  vtkNew<vtkImageData> pixels;
  pixels->SetDimensions(image.width, image.height, 1);
  pixels->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* target = static_cast<unsigned char*>(pixels->GetScalarPointer());
  for (int y = image.height - 1; y >= 0; --y)  // VTK counts rows from the bottom
    for (int x = 0; x < image.width; ++x, target += 3)
      std::memcpy(target, &image.pixels[4 * (static_cast<std::size_t>(y) * image.width + x)], 3);
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputData(pixels);
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  return {reinterpret_cast<const char*>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

void writePng(const Image& image, const std::filesystem::path& file) { base::writeFile(file, pngOf(image)); }

}  // namespace pliant::render
