#pragma once

namespace pliant::render {

/// VTK draws text of all windows by one renderer with one cache of glyphs, which is made for one thread. From now on
/// threads take turns there; the rest of what they draw in windows of their own goes on side by side. To be called
/// before any text is drawn, by everything that draws text; later calls do nothing.
void makeTextThreadSafe();

}  // namespace pliant::render
