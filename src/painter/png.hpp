// The content of a window as the bytes of a PNG file.
#pragma once

#include <string>

class vtkRenderWindow;

namespace kaya {

/// Each pixel is the mean of a square of `finer` pixels of the window along a side.
std::string png_of(vtkRenderWindow* window, int finer);

} // namespace kaya
