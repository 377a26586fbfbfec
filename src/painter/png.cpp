#include "png.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>
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

/// A chunk of a PNG file: length, name, data, check sum, high bytes first.
std::string chunk(const std::string& name, const std::string& data) {
    const auto number = [](std::uint32_t value) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
        return bytes;
    };
    std::uint32_t sum = 0xffffffff; // CRC-32 of the PNG specification
    for (const char c : name + data) {
        sum ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) sum = (sum & 1) != 0 ? 0xedb88320 ^ sum >> 1 : sum >> 1;
    }
    return number(static_cast<std::uint32_t>(data.size())) + name + data + number(~sum);
}

/// The file says how large it is to be printed.
std::string with_dpi(std::string png, std::int32_t dpi) {
    constexpr std::size_t header = 8 + 25; // the signature and the first chunk
    const auto per_metre = static_cast<std::uint32_t>(std::lround(dpi / 0.0254));
    std::string data;
    for (int axis = 0; axis < 2; ++axis)
        for (int shift = 24; shift >= 0; shift -= 8) data += static_cast<char>(per_metre >> shift & 0xff);
    return dpi > 0 && png.size() > header ? png.insert(header, chunk("pHYs", data + '\1')) : png;
}

} // namespace

vtkSmartPointer<vtkImageData> image_of(vtkRenderWindow* window, const Paper& paper, int finer) {
    window->Render();
    vtkNew<vtkWindowToImageFilter> picture;
    picture->SetInput(window);
    picture->ShouldRerenderOff();
    picture->SetInputBufferTypeToRGB();
    picture->ReadFrontBufferOff();
    picture->Update();
    return smoothed(picture->GetOutput(), paper.fine ? 1 : finer);
}

std::string png_of(vtkImageData* image, const Paper& paper) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->WriteToMemoryOn();
    writer->Write();
    const auto* bytes = writer->GetResult();
    if (bytes == nullptr || bytes->GetNumberOfValues() == 0) throw std::runtime_error("the picture cannot be made");
    const auto* first = const_cast<vtkUnsignedCharArray*>(bytes)->GetPointer(0);
    return with_dpi({reinterpret_cast<const char*>(first), static_cast<std::size_t>(bytes->GetNumberOfValues())},
                    paper.dpi);
}

} // namespace kaya
