// gen, hide, seek, delete, facetri.
#include "commands/session/handlers.hpp"
#include "commands/session/long_work.hpp"

#include "base/counted.hpp"
#include "base/number_text.hpp"
#include "mechanics/contact/load_before.hpp"
#include "mechanics/supports/loads_to_zones.hpp"
#include "model/edit/build.hpp"
#include "model/measure/measure.hpp"
#include "model/measure/volume_jumps.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya {

namespace {

/// One warning for all zones adjacent to much larger ones.
void warn_of_jumps(Session& session, const std::vector<Row>& blocks, const Place& place) {
    const VolumeJumps jumps = volume_jumps(session.engine.model, blocks);
    if (jumps.count == 0) return;
    const auto number = [&](std::size_t i) { return session.engine.model.blocks.number[jumps.blocks[i]]; };
    const std::string where = number(0) == number(1) ? fmt::format("in block {}", number(0))
                                                     : fmt::format("between blocks {} and {}", number(0), number(1));
    session.warn(Diagnostic(fmt::format("the volumes of {} of zones with a common face differ by more than 4 to 1; the "
                                        "worst by {:.3g} to 1, {} at {}",
                                        counted(jumps.count, "pair"), jumps.worst, where, place_text(jumps.place)),
                            "zones that change slowly are more exact: give edges that are nearer to those of the "
                            "neighbours, or a field with `gen edge f center ...`")
                     .at(place));
}

template <class Command, class Generate>
void give_zones_to_blocks(Session& session, const Command& command, const Generate& generate) {
    const auto blocks = session.pick(ObjectKind::block, command.range);
    if (blocks.empty()) return;
    try {
        LongWork work(session, "zones");
        if (generate(blocks, std::ref(work)) == 0)
            session.warn(Diagnostic(fmt::format("all {} blocks that this acts on have zones already", blocks.size()),
                                    "the command has no effect")
                             .at(command.place));
        else warn_of_jumps(session, blocks, command.place);
        const auto lost = put_loads_on_zones(session.engine.model, blocks);
        if (!lost.empty())
            session.warn(
                Diagnostic(
                    fmt::format("{} had forces or moments without a place, which zones cannot take: they are gone",
                                lost.size() == 1 ? fmt::format("block {}", lost.front())
                                                 : fmt::format("{} blocks", lost.size())),
                    "give them again, at gridpoints or faces")
                    .at(command.place));
    } catch (Diagnostic& mistake) {
        mistake.at(command.place);
        throw;
    }
}

} // namespace

void run(Session& session, const lang::Hide& command) {
    for (const Row block : session.pick(ObjectKind::block, command.range))
        session.engine.model.blocks.hidden[block] = 1;
}

void run(Session& session, const lang::Seek& command) {
    for (const Row block : session.pick_hidden_too(ObjectKind::block, command.range))
        session.engine.model.blocks.hidden[block] = 0;
}

void run(Session& session, const lang::Delete& command) {
    const auto blocks = session.pick(ObjectKind::block, command.range);
    if (blocks.empty()) return;
    lose_joints_of(session.engine.model, blocks);
    delete_blocks(session.engine.model, blocks);
}

namespace {

/// Throws Diagnostic when the faces of the rigid blocks, divided by that edge, would have more sub-contacts than a model can hold.
void refuse_too_fine(const Model& model, const std::vector<Row>& picked, double edge, const Place& place) {
    constexpr double most_places = 2e6;
    double area = 0;
    for (const Row block : picked) {
        if (model.blocks.deformable[block]) continue;
        const Span faces = model.blocks.faces[block];
        for (Row face = faces.first; face < faces.end(); ++face) area += face_area_vector(model, face).norm();
    }
    if (area > most_places * edge * edge)
        throw Diagnostic(fmt::format("an edge of {:g} would make more than {:.0e} sub-contacts", edge, most_places),
                         "give a longer edge, or a range with fewer blocks")
            .at(place);
}

} // namespace

void run(Session& session, const lang::FaceTriangulation& command) {
    using Style = lang::FaceTriangulation::Style;
    const auto picked = session.pick(ObjectKind::block, command.range);
    if (command.style == Style::edge) refuse_too_fine(session.engine.model, picked, command.edge, command.place);
    auto& blocks = session.engine.model.blocks;
    std::size_t rigid = 0;
    for (const Row block : picked) {
        if (blocks.deformable[block]) continue;
        ++rigid;
        if (command.style == Style::edge) {
            blocks.face_edge[block] = command.edge;
            continue;
        }
        blocks.face_triangles[block] = command.style == Style::radial     ? FaceTriangles::radial
                                       : command.style == Style::radial_8 ? FaceTriangles::radial_8
                                                                          : FaceTriangles::fan;
        if (command.style == Style::fan) blocks.face_edge[block] = 0;
    }
    if (rigid > 0) ModelEdit(session.engine.model, Change::surfaces);
    else if (!picked.empty())
        throw Diagnostic(picked.size() == 1 ? std::string("the block that this acts on has zones")
                                            : fmt::format("all {} blocks that this acts on have zones", picked.size()),
                         "zones divide the faces of their blocks: give the edge of zones (generate edge ...)")
            .at(command.place);
}

void run(Session& session, const lang::GenerateEdge& command) {
    EdgeField field(command.edge.value_or(command.at_distance.value_or(0)));
    if (command.center)
        field = EdgeField(field.edge, *command.center, *command.at_center, *command.at_distance, *command.distance);
    give_zones_to_blocks(session, command, [&](const std::vector<Row>& blocks, const ProgressCallback& progress) {
        return generate_zones(session.engine.model, blocks, field, progress);
    });
}

void run(Session& session, const lang::GenerateQuad& command) {
    std::array<int, 3> parts;
    for (std::size_t k = 0; k < 3; ++k) parts[k] = static_cast<int>(command.parts[k]);
    give_zones_to_blocks(session, command, [&](const std::vector<Row>& blocks, const ProgressCallback& progress) {
        return generate_zones(session.engine.model, blocks, parts, command.ratio, progress);
    });
}

void add_handlers(HandlerTable& table, lang::GeometryCommands list) { fill(table, list); }

} // namespace kaya
