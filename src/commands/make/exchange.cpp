// import, export: blocks in files of other programs.
#include "base/counted.hpp"
#include "commands/session/handlers.hpp"
#include "commands/make/incoming.hpp"
#include "geometry/grid/grid3d.hpp"
#include "model/edit/build.hpp"
#include "model/kinds/groups.hpp"
#include "system/whole_file.hpp"

#include <algorithm>
#include <fmt/format.h>

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

double volume_of(const IncomingFile& file) {
    double volume = 0;
    for (const IncomingBlock& block : file.blocks)
        for (const Polyhedron& part : block.solid.parts) volume += mass_properties(part).volume;
    return volume;
}

} // namespace

void run(Session& session, const lang::Import& command) {
    Model& model = session.engine.model;
    try {
        const std::string path = session.input_file(command.file).string();
        // All blocks are read and checked before the first is made.
        IncomingFile file = read_blocks(
            path, {command.scale, command.up, {command.mend, command.holes}, {command.simplify, command.deviation}});
        report_refused(session, command, file);
        report_repairs(session, command.file, file.repaired);
        report_simplified(session, command.file, file.simplified);
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

void run(Session& session, const lang::Export& command) {
    if (!is_block_grid(command.file))
        throw Diagnostic(fmt::format("'{}' does not have the suffix .3dgrid", command.file),
                         "blocks are written as .3dgrid; `vtk write` makes pictures")
            .at(command.place);
    const auto rows = session.pick(ObjectKind::block, command.range);
    if (rows.empty()) return;
    const Model& model = session.engine.model;
    std::vector<Polyhedron> shapes;
    for (const Row row : rows) shapes.push_back(shape_of(model, row));
    std::vector<GridShape> blocks;
    bool zoned = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row row = rows[i];
        blocks.push_back({model.blocks.number[row], model.blocks.region[row],
                          std::string(default_group(model, model.blocks.group[row])), &shapes[i]});
        zoned = zoned || model.blocks.deformable[row] != 0;
    }
    if (zoned) session.note_once("blocks with zones are written as rigid ones", "`save` keeps everything");
    write_whole_file(session.program.output_file(command.file), write_grid3d(grid_of(blocks)));
    session.program.output.say(fmt::format("{} written to {}", counted(rows.size(), "block"), command.file));
}

void add_handlers(HandlerTable& table, lang::ExchangeCommands list) { fill(table, list); }

} // namespace kaya
