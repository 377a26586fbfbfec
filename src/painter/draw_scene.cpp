#include "draw.hpp"

#include "legend.hpp"
#include "png.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
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

void aim(vtkRenderer* renderer, const Scene& scene) {
    constexpr double degree = std::numbers::pi / 180;
    const double dip = scene.dip * degree, direction = scene.dip_direction * degree;
    const double eye[3] = {std::sin(dip) * std::sin(direction), std::sin(dip) * std::cos(direction), std::cos(dip)};
    const double up[3] = {-std::cos(dip) * std::sin(direction), -std::cos(dip) * std::cos(direction), std::sin(dip)};
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->SetFocalPoint(0, 0, 0);
    camera->SetPosition(eye[0], eye[1], eye[2]);
    camera->SetViewUp(up[0], up[1], up[2]);
    camera->SetViewAngle(25);
    camera->SetParallelProjection(!scene.perspective);
    renderer->ResetCamera();
    if (!scene.bars.empty()) camera->SetWindowCenter(0.14, 0); // the legend is on the right
    if (scene.has_centre) {
        double old[3], place[3];
        camera->GetFocalPoint(old);
        camera->GetPosition(place);
        for (std::size_t k = 0; k < 3; ++k) place[k] += scene.centre[k] - old[k];
        camera->SetFocalPoint(scene.centre[0], scene.centre[1], scene.centre[2]);
        camera->SetPosition(place);
    }
    const double closer = (scene.bars.empty() ? 1.2 : 1.05) * std::max(scene.magnification, 1e-3);
    if (scene.perspective) camera->Dolly(closer);
    else camera->Zoom(closer);
    renderer->ResetCameraClippingRange();
}

/// A small cross of axes in the lower left corner that turns with the view.
void add_axes(vtkRenderWindow* window, vtkRenderer* corner, vtkCamera* view) {
    vtkNew<vtkAxesActor> axes;
    for (auto* caption :
         {axes->GetXAxisCaptionActor2D(), axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D()}) {
        caption->GetTextActor()->SetTextScaleModeToNone();
        auto* style = caption->GetCaptionTextProperty();
        style->SetFontSize(std::max(11, window->GetSize()[0] / 62));
        style->SetColor(0.1, 0.1, 0.1);
        style->ShadowOff();
        style->ItalicOff();
    }
    axes->GetXAxisShaftProperty()->SetColor(0.84, 0.37, 0.0);
    axes->GetXAxisTipProperty()->SetColor(0.84, 0.37, 0.0);
    axes->GetYAxisShaftProperty()->SetColor(0.0, 0.62, 0.45);
    axes->GetYAxisTipProperty()->SetColor(0.0, 0.62, 0.45);
    axes->GetZAxisShaftProperty()->SetColor(0.0, 0.45, 0.7);
    axes->GetZAxisTipProperty()->SetColor(0.0, 0.45, 0.7);
    corner->SetLayer(1);
    corner->SetViewport(0.0, 0.0, 0.13, 0.17);
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

std::string png_of(const Scene& given) {
    Scene scene = given;
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
    renderer->SetBackground2(0.86, 0.89, 0.93);
    renderer->GradientBackgroundOn();
    window->AddRenderer(renderer);
    vtkNew<vtkLightKit> lights;
    lights->SetKeyLightAngle(35, 25);
    lights->AddLightsToRenderer(renderer);
    for (const Layer& layer : scene.layers) add_layer(renderer, scene, layer);
    aim(renderer, scene);
    add_texts(renderer, scene);
    vtkNew<vtkRenderer> corner;
    if (scene.axes) add_axes(window, corner, renderer->GetActiveCamera());
    return png_of(window, finer);
}

} // namespace kaya
