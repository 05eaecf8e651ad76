#pragma once

#include <string>

#include "ui/render/offscreen.hpp"

namespace pliant::cli {

/// A picture of the size "WIDTHxHEIGHT". Throws base::InputError for anything else.
render::PictureOptions pictureOf(const std::string& size);

}  // namespace pliant::cli
