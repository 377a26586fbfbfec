#include "commands/make/incoming.hpp"

#include "base/parallel.hpp"
#include "base/stop_point.hpp"
#include "base/number_text.hpp"
#include "geometry/grid/file_formats.hpp"
#include "geometry/grid/joint_sets.hpp"
#include "geometry/surface/few_parts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace kaya {

namespace {

/// Strongly warped faces become triangles: they are common in files of other programs.
constexpr Flatness of_files{1e-3, true};

/// From the axes and units of the file to those of the model.
class Placement {
public:
    explicit Placement(const IncomingOptions& options) : scale_(options.scale), up_(options.up) {}

    void apply(Vec3& v) const {
        if (up_ == 'y') v = Vec3(v.x(), -v.z(), v.y());
        if (up_ == 'x') v = Vec3(v.y(), v.z(), v.x());
        v *= scale_;
    }

private:
    double scale_;
    char up_;
};

/// A body of a file before it is made.
struct Body {
    std::string name; ///< of messages
    Vec3 centre;
    std::function<IncomingBlock(Reductions&)> make;
};

/// Makes the bodies, several at once; a message about one gets its name and place.
void add_bodies(IncomingFile& file, const std::string& path, const std::vector<Body>& bodies) {
    struct Made {
        std::optional<IncomingBlock> block;
        std::optional<Diagnostic> mistake;
        Reductions reductions;
    };
    std::vector<Made> made(bodies.size());
    for_chunks(bodies.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            stop_point();
            try {
                made[i].block = bodies[i].make(made[i].reductions);
            } catch (const Diagnostic& mistake) {
                if (mistake.fault != Fault::deck) throw; // a request to stop
                made[i].mistake = mistake;
            }
        }
    });
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        file.reductions.triangles.add(made[i].reductions.triangles);
        file.reductions.convex_parts.add(made[i].reductions.convex_parts);
        if (made[i].block) {
            file.blocks.push_back(std::move(*made[i].block));
            continue;
        }
        Diagnostic& mistake = *made[i].mistake;
        const Vec3& centre = bodies[i].centre;
        mistake.message = fmt::format("{}, {} near {}: {}", path, bodies[i].name, place_text(centre), mistake.message);
        file.refused.push_back(std::move(mistake));
    }
}

IncomingBlock block_of(const Grid3d& grid, const Grid3d::Block& block, const Surface& surface) {
    IncomingBlock incoming{
        solid_from_surface(surface, of_files), {}, block.group, block.region, block.material, block.number};
    if (block.zones.empty()) return incoming;
    if (incoming.solid.parts.size() > 1)
        throw Diagnostic("the block is concave and has zones", "give its faces without zones, or convex blocks");
    incoming.mesh = zones_of(grid, block, incoming.solid.parts.front());
    return incoming;
}

IncomingFile from_grid(const std::string& path, Grid3d grid, const Placement& placement) {
    IncomingFile file;
    for (auto& [number, place] : grid.gridpoints) placement.apply(place);
    std::vector<Surface> surfaces;
    for (const auto& block : grid.blocks) surfaces.push_back(surface_of(grid, block));
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < surfaces.size(); ++i)
        bodies.push_back({fmt::format("block {}", grid.blocks[i].number), mean_of(surfaces[i].vertices),
                          [&, i](Reductions&) { return block_of(grid, grid.blocks[i], surfaces[i]); }});
    add_bodies(file, path, bodies);
    std::map<int, IncomingBlock*> by_number;
    for (IncomingBlock& block : file.blocks) by_number[block.number] = &block;
    give_joint_sets(grid, [&](int number) {
        const auto found = by_number.find(number);
        return found == by_number.end() ? nullptr : &found->second->solid.parts;
    });
    return file;
}

/// Fewer triangles for a body; its hollows have their shares of the number.
void simplify(NamedSurface& body, const Simplification& wanted, SimplifyCounts& counts) {
    std::size_t all = body.surface.faces.size();
    for (const Surface& cavity : body.cavities) all += cavity.faces.size();
    const auto reduce = [&](Surface& shell) {
        Simplification share = wanted;
        share.faces = static_cast<std::int64_t>(static_cast<double>(wanted.faces) *
                                                static_cast<double>(shell.faces.size()) / static_cast<double>(all));
        shell = simplified(std::move(shell), share, counts);
    };
    reduce(body.surface);
    for (Surface& cavity : body.cavities) reduce(cavity);
}

Solid solid_of(const NamedSurface& body, const Flatness& flatness) {
    try {
        return solid_from_surface(body.surface, flatness, body.cavities);
    } catch (Diagnostic& mistake) {
        if (mistake.message.find("open") != std::string::npos || mistake.message.find("close") != std::string::npos)
            mistake.hint += ", or let `import ... mend d` close cracks and `holes d` holes up to a width";
        throw;
    }
}

/// Few convex parts in place of many.
void enclose(Solid& solid, std::size_t most, SimplifyCounts& counts) {
    if (solid.parts.size() <= most) return;
    ++counts.bodies;
    counts.before += solid.parts.size();
    counts.volume_before += volume_of(solid);
    solid.parts = few_convex_parts(solid.parts, most);
    counts.after += solid.parts.size();
    counts.volume_after += volume_of(solid);
}

IncomingFile from_surfaces(const std::string& path, std::vector<FaceSoup> soups, const Placement& placement,
                           const IncomingOptions& options) {
    for (FaceSoup& soup : soups)
        for (auto& loop : soup.loops)
            for (Vec3& corner : loop) placement.apply(corner);
    SurfaceFile surfaces = surfaces_of(soups, options.repair);
    IncomingFile file;
    file.repaired = surfaces.repaired;
    std::vector<Body> bodies;
    for (NamedSurface& body : surfaces.surfaces) {
        const std::string quoted = body.name.empty() ? "" : fmt::format(" '{}'", body.name);
        bodies.push_back({fmt::format("body {}{}", bodies.size() + 1, quoted), mean_of(body.surface.vertices),
                          [&](Reductions& reductions) {
                              if (options.simplification.wanted())
                                  simplify(body, options.simplification, reductions.triangles);
                              Flatness flatness = of_files;
                              const double joined = options.repair.near / size_of(body.surface.vertices);
                              flatness.merged = std::clamp(joined, flatness.merged, flatness.mended);
                              IncomingBlock block{solid_of(body, flatness), {}, body.name, 0, 0};
                              if (options.convex > 0)
                                  enclose(block.solid, static_cast<std::size_t>(options.convex),
                                          reductions.convex_parts);
                              return block;
                          }});
    }
    add_bodies(file, path, bodies);
    return file;
}

} // namespace

double volume_of(const Solid& solid) {
    double volume = 0;
    for (const Polyhedron& part : solid.parts) volume += mass_properties(part).volume;
    return volume;
}

IncomingFile read_blocks(const std::string& path, const IncomingOptions& options) {
    const Placement placement(options);
    FileContents contents = read_contents(path);
    if (contents.grid.blocks.empty()) return from_surfaces(path, std::move(contents.soups), placement, options);
    if (options.simplification.wanted() || options.convex > 0)
        throw Diagnostic(fmt::format("{} holds blocks or zones; only surfaces can be simplified", path),
                         "leave out `simplify`, `deviation` and `convex`");
    return from_grid(path, std::move(contents.grid), placement);
}

} // namespace kaya
