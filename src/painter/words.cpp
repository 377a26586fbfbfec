#include "words.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

namespace kaya {

namespace {

/// The font's file in the folders of the usual systems; "" where it is missing.
std::string font_file(const std::string& name) {
    static constexpr std::array folders{"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu-sans-fonts",
                                        "/usr/share/fonts/TTF", "/usr/share/fonts/dejavu"};
    for (const char* folder : folders) {
        std::error_code none;
        const auto file = std::filesystem::path(folder) / name;
        if (std::filesystem::exists(file, none)) return file.string();
    }
    return {};
}

} // namespace

void use_font(vtkTextProperty* style, bool bold) {
    static const std::array files{font_file("DejaVuSans.ttf"), font_file("DejaVuSans-Bold.ttf")};
    const std::string& file = files[bold ? 1 : 0];
    style->SetItalic(0);
    style->SetShadow(0);
    style->SetColor(0.1, 0.1, 0.1);
    if (file.empty()) {
        style->SetFontFamilyToArial();
        style->SetBold(bold);
        return;
    }
    style->SetFontFamily(VTK_FONT_FILE);
    style->SetFontFile(file.c_str());
    style->SetBold(0); // the file is of the bold letters
}

void add_words(vtkRenderer* renderer, const std::string& text, double x, double y, const Words& how) {
    if (text.empty()) return;
    vtkNew<vtkTextActor> actor;
    actor->SetInput(text.c_str());
    actor->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
    actor->SetDisplayPosition(static_cast<int>(x), static_cast<int>(y));
    auto* style = actor->GetTextProperty();
    use_font(style, how.bold);
    style->SetFontSize(static_cast<int>(how.size));
    if (how.across == Anchor::middle) style->SetJustificationToCentered();
    if (how.across == Anchor::right) style->SetJustificationToRight();
    if (how.centred) style->SetVerticalJustificationToCentered();
    renderer->AddActor2D(actor);
}

double width_of(const std::string& text) {
    const auto letters = std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }); // of UTF-8
    return 0.62 * static_cast<double>(letters);
}

} // namespace kaya
