// Words on pictures, in a font that has Greek and all Latin letters.
#pragma once

#include <string>

class vtkRenderer;
class vtkTextProperty;

namespace kaya {

/// DejaVu Sans where it is installed, otherwise VTK's own font, which has the letters of western Europe only.
void use_font(vtkTextProperty* style, bool bold = false);

enum class Anchor { left, middle, right };
struct Words {
    double size = 12; ///< height of the font in pixels
    bool bold = false;
    Anchor across = Anchor::left; ///< which part of the text is at the place
    bool centred = false;         ///< the place is at half of the height of the text, not below it
};
/// A text by a place of the picture, in pixels from its lower left corner.
void add_words(vtkRenderer* renderer, const std::string& text, double x, double y, const Words& how);

/// About how wide a text is, in heights of its font.
double width_of(const std::string& text);

} // namespace kaya
