#pragma once

namespace pliant::render {

/// VTK draws text of all windows by one renderer with one cache of glyphs, which is made for one thread. From now on
/// threads take turns there; the rest of what they draw in windows of their own goes on side by side. To be called
/// before any vtkTextActor is made, since these keep the renderer that they find; later calls do nothing.
void makeTextThreadSafe();

/// Calls it for the members after this one.
struct ThreadSafeText {
  ThreadSafeText() { makeTextThreadSafe(); }
};

}  // namespace pliant::render
