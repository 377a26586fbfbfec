// Structured grids that VTK writes, in all their encodings.
#include "geometry/grid/file_formats.hpp"
#include "geometry/polyhedra/polyhedron.hpp"

#include "tests/unit/vtk/read_back.hpp"

#include <functional>
#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkRectilinearGrid.h>
#include <vtkRectilinearGridWriter.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridWriter.h>
#include <vtkStructuredPoints.h>
#include <vtkStructuredPointsWriter.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>

using namespace kaya;
using namespace kaya::test;

namespace {

constexpr int nx = 4, ny = 3, nz = 3;

/// Region 1 below and 2 above.
void label_layers(vtkDataSet& data) {
    vtkNew<vtkIntArray> region;
    region->SetName("region");
    for (int cell = 0; cell < 12; ++cell) region->InsertNextValue(cell < 6 ? 1 : 2);
    data.GetCellData()->AddArray(region);
}

template <class Writer> std::string written_by(vtkDataSet* data, const std::function<void(Writer&)>& options) {
    const ScratchFolder folder;
    vtkNew<Writer> writer;
    writer->SetInputData(data);
    writer->SetFileName((folder / "grid").c_str());
    options(*writer);
    writer->Write();
    return content_of(folder / "grid");
}

void expect_layers(const std::string& text) {
    const Grid3d grid = read_vtk_blocks(text, "grid");
    ASSERT_EQ(grid.blocks.size(), 2U);
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_EQ(grid.blocks[b].region, static_cast<int>(b) + 1);
        double volume = 0;
        for (const Polyhedron& part : solid_from_surface(surface_of(grid, grid.blocks[b])).parts)
            volume += mass_properties(part).volume;
        EXPECT_NEAR(volume, 6 * 2 * 3 * 0.5, 1e-12);
    }
}

template <class XmlWriter, class LegacyWriter> void expect_all_encodings(vtkDataSet* data) {
    label_layers(*data);
    expect_layers(written_by<XmlWriter>(data, [](XmlWriter& w) { w.SetDataModeToAscii(); }));
    expect_layers(written_by<XmlWriter>(data, [](XmlWriter& w) { w.SetDataModeToBinary(); }));
    expect_layers(written_by<XmlWriter>(data, [](XmlWriter& w) { w.SetDataModeToAppended(); }));
    expect_layers(written_by<XmlWriter>(data, [](XmlWriter& w) { w.SetCompressorTypeToNone(); }));
    expect_layers(written_by<LegacyWriter>(data, [](LegacyWriter& w) { w.SetFileTypeToASCII(); }));
    expect_layers(written_by<LegacyWriter>(data, [](LegacyWriter& w) { w.SetFileTypeToBinary(); }));
}

} // namespace

TEST(StructuredGrids, ImagesOfVtk) {
    vtkNew<vtkStructuredPoints> image;
    image->SetDimensions(nx, ny, nz);
    image->SetOrigin(1, -2, 3);
    image->SetSpacing(2, 3, 0.5);
    expect_all_encodings<vtkXMLImageDataWriter, vtkStructuredPointsWriter>(image);
}

TEST(StructuredGrids, RectilinearGridsOfVtk) {
    vtkNew<vtkRectilinearGrid> grid;
    grid->SetDimensions(nx, ny, nz);
    const auto axis = [](int points, double step) {
        vtkNew<vtkDoubleArray> places;
        for (int i = 0; i < points; ++i) places->InsertNextValue(step * i - 1);
        return places;
    };
    grid->SetXCoordinates(axis(nx, 2));
    grid->SetYCoordinates(axis(ny, 3));
    grid->SetZCoordinates(axis(nz, 0.5));
    expect_all_encodings<vtkXMLRectilinearGridWriter, vtkRectilinearGridWriter>(grid);
}

TEST(StructuredGrids, CurvedGridsOfVtk) {
    vtkNew<vtkStructuredGrid> grid;
    grid->SetDimensions(nx, ny, nz);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int k = 0; k < nz; ++k)
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) points->InsertNextPoint(2 * i + 0.5 * j, 3 * j, 0.5 * k + 0.25 * i); // sheared
    grid->SetPoints(points);
    expect_all_encodings<vtkXMLStructuredGridWriter, vtkStructuredGridWriter>(grid);
}
