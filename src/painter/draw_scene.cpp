#include "draw.hpp"

#include "legend.hpp"
#include "png.hpp"
#include "words.hpp"

#include <algorithm>
#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageAppend.h>
#include <vtkLightKit.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

namespace kaya {

namespace {

/// No picture has more pixels along a side.
constexpr int longest_side = 8192;

void set_numbers(vtkFloatArray* array, const std::vector<float>& values, int components) {
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size() / static_cast<std::size_t>(components)));
    std::copy(values.begin(), values.begin() + array->GetNumberOfValues(), array->GetPointer(0));
}

void add_points(vtkPolyData* data, const Layer& layer) {
    vtkNew<vtkFloatArray> places;
    set_numbers(places, layer.points, 3);
    vtkNew<vtkPoints> points;
    points->SetData(places);
    data->SetPoints(points);
    if (layer.values.size() * 3 != layer.points.size()) return;
    vtkNew<vtkFloatArray> values;
    set_numbers(values, layer.values, 1);
    values->SetName("value");
    data->GetPointData()->SetScalars(values);
}

void add_cells(vtkPolyData* data, const Layer& layer) {
    const vtkIdType corners = layer.kind == Layer::Kind::triangles ? 3 : 2, points = data->GetNumberOfPoints();
    vtkNew<vtkCellArray> cells;
    cells->AllocateExact(points / corners, points);
    for (vtkIdType first = 0; first + corners <= points; first += corners) {
        const vtkIdType ids[3] = {first, first + 1, first + 2};
        cells->InsertNextCell(corners, ids);
    }
    if (corners == 3) data->SetPolys(cells);
    else data->SetLines(cells);
}

void colour_by_values(vtkMapper* mapper, const Scene& scene, const Layer& layer) {
    const bool coloured = layer.bar >= 0 && static_cast<std::size_t>(layer.bar) < scene.bars.size() &&
                          layer.values.size() * 3 == layer.points.size();
    mapper->SetScalarVisibility(coloured);
    if (!coloured) return;
    vtkNew<vtkLookupTable> table;
    fill_colours(table, scene.bars[static_cast<std::size_t>(layer.bar)]);
    mapper->SetLookupTable(table);
    mapper->UseLookupTableScalarRangeOn();
    if (layer.kind == Layer::Kind::arrows) { // one colour for all points of an arrow
        mapper->SetScalarModeToUsePointFieldData();
        mapper->SelectColorArray("value");
    } else mapper->InterpolateScalarsBeforeMappingOn();
}

void add_arrows(vtkRenderer* renderer, const Scene& scene, const Layer& layer, vtkPolyData* data) {
    vtkNew<vtkFloatArray> vectors;
    set_numbers(vectors, layer.vectors, 3);
    if (vectors->GetNumberOfTuples() != data->GetNumberOfPoints()) return;
    vectors->SetName("vector");
    data->GetPointData()->AddArray(vectors);
    vtkNew<vtkArrowSource> arrow;
    arrow->SetTipResolution(12);
    arrow->SetShaftResolution(8);
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(data);
    mapper->SetSourceConnection(arrow->GetOutputPort());
    mapper->SetOrientationArray("vector");
    mapper->SetScaleArray("vector");
    mapper->SetScaleModeToScaleByMagnitude();
    colour_by_values(mapper, scene, layer);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(layer.colour[0], layer.colour[1], layer.colour[2]);
    renderer->AddActor(actor);
}

void add_layer(vtkRenderer* renderer, const Scene& scene, const Layer& layer) {
    if (layer.points.empty()) return;
    vtkNew<vtkPolyData> data;
    add_points(data, layer);
    if (layer.kind == Layer::Kind::arrows) return add_arrows(renderer, scene, layer, data);
    add_cells(data, layer);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    colour_by_values(mapper, scene, layer);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    auto* property = actor->GetProperty();
    property->SetColor(layer.colour[0], layer.colour[1], layer.colour[2]);
    property->SetOpacity(layer.opacity);
    if (layer.kind == Layer::Kind::lines) {
        property->SetLineWidth(static_cast<float>(std::max(1.0, layer.width * scene.width / 1000.0)));
        property->LightingOff();
        mapper->SetResolveCoincidentTopologyToPolygonOffset();
        mapper->SetRelativeCoincidentTopologyLineOffsetParameters(-1, -20);
    } else {
        // Colours that are compared with a legend must look like those of the legend.
        const bool plain = layer.bar < 0;
        property->SetAmbient(plain ? 0.3 : 0.6);
        property->SetDiffuse(plain ? 0.75 : 0.45);
        mapper->SetResolveCoincidentTopologyToPolygonOffset();
        mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(2, 2);
    }
    renderer->AddActor(actor);
}

void aim(vtkRenderer* renderer, const Scene& scene, const Area& area, const Framing& framing) {
    vtkCamera* camera = renderer->GetActiveCamera();
    const auto& f = framing;
    camera->SetFocalPoint(f.focus[0], f.focus[1], f.focus[2]);
    camera->SetPosition(f.focus[0] + f.distance * f.toward[0], f.focus[1] + f.distance * f.toward[1],
                        f.focus[2] + f.distance * f.toward[2]);
    camera->SetViewUp(f.up[0], f.up[1], f.up[2]);
    camera->SetViewAngle(view_angle);
    camera->SetParallelProjection(!scene.perspective);
    camera->SetParallelScale(0.5 * scene.height * f.pixel);
    // The focus is in the middle of the area, not of the picture.
    camera->SetWindowCenter(1 - (area.left + area.right) / scene.width, 1 - (area.bottom + area.top) / scene.height);
    renderer->ResetCameraClippingRange();
}

/// A small cross of axes that turns with the view.
void add_axes(vtkRenderWindow* window, vtkRenderer* corner, vtkCamera* view, const Area& place, double font) {
    const double width = window->GetSize()[0], height = window->GetSize()[1];
    vtkNew<vtkAxesActor> axes;
    for (auto* caption :
         {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D()}) {
        caption->GetTextActor()->SetTextScaleModeToNone();
        auto* style = caption->GetCaptionTextProperty();
        use_font(style);
        style->SetFontSize(static_cast<int>(font));
    }
    axes->GetXAxisShaftProperty()->SetColor(0.84, 0.37, 0.0);
    axes->GetXAxisTipProperty()->SetColor(0.84, 0.37, 0.0);
    axes->GetYAxisShaftProperty()->SetColor(0.0, 0.62, 0.45);
    axes->GetYAxisTipProperty()->SetColor(0.0, 0.62, 0.45);
    axes->GetZAxisShaftProperty()->SetColor(0.0, 0.45, 0.7);
    axes->GetZAxisTipProperty()->SetColor(0.0, 0.45, 0.7);
    corner->SetLayer(1);
    corner->SetViewport(place.left / width, place.bottom / height, place.right / width, place.top / height);
    corner->AddActor(axes);
    vtkCamera* camera = corner->GetActiveCamera();
    camera->SetFocalPoint(0, 0, 0);
    camera->SetPosition(view->GetDirectionOfProjection()[0] * -5, view->GetDirectionOfProjection()[1] * -5,
                        view->GetDirectionOfProjection()[2] * -5);
    camera->SetViewUp(view->GetViewUp());
    camera->SetViewAngle(32);
    corner->ResetCameraClippingRange();
    window->SetNumberOfLayers(2);
    window->AddRenderer(corner);
}

} // namespace

namespace {

vtkSmartPointer<vtkImageData> image_of(Scene scene) {
    // Smooth edges: drawn twice as large, and each pixel is the mean of four.
    const int finer = std::max(scene.width, scene.height) <= longest_side / 2 ? 2 : 1;
    scene.width = std::clamp(scene.width, 64, longest_side) * finer;
    scene.height = std::clamp(scene.height, 64, longest_side) * finer;
    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(scene.width, scene.height);
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1, 1, 1);
    window->AddRenderer(renderer);
    vtkNew<vtkLightKit> lights;
    lights->SetKeyLightAngle(35, 25);
    lights->AddLightsToRenderer(renderer);
    for (const Layer& layer : scene.layers) add_layer(renderer, scene, layer);
    const Layout layout = layout_of(scene);
    const Framing framing = framing_of(scene, layout.model);
    aim(renderer, scene, layout.model, framing);
    add_texts(renderer, scene, layout);
    if (scene.scale_bar) add_scale_bar(renderer, scene, layout, framing.pixel);
    vtkNew<vtkRenderer> corner;
    const double font = layout.font;
    if (scene.axes)
        add_axes(window, corner, renderer->GetActiveCamera(),
                 {layout.column, 4 * font, layout.column + 7 * font, 11 * font}, font);
    return image_of(window, scene.paper, finer);
}

} // namespace

std::string png_of(const Scene& scene) { return png_of(image_of(scene), scene.paper); }

std::string png_of(const ScenePair& pair) {
    vtkNew<vtkImageAppend> row;
    for (Scene scene : {pair.left, pair.right}) {
        scene.paper = pair.paper;
        row->AddInputData(image_of(std::move(scene)));
    }
    row->Update();
    return png_of(row->GetOutput(), pair.paper);
}

} // namespace kaya
