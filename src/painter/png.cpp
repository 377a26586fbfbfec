#include "png.hpp"

#include <stdexcept>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

namespace kaya {

namespace {

vtkSmartPointer<vtkImageData> smoothed(vtkImageData* fine, int finer) {
    const int width = fine->GetDimensions()[0] / finer, height = fine->GetDimensions()[1] / finer;
    auto result = vtkSmartPointer<vtkImageData>::New();
    result->SetDimensions(width, height, 1);
    result->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    const auto* from = static_cast<const unsigned char*>(fine->GetScalarPointer());
    auto* to = static_cast<unsigned char*>(result->GetScalarPointer());
    const auto at = [&](int x, int y, int k) {
        return from[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width * finer) +
                     static_cast<std::size_t>(x)) *
                        3 +
                    static_cast<std::size_t>(k)];
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int k = 0; k < 3; ++k) {
                int sum = 0;
                for (int v = 0; v < finer; ++v)
                    for (int u = 0; u < finer; ++u) sum += at(x * finer + u, y * finer + v, k);
                *to++ = static_cast<unsigned char>((sum + finer * finer / 2) / (finer * finer));
            }
    return result;
}

} // namespace

std::string png_of(vtkRenderWindow* window, int finer) {
    window->Render();
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(window);
    picture->SetInputBufferTypeToRGB();
    picture->ReadFrontBufferOff();
    picture->Update();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(smoothed(picture->GetOutput(), finer));
    writer->WriteToMemoryOn();
    writer->Write();
    const auto* bytes = writer->GetResult();
    if (bytes == nullptr || bytes->GetNumberOfValues() == 0) throw std::runtime_error("the picture cannot be made");
    const auto* first = const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0);
    return {reinterpret_cast<const char*>(first), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}

} // namespace kaya
