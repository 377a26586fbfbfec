// Drawings (.dxf, text): 3DFACE entities and polyface or polygon meshes, by layer. A file is pairs of lines: a group code and its value.
#include "base/diagnostic.hpp"
#include "base/stop_point.hpp"
#include "geometry/read/surface_files.hpp"
#include "geometry/read/text_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <map>

namespace kaya {
namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
    return text;
}

/// The pairs of an entity: code 0 with its kind, then its data.
struct Entity {
    std::string_view kind;
    int line = 0;
    std::string_view layer;
    std::map<int, double> numbers;
    int flag(int code) const {
        const auto found = numbers.find(code);
        return found == numbers.end() ? 0 : static_cast<int>(std::clamp(found->second, -1e9, 1e9));
    }
};

class DxfReader {
public:
    DxfReader(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

    std::vector<FaceSoup> read() {
        if (rest_.substr(0, 18) == "AutoCAD Binary DXF")
            throw Diagnostic(fmt::format("{} is a binary drawing", file_), "save it as DXF text");
        Entity entity;
        while (next_entity(entity)) {
            stop_point();
            if (entity.kind == "3DFACE") face(entity);
            else if (entity.kind == "POLYLINE") polyline(entity);
        }
        if (!ended_)
            throw Diagnostic(fmt::format("{}, line {}: the file ends before EOF", file_, line_), "export it again");
        std::vector<FaceSoup> soups;
        for (auto& [layer, soup] : layers_) soups.push_back(std::move(soup));
        return soups;
    }

private:
    std::string_view next_line() {
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        const std::string_view line = trimmed(rest_.substr(0, end));
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++line_;
        return line;
    }

    [[noreturn]] void fail(int line, const std::string& message) const {
        throw Diagnostic(fmt::format("{}, line {}: {}", file_, line, message), "export it again as DXF text");
    }

    bool next_pair(int& code, std::string_view& value) {
        if (ended_ || rest_.empty()) return false;
        const std::string_view word = next_line();
        const auto number = kaya::number(word);
        if (!number || *number != std::floor(*number) || std::abs(*number) > 9999)
            fail(line_, fmt::format("'{}' is not a group code", word.substr(0, 30)));
        if (rest_.empty()) fail(line_, "the value of the group code is missing");
        code = static_cast<int>(*number);
        value = next_line();
        return true;
    }

    /// Reads the data of the entity whose head was read last, up to the next head.
    bool next_entity(Entity& entity) {
        int code = 0;
        std::string_view value;
        while (!has_head_) {
            if (!next_pair(code, value)) return false;
            if (code != 0) continue; // comments before the first section
            has_head_ = true;
            head_ = value;
            head_line_ = line_;
        }
        if (head_ == "EOF") {
            ended_ = true;
            return false;
        }
        entity = {head_, head_line_, {}, {}};
        has_head_ = false;
        while (next_pair(code, value)) {
            if (code == 0) {
                has_head_ = true;
                head_ = value;
                head_line_ = line_;
                break;
            }
            if (code == 8) entity.layer = value;
            if ((code < 10 || code > 39) && (code < 70 || code > 79)) continue;
            const auto number = kaya::number(value);
            if (!number && code_matters(entity.kind))
                fail(line_, fmt::format("'{}' is not a number", value.substr(0, 30)));
            if (number) entity.numbers[code] = *number;
        }
        return true;
    }

    static bool code_matters(std::string_view kind) {
        return kind == "3DFACE" || kind == "POLYLINE" || kind == "VERTEX";
    }

    Vec3 place(const Entity& entity, int corner) const {
        Vec3 result;
        for (int k = 0; k < 3; ++k) {
            const auto found = entity.numbers.find(10 * (k + 1) + corner);
            if (found == entity.numbers.end() && k < 2)
                fail(entity.line, fmt::format("the {} has no coordinate {}", entity.kind, 10 * (k + 1) + corner));
            result[k] = found == entity.numbers.end() ? 0 : found->second;
        }
        return result;
    }

    FaceSoup& soup_of(std::string_view layer) {
        FaceSoup& soup = layers_[std::string(layer)];
        soup.name = layer;
        return soup;
    }

    /// The fourth corner repeats the third in a triangle.
    void face(const Entity& entity) {
        std::vector<Vec3> loop;
        const int corners = entity.numbers.contains(13) ? 4 : 3;
        for (int k = 0; k < corners; ++k) loop.push_back(place(entity, k));
        soup_of(entity.layer).loops.push_back(std::move(loop));
    }

    /// The vertices and faces up to SEQEND.
    void polyline(const Entity& head) {
        constexpr int is_mesh = 16, is_polyface = 64;
        const int flags = head.flag(70), rows = head.flag(71), columns = head.flag(72);
        const std::string layer(head.layer);
        std::vector<Vec3> corners;
        std::vector<std::vector<Vec3>> loops;
        Entity entity;
        while (next_entity(entity) && entity.kind != "SEQEND") {
            if (entity.kind != "VERTEX")
                fail(entity.line, fmt::format("a polyline holds a '{}'", entity.kind.substr(0, 30)));
            const bool is_face = (entity.flag(70) & 128) != 0 && (entity.flag(70) & 64) == 0;
            if (is_face && (flags & is_polyface)) loops.push_back(polyface_loop(entity, corners));
            else corners.push_back(place(entity, 0));
        }
        if (entity.kind != "SEQEND") fail(head.line, "the polyline has no SEQEND");
        if (flags & is_mesh) loops = mesh_loops(head, corners, rows, columns, flags);
        auto& all = soup_of(layer).loops;
        all.insert(all.end(), loops.begin(), loops.end());
    }

    std::vector<Vec3> polyface_loop(const Entity& entity, const std::vector<Vec3>& corners) const {
        std::vector<Vec3> loop;
        for (int code = 71; code <= 74; ++code) {
            const int number = std::abs(entity.flag(code)); // negative: the edge is invisible
            if (number == 0) break;
            if (number > static_cast<int>(corners.size()))
                fail(entity.line,
                     fmt::format("a face has vertex {}, and {} have been defined so far", number, corners.size()));
            loop.push_back(corners[static_cast<std::size_t>(number - 1)]);
        }
        return loop;
    }

    std::vector<std::vector<Vec3>> mesh_loops(const Entity& head, const std::vector<Vec3>& corners, int rows,
                                              int columns, int flags) const {
        if (rows < 2 || columns < 2 ||
            static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) != corners.size())
            fail(head.line, fmt::format("a mesh of {} times {} has {} vertices", rows, columns, corners.size()));
        constexpr int closed_rows = 1, closed_columns = 32;
        std::vector<std::vector<Vec3>> loops;
        const auto at = [&](int i, int j) {
            return corners[static_cast<std::size_t>((i % rows) * columns + j % columns)];
        };
        for (int i = 0; i < rows - ((flags & closed_rows) ? 0 : 1); ++i)
            for (int j = 0; j < columns - ((flags & closed_columns) ? 0 : 1); ++j)
                loops.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        return loops;
    }

    std::string_view rest_;
    std::string file_;
    int line_ = 0;
    bool ended_ = false, has_head_ = false;
    std::string_view head_;
    int head_line_ = 0;
    std::map<std::string, FaceSoup> layers_;
};

} // namespace

std::vector<FaceSoup> read_dxf(std::string_view text, const std::string& file) { return DxfReader(text, file).read(); }

} // namespace kaya
