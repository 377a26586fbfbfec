#include "scene/svg_chart.hpp"

#include "scene/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kaya {

namespace {

std::string xml(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (static_cast<unsigned char>(c) >= 32) result += c;
    }
    return result;
}

std::string colour_text(std::size_t index) {
    // The line colours begin with the dark ones: the background is white.
    static constexpr std::size_t order[] = {4, 5, 2, 6, 1, 0, 7, 3};
    const Colour c = named_colour(order[index % std::size(order)]);
    return fmt::format("rgb({:.0f},{:.0f},{:.0f})", 255 * c[0], 255 * c[1], 255 * c[2]);
}

struct Limits {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void take(double value) {
        if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    }
};

/// Converts numbers to positions on the picture.
struct Frame {
    Ticks x, y;
    double left, right, top, bottom, font;
    double across(double value) const { return left + (value - x.low) / (x.high - x.low) * (right - left); }
    double up(double value) const { return bottom - (value - y.low) / (y.high - y.low) * (bottom - top); }
};

std::string text_at(double x, double y, const std::string& text, const char* anchor, double size,
                    const char* more = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{:.1f}\"{}>{}</text>\n", x, y,
                       anchor, size, more, xml(text));
}

std::string grid(const Frame& f) {
    std::string svg;
    const auto line = [&](double x1, double y1, double x2, double y2) {
        svg += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#d8d8d8\"/>\n", x1, y1, x2, y2);
    };
    for (const double value : f.x.values()) {
        line(f.across(value), f.top, f.across(value), f.bottom);
        svg += text_at(f.across(value), f.bottom + 1.5 * f.font, f.x.label(value), "middle", f.font);
    }
    for (const double value : f.y.values()) {
        line(f.left, f.up(value), f.right, f.up(value));
        svg += text_at(f.left - 0.5 * f.font, f.up(value) + 0.35 * f.font, f.y.label(value), "end", f.font);
    }
    return svg +
           fmt::format(
               "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#444\"/>\n",
               f.left, f.top, f.right - f.left, f.bottom - f.top);
}

/// A gap where a number is missing.
std::string path_of(const Curve& curve, const Frame& f) {
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
        const bool there = std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]);
        if (there) path += fmt::format("{}{:.2f} {:.2f}", drawing ? 'L' : 'M', f.across(curve.x[i]), f.up(curve.y[i]));
        drawing = there;
    }
    return path;
}

/// Small circles.
std::string marks_of(const Curve& curve, const Frame& f, const std::string& colour) {
    std::string svg;
    for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i)
        if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]))
            svg += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", f.across(curve.x[i]),
                               f.up(curve.y[i]), f.font / 3, colour);
    return svg;
}

/// The circle with its four winds.
std::string net_of(const Frame& f) {
    const double x = f.across(0), y = f.up(0), r = f.across(1) - x;
    std::string svg = fmt::format(
        "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"{2:.1f}\" fill=\"none\" stroke=\"#444\"/>\n<path d=\"M{0:.1f} {1:.1f}m-6 0h12m-6 -6v12\" stroke=\"#999\"/>\n",
        x, y, r);
    svg += text_at(x, y - r - 0.5 * f.font, "N", "middle", f.font) +
           text_at(x, y + r + 1.3 * f.font, "S", "middle", f.font);
    return svg + text_at(x + r + 0.5 * f.font, y + 0.35 * f.font, "E", "start", f.font) +
           text_at(x - r - 0.5 * f.font, y + 0.35 * f.font, "W", "end", f.font);
}

/// A square frame for a net, in the middle of the picture.
Frame net_frame(const Chart& chart, double font) {
    const double half = 0.5 * std::min(chart.width - 6 * font, chart.height - 11 * font), x = chart.width / 2.0,
                 y = 5.5 * font + half;
    Frame f{round_ticks(-1, 1, 2), round_ticks(-1, 1, 2), x - half, x + half, y - half, y + half, font};
    f.x.low = f.y.low = -1, f.x.high = f.y.high = 1;
    return f;
}

} // namespace

std::string svg_of(const Chart& chart) {
    Limits x, y;
    for (const Curve& curve : chart.curves) {
        for (const double value : curve.x) x.take(value);
        for (const double value : curve.y) y.take(value);
    }
    const double font = std::max(10.0, chart.width / 70.0);
    const bool legend = chart.curves.size() > 1 || chart.net;
    Frame f = chart.net ? net_frame(chart, font)
                        : Frame{round_ticks(x.low, x.high, 7),
                                round_ticks(y.low, y.high, 6),
                                7 * font,
                                chart.width - 2 * font,
                                4 * font,
                                chart.height - (legend ? 6.0 : 4.5) * font,
                                font};
    if (chart.equal && !chart.net) make_equal(f.x, f.y, f.right - f.left, f.bottom - f.top);
    std::string svg =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
                    "font-family=\"sans-serif\" fill=\"#222\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
                    chart.width, chart.height);
    svg +=
        text_at(chart.width / 2.0, 2.3 * font, chart.title, "middle", 1.3 * font) + (chart.net ? net_of(f) : grid(f));
    svg +=
        text_at((f.left + f.right) / 2, f.bottom + (chart.net ? 2.8 : 3.2) * font, chart.x_label, "middle", 1.1 * font);
    const double middle = (f.top + f.bottom) / 2;
    svg += text_at(1.6 * font, middle, chart.y_label, "middle", 1.1 * font,
                   fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", 1.6 * font, middle).c_str());
    double at = f.left;
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
        const Curve& curve = chart.curves[i];
        const std::string colour = colour_text(i);
        if (curve.marks) svg += marks_of(curve, f, colour);
        else
            svg += fmt::format(
                "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\" stroke-linejoin=\"round\"/>\n",
                path_of(curve, f), colour, font / 7);
        if (!legend || curve.name.empty()) continue;
        const double base = chart.height - font;
        if (curve.marks)
            svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\"/>\n", at + font,
                               base - 0.35 * font, font / 3, colour);
        else
            svg += fmt::format("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"{}\" stroke-width=\"{:.1f}\"/>\n", at,
                               base - 0.35 * font, 2 * font, colour, font / 4);
        svg += text_at(at + 2.5 * font, base, curve.name, "start", font);
        at += (4.5 + 0.6 * static_cast<double>(curve.name.size())) * font;
    }
    return svg + "</svg>\n";
}

} // namespace kaya
