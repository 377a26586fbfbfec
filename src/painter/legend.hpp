// Texts on a picture: title, note, and legends of colours.
#pragma once

#include "scene/scene.hpp"

class vtkRenderer;
class vtkLookupTable;

namespace kaya {

void fill_colours(vtkLookupTable* table, const ColourBar& bar);
void add_texts(vtkRenderer* renderer, const Scene& scene);

} // namespace kaya
