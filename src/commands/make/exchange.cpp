// import, export: blocks in files of other programs.
#include "base/counted.hpp"
#include "commands/session/handlers.hpp"
#include "commands/make/incoming.hpp"
#include "geometry/grid/file_formats.hpp"
#include "model/edit/build.hpp"
#include "model/kinds/groups.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <ranges>

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

Grid3d grid_of_rows(const Model& model, const std::vector<Row>& rows, const FileFormat& format) {
    std::vector<Polyhedron> shapes;
    std::vector<TetMesh> meshes;
    shapes.reserve(rows.size());
    meshes.reserve(rows.size());
    std::vector<GridShape> blocks;
    for (const Row row : rows) {
        shapes.push_back(shape_of(model, row));
        meshes.push_back(zones_of(model, row));
        blocks.push_back({model.blocks.number[row], model.blocks.region[row],
                          std::string(default_group(model, model.blocks.group[row])), &shapes.back(),
                          model.blocks.material[row], meshes.back().tetrahedra.empty() ? nullptr : &meshes.back()});
    }
    return grid_of(blocks, format.holds == FileFormat::Holds::grid ? Corners::shared : Corners::own);
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
    const Grid3d grid = grid_of_rows(model, rows, *format);
    const auto zoned = std::ranges::count_if(grid.blocks, [](const auto& block) { return !block.zones.empty(); });
    if (zoned > 0 && format->holds == FileFormat::Holds::surfaces)
        session.note_once("of blocks with zones the surfaces are written", "`save` keeps everything");
    const auto has_joint_sets = [&](const Row row) {
        const Span faces = model.blocks.faces[row];
        return model.blocks.deformable[row] != 0 &&
               std::ranges::any_of(std::views::iota(faces.first, faces.end()),
                                   [&](const Row face) { return model.faces.joint_set[face] != 0; });
    };
    if (format->holds == FileFormat::Holds::grid && std::ranges::any_of(rows, has_joint_sets))
        session.note_once("joint set numbers of faces of blocks with zones are not written", "`save` keeps everything");
    if (zoned < std::ssize(rows) && format->holds == FileFormat::Holds::zones && !format->surfaces)
        session.note_once("rigid blocks are written as zones around their middle",
                          "`import` makes blocks with zones of them");
    write_whole_file(session.program.output_file(command.file), format->write(grid));
    session.program.output.say(fmt::format("{} written to {}", counted(rows.size(), "block"), command.file));
}

void add_handlers(HandlerTable& table, lang::ExchangeCommands list) { fill(table, list); }

} // namespace kaya
