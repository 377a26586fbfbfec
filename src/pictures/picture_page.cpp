#include "pictures/picture_page.hpp"

#include "base/base64.hpp"

#include <cstddef>
#include <fmt/format.h>
#include <vector>

namespace kaya {

namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < 4; ++k) number = number << 8 | static_cast<unsigned char>(bytes.at(at + k));
    return number;
}

/// The compressed rows of a PNG file: its chunks IDAT without their heads.
std::string rows_of(const std::string& png) {
    std::string rows;
    constexpr std::size_t signature = 8, head = 8, sum = 4;
    for (std::size_t at = signature; at + head + sum <= png.size();) {
        const std::size_t size = number_at(png, at);
        if (png.compare(at + 4, 4, "IDAT") == 0) rows.append(png, at + head, size);
        at += head + size + sum;
    }
    return rows;
}

} // namespace

std::string svg_page(const std::string& png, std::int32_t width, std::int32_t height) {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
        "<image width=\"{0}\" height=\"{1}\" href=\"data:image/png;base64,{2}\"/>\n</svg>\n",
        width, height, base64(png));
}

std::string pdf_page(const std::string& png, std::int32_t width, std::int32_t height, std::int32_t dpi) {
    constexpr std::size_t header = 16; // the place of width and height in the file
    const std::uint32_t columns = number_at(png, header), lines = number_at(png, header + 4);
    const double points = 72.0 / dpi;
    const std::string rows = rows_of(png), drawing = fmt::format("q {:.3f} 0 0 {:.3f} 0 0 cm /Picture Do Q",
                                                                 width * points, height * points);
    std::string pdf = "%PDF-1.4\n";
    std::vector<std::size_t> places;
    const auto object = [&](const std::string& content) {
        places.push_back(pdf.size());
        pdf += fmt::format("{} 0 obj\n{}\nendobj\n", places.size(), content);
    };
    object("<< /Type /Catalog /Pages 2 0 R >>");
    object("<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
    object(fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.3f} {:.3f}] /Contents 4 0 R "
                       "/Resources << /XObject << /Picture 5 0 R >> >> >>",
                       width * points, height * points));
    object(fmt::format("<< /Length {} >>\nstream\n{}\nendstream", drawing.size(), drawing));
    object(fmt::format("<< /Type /XObject /Subtype /Image /Width {0} /Height {1} /ColorSpace /DeviceRGB "
                       "/BitsPerComponent 8 /Filter /FlateDecode "
                       "/DecodeParms << /Predictor 15 /Colors 3 /BitsPerComponent 8 /Columns {0} >> /Length {2} >>\n"
                       "stream\n",
                       columns, lines, rows.size()) +
           rows + "\nendstream");
    const std::size_t table = pdf.size();
    pdf += fmt::format("xref\n0 {}\n0000000000 65535 f \n", places.size() + 1);
    for (const std::size_t place : places) pdf += fmt::format("{:010} 00000 n \n", place);
    return pdf + fmt::format("trailer << /Size {} /Root 1 0 R >>\nstartxref\n{}\n%%EOF\n", places.size() + 1, table);
}

} // namespace kaya
