// geometry: surfaces.
#include "commands/session/handlers.hpp"

#include "base/counted.hpp"
#include "base/lower_case.hpp"
#include "geometry/grid/file_formats.hpp"
#include "system/whole_file.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace kaya {

namespace {

/// The set that a line means.
std::string set_of(const Session& session, const lang::GeometryCommand& command) {
    if (!command.set.empty()) return lower_case(command.set);
    if (!session.deck.surface_sets.current.empty()) return session.deck.surface_sets.current;
    throw Diagnostic("there is no set of surfaces yet", "write before: geometry set 'name'").at(command.place);
}

PolygonSet faces_in(Session& session, const lang::GeometryCommand& command) {
    try {
        PolygonSet faces;
        for (const FaceSoup& soup : read_soups(session.input_file(command.file).string()))
            faces.insert(faces.end(), soup.loops.begin(), soup.loops.end());
        return faces;
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

/// The polygon, or the prism from it to its copy.
PolygonSet polygons_of(const lang::GeometryCommand& command) {
    const auto& corners = command.corners;
    PolygonSet polygons{corners};
    if (!command.extrude) return polygons;
    std::vector<Vec3> moved;
    for (const Vec3& corner : corners) moved.push_back(corner + *command.extrude);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::size_t next = (i + 1) % corners.size();
        polygons.push_back({corners[i], corners[next], moved[next], moved[i]});
    }
    polygons.push_back(std::move(moved));
    return polygons;
}

void write_set(Session& session, const lang::GeometryCommand& command) {
    const FileFormat* format = file_format(command.file);
    if (format == nullptr || format->write == nullptr || format->holds != FileFormat::Holds::surfaces)
        throw Diagnostic(fmt::format("'{}' does not have the suffix of a surface file that is written", command.file),
                         fmt::format("use one of {}", surface_suffixes_written()))
            .at(command.place);
    const std::string name = set_of(session, command);
    const auto set = session.deck.surface_sets.surfaces.find(name);
    if (set == session.deck.surface_sets.surfaces.end() || set->second.empty())
        throw Diagnostic(fmt::format("there is no set of surfaces named '{}' with polygons in it", name),
                         "write before: geometry import, or geometry polygon create")
            .at(command.place);
    Polyhedron shape;
    for (const auto& polygon : set->second) {
        auto& face = shape.faces.emplace_back();
        for (const Vec3& corner : polygon) {
            face.vertices.push_back(static_cast<int>(shape.vertices.size()));
            shape.vertices.push_back(corner);
        }
    }
    const Grid3d grid = grid_of({{.number = 1, .group = name, .shape = &shape}}, Corners::own);
    write_whole_file(session.program.output_file(command.file), format->write(grid));
    session.program.output.say(fmt::format("{} written to {}", counted(set->second.size(), "polygon"), command.file));
}

} // namespace

void run(Session& session, const lang::GeometryCommand& command) {
    using enum lang::GeometryCommand::Action;
    auto& sets = session.deck.surface_sets;
    switch (command.action) {
    case choose:
        sets.current = lower_case(command.set);
        sets.surfaces.try_emplace(sets.current);
        return;
    case import: {
        const std::string stem = std::filesystem::path(command.file).stem().string();
        const std::string name = lower_case(command.set.empty() ? stem : command.set);
        const PolygonSet faces = faces_in(session, command);
        auto& set = sets.surfaces[name];
        set.insert(set.end(), faces.begin(), faces.end());
        sets.current = name;
        session.program.output.say(fmt::format("set {}: {} polygons", name, set.size()));
        return;
    }
    case write: return write_set(session, command);
    case polygon: {
        auto& set = sets.surfaces[set_of(session, command)];
        const PolygonSet polygons = polygons_of(command);
        set.insert(set.end(), polygons.begin(), polygons.end());
        return;
    }
    case remove: {
        const std::string name = set_of(session, command);
        if (sets.surfaces.erase(name) == 0)
            throw Diagnostic(fmt::format("there is no set of surfaces named '{}'", name), "look at its name")
                .at(command.place);
        if (sets.current == name) sets.current.clear();
    }
    }
}

void add_handlers(HandlerTable& table, lang::SurfaceCommands list) { fill(table, list); }

} // namespace kaya
