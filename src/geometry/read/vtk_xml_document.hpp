// The elements of VTK's XML files, up to the appended data. Private to geometry.
#pragma once

#include "geometry/read/vtk_mesh.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

using XmlAttributes = std::map<std::string, std::string, std::less<>>;

inline std::string_view value_of(const XmlAttributes& attributes, std::string_view name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? std::string_view() : std::string_view(found->second);
}

/// An array with its text as written.
struct XmlArray {
    std::string section; ///< the element that it is in: Points, Cells, CellData, ...
    XmlAttributes attributes;
    std::string text; ///< inside the element
    int line = 0;
};

struct XmlPiece {
    XmlAttributes attributes;
    std::vector<XmlArray> arrays;
    int line = 0;
};

struct XmlDocument {
    std::string
        kind; ///< UnstructuredGrid, PolyData, StructuredGrid, RectilinearGrid or ImageData; behind a P: of files of pieces
    XmlAttributes file; ///< attributes of VTKFile
    XmlAttributes data; ///< attributes of the element of that kind
    std::vector<XmlPiece> pieces;
    std::vector<XmlArray> whole;  ///< arrays of FieldData
    std::string_view appended;    ///< after its mark
    bool appended_is_raw = false; ///< otherwise base64
};

/// Throws Diagnostic with file and line, in the name of the mesh. The document refers to the bytes.
XmlDocument read_xml_document(std::string_view bytes, const VtkMesh& mesh);

} // namespace kaya
