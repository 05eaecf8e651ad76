#include "ui/render/image.hpp"

#include <unistd.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <cstring>
#include <fstream>
#include <string>

#include "core/base/error.hpp"

namespace pliant::render {

void writePng(const Image& image, const std::filesystem::path& file) {
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
  const vtkUnsignedCharArray* bytes = writer->GetResult();

  const std::filesystem::path temporary = file.string() + "." + std::to_string(getpid()) + ".tmp";
  std::error_code failure;
  if (std::ofstream stream(temporary, std::ios::binary);
      !stream.write(reinterpret_cast<const char*>(const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0)),
                    bytes->GetNumberOfValues()) ||
      !stream.flush())
    failure = std::make_error_code(std::errc::io_error);
  if (!failure) std::filesystem::rename(temporary, file, failure);
  if (failure) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw base::InputError(file.string(), "the picture cannot be written here");
  }
}

}  // namespace pliant::render
