// jset, tunnel, densify, join: cutting and joining existing blocks.
#include "commands/review/text_doubts.hpp"
#include "commands/session/ground.hpp"
#include "commands/session/handlers.hpp"

#include "commands/session/long_work.hpp"
#include "commands/make/networks.hpp"
#include "commands/session/plausible.hpp"

#include "base/lower_case.hpp"
#include "geometry/surface/block_cuts.hpp"
#include "geometry/ground/ground_cuts.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/assign/cut_joints.hpp"
#include "model/edit/build.hpp"
#include "model/edit/cut_blocks.hpp"
#include "model/edit/joined.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace kaya {

namespace {

/// Pieces thinner than this part of the model's size are not made.
constexpr double thinnest_part = 1e-6;

/// The first number that no face carries.
int next_joint_set(const Model& model) {
    const auto& sets = model.faces.joint_set;
    return sets.empty() ? 1 : 1 + std::max(0, *std::max_element(sets.begin(), sets.end()));
}

/// "1 block", "2 blocks".
template <class Number> std::string counted(Number number, std::string_view one, std::string_view several) {
    return fmt::format("{} {}", number, number == 1 ? one : several);
}

/// The rigid ones among the blocks to be cut; warns about the others.
std::vector<Row> rigid_blocks(Session& session, std::vector<Row> rows, const Place& place) {
    const std::size_t all = rows.size();
    std::erase_if(rows, [&](Row row) { return session.engine.model.blocks.deformable[row] != 0; });
    if (rows.size() < all)
        session.warn(Diagnostic(counted(all - rows.size(), "block with zones cannot be cut and was left out",
                                        "blocks with zones cannot be cut and were left out"),
                                "cut blocks before `gen`")
                         .at(place));
    return rows;
}

std::vector<Polyhedron> shapes_of(const Model& model, const std::vector<Row>& rows) {
    std::vector<Polyhedron> shapes;
    shapes.reserve(rows.size());
    for (const Row row : rows) shapes.push_back(shape_of(model, row));
    return shapes;
}

std::string too_near(const CutBlocks& cut, double tolerance) {
    return fmt::format("{} not made: too near to a corner of the block (tolerance {:g})",
                       counted(cut.corners, "cut was", "cuts were"), tolerance);
}

std::string too_thin(const CutBlocks& cut, double thinnest) {
    return fmt::format("{} not made: a piece would be thinner than {:.3g}",
                       counted(cut.slivers, "cut was", "cuts were"), thinnest);
}

/// Replaces blocks by their pieces and reports it in one line. Returns the row of each piece.
std::vector<Row> apply(Session& session, const std::vector<Row>& rows, const CutBlocks& cut, double thinnest,
                       const std::string& by, double tolerance = 0) {
    const std::size_t whole = rows.size() - cut.parents.size();
    std::string line = fmt::format("{}: {} cut into {}, {} left whole", by,
                                   counted(cut.parents.size(), "block", "blocks"), cut.pieces.size(), whole);
    if (cut.slivers > 0) line += "; " + too_thin(cut, thinnest);
    if (cut.corners > 0) line += "; " + too_near(cut, tolerance);
    std::vector<Row> pieces;
    if (!cut.parents.empty()) {
        Model& model = session.engine.model;
        std::vector<Row> parents;
        for (const int parent : cut.parents) parents.push_back(rows[static_cast<std::size_t>(parent)]);
        const auto given = given_joints(model, session.engine.joints, parents);
        pieces = replace_by_pieces(model, rows, cut);
        std::vector<BlockId> origin(model.blocks.id.begin(), model.blocks.id.end());
        for (std::size_t i = 0; i < pieces.size(); ++i)
            origin[pieces[i]] = model.blocks.id[rows[static_cast<std::size_t>(cut.pieces[i].parent)]];
        give_to_pieces(model, session.engine.joints, given, origin);
    }
    session.program.output.say(line);
    return pieces;
}

/// Joins the pieces of each block to one body; they are consecutive in the list.
void join_pieces(Model& model, const CutBlocks& cut, const std::vector<Row>& pieces) {
    std::vector<std::pair<Row, Row>> pairs;
    for (std::size_t i = 1; i < pieces.size(); ++i)
        if (cut.pieces[i].parent == cut.pieces[i - 1].parent) pairs.emplace_back(pieces[i - 1], pieces[i]);
    join_pairs(model, pairs);
}

/// Those of a set, or the discs of a network.
std::vector<CuttingPolygon> polygons_of(const SurfaceSets& sets, const lang::CutPolygons& command) {
    const std::string name = lower_case(command.set);
    std::vector<CuttingPolygon> polygons;
    if (command.fractures) {
        for (const Disc& disc : network_named(sets, name, command.place))
            polygons.push_back({rim_of(disc), {normal_of(disc), disc.centre}});
        return polygons;
    }
    const auto found = sets.surfaces.find(name);
    if (found == sets.surfaces.end())
        throw Diagnostic(fmt::format("there is no set of surfaces named '{}'", command.set),
                         "make it before: geometry set 'name', geometry import 'file'");
    for (const auto& polygon : found->second) polygons.push_back(cutting_polygon(polygon, polygons.size()));
    return polygons;
}

} // namespace

void run(Session& session, const lang::JointSetCommand& command) {
    try {
        const std::vector<Row> rows =
            rigid_blocks(session, session.pick(ObjectKind::block, command.range), command.place);
        if (rows.empty()) return;
        warn_of(session, doubts_of(command));
        JointSet set;
        set.dip = command.dip[0];
        set.dip_deviation = command.dip[1];
        set.dip_direction = command.dip_direction[0];
        set.dip_direction_deviation = command.dip_direction[1];
        set.spacing = command.spacing[0];
        set.spacing_deviation = command.spacing[1];
        set.number = static_cast<int>(command.number);
        set.origin = command.origin;
        set.persistence = command.persistence;
        set.tolerance = command.tolerance;
        set.id = command.id ? static_cast<int>(*command.id) : next_joint_set(session.engine.model);
        set.seed = static_cast<std::uint64_t>(command.seed);
        const double thinnest = thinnest_part * model_size(session.engine.model);
        if (set.number > 1 && set.spacing < thinnest)
            throw Diagnostic(fmt::format("a spacing of {:g} would make pieces thinner than {:.3g}, a millionth of "
                                         "the model's size",
                                         set.spacing, thinnest),
                             "give a larger spacing");
        const std::string name = fmt::format("joint set {}", set.id);
        LongWork work(session, name);
        const CutBlocks cut = cut_blocks(shapes_of(session.engine.model, rows), set, thinnest, std::ref(work));
        const auto pieces = apply(session, rows, cut, thinnest, name, set.tolerance);
        if (command.join) join_pieces(session.engine.model, cut, pieces);
        if (cut.parents.empty())
            session.warn(Diagnostic("no block was cut by this joint set", cut.corners > 0 ? too_near(cut, set.tolerance)
                                                                          : cut.slivers > 0
                                                                              ? too_thin(cut, thinnest)
                                                                              : "look at its origin and its dip")
                             .at(command.place));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::TunnelCommand& command) {
    try {
        const std::vector<Row> rows =
            rigid_blocks(session, session.pick(ObjectKind::block, command.range), command.place);
        if (rows.empty()) return;
        const double thinnest = thinnest_part * model_size(session.engine.model);
        TunnelOutline outline{command.first, command.second, command.radial, next_joint_set(session.engine.model)};
        LongWork work(session, "tunnel");
        const TunnelCut cut = cut_tunnel(shapes_of(session.engine.model, rows), outline, thinnest, std::ref(work));
        const std::vector<Row> pieces =
            apply(session, rows, cut.blocks, thinnest, fmt::format("tunnel, joint set {}", outline.id));
        if (cut.blocks.parents.empty() && cut.swallowed.empty())
            session.warn(
                Diagnostic("no block lies in the tunnel", "look at the corners of its outline").at(command.place));
        if (command.region == 0) return;
        auto& region = session.engine.model.blocks.region;
        for (std::size_t i = 0; i < pieces.size(); ++i)
            if (cut.inside[i]) region[pieces[i]] = static_cast<std::int32_t>(command.region);
        for (const int block : cut.swallowed)
            region[rows[static_cast<std::size_t>(block)]] = static_cast<std::int32_t>(command.region);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::CutGround& command) {
    const Ground ground = ground_of(session, command.file, command.shift, command.place);
    const std::vector<Row> rows = rigid_blocks(session, session.pick(ObjectKind::block, command.range), command.place);
    if (rows.empty()) return;
    try {
        Model& model = session.engine.model;
        const double thinnest = thinnest_part * model_size(model);
        const int id = command.id ? static_cast<int>(*command.id) : next_joint_set(model);
        LongWork work(session, "cut ground");
        const GroundCut cut = cut_by_ground(shapes_of(model, rows), ground, id, thinnest, std::ref(work));
        const auto pieces = apply(session, rows, cut.blocks, thinnest, fmt::format("ground, joint set {}", id));
        if (cut.blocks.parents.empty()) {
            session.warn(Diagnostic("no block was cut by this surface",
                                    "look at its place: list blocks shows those of the blocks")
                             .at(command.place));
            return;
        }
        // Pieces on one side stay one body.
        for (std::size_t i = 0; i < pieces.size();) {
            std::array<std::vector<Row>, 2> sides;
            const int parent = cut.blocks.pieces[i].parent;
            for (; i < pieces.size() && cut.blocks.pieces[i].parent == parent; ++i)
                sides[cut.above[i] ? 1 : 0].push_back(pieces[i]);
            for (const auto& side : sides)
                if (side.size() > 1) join_pairs(model, adjacent_pairs(model, side));
        }
        for (std::size_t i = 0; i < pieces.size(); ++i)
            if (command.region && !cut.above[i])
                model.blocks.region[pieces[i]] = static_cast<std::int32_t>(*command.region);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::CutPolygons& command) {
    const char* what = command.fractures ? "network of fractures" : "set of surfaces";
    try {
        const std::vector<CuttingPolygon> polygons = polygons_of(session.deck.surface_sets, command);
        const std::vector<Row> rows =
            rigid_blocks(session, session.pick(ObjectKind::block, command.range), command.place);
        if (rows.empty()) return;
        Model& model = session.engine.model;
        const double thinnest = thinnest_part * model_size(model);
        const int id = command.id ? static_cast<int>(*command.id) : next_joint_set(model);
        const std::string name =
            fmt::format("{} {}, joint set {}", command.fractures ? "dfn" : "geometry", command.set, id);
        LongWork work(session, name);
        const CutBlocks cut = cut_by_polygons(shapes_of(model, rows), polygons, id, thinnest, std::ref(work));
        const auto pieces = apply(session, rows, cut, thinnest, name);
        if (command.join) join_pieces(model, cut, pieces);
        if (cut.parents.empty())
            session.warn(Diagnostic(fmt::format("no block was cut by this {}", what),
                                    cut.slivers > 0 ? too_thin(cut, thinnest) : "look at its place")
                             .at(command.place));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::Densify& command) {
    const std::vector<Row> rows = rigid_blocks(session, session.pick(ObjectKind::block, command.range), command.place);
    if (rows.empty()) return;
    constexpr double most_pieces = 5e6;
    std::array<int, 3> parts{};
    double count = static_cast<double>(rows.size());
    for (std::size_t k = 0; k < 3; ++k) {
        parts[k] = static_cast<int>(command.parts[k]);
        count *= parts[k];
    }
    if (count > most_pieces)
        throw Diagnostic(fmt::format("this would make {:.3g} blocks, more than {:.0e}", count, most_pieces),
                         "give fewer parts or a smaller range")
            .at(command.place);
    try {
        LongWork work(session, "densify");
        const CutBlocks cut = densify(shapes_of(session.engine.model, rows), parts, 0, std::ref(work));
        const std::vector<Row> pieces = apply(session, rows, cut, 0, "densify");
        if (command.join) join_pieces(session.engine.model, cut, pieces);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

namespace {

/// Joins the pairs and reports the result in one line.
void join(Session& session, const std::vector<std::pair<Row, Row>>& pairs, const Place& place) {
    try {
        join_pairs(session.engine.model, pairs);
    } catch (Diagnostic& mistake) {
        mistake.at(place);
        throw;
    }
    if (pairs.empty())
        return session.warn(Diagnostic("none of these blocks lie face on face", "nothing is joined").at(place));
    std::set<std::int32_t> bodies;
    std::set<Row> blocks;
    for (const auto& pair : pairs) {
        blocks.insert({pair.first, pair.second});
        bodies.insert(session.engine.model.blocks.body[pair.first]);
    }
    session.program.output.say(fmt::format("{} joined to {}", counted(blocks.size(), "block", "blocks"),
                                           counted(bodies.size(), "body", "bodies")));
}

} // namespace

void run(Session& session, const lang::Join& command) {
    const auto rows = session.pick(ObjectKind::block, command.range);
    if (rows.empty()) return;
    if (command.on) return join(session, adjacent_pairs(session.engine.model, rows), command.place);
    unjoin(session.engine.model, rows);
}

void run(Session& session, const lang::JoinContact& command) {
    std::vector<std::pair<Row, Row>> pairs;
    const auto& contacts = session.engine.model.contacts;
    for (const Row contact : session.pick(ObjectKind::contact, command.range))
        pairs.emplace_back(contacts.block1[contact], contacts.block2[contact]);
    if (!pairs.empty()) join(session, pairs, command.place);
}

void add_handlers(HandlerTable& table, lang::CutCommands list) { fill(table, list); }

} // namespace kaya
