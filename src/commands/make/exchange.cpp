// import, export: blocks in files of other programs.
#include "base/counted.hpp"
#include "commands/session/handlers.hpp"
#include "commands/make/incoming.hpp"
#include "geometry/grid/file_formats.hpp"
#include "geometry/surface/outer_surface.hpp"
#include "model/edit/build.hpp"
#include "model/kinds/groups.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace kaya {

namespace {

/// Bodies that are wrong: an error if none is right or the deck says so, else a warning for each of the first ones.
void report_refused(Session& session, const lang::Import& command, IncomingFile& file) {
    if (file.refused.empty()) return;
    if (command.stop || file.blocks.empty()) throw file.refused.front();
    constexpr std::size_t most = 20;
    for (std::size_t i = 0; i < std::min(most, file.refused.size()); ++i) {
        Diagnostic warning = file.refused[i];
        warning.message += "; it is left out";
        session.warn(warning.at(command.place));
    }
    if (file.refused.size() > most)
        session.warn(Diagnostic(fmt::format("{} more are left out", counted(file.refused.size() - most, "body")),
                                "`import ... stop` ends the run at the first")
                         .at(command.place));
}

void report_repairs(Session& session, const std::string& file, const RepairCounts& counts) {
    std::vector<std::string> parts;
    if (counts.welded > 0) parts.push_back(fmt::format("{} joined", counted(counts.welded, "corner")));
    if (counts.narrow > 0) parts.push_back(fmt::format("{} dropped", counted(counts.narrow, "narrow face")));
    if (counts.inserted > 0) parts.push_back(fmt::format("{} put on edges", counted(counts.inserted, "corner")));
    if (counts.closed > 0) parts.push_back(fmt::format("{} closed", counted(counts.closed, "hole")));
    if (counts.doubled > 0)
        parts.push_back(fmt::format("{} dropped that lay on others", counted(counts.doubled, "face")));
    if (!parts.empty()) session.note_once(fmt::format("{}: {}", file, fmt::join(parts, ", ")));
}

void report_simplified(Session& session, const std::string& file, const SimplifyCounts& counts) {
    if (counts.bodies == 0) return;
    session.note_once(fmt::format(
        "{}: {} simplified from {} to {} triangles, greatest deviation {:.3g}, volume {:.6g} before and {:.6g} after",
        file, counted(counts.bodies, "surface"), counts.before, counts.after, counts.deviation, counts.volume_before,
        counts.volume_after));
}

void report_enclosed(Session& session, const std::string& file, const SimplifyCounts& counts) {
    if (counts.bodies == 0) return;
    session.note_once(fmt::format("{}: {} convex parts of {} replaced by {}, volume {:.6g} before and {:.6g} after",
                                  file, counts.before, counted(counts.bodies, "body"), counts.after,
                                  counts.volume_before, counts.volume_after));
}

double volume_of(const IncomingFile& file) {
    double volume = 0;
    for (const IncomingBlock& block : file.blocks) volume += volume_of(block.solid);
    return volume;
}

} // namespace

void run(Session& session, const lang::Import& command) {
    Model& model = session.engine.model;
    try {
        const std::string path = session.input_file(command.file).string();
        // All blocks are read and checked before the first is made.
        IncomingFile file = read_blocks(path, {command.scale,
                                               command.up,
                                               {command.mend, command.holes},
                                               {command.simplify, command.deviation},
                                               command.convex});
        report_refused(session, command, file);
        report_repairs(session, command.file, file.repaired);
        report_simplified(session, command.file, file.reductions.triangles);
        report_enclosed(session, command.file, file.reductions.convex_parts);
        std::size_t parts = 0, zoned = 0;
        for (const IncomingBlock& block : file.blocks) {
            NewBlock options;
            options.material =
                block.material != 0 ? block.material : static_cast<std::int32_t>(command.options.material);
            options.constitutive = static_cast<std::int32_t>(command.options.constitutive);
            options.region = block.region != 0 ? block.region : static_cast<std::int32_t>(command.options.region);
            options.group = with_group(model, 0, GroupName{.name = block.group});
            const Row row = add_solid(model, block.solid.parts, options);
            parts += block.solid.parts.size();
            if (!block.mesh) continue;
            give_zones(model, row, block.solid.parts.front(), *block.mesh);
            ++zoned;
        }
        if (zoned > 0) put_in_block_order(model);
        const std::string left_out =
            file.refused.empty() ? "" : fmt::format(", {} left out", counted(file.refused.size(), "wrong one"));
        session.program.output.say(fmt::format("{}: {} read{}, {}, {} with zones, volume {:g}", command.file,
                                               counted(file.blocks.size(), "solid"), left_out, counted(parts, "block"),
                                               zoned, volume_of(file)));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

namespace {

/// The zones of a block where they are now.
TetMesh zones_of(const Model& model, Row block) {
    TetMesh mesh;
    const Span points = model.blocks.gridpoints[block], zones = model.blocks.zones[block];
    for (Row row = points.first; row < points.end(); ++row) mesh.points.push_back(model.gridpoints.position[row]);
    for (Row zone = zones.first; zone < zones.end(); ++zone) {
        auto& corners = mesh.tetrahedra.emplace_back();
        for (std::size_t k = 0; k < corners.size(); ++k)
            corners[k] = static_cast<int>(model.zones.gridpoints[zone][k] - points.first);
    }
    return mesh;
}

/// The rows of each body, in the order of their first; with `apart` each row is one.
std::vector<std::vector<Row>> bodies_of(const Model& model, const std::vector<Row>& rows, bool apart) {
    std::vector<std::vector<Row>> bodies;
    std::map<std::int32_t, std::size_t> place;
    for (const Row row : rows) {
        const std::int32_t body = model.blocks.body[row];
        if (apart || body == 0) {
            bodies.push_back({row});
            continue;
        }
        const auto [found, is_new] = place.try_emplace(body, bodies.size());
        if (is_new) bodies.emplace_back();
        bodies[found->second].push_back(row);
    }
    return bodies;
}

/// The polygons of a surface as the faces of a block.
Polyhedron shape_of_surface(const Surface& surface) {
    Polyhedron shape{surface.vertices, {}};
    for (const Surface::Face& face : surface.faces) shape.faces.push_back({face.vertices});
    return shape;
}

/// What is written.
struct Outgoing {
    Grid3d grid;
    std::size_t open_bodies = 0;  ///< written block by block, because the surface around them is not closed
    std::size_t mixed_groups = 0; ///< bodies whose blocks are in several groups
};

Outgoing grid_of_rows(const Model& model, const std::vector<Row>& rows, const FileFormat& format) {
    Outgoing outgoing;
    std::deque<Polyhedron> shapes;
    std::deque<TetMesh> meshes;
    std::vector<GridShape> blocks;
    const auto add = [&](Row row, Polyhedron shape, bool zones) {
        shapes.push_back(std::move(shape));
        if (zones) meshes.push_back(zones_of(model, row));
        const bool has_zones = zones && !meshes.back().tetrahedra.empty();
        blocks.push_back({model.blocks.number[row], model.blocks.region[row],
                          std::string(default_group(model, model.blocks.group[row])), &shapes.back(),
                          model.blocks.material[row], has_zones ? &meshes.back() : nullptr});
    };
    const bool surfaces = format.holds == FileFormat::Holds::surfaces;
    for (const std::vector<Row>& body : bodies_of(model, rows, !surfaces)) {
        if (body.size() > 1) {
            std::vector<Polyhedron> parts;
            for (const Row row : body) parts.push_back(shape_of(model, row));
            if (const auto surface = outer_surface(parts)) {
                add(body.front(), shape_of_surface(*surface), false);
                outgoing.mixed_groups += std::ranges::any_of(body, [&](Row row) {
                    return default_group(model, model.blocks.group[row]) !=
                           default_group(model, model.blocks.group[body.front()]);
                });
                continue;
            }
            ++outgoing.open_bodies;
        }
        for (const Row row : body) add(row, shape_of(model, row), true);
    }
    outgoing.grid = grid_of(blocks, format.holds == FileFormat::Holds::grid ? Corners::shared : Corners::own);
    return outgoing;
}

/// Faces with a joint set that is not written, because no other block lies against them with it.
std::size_t sets_left_out(const Model& model, const std::vector<Row>& rows, const Grid3d& grid) {
    std::set<std::pair<int, int>> written; // block and joint set
    for (const Grid3d::JointSet& set : grid.joint_sets)
        for (const auto& pair : set.blocks)
            for (const int block : pair) written.emplace(block, set.number);
    std::size_t lost = 0;
    for (const Row row : rows)
        for (Row face = model.blocks.faces[row].first; face < model.blocks.faces[row].end(); ++face) {
            const std::int32_t set = model.faces.joint_set[face];
            lost += set != 0 && !written.contains({model.blocks.number[row], set});
        }
    return lost;
}

} // namespace

void run(Session& session, const lang::Export& command) {
    const FileFormat* format = file_format(command.file);
    if (format == nullptr || format->write == nullptr)
        throw Diagnostic(fmt::format("'{}' does not have the suffix of a file that is written", command.file),
                         fmt::format("use one of {}; `vtk write` writes results for ParaView", suffixes_written()))
            .at(command.place);
    const auto rows = session.pick(ObjectKind::block, command.range);
    if (rows.empty()) return;
    const Model& model = session.engine.model;
    const auto [grid, open_bodies, mixed_groups] = grid_of_rows(model, rows, *format);
    const auto zoned = std::ranges::count_if(rows, [&](Row row) { return model.blocks.zones[row].count > 0; });
    if (open_bodies > 0)
        session.note_once(
            fmt::format("{} of joined blocks {} written block by block: their faces do not lie against each other",
                        counted(open_bodies, "body"), open_bodies == 1 ? "is" : "are"),
            "`.3dgrid` keeps blocks one by one");
    if (mixed_groups > 0)
        session.note_once("joined blocks of several groups are written under the group of the first",
                          "`.3dgrid` keeps blocks one by one");
    if (zoned > 0 && format->holds == FileFormat::Holds::surfaces)
        session.note_once("of blocks with zones the surfaces are written", "`save` keeps everything");
    const std::size_t lost =
        format->holds == FileFormat::Holds::grid ? sets_left_out(model, rows, grid) : std::size_t{0};
    if (lost > 0)
        session.note_once(
            fmt::format("the joint sets of {} without a neighbour in the file are not written", counted(lost, "face")),
            "`save` keeps everything");
    if (zoned < std::ssize(rows) && format->holds == FileFormat::Holds::zones && !format->surfaces)
        session.note_once("rigid blocks are written as zones around their middle",
                          "`import` makes blocks with zones of them");
    write_whole_file(session.program.output_file(command.file), format->write(grid));
    const std::string as_bodies =
        grid.blocks.size() < rows.size() ? " as " + counted(grid.blocks.size(), "body") : std::string();
    session.program.output.say(
        fmt::format("{} written{} to {}", counted(rows.size(), "block"), as_bodies, command.file));
}

void add_handlers(HandlerTable& table, lang::ExchangeCommands list) { fill(table, list); }

} // namespace kaya
