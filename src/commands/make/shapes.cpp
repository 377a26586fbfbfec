// poly: blocks of a shape.
#include "commands/make/overlaps.hpp"
#include "commands/session/handlers.hpp"

#include "geometry/surface/shapes.hpp"
#include "model/edit/build.hpp"
#include "model/kinds/groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

namespace {

NewBlock block_of_command(const lang::BlockOptions& options) {
    NewBlock block;
    block.material = static_cast<std::int32_t>(options.material);
    block.constitutive = static_cast<std::int32_t>(options.constitutive);
    block.region = static_cast<std::int32_t>(options.region);
    return block;
}

/// Makes the shapes and puts them into the model; a mistake points at the command.
template <class Command, class Make> void make(Session& session, const Command& command, Make shape) {
    try {
        const NewBlock block = block_of_command(command.options);
        const auto made = shape();
        const auto first = static_cast<Row>(session.engine.model.blocks.size());
        if constexpr (std::same_as<std::remove_cv_t<decltype(made)>, Solid>) {
            add_solid(session.engine.model, made.parts, block);
        } else {
            for (const Polyhedron& part : made) add_block(session.engine.model, part, block);
        }
        if (const std::int32_t group = with_group(session.engine.model, 0, command.options.group))
            for (Row b = first; b < static_cast<Row>(session.engine.model.blocks.size()); ++b)
                session.engine.model.blocks.group[b] = group;
        warn_of_overlaps(session, first, command.place);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

} // namespace

void run(Session& session, const lang::PolyBrick& command) {
    make(session, command, [&] {
        const Vec3 low(command.x[0], command.y[0], command.z[0]), high(command.x[1], command.y[1], command.z[1]);
        return std::array{make_brick(low, high)};
    });
}

void run(Session& session, const lang::PolyPrism& command) {
    make(session, command, [&] { return make_prism(command.first, command.second); });
}

void run(Session& session, const lang::PolyFace& command) {
    make(session, command, [&] {
        std::vector<std::vector<Vec3>> loops;
        std::vector<int> joint_sets;
        for (const auto& face : command.faces) {
            loops.push_back(face.corners);
            joint_sets.push_back(static_cast<int>(face.joint_set));
        }
        // Coordinates with three decimals put the faces of small blocks off their planes.
        constexpr Flatness of_decks{1e-3, false, 1e-2};
        Solid solid = make_from_faces(loops, joint_sets, of_decks);
        if (!solid.triangulated.empty())
            session.note_once(
                "faces that lie a thousandth of the block's size or more off their plane become triangles",
                fmt::format("here {}{}; give corners with more digits, or triangles instead",
                            fmt::join(solid.triangulated, ", "),
                            solid.parts.size() == 1 ? ""
                                                    : fmt::format(", and the block is {} convex parts that are joined",
                                                                  solid.parts.size())));
        constexpr const char* clockwise = "give the corners of all faces clockwise seen from outside";
        if (solid.turned_faces > 0)
            session.warn(
                Diagnostic(fmt::format("{} of the {} faces {} in the opposite direction to the first, and {} reversed",
                                       solid.turned_faces, loops.size(), solid.turned_faces == 1 ? "runs" : "run",
                                       solid.turned_faces == 1 ? "was" : "were"),
                           clockwise)
                    .at(command.place));
        if (solid.anticlockwise)
            session.note_once("the polyhedron is inside out, and was reversed: its faces run anticlockwise seen from "
                              "outside",
                              clockwise);
        return solid;
    });
}

void run(Session& session, const lang::PolyTet& command) {
    make(session, command, [&] {
        std::array<Vec3, 4> corners;
        std::copy_n(command.corners.begin(), 4, corners.begin());
        return std::array{make_tetrahedron(corners)};
    });
}

void run(Session& session, const lang::PolyCube& command) {
    make(session, command, [&] { return std::array{make_cube(command.centre, command.edge)}; });
}

void run(Session& session, const lang::PolyDrum& command) {
    make(session, command, [&] {
        return std::array{make_drum(
            {*command.end1, *command.end2, *command.radius1, *command.radius2, static_cast<int>(command.sides)})};
    });
}

namespace {

TunnelBlocks tunnel_of(const lang::PolyTunnel& command) {
    TunnelBlocks tunnel;
    tunnel.dip = command.dip;
    tunnel.dip_direction = command.dip_direction;
    tunnel.origin = command.origin;
    tunnel.radius = command.radius;
    tunnel.begin = command.length[0];
    tunnel.end = command.length[1];
    tunnel.radial = static_cast<int>(command.radial);
    tunnel.tangential = static_cast<int>(command.tangential);
    tunnel.axial = static_cast<int>(command.axial);
    tunnel.boundary = command.boundary;
    tunnel.ratio = command.ratio;
    return tunnel;
}

} // namespace

void run(Session& session, const lang::PolyTunnel& command) {
    const TunnelBlocks tunnel = tunnel_of(command);
    make(session, command, [&] { return make_tunnel(tunnel); });
    if (!command.core) return;
    lang::PolyTunnel core = command;
    core.options.region = command.core_region.value_or(command.options.region);
    const auto first = static_cast<Row>(session.engine.model.blocks.size());
    make(session, core, [&] { return make_tunnel_core(tunnel); });
    if (command.core_group.empty()) return;
    const std::int32_t group = with_group(session.engine.model, 0, command.core_group);
    for (Row b = first; b < static_cast<Row>(session.engine.model.blocks.size()); ++b)
        session.engine.model.blocks.group[b] = group;
}

void add_handlers(HandlerTable& table, lang::ShapeCommands list) { fill(table, list); }

} // namespace kaya
