// A picture as a page of another format. The image on it is that of the PNG file, unchanged.
#pragma once

#include <cstdint>
#include <string>

namespace kaya {

/// An SVG file of `width` by `height` pixels.
std::string svg_page(const std::string& png, std::int32_t width, std::int32_t height);

/// A PDF file of one page; its size is that of `width` by `height` pixels at `dpi` pixels per inch. The same picture gives the same bytes:
/// there is no date in it. `png` must have three bytes per pixel (ISO 32000-1, 7.4.4.4: both formats compress rows alike).
std::string pdf_page(const std::string& png, std::int32_t width, std::int32_t height, std::int32_t dpi);

} // namespace kaya
