// Expat reads the elements up to the appended data, which need not be XML; only this file includes its header.
#include "geometry/read/vtk_xml_document.hpp"

#include "base/stop_point.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <expat.h>
#include <fmt/format.h>
#include <memory>
#include <new>

namespace kaya {
namespace {

constexpr std::array xml_sections{"Points", "Coordinates", "Cells", "CellData", "Polys",
                                  "Strips", "Verts",       "Lines", "FieldData"};
constexpr std::array kinds{"UnstructuredGrid", "PolyData", "StructuredGrid", "RectilinearGrid", "ImageData"};

/// Whether an element holds data of a kind that is read, in this file or in files of pieces.
bool is_data(std::string_view name) {
    if (std::ranges::find(kinds, name) != kinds.end()) return true;
    return name.starts_with('P') && std::ranges::find(kinds, name.substr(1)) != kinds.end();
}

/// The elements of a document. Exceptions of handlers wait until expat, which is C, has returned.
class XmlReader {
public:
    XmlReader(std::string_view bytes, const VtkMesh& mesh)
        : bytes_(bytes), mesh_(mesh), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
        if (!parser_) throw std::bad_alloc();
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(
            parser_.get(),
            [](void* self, const char* name, const char** attributes) {
                of(self).guarded([&] { of(self).begin(name, attributes); });
            },
            [](void* self, const char*) { of(self).guarded([&] { of(self).end(); }); });
        XML_SetCharacterDataHandler(parser_.get(), [](void* self, const char* text, int length) {
            of(self).guarded([&] { of(self).characters({text, static_cast<std::size_t>(length)}); });
        });
        XML_SetStartDoctypeDeclHandler(parser_.get(), [](void* self, const char*, const char*, const char*, int) {
            of(self).guarded([&] { of(self).fail("a file of VTK has no DOCTYPE"); });
        });
    }

    XmlDocument read() {
        constexpr std::size_t part = 1 << 20; // of the file, for requests to stop
        for (std::size_t at = 0; !stopped_; at += part) {
            stop_point();
            const std::string_view bytes = bytes_.substr(std::min(at, bytes_.size()), part);
            const bool is_last = at + part >= bytes_.size();
            const auto status = XML_Parse(parser_.get(), bytes.data(), static_cast<int>(bytes.size()), is_last);
            if (failure_) std::rethrow_exception(failure_);
            if (status == XML_STATUS_ERROR && !stopped_)
                fail(XML_ErrorString(XML_GetErrorCode(parser_.get())),
                     "the XML is wrong or cut off: save the mesh again");
            if (is_last) break;
        }
        if (document_.kind.empty())
            fail("there is no grid and no PolyData in it", "save the mesh as .vtu, .vtp, .vts, .vtr or .vti");
        return std::move(document_);
    }

private:
    static XmlReader& of(void* self) { return *static_cast<XmlReader*>(self); }

    void guarded(const auto& work) {
        try {
            if (!stopped_) work();
        } catch (...) {
            failure_ = std::current_exception();
            stop();
        }
    }

    void stop() {
        stopped_ = true;
        XML_StopParser(parser_.get(), XML_FALSE);
    }

    int line() const { return static_cast<int>(XML_GetCurrentLineNumber(parser_.get())); }
    [[noreturn]] void fail(const std::string& message, const std::string& hint = {}) const {
        mesh_.fail(line(), message, hint);
    }

    void begin(const std::string& name, const char** given) {
        constexpr std::size_t deepest = 20;
        if (open_.size() >= deepest) fail("the elements are nested too deeply");
        XmlAttributes attributes;
        for (; *given != nullptr; given += 2) attributes[given[0]] = given[1];
        const std::string parent = open_.empty() ? "" : open_.back();
        open_.push_back(name);
        if (parent.empty()) {
            if (name != "VTKFile")
                fail(fmt::format("the file begins with <{}>, not with <VTKFile>", name.substr(0, 30)));
            document_.file = std::move(attributes);
        } else if (parent == "VTKFile" && name == "AppendedData") {
            appended(value_of(attributes, "encoding"));
        } else if (parent == "VTKFile") {
            if (!is_data(name))
                fail(fmt::format("the data are a <{}>; {} are read", name.substr(0, 30), fmt::join(kinds, ", ")),
                     "convert them, for example in ParaView: Append Datasets, then save");
            document_.kind = name;
            document_.data = std::move(attributes);
        } else if (parent == document_.kind && name == "Piece") {
            document_.pieces.push_back({std::move(attributes), {}, line()});
        } else if (name == "DataArray" || name == "Array") {
            array(parent, std::move(attributes));
        }
    }

    void array(const std::string& section, XmlAttributes attributes) {
        if (std::ranges::find(xml_sections, section) == xml_sections.end()) return;
        const bool of_whole = section == "FieldData";
        if (!of_whole && document_.pieces.empty()) fail("an array stands before the first Piece");
        if ((of_whole || section == "CellData") && !VtkMesh::wanted(value_of(attributes, "Name"))) return;
        auto& arrays = of_whole ? document_.whole : document_.pieces.back().arrays;
        constexpr std::size_t most = 100; // points, cells and labels have 20 at most
        if (arrays.size() >= most) fail(fmt::format("there are more than {} arrays of points and cells", most));
        for (const XmlArray& other : arrays)
            if (other.section == section && section != "Coordinates" && // which count by their order
                value_of(other.attributes, "Name") == value_of(attributes, "Name"))
                fail(fmt::format("{} has two arrays '{}'", section, value_of(attributes, "Name").substr(0, 30)));
        arrays.push_back({section, std::move(attributes), {}, line()});
        in_array_ = &arrays.back();
        depth_ = open_.size();
    }

    void end() {
        if (in_array_ != nullptr && open_.size() == depth_) in_array_ = nullptr;
        open_.pop_back();
    }

    void characters(std::string_view text) {
        if (in_array_ != nullptr && open_.size() == depth_) in_array_->text += text;
    }

    /// The data follow an underscore. What comes after them holds nothing that is needed.
    void appended(std::string_view encoding) {
        if (encoding != "raw" && encoding != "base64")
            fail(fmt::format("the encoding of the appended data is '{}'; raw and base64 are read",
                             encoding.substr(0, 30)));
        document_.appended_is_raw = encoding == "raw";
        const auto after = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get())) +
                           static_cast<std::size_t>(XML_GetCurrentByteCount(parser_.get()));
        const std::size_t mark = bytes_.find_first_not_of(" \t\r\n", after);
        if (mark == bytes_.npos || bytes_[mark] != '_') fail("the appended data do not begin with an underscore");
        document_.appended = bytes_.substr(mark + 1);
        stop();
    }

    std::string_view bytes_;
    const VtkMesh& mesh_;
    std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
    XmlDocument document_;
    std::vector<std::string> open_; ///< elements
    XmlArray* in_array_ = nullptr;
    std::size_t depth_ = 0; ///< of that array
    bool stopped_ = false;
    std::exception_ptr failure_;
};

} // namespace

XmlDocument read_xml_document(std::string_view bytes, const VtkMesh& mesh) { return XmlReader(bytes, mesh).read(); }

} // namespace kaya
