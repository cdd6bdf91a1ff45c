#pragma once

#include "options.h"

class vtkRenderWindow;

namespace hexwall {

/// Fills the window from the file: the surface, the lines over it, and a bar with the colours.
/// \throws ReadError, UsageError
void build_scene(const PictureOptions& options, vtkRenderWindow* window);

}  // namespace hexwall
