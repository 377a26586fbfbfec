// jset, tunnel, densify, join: cutting and joining existing blocks.
#include "commands/review/text_doubts.hpp"
#include "commands/session/ground.hpp"
#include "commands/session/handlers.hpp"

#include "commands/session/long_work.hpp"
#include "commands/make/networks.hpp"
#include "commands/session/plausible.hpp"

#include "base/lower_case.hpp"
#include "base/number_text.hpp"
#include "geometry/fractures/fracture_cuts.hpp"
#include "geometry/grid/file_formats.hpp"
#include "geometry/read/surface_files.hpp"
#include "geometry/surface/block_cuts.hpp"
#include "geometry/surface/surface_cuts.hpp"
#include "geometry/ground/ground_cuts.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/assign/cut_joints.hpp"
#include "mechanics/assign/parted_joints.hpp"
#include "mechanics/cycle/separate.hpp"
#include "model/edit/build.hpp"
#include "model/edit/cut_blocks.hpp"
#include "model/edit/joined.hpp"
#include "model/measure/measure.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <set>

namespace kaya {

namespace {

/// Pieces thinner than this part of the model's size are not made.
constexpr double thinnest_part = 1e-6;

/// The first number above those of faces and of fractures.
int next_joint_set(const Session& session) {
    int last = 0;
    for (const int set : session.engine.model.faces.joint_set) last = std::max(last, set);
    for (const auto& [name, fractures] : session.deck.surface_sets.networks)
        for (const Fracture& fracture : fractures) last = std::max(last, fracture.joint_set);
    return last + 1;
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

/// Blocks to be cut, and the least thickness of their pieces.
struct ToBeCut {
    std::vector<Row> rows;
    std::vector<Polyhedron> shapes;
    double thinnest;
};

template <class Command> ToBeCut to_be_cut(Session& session, const Command& command) {
    const Model& model = session.engine.model;
    const auto rows = rigid_blocks(session, session.pick(ObjectKind::block, command.range), command.place);
    return {rows, shapes_of(model, rows), thinnest_part * model_size(model)};
}

/// The number that the deck gives, or the next free one.
int joint_set_of(const Session& session, const std::optional<std::int64_t>& given) {
    return given ? static_cast<int>(*given) : next_joint_set(session);
}

std::string too_near(const CutBlocks& cut, double tolerance) {
    return fmt::format("{} not made: too near to a corner of the block (tolerance {:g})",
                       counted(cut.corners, "cut was", "cuts were"), tolerance);
}

std::string too_thin(const CutBlocks& cut, double thinnest) {
    return fmt::format("{} not made: a piece would be thinner than {:.3g}",
                       counted(cut.slivers, "cut was", "cuts were"), thinnest);
}

/// Warns that none of the blocks was cut.
void nothing_cut(Session& session, const char* by, const CutBlocks& cut, double thinnest, double tolerance,
                 const Place& place) {
    session.warn(Diagnostic(fmt::format("no block was cut by this {}", by), cut.corners > 0   ? too_near(cut, tolerance)
                                                                            : cut.slivers > 0 ? too_thin(cut, thinnest)
                                                                                              : "look at its place")
                     .at(place));
}

using JoinPieces = std::function<void(const std::vector<Row>& pieces)>;

/// Replaces blocks by their pieces, joins those that `join` names, and reports it in one line. Returns the row of each piece.
std::vector<Row> apply(Session& session, const std::vector<Row>& rows, const CutBlocks& cut, double thinnest,
                       const std::string& by, const JoinPieces& join = {}, double tolerance = 0) {
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
        const auto whole = whole_joints(model, session.engine.joints, parents);
        pieces = replace_by_pieces(model, rows, cut);
        std::vector<BlockId> origin(model.blocks.id.begin(), model.blocks.id.end());
        std::vector<std::vector<Row>> bodies;
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            const int parent = cut.pieces[i].parent;
            if (i == 0 || parent != cut.pieces[i - 1].parent) bodies.emplace_back();
            bodies.back().push_back(pieces[i]);
            origin[pieces[i]] = model.blocks.id[rows[static_cast<std::size_t>(parent)]];
        }
        share_joints(model, session.engine.joints, whole, origin);
        if (join) join(pieces);
        load_parted_joints(model, session.engine.joints, bodies);
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

JoinPieces joined_if(bool wanted, Session& session, const CutBlocks& cut) {
    if (!wanted) return {};
    return [&](const std::vector<Row>& pieces) { join_pieces(session.engine.model, cut, pieces); };
}

/// Joins the pieces of each block that lie on one side.
void join_sides(Model& model, const SidedBlocks& cut, const std::vector<Row>& pieces) {
    for (std::size_t i = 0; i < pieces.size();) {
        std::array<std::vector<Row>, 2> sides;
        const int parent = cut.blocks.pieces[i].parent;
        for (; i < pieces.size() && cut.blocks.pieces[i].parent == parent; ++i)
            sides[cut.inside[i] ? 0 : 1].push_back(pieces[i]);
        for (const auto& side : sides)
            if (side.size() > 1) join_pairs(model, adjacent_pairs(model, side));
    }
}

/// Gives blocks and pieces inside a region number.
void give_region(Model& model, const SidedBlocks& cut, const std::vector<Row>& rows, const std::vector<Row>& pieces,
                 std::int64_t number) {
    auto& region = model.blocks.region;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (cut.inside[i]) region[pieces[i]] = static_cast<std::int32_t>(number);
    for (const int block : cut.swallowed)
        region[rows[static_cast<std::size_t>(block)]] = static_cast<std::int32_t>(number);
}

/// The surface of a file, moved.
CuttingSurface surface_of(Session& session, const lang::CutSurface& command) {
    std::vector<FaceSoup> soups = read_soups(session.input_file(command.file).string());
    for (FaceSoup& soup : soups)
        for (auto& loop : soup.loops)
            for (Vec3& corner : loop) corner += command.shift;
    std::vector<Surface> bodies, cavities;
    for (NamedSurface& body : surfaces_of(soups).surfaces) {
        bodies.push_back(std::move(body.surface));
        std::ranges::move(body.cavities, std::back_inserter(cavities));
    }
    return cutting_surface(std::move(bodies), std::move(cavities));
}

std::vector<CuttingPolygon> polygons_of(const SurfaceSets& sets, const std::string& name) {
    const auto found = sets.surfaces.find(lower_case(name));
    if (found == sets.surfaces.end())
        throw Diagnostic(fmt::format("there is no set of surfaces named '{}'", name),
                         "make it before: geometry set 'name', geometry import 'file'");
    std::vector<CuttingPolygon> polygons;
    for (const auto& polygon : found->second) polygons.push_back(cutting_polygon(polygon, polygons.size()));
    return polygons;
}

/// Gives each fracture of a network its joint set: the one that it has, or numbers from the given or the next free one.
void number_joint_sets(Network& network, const lang::CutFractures& command, int next) {
    std::int64_t number = command.id.value_or(next);
    for (Fracture& fracture : network) {
        if (!command.id && fracture.joint_set != 0) continue;
        if (number > std::numeric_limits<std::int32_t>::max())
            throw Diagnostic(fmt::format("there is no joint set number {}", number), "give a smaller id");
        fracture.joint_set = static_cast<std::int32_t>(number++);
    }
}

/// In the order in which they cut.
Network by_dominance(Network fractures) {
    std::ranges::stable_sort(fractures, {}, &Fracture::dominance);
    return fractures;
}

/// Closes the faces of the block that a fracture has opened.
void close_faces(Model& model, Row block) {
    for (Row f = model.blocks.faces[block].first; f < model.blocks.faces[block].end(); ++f) model.faces.open[f] = 0;
}

/// Joins the pieces of each block where their common face is not open. Pieces without a body have joints on all sides.
void join_beyond(Model& model, const CutBlocks& cut, const std::vector<Row>& pieces) {
    std::vector<std::pair<Row, Row>> pairs;
    for (std::size_t i = 0; i < pieces.size();) {
        std::vector<Row> of_parent;
        const int parent = cut.pieces[i].parent;
        for (; i < pieces.size() && cut.pieces[i].parent == parent; ++i) of_parent.push_back(pieces[i]);
        const auto more = adjacent_pairs(model, of_parent);
        pairs.insert(pairs.end(), more.begin(), more.end());
    }
    join_pairs(model, pairs);
    for (const Row piece : pieces)
        if (model.blocks.body[piece] == 0) close_faces(model, piece);
}

} // namespace

void run(Session& session, const lang::JointSetCommand& command) {
    try {
        const auto [rows, shapes, thinnest] = to_be_cut(session, command);
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
        set.id = joint_set_of(session, command.id);
        set.seed = static_cast<std::uint64_t>(command.seed);
        if (set.number > 1 && set.spacing < thinnest)
            throw Diagnostic(fmt::format("a spacing of {:g} would make pieces thinner than {:.3g}, a millionth of "
                                         "the model's size",
                                         set.spacing, thinnest),
                             "give a larger spacing");
        const std::string name = fmt::format("joint set {}", set.id);
        LongWork work(session, name);
        const CutBlocks cut = cut_blocks(shapes, set, thinnest, std::ref(work));
        apply(session, rows, cut, thinnest, name, joined_if(command.join, session, cut), set.tolerance);
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
        const auto [rows, shapes, thinnest] = to_be_cut(session, command);
        if (rows.empty()) return;
        TunnelOutline outline;
        if (command.path.empty()) outline.sections = {command.first, command.second};
        else outline.sections = sections_along(command.first, command.path);
        outline.radial = command.radial;
        outline.id = next_joint_set(session);
        LongWork work(session, "tunnel");
        const SidedBlocks cut = cut_tunnel(shapes, outline, thinnest, std::ref(work));
        const auto join = [&](const std::vector<Row>& pieces) {
            if (command.join) join_sides(session.engine.model, cut, pieces);
        };
        const auto pieces =
            apply(session, rows, cut.blocks, thinnest, fmt::format("tunnel, joint set {}", outline.id), join);
        if (cut.blocks.parents.empty() && cut.swallowed.empty())
            session.warn(
                Diagnostic("no block lies in the tunnel", "look at the corners of its outline").at(command.place));
        if (command.region != 0) give_region(session.engine.model, cut, rows, pieces, command.region);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::CutGround& command) {
    const Ground ground = ground_of(session, command.file, command.shift, command.place);
    const auto [rows, shapes, thinnest] = to_be_cut(session, command);
    if (rows.empty()) return;
    try {
        Model& model = session.engine.model;
        const int id = joint_set_of(session, command.id);
        LongWork work(session, "cut ground");
        const SidedBlocks cut = cut_by_ground(shapes, ground, id, thinnest, std::ref(work));
        const auto join = [&](const std::vector<Row>& pieces) { join_sides(model, cut, pieces); };
        if (!cut.beyond.empty()) {
            const auto first = static_cast<std::size_t>(cut.beyond.front());
            session.warn(
                Diagnostic(
                    fmt::format(
                        "the surface ends, or has a hole, inside of {}, the first at {}: the planes of the nearest triangles are continued there",
                        counted(cut.beyond.size(), "block", "blocks"), place_text(block_centroid(model, rows[first]))),
                    "give a surface that is larger than the blocks and has no holes, or cut the blocks at its border before")
                    .at(command.place));
        }
        const auto pieces = apply(session, rows, cut.blocks, thinnest, fmt::format("ground, joint set {}", id), join);
        if (cut.blocks.parents.empty()) {
            session.warn(Diagnostic("no block was cut by this surface",
                                    "look at its place: list blocks shows those of the blocks")
                             .at(command.place));
            return;
        }
        if (command.region) give_region(model, cut, rows, pieces, *command.region);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::CutSurface& command) {
    try {
        const CuttingSurface surface = surface_of(session, command);
        const auto [rows, shapes, thinnest] = to_be_cut(session, command);
        if (rows.empty()) return;
        Model& model = session.engine.model;
        const int id = joint_set_of(session, command.id);
        const std::string name = fmt::format("surface {}, joint set {}", command.file, id);
        LongWork work(session, name);
        const SidedBlocks cut = cut_by_surface(shapes, surface, id, thinnest, std::ref(work));
        const auto join = [&](const std::vector<Row>& pieces) {
            if (command.join) join_pieces(model, cut.blocks, pieces);
            else join_sides(model, cut, pieces);
        };
        const auto pieces = apply(session, rows, cut.blocks, thinnest, name, join);
        if (command.region) give_region(model, cut, rows, pieces, *command.region);
        if (cut.blocks.parents.empty() && cut.swallowed.empty())
            nothing_cut(session, "surface", cut.blocks, thinnest, 0, command.place);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::CutPolygons& command) {
    try {
        const std::vector<CuttingPolygon> polygons = polygons_of(session.deck.surface_sets, command.set);
        const auto [rows, shapes, thinnest] = to_be_cut(session, command);
        if (rows.empty()) return;
        const int id = joint_set_of(session, command.id);
        const std::string name = fmt::format("geometry {}, joint set {}", command.set, id);
        LongWork work(session, name);
        const CutBlocks cut = cut_by_polygons(shapes, polygons, id, thinnest, std::ref(work));
        apply(session, rows, cut, thinnest, name, joined_if(command.join, session, cut));
        if (cut.parents.empty()) nothing_cut(session, "set of surfaces", cut, thinnest, 0, command.place);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::CutFractures& command) {
    try {
        SurfaceSets& sets = session.deck.surface_sets;
        Network& network = network_named(sets, lower_case(command.network), command.place);
        const auto [rows, shapes, thinnest] = to_be_cut(session, command);
        if (rows.empty()) return;
        Model& model = session.engine.model;
        number_joint_sets(network, command, next_joint_set(session));
        const FractureCutting how{.limited = command.limited,
                                  .sides = static_cast<int>(command.sides),
                                  .persistence = command.persistence,
                                  .seed = static_cast<std::uint64_t>(command.seed),
                                  .thinnest = thinnest,
                                  .nearest = command.tolerance};
        const std::string name = fmt::format("dfn {}", command.network);
        LongWork work(session, name);
        const FractureCuts cut = cut_by_fractures(shapes, by_dominance(network), how, std::ref(work));
        const auto join = [&](const std::vector<Row>& pieces) {
            if (command.join) join_pieces(model, cut.blocks, pieces);
            else if (command.limited) join_beyond(model, cut.blocks, pieces);
        };
        apply(session, rows, cut.blocks, thinnest, name, join, how.nearest);
        session.program.output.say(fmt::format("{}: area of fractures in these blocks {:.9g}, of joints {:.9g}", name,
                                               cut.of_fractures, cut.of_joints));
        if (cut.blocks.parents.empty())
            nothing_cut(session, "network of fractures", cut.blocks, thinnest, how.nearest, command.place);
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

void run(Session& session, const lang::Densify& command) {
    const auto [rows, shapes, thinnest] = to_be_cut(session, command);
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
        const CutBlocks cut = densify(shapes, parts, 0, thinnest, std::ref(work));
        apply(session, rows, cut, thinnest, "densify", joined_if(command.join, session, cut));
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
    if (command.on) {
        for (const Row row : rows) close_faces(session.engine.model, row);
        return join(session, adjacent_pairs(session.engine.model, rows), command.place);
    }
    separate(session.engine.model, session.engine.joints, rows);
}

void run(Session& session, const lang::JoinContact& command) {
    std::vector<std::pair<Row, Row>> pairs;
    const auto& contacts = session.engine.model.contacts;
    for (const Row contact : session.pick(ObjectKind::contact, command.range)) {
        pairs.emplace_back(contacts.block1[contact], contacts.block2[contact]);
        for (const Row face : {contacts.face1[contact], contacts.face2[contact]})
            if (face != no_row) session.engine.model.faces.open[face] = 0;
    }
    if (!pairs.empty()) join(session, pairs, command.place);
}

void add_handlers(HandlerTable& table, lang::CutCommands list) { fill(table, list); }

} // namespace kaya
