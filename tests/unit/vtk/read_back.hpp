// The bytes of a .vtu file as read by VTK.
#pragma once

#include "tests/unit/scratch_folder.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace kaya::test {

inline vtkSmartPointer<vtkUnstructuredGrid> parsed(const std::string& bytes) {
    const ScratchFolder folder;
    put(folder / "a.vtu", bytes);
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName((folder / "a.vtu").c_str());
    reader->Update();
    return reader->GetOutput();
}

inline std::vector<double> row_of(vtkFieldData* data, const char* name, vtkIdType row) {
    vtkDataArray* array = data->GetArray(name);
    if (!array) throw std::runtime_error(std::string("no array ") + name);
    std::vector<double> values;
    for (int k = 0; k < array->GetNumberOfComponents(); ++k) values.push_back(array->GetComponent(row, k));
    return values;
}

inline std::vector<std::string> names_in(vtkFieldData* data, const char* name) {
    auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
    if (!array) throw std::runtime_error(std::string("no names ") + name);
    std::vector<std::string> names;
    for (vtkIdType k = 0; k < array->GetNumberOfValues(); ++k) names.push_back(array->GetValue(k));
    return names;
}

inline std::string unit_of(vtkDataArray* array) {
    const char* unit = array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
    return unit ? unit : "";
}

} // namespace kaya::test
