// The content of a window as an image, and an image as the bytes of a PNG file.
#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vtkImageData.h>
#include <vtkSmartPointer.h>

class vtkRenderWindow;

namespace kaya {

/// The content of a window. Each pixel is the mean of a square of `finer` pixels of the window along a side, unless the paper wants them all.
vtkSmartPointer<vtkImageData> image_of(vtkRenderWindow* window, const Paper& paper, int finer);

std::string png_of(vtkImageData* image, const Paper& paper);

} // namespace kaya
