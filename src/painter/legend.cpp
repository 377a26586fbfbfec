#include "legend.hpp"

#include "scene/ticks.hpp"
#include "words.hpp"

#include <algorithm>
#include <cmath>
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
#include <vtkUnsignedCharArray.h>

namespace kaya {

namespace {

constexpr std::size_t most_names = 16;   // in a legend
constexpr Colour grey{0.75, 0.75, 0.75}; // of what has no value

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

/// The words of a legend, and the widest of them.
struct Head {
    std::string quantity, unit; ///< "displacement", "[length]"
    explicit Head(const std::string& title) {
        const auto mark = title.find(" [");
        quantity = title.substr(0, mark);
        if (mark != std::string::npos) unit = title.substr(mark + 1);
    }
};

double width_of_legend(const ColourBar& bar) {
    const Head head(bar.title);
    double widest = std::max({width_of(head.quantity) * 1.1, width_of(head.unit), width_of(bar.grey) + 2});
    if (bar.names.empty()) return std::max(widest, 2.2 + width_of("-0.0000e-00"));
    for (const std::string& name : bar.names) widest = std::max(widest, 2 + width_of(name));
    return widest;
}

/// A legend in a column of the picture, drawn downwards.
class LegendColumn {
public:
    LegendColumn(vtkRenderer* renderer, double left, double top, double font)
        : renderer_(renderer), left_(left), top_(top), font_(font) {}

    void add(const ColourBar& bar, double height) {
        const double end = top_ - height;
        const Head head(bar.title);
        line(head.quantity, 0, true);
        if (!head.unit.empty()) line(head.unit, 0, false);
        if (bar.names.empty()) add_numbers(bar, top_ - end - (bar.grey.empty() ? 3 : 4.6) * font_);
        else add_names(bar);
        if (!bar.grey.empty()) {
            boxes_.add(left_, top_ - 0.5 * font_, 1.4 * font_, font_, grey);
            line(bar.grey, 2, false, true);
        }
        top_ = std::min(top_ - font_, end);
    }
    void show() { boxes_.show(renderer_); }

private:
    void line(const std::string& text, double indent, bool bold, bool centred = false) {
        add_words(renderer_, text, left_ + indent * font_, top_, {font_, bold, Anchor::left, centred});
        top_ -= 1.6 * font_;
    }

    void add_names(const ColourBar& bar) {
        const std::size_t shown = std::min(bar.names.size(), most_names);
        for (std::size_t k = 0; k < shown; ++k) {
            boxes_.add(left_, top_ - 0.5 * font_, 1.4 * font_, font_, named_colour(k));
            line(bar.names[k], 2, false, true);
        }
        if (shown < bar.names.size()) line("and " + std::to_string(bar.names.size() - shown) + " more", 2, false, true);
    }

    /// The least and the greatest value at their places, and round numbers where there is room between them.
    void add_numbers(const ColourBar& bar, double height) {
        height = std::max(height, 4 * font_);
        const double bottom = top_ - height;
        constexpr int steps = 128;
        for (int k = 0; k < steps; ++k)
            boxes_.add(left_, bottom + height * k / steps, 1.4 * font_, height / steps + 1,
                       bar.diverging ? diverging_colour((k + 0.5) / steps) : sequential_colour((k + 0.5) / steps));
        std::vector<double> taken;
        const auto mark = [&](double value, const std::string& text) {
            const double part = (value - bar.low) / (bar.high - bar.low), y = bottom + height * part;
            if (!(part > -1e-9 && part < 1 + 1e-9)) return;
            if (std::ranges::any_of(taken, [&](double other) { return std::abs(other - y) < 1.3 * font_; })) return;
            taken.push_back(y);
            boxes_.add(left_ + 1.4 * font_, y, 0.4 * font_, std::max(1.0, font_ / 14), {0.1, 0.1, 0.1});
            add_words(renderer_, text, left_ + 2.2 * font_, y, {font_, false, Anchor::left, true});
        };
        // A value that is rounding beside the range is 0.
        const auto end = [&](double value) { return std::abs(value) < 1e-6 * (bar.high - bar.low) ? 0.0 : value; };
        mark(bar.greatest, short_number(end(bar.greatest)));
        mark(bar.least, short_number(end(bar.least)));
        const Ticks ticks = round_ticks(bar.low, bar.high, 6);
        for (const double value : ticks.values()) mark(value, ticks.label(value));
        top_ = bottom - 2 * font_;
    }

    vtkRenderer* renderer_;
    double left_, top_, font_;
    Rectangles boxes_;
};

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
    table->SetNanColor(grey[0], grey[1], grey[2], 1);
}

Layout layout_of(const Scene& scene) {
    Layout layout;
    const double font = layout.font = std::max(11.0, std::min(scene.width, scene.height * 4 / 3) / 62.0);
    double column = scene.axes ? 9 : 0; // heights of the font
    for (const ColourBar& bar : scene.bars) column = std::max(column, width_of_legend(bar));
    layout.column = scene.width - (column > 0 ? column + 1.5 : 0) * font;
    const bool words = !scene.title.empty() || !scene.note.empty(), below = scene.scale_bar && column == 0;
    layout.model = {1.5 * font, (below ? 4.5 : 1.5) * font, layout.column - 1.5 * font,
                    scene.height - (words ? 5.2 : 1.5) * font};
    return layout;
}

void add_texts(vtkRenderer* renderer, const Scene& scene, const Layout& layout) {
    const double font = layout.font;
    add_words(renderer, scene.title, 1.5 * font, scene.height - 2.4 * font, {1.4 * font, true});
    add_words(renderer, scene.note, 1.5 * font, scene.height - 4.1 * font, {font});
    if (scene.bars.empty()) return;
    const double top = layout.model.top - 1.2 * font, bottom = (scene.axes ? 11 : 4.5) * font;
    LegendColumn column(renderer, layout.column, top, font);
    for (const ColourBar& bar : scene.bars)
        column.add(bar, (top - bottom) / static_cast<double>(scene.bars.size()) - font);
    column.show();
}

void add_scale_bar(vtkRenderer* renderer, const Scene& scene, const Layout& layout, double pixel) {
    const double font = layout.font, room = std::max(8.0 * font, scene.width - layout.column - 1.5 * font);
    const double right = scene.width - 1.5 * font, length = round_length(room * pixel), size = length / pixel;
    const double left = layout.column < right - size ? layout.column : right - size, line = std::max(1.0, font / 8);
    Rectangles boxes;
    boxes.add(left, 1.6 * font, size, line, {0.1, 0.1, 0.1});
    for (const double end : {left, left + size - line})
        boxes.add(end, 1.6 * font - 0.3 * font, line, 0.6 * font + line, {0.1, 0.1, 0.1});
    boxes.show(renderer);
    std::string text = short_number(length);
    if (!scene.length_unit.empty()) text += " " + scene.length_unit;
    add_words(renderer, text, left + 0.5 * size, 2.2 * font, {font, false, Anchor::middle});
}

} // namespace kaya
