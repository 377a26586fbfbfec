#include "draw.hpp"

#include "png.hpp"
#include "scene/ticks.hpp"
#include "words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextScene.h>
#include <vtkContextView.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

namespace kaya {

namespace {

Ticks ticks_of(const std::vector<Curve>& curves, std::vector<double> Curve::*values, int about) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Curve& curve : curves)
        for (const double value : curve.*values)
            if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    return round_ticks(low, high, about);
}

void set_ticks(vtkAxis* axis, const Ticks& ticks) {
    vtkNew<vtkDoubleArray> places;
    vtkNew<vtkStringArray> labels;
    for (const double value : ticks.values()) {
        places->InsertNextValue(value);
        labels->InsertNextValue(ticks.label(value));
    }
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(ticks.low, ticks.high);
    axis->SetCustomTickPositions(places, labels);
}

void set_axis(vtkAxis* axis, const std::string& label, const Ticks& ticks, int font) {
    set_ticks(axis, ticks);
    axis->SetTitle(label);
    use_font(axis->GetTitleProperties());
    use_font(axis->GetLabelProperties());
    axis->GetTitleProperties()->SetFontSize(font);
    axis->GetLabelProperties()->SetFontSize(font);
    axis->GetGridPen()->SetColor(216, 216, 216, 255);
    axis->GetGridPen()->SetWidth(static_cast<float>(font) / 14);
    axis->GetPen()->SetWidth(static_cast<float>(font) / 12);
    axis->SetLabelOffset(static_cast<float>(font) * 0.4F);
}

void add_piece(vtkChartXY* chart, const Curve& curve, std::size_t first, std::size_t end, bool in_legend,
               std::size_t index, float width) {
    static constexpr std::size_t order[] = {4, 5, 2, 6, 1, 0, 7, 3}; // the dark colours first: the background is white
    vtkNew<vtkDoubleArray> x, y;
    x->SetName("x");
    y->SetName("y"); // not the curve's name, which may be "x"
    for (std::size_t i = first; i < end; ++i) {
        x->InsertNextValue(curve.x[i]);
        y->InsertNextValue(curve.y[i]);
    }
    if (x->GetNumberOfValues() == 0) return;
    vtkNew<vtkTable> table;
    table->AddColumn(x);
    table->AddColumn(y);
    vtkPlot* plot = chart->AddPlot(curve.marks ? vtkChart::POINTS : vtkChart::LINE);
    plot->SetInputData(table, 0, 1);
    plot->SetLabel(curve.name);
    if (auto* points = vtkPlotPoints::SafeDownCast(plot); points != nullptr && curve.marks) { // lines are points, too
        points->SetMarkerStyle(vtkPlotPoints::CIRCLE);
        points->SetMarkerSize(4 * width);
    }
    const Colour c = named_colour(order[index % std::size(order)]);
    plot->GetPen()->SetColorF(c[0], c[1], c[2]);
    plot->SetWidth(width);
    if (curve.name.empty() || !in_legend) plot->LegendVisibilityOff();
}

/// A gap where a number is missing: each piece is a separate plot.
void add_curve(vtkChartXY* chart, const Curve& curve, std::size_t index, float width) {
    const std::size_t size = std::min(curve.x.size(), curve.y.size());
    const auto there = [&](std::size_t i) { return std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]); };
    bool any = false;
    for (std::size_t first = 0; first < size;) {
        std::size_t end = first;
        while (end < size && there(end)) ++end;
        if (end > first) add_piece(chart, curve, first, end, !any, index, width);
        any = any || end > first;
        first = end + 1;
    }
    if (!any) add_piece(chart, curve, 0, 0, true, index, width);
}

/// The circle of a net, with two of its winds on the axes: VTK shows no others.
void add_net(vtkChartXY* chart, int font) {
    Curve circle;
    for (int k = 0; k <= 180; ++k) {
        const double angle = k * std::numbers::pi / 90;
        circle.x.push_back(std::sin(angle)), circle.y.push_back(std::cos(angle));
    }
    add_curve(chart, circle, 0, static_cast<float>(font / 10.0));
    chart->GetPlot(0)->GetPen()->SetColor(68, 68, 68, 255);
    const std::pair<int, const char*> winds[] = {{vtkAxis::BOTTOM, "S"}, {vtkAxis::LEFT, "W"}};
    for (const auto& [place, name] : winds) {
        vtkAxis* axis = chart->GetAxis(place);
        vtkNew<vtkDoubleArray> places;
        vtkNew<vtkStringArray> labels;
        places->InsertNextValue(0);
        labels->InsertNextValue(name);
        axis->SetBehavior(vtkAxis::FIXED);
        axis->SetRange(-1.03, 1.03);
        axis->SetCustomTickPositions(places, labels);
        axis->SetTitle("");
        use_font(axis->GetLabelProperties());
        axis->GetLabelProperties()->SetFontSize(font);
        axis->GetPen()->SetColor(255, 255, 255, 255);
        axis->GetGridPen()->SetColor(225, 225, 225, 255);
    }
}

/// To be called when the axes have their places.
void equalize(vtkChartXY* chart, const std::vector<Curve>& curves) {
    vtkAxis *across = chart->GetAxis(vtkAxis::BOTTOM), *upward = chart->GetAxis(vtkAxis::LEFT);
    Ticks x = ticks_of(curves, &Curve::x, 7), y = ticks_of(curves, &Curve::y, 6);
    make_equal(x, y, across->GetPoint2()[0] - across->GetPoint1()[0], upward->GetPoint2()[1] - upward->GetPoint1()[1]);
    set_ticks(across, x);
    set_ticks(upward, y);
}

/// A corner of the chart.
struct Corner {
    bool right, top;
};

/// The corner in which the legend covers least of the curves.
Corner free_corner(const Chart& given) {
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    const auto each = [&](auto visit) {
        for (const Curve& curve : given.curves)
            for (std::size_t i = 0; i < curve.x.size(); ++i)
                if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) visit(curve, i);
    };
    each([&](const Curve& curve, std::size_t i) {
        low[0] = std::min(low[0], curve.x[i]), high[0] = std::max(high[0], curve.x[i]);
        low[1] = std::min(low[1], curve.y[i]), high[1] = std::max(high[1], curve.y[i]);
    });
    const double wide = 0.3, tall = std::min(0.5, 0.05 + 0.035 * static_cast<double>(given.curves.size()));
    constexpr std::array<Corner, 4> corners{{{true, true}, {false, true}, {true, false}, {false, false}}};
    std::array<int, 4> covered{};
    const auto cover = [&](double x, double y) {
        for (std::size_t k = 0; k < corners.size(); ++k)
            covered[k] += (corners[k].right ? x > 1 - wide : x < wide) && (corners[k].top ? y > 1 - tall : y < tall);
    };
    each([&](const Curve& curve, std::size_t i) {
        const std::size_t next = std::min(i + 1, curve.x.size() - 1); // the line to the next point, in pieces
        constexpr int pieces = 20;
        for (int part = 0; part < pieces; ++part) {
            const double t = static_cast<double>(part) / pieces;
            const double x = curve.x[i] + t * (curve.x[next] - curve.x[i]);
            const double y = curve.y[i] + t * (curve.y[next] - curve.y[i]);
            cover(high[0] > low[0] ? (x - low[0]) / (high[0] - low[0]) : 0.5,
                  high[1] > low[1] ? (y - low[1]) / (high[1] - low[1]) : 0.5);
        }
    });
    return corners[static_cast<std::size_t>(std::ranges::min_element(covered) - covered.begin())];
}

} // namespace

std::string png_of(const Chart& given) {
    const int finer = std::max(given.width, given.height) <= 4096 ? 2 : 1; // each pixel is the mean of four
    const int width = std::clamp(given.width, 64, 8192) * finer, height = std::clamp(given.height, 64, 8192) * finer;
    const int font = std::max(11, width / 62);
    vtkNew<vtkContextView> view;
    view->GetRenderWindow()->SetOffScreenRendering(1);
    view->GetRenderWindow()->SetMultiSamples(0);
    view->GetRenderWindow()->SetSize(width, height);
    view->GetRenderer()->SetBackground(1, 1, 1);
    vtkNew<vtkChartXY> chart;
    view->GetScene()->AddItem(chart);
    chart->SetAutoSize(false); // a margin on all sides
    // A net is as wide as high, and leaves more room on its right for the legend.
    const auto net_side = static_cast<float>(std::min(width - 8 * font, height - 8 * font)),
               net_left = 0.3F * (static_cast<float>(width) - net_side);
    if (given.net) {
        chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
        chart->SetSize(vtkRectf(net_left, static_cast<float>(3.5 * font), net_side, net_side));
    } else
        chart->SetSize(vtkRectf(static_cast<float>(font), static_cast<float>(font),
                                static_cast<float>(width - 3 * font), static_cast<float>(height - 2 * font)));
    chart->SetTitle(given.title);
    use_font(chart->GetTitleProperties());
    chart->GetTitleProperties()->SetFontSize(static_cast<int>(1.3 * font));
    if (given.net) add_net(chart, font);
    else {
        // The empty line separates the name from the numbers.
        set_axis(chart->GetAxis(vtkAxis::BOTTOM), "\n" + given.x_label, ticks_of(given.curves, &Curve::x, 7), font);
        set_axis(chart->GetAxis(vtkAxis::LEFT), given.y_label + "\n", ticks_of(given.curves, &Curve::y, 6), font);
    }
    for (std::size_t i = 0; i < given.curves.size(); ++i)
        add_curve(chart, given.curves[i], i, static_cast<float>(font / 6.0));
    chart->SetShowLegend(given.curves.size() > 1 || given.net);
    use_font(chart->GetLegend()->GetLabelProperties());
    chart->GetLegend()->SetLabelSize(font);
    chart->GetLegend()->SetSymbolWidth(2 * font);
    chart->GetLegend()->SetPadding(font / 2);
    if (given.net) { // beside the circle
        chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::CUSTOM);
        chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::CUSTOM);
        chart->GetLegend()->SetPoint(net_left + net_side + static_cast<float>(font), static_cast<float>(height) / 2);
    } else {
        const Corner corner = free_corner(given);
        chart->GetLegend()->SetHorizontalAlignment(corner.right ? vtkChartLegend::RIGHT : vtkChartLegend::LEFT);
        chart->GetLegend()->SetVerticalAlignment(corner.top ? vtkChartLegend::TOP : vtkChartLegend::BOTTOM);
    }
    view->GetRenderWindow()->Render(); // the chart takes its place by the first one
    if (given.equal && !given.net) {
        equalize(chart, given.curves);
        view->GetRenderWindow()->Render();
    }
    return png_of(image_of(view->GetRenderWindow(), given.paper, finer), given.paper);
}

} // namespace kaya
