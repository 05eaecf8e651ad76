#pragma once

namespace pliant::shell {

enum class Theme { system, light, dark };

/// Sets the application's style and colours; `system` follows the desktop's palette.
void applyTheme(Theme theme);

}  // namespace pliant::shell
