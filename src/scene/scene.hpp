// A picture as plain numbers: made from the model by src/pictures, drawn by the program in src/painter.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace kaya {

/// The legend of colours: a range of numbers, or a list of names.
struct ColourBar {
    std::string title;              ///< quantity and unit: "displacement [length]"
    double low = 0, high = 1;       ///< of the colours
    double least = 0, greatest = 1; ///< of the values
    bool diverging = false;         ///< zero is in the middle
    std::vector<std::string> names; ///< value k is the k-th name; none: a range of numbers
    std::string grey;               ///< what is drawn in grey; none: nothing is
    template <class Visit> void parts(Visit&& visit) {
        visit(title), visit(low), visit(high), visit(least), visit(greatest), visit(diverging), visit(names),
            visit(grey);
    }
};

/// Things of one kind that are drawn alike. No point is shared.
struct Layer {
    enum class Kind : std::int32_t { triangles, lines, arrows };
    Kind kind = Kind::triangles;
    std::vector<float> points;  ///< x y z of three corners, two ends, or of one foot
    std::vector<float> values;  ///< one for each point; none: all in `colour`
    std::vector<float> vectors; ///< of arrows, in the units of points
    std::array<float, 3> colour{0.8F, 0.8F, 0.8F};
    float opacity = 1, width = 1;
    std::int32_t bar = -1; ///< index into Scene::bars
    template <class Visit> void parts(Visit&& visit) {
        visit(kind), visit(points), visit(values), visit(vectors), visit(colour), visit(opacity), visit(width),
            visit(bar);
    }
};

/// What a picture is drawn on.
struct Paper {
    std::int32_t dpi = 0; ///< pixels per inch when it is printed; 0: the file does not say
    bool fine = false;    ///< twice as many pixels along a side, for a page that is enlarged
    template <class Visit> void parts(Visit&& visit) { visit(dpi), visit(fine); }
};

/// The model from one side.
struct Scene {
    std::string title, note; ///< on top; small below it
    std::int32_t width = 1200, height = 900;
    Paper paper;
    double dip = 65, dip_direction = 155; ///< of the plane of the picture; its normal points to the eye
    std::array<double, 3> centre{0, 0, 0};
    bool has_centre = false;
    double magnification = 1;
    bool perspective = true, axes = true, scale_bar = true;
    std::string length_unit; ///< beside the scale bar
    std::vector<ColourBar> bars;
    std::vector<Layer> layers;
    template <class Visit> void parts(Visit&& visit) {
        visit(title), visit(note), visit(width), visit(height), visit(paper), visit(dip), visit(dip_direction),
            visit(centre), visit(has_centre);
        visit(magnification), visit(perspective), visit(axes), visit(scale_bar), visit(length_unit), visit(bars),
            visit(layers);
    }
};

/// Two states of a model, side by side, with the same colours for the same values.
struct ScenePair {
    Scene left, right;                       ///< of the same size
    std::int32_t width = 2400, height = 900; ///< of both together
    Paper paper{};
    template <class Visit> void parts(Visit&& visit) {
        visit(left), visit(right), visit(width), visit(height), visit(paper);
    }
};
/// Right is the present one, of whose size both are. Colours of one title cover the values of both.
ScenePair side_by_side(Scene left, Scene right);

struct Curve {
    std::string name; ///< none: not in the legend
    std::vector<double> x, y;
    bool marks = false; ///< points and no line
    template <class Visit> void parts(Visit&& visit) { visit(name), visit(x), visit(y), visit(marks); }
};

struct Chart {
    std::string title, x_label, y_label;
    std::int32_t width = 1200, height = 800;
    std::vector<Curve> curves;
    bool net =
        false; ///< of directions, seen from above: a circle of radius 1 around the origin with the four cardinal directions, and no axes
    bool equal = false; ///< a length is as long across as upward
    Paper paper{};
    template <class Visit> void parts(Visit&& visit) {
        visit(title), visit(x_label), visit(y_label), visit(width), visit(height), visit(curves), visit(net),
            visit(equal), visit(paper);
    }
};

} // namespace kaya
