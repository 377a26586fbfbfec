#include "legend.hpp"

#include "scene/ticks.hpp"

#include <algorithm>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

namespace kaya {

namespace {

constexpr std::size_t most_names = 16; // in a legend

/// A text by a point of the picture, counted in pixels from the lower left corner.
void add_text(vtkRenderer* renderer, const std::string& text, double x, double y, double size, bool bold = false,
              bool middle = false) {
    if (text.empty()) return;
    vtkNew<vtkTextActor> actor;
    actor->SetInput(text.c_str());
    actor->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
    actor->SetDisplayPosition(static_cast<int>(x), static_cast<int>(y));
    auto* style = actor->GetTextProperty();
    style->SetFontFamilyToArial();
    style->SetFontSize(static_cast<int>(size));
    style->SetColor(0.1, 0.1, 0.1);
    style->SetBold(bold);
    if (middle) style->SetVerticalJustificationToCentered();
    renderer->AddActor2D(actor);
}

/// Rectangles in pixels, each in one colour.
class Rectangles {
public:
    void add(double x, double y, double width, double height, const Colour& colour) {
        const vtkIdType first = points_->GetNumberOfPoints();
        points_->InsertNextPoint(x, y, 0);
        points_->InsertNextPoint(x + width, y, 0);
        points_->InsertNextPoint(x + width, y + height, 0);
        points_->InsertNextPoint(x, y + height, 0);
        const vtkIdType corners[4] = {first, first + 1, first + 2, first + 3};
        cells_->InsertNextCell(4, corners);
        for (const double part : colour) colours_->InsertNextValue(static_cast<unsigned char>(255 * part + 0.5));
    }
    void show(vtkRenderer* renderer) {
        colours_->SetNumberOfComponents(3);
        vtkNew<vtkPolyData> data;
        data->SetPoints(points_);
        data->SetPolys(cells_);
        data->GetCellData()->SetScalars(colours_);
        vtkNew<vtkPolyDataMapper2D> mapper;
        mapper->SetInputData(data);
        vtkNew<vtkActor2D> actor;
        actor->SetMapper(mapper);
        renderer->AddActor2D(actor);
    }

private:
    vtkNew<vtkPoints> points_;
    vtkNew<vtkCellArray> cells_;
    vtkNew<vtkUnsignedCharArray> colours_;
};

/// Draws from `top` downwards and returns where the next one begins.
double add_names(vtkRenderer* renderer, const ColourBar& bar, double left, double top, double font) {
    Rectangles boxes;
    const std::size_t shown = std::min(bar.names.size(), most_names);
    double y = top - 1.8 * font;
    for (std::size_t k = 0; k < shown; ++k, y -= 1.6 * font) {
        boxes.add(left, y - 0.5 * font, 1.4 * font, font, named_colour(k));
        add_text(renderer, bar.names[k], left + 2 * font, y, font, false, true);
    }
    if (shown < bar.names.size()) {
        add_text(renderer, "and " + std::to_string(bar.names.size() - shown) + " more", left + 2 * font, y, font, false,
                 true);
        y -= 1.6 * font;
    }
    boxes.show(renderer);
    return y;
}

double add_numbers(vtkRenderer* renderer, const ColourBar& bar, double left, double top, double height, double font) {
    Rectangles boxes;
    const double bottom = top - 1.5 * font - height;
    constexpr int steps = 128;
    for (int k = 0; k < steps; ++k) {
        const double part = (k + 0.5) / steps;
        boxes.add(left, bottom + height * k / steps, 1.4 * font, height / steps + 1,
                  bar.diverging ? diverging_colour(part) : sequential_colour(part));
    }
    const Ticks ticks = round_ticks(bar.low, bar.high, 6);
    for (const double value : ticks.values()) {
        const double part = (value - bar.low) / (bar.high - bar.low);
        if (part < -1e-9 || part > 1 + 1e-9) continue;
        const double y = bottom + height * part;
        boxes.add(left + 1.4 * font, y, 0.4 * font, std::max(1.0, font / 14), {0.1, 0.1, 0.1});
        add_text(renderer, ticks.label(value), left + 2.2 * font, y, font, false, true);
    }
    boxes.show(renderer);
    return bottom - 2 * font;
}

} // namespace

void fill_colours(vtkLookupTable* table, const ColourBar& bar) {
    const bool named = !bar.names.empty();
    const int count = named ? static_cast<int>(bar.names.size()) : 256;
    table->SetNumberOfTableValues(count);
    for (int k = 0; k < count; ++k) {
        const double part = count > 1 ? static_cast<double>(k) / (count - 1) : 0.5;
        const Colour c = named           ? named_colour(static_cast<std::size_t>(k))
                         : bar.diverging ? diverging_colour(part)
                                         : sequential_colour(part);
        table->SetTableValue(k, c[0], c[1], c[2], 1);
    }
    if (named) table->SetTableRange(-0.5, count - 0.5);
    else table->SetTableRange(bar.low, bar.high);
    table->SetNanColor(0.75, 0.75, 0.75, 1);
}

void add_texts(vtkRenderer* renderer, const Scene& scene) {
    const double font = std::max(11.0, std::min(scene.width, scene.height * 4 / 3) / 62.0);
    add_text(renderer, scene.title, 1.5 * font, scene.height - 2.4 * font, 1.5 * font, true);
    add_text(renderer, scene.note, 1.5 * font, scene.height - 4.1 * font, font);
    double top = scene.height - 6 * font;
    const auto bars = static_cast<double>(std::max<std::size_t>(scene.bars.size(), 1));
    for (const ColourBar& bar : scene.bars) {
        std::size_t longest = bar.title.size();
        for (const std::string& name : bar.names) longest = std::max(longest, name.size() + 4);
        const double left = scene.width - std::max(10.0, 0.58 * static_cast<double>(longest) + 1.5) * font;
        add_text(renderer, bar.title, left, top, font, true);
        top = bar.names.empty() ? add_numbers(renderer, bar, scene.width - 10 * font, top,
                                              (scene.height - 12 * font) / bars - 5 * font, font)
                                : add_names(renderer, bar, left, top, font);
        top -= font;
    }
}

} // namespace kaya
