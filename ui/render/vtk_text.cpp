#include "ui/render/vtk_text.hpp"

#include <vtkTextProperty.h>

#include <filesystem>
#include <string>

namespace pliant::render {
namespace {

const std::string& fontFile() {
  static const std::string file = [] {
    for (const char* candidate : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",    // Debian, Ubuntu
                                  "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",  // Fedora
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf"}) {             // Arch
      std::error_code ignored;
      if (std::filesystem::exists(candidate, ignored)) return std::string(candidate);
    }
    return std::string();
  }();
  return file;
}

}  // namespace

void setTextStyle(vtkTextProperty* property, int size, const Color& color) {
  if (fontFile().empty()) {
    property->SetFontFamilyToArial();
  } else {
    property->SetFontFamily(VTK_FONT_FILE);
    property->SetFontFile(fontFile().c_str());
  }
  property->SetFontSize(size);
  property->SetColor(color[0], color[1], color[2]);
  property->ShadowOff();
}

}  // namespace pliant::render
