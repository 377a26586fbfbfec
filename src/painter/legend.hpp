// Texts of a picture, beside the model: title, note, legends of colours, scale bar.
#pragma once

#include "scene/framing.hpp"

class vtkRenderer;
class vtkLookupTable;

namespace kaya {

void fill_colours(vtkLookupTable* table, const ColourBar& bar);
/// The parts of a picture, in pixels. Legends, the axes and the scale bar are in a column on the right.
struct Layout {
    double font = 12;
    double column = 0; ///< its left side; the width of the picture when there is none
    Area model;
};
Layout layout_of(const Scene& scene);

void add_texts(vtkRenderer* renderer, const Scene& scene, const Layout& layout);
/// `pixel` is the length of a pixel in the model.
void add_scale_bar(vtkRenderer* renderer, const Scene& scene, const Layout& layout, double pixel);

} // namespace kaya
