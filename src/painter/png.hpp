// The content of a window as the bytes of a PNG file.
#pragma once

#include "scene/scene.hpp"

#include <string>

class vtkRenderWindow;

namespace kaya {

/// Each pixel is the mean of a square of `finer` pixels of the window along a side, unless the paper wants them all.
std::string png_of(vtkRenderWindow* window, const Paper& paper, int finer);

} // namespace kaya
