// import, export: blocks in files of other programs.
#include "base/lower_case.hpp"
#include "base/stop_point.hpp"
#include "commands/handlers.hpp"
#include "base/counted.hpp"
#include "geometry/grid3d.hpp"
#include "geometry/surface_files.hpp"
#include "base/whole_file.hpp"
#include "model/build.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace kaya {

namespace {

/// A block that was read and checked, not yet in the model.
struct Incoming {
    Solid solid;
    std::optional<TetMesh> mesh;
    std::string group;
    std::int32_t region;
    std::int32_t material = 0; ///< 0: not given in the file
};

/// Strongly warped faces become triangles: they are common in files of other programs.
constexpr Flatness of_files{1e-3, true};

std::vector<Incoming> from_grid(const std::string& path, std::int32_t region) {
    std::vector<Incoming> blocks;
    const Grid3d grid = read_grid3d_file(path);
    for (const auto& block : grid.blocks) {
        stop_point();
        Incoming incoming{solid_from_surface(surface_of(grid, block), of_files),
                          {},
                          block.group,
                          block.region != 0 ? block.region : region,
                          block.material};
        if (!block.zones.empty()) {
            if (incoming.solid.parts.size() > 1)
                throw Diagnostic(fmt::format("block {} is concave and has zones", block.number),
                                 "give its faces without zones, or convex blocks");
            incoming.mesh = zones_of(grid, block, incoming.solid.parts.front());
        }
        blocks.push_back(std::move(incoming));
    }
    return blocks;
}

std::vector<Incoming> from_surfaces(const std::string& path, std::int32_t region) {
    std::vector<Incoming> blocks;
    for (const auto& [name, surface] : read_surfaces(path)) {
        stop_point();
        blocks.push_back({solid_from_surface(surface, of_files), {}, name, region, 0});
    }
    return blocks;
}

bool is_grid(const std::string& path) {
    const std::string suffix = lower_case(std::filesystem::path(path).extension().string());
    return suffix == ".3dgrid";
}

std::int32_t group_number(Model& model, const std::string& name) {
    if (name.empty()) return 0;
    auto& names = model.group_names;
    auto found = std::find(names.begin() + 1, names.end(), name);
    if (found == names.end()) found = names.insert(names.end(), name);
    return static_cast<std::int32_t>(found - names.begin());
}

} // namespace

void run(Session& session, const lang::Import& command) {
    Model& model = session.model;
    try {
        const std::string path = session.input_file(command.file).string();
        const auto region = static_cast<std::int32_t>(command.options.region);
        // All blocks are read and checked before the first is made.
        const auto blocks = is_grid(path) || is_msh(path) ? from_grid(path, region) : from_surfaces(path, region);
        std::size_t parts = 0, zoned = 0;
        for (const Incoming& block : blocks) {
            NewBlock options;
            options.material =
                block.material != 0 ? block.material : static_cast<std::int32_t>(command.options.material);
            options.constitutive = static_cast<std::int32_t>(command.options.constitutive);
            options.region = block.region;
            options.group = group_number(model, block.group);
            const Row row = add_solid(model, block.solid.parts, options);
            parts += block.solid.parts.size();
            if (!block.mesh) continue;
            give_zones(model, row, block.solid.parts.front(), *block.mesh);
            ++zoned;
        }
        if (zoned > 0) put_in_block_order(model);
        session.output.say(fmt::format("{}: {} solid{} read, {} block{}, {} with zones", command.file, blocks.size(),
                                       blocks.size() == 1 ? "" : "s", parts, parts == 1 ? "" : "s", zoned));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::Export& command) {
    if (!is_grid(command.file))
        throw Diagnostic(fmt::format("'{}' does not have the suffix .3dgrid", command.file),
                         "blocks are written as .3dgrid; `vtk write` makes pictures")
            .at(command.place);
    const auto rows = session.pick(ObjectKind::block, command.range);
    if (rows.empty()) return;
    const Model& model = session.model;
    std::vector<Polyhedron> shapes;
    for (const Row row : rows) shapes.push_back(shape_of(model, row));
    std::vector<GridShape> blocks;
    bool zoned = false;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row row = rows[i];
        blocks.push_back({model.blocks.number[row], model.blocks.region[row],
                          model.group_names[model.blocks.group[row]], &shapes[i]});
        zoned = zoned || model.blocks.deformable[row] != 0;
    }
    if (zoned) session.note_once("blocks with zones are written as rigid ones", "`save` keeps everything");
    write_whole_file(session.output_file(command.file), write_grid3d(grid_of(blocks)));
    session.output.say(fmt::format("{} written to {}", counted(rows.size(), "block"), command.file));
}

void add_handlers(HandlerTable& table, lang::ExchangeCommands list) { fill(table, list); }

} // namespace kaya
