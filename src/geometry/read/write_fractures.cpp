#include "geometry/read/write_fractures.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {
namespace {

std::string line_text(const Vec3& place) { return fmt::format("{} {} {}", place.x(), place.y(), place.z()); }

std::string discs_text(const std::vector<Fracture>& fractures) {
    std::string text = "x y z dip dip-direction diameter\n";
    for (const Fracture& fracture : fractures) {
        if (!fracture.corners.empty())
            throw Diagnostic(fmt::format("fracture {} is a polygon", fracture.id), "write: format polygons");
        const Disc& disc = fracture.disc;
        text += fmt::format("{} {} {} {}\n", line_text(disc.centre), disc.dip, disc.dip_direction, disc.diameter);
    }
    return text;
}

std::string polygons_text(const std::vector<Fracture>& fractures, int sides) {
    std::string text;
    for (const Fracture& fracture : fractures) {
        text += fmt::format("# fracture {}\n", fracture.id);
        for (const Vec3& corner : outline_of(fracture, sides)) text += line_text(corner) + '\n';
        text += '\n';
    }
    return text;
}

/// The name in the slot `set`, without the quotes that would end it in the file.
std::string set_of(const Fracture& fracture) {
    constexpr std::string_view slot = "set=";
    for (const std::string& group : fracture.groups)
        if (group.starts_with(slot)) {
            std::string name = group.substr(slot.size());
            std::ranges::replace(name, '"', '\'');
            return name;
        }
    return "fractures";
}

std::string fracman_text(const std::vector<Fracture>& fractures, int sides) {
    std::vector<std::string> sets;
    std::string lines;
    std::size_t corners = 0, number = 0;
    for (const Fracture& fracture : fractures) {
        const std::string set = set_of(fracture);
        auto at = std::ranges::find(sets, set);
        if (at == sets.end()) at = sets.insert(at, set);
        const std::vector<Vec3> outline = outline_of(fracture, sides);
        corners += outline.size();
        lines += fmt::format("{} {} {}\n", ++number, outline.size(), at - sets.begin() + 1);
        for (std::size_t i = 0; i < outline.size(); ++i) lines += fmt::format("{} {}\n", i + 1, line_text(outline[i]));
        lines += fmt::format("0 {}\n", line_text(plane_of(fracture).normal));
    }
    std::string names;
    for (std::size_t i = 0; i < sets.size(); ++i) names += fmt::format("Set{} = \"{}\"\n", i + 1, sets[i]);
    return fmt::format(
        "BEGIN FORMAT\nFormat = Ascii\nXAxis = East\nScale = 1\nNo_Fractures = {}\nNo_TessFractures = 0\n"
        "No_Nodes = {}\nNo_RockBlocks = 0\nNo_NodesRockBlock = 0\nNo_Properties = 0\nEND FORMAT\n\n"
        "BEGIN PROPERTIES\nEND PROPERTIES\n\nBEGIN SETS\n{}END SETS\n\nBEGIN FRACTURE\n{}END FRACTURE\n\n"
        "BEGIN TESSFRACTURE\nEND TESSFRACTURE\n\nBEGIN ROCKBLOCK\nEND ROCKBLOCK\n",
        fractures.size(), corners, names, lines);
}

} // namespace

std::string fractures_text(const std::vector<Fracture>& fractures, FractureFormat format, int sides) {
    switch (format) {
    case FractureFormat::discs: return discs_text(fractures);
    case FractureFormat::polygons: return polygons_text(fractures, sides);
    case FractureFormat::fracman: return fracman_text(fractures, sides);
    case FractureFormat::traces: break;
    }
    throw std::logic_error("fractures are not written as traces");
}

} // namespace kaya
