// group, mark, excavate, fill, copy.
#include "commands/make/overlaps.hpp"
#include "commands/session/all_or_nothing.hpp"
#include "base/counted.hpp"
#include "commands/session/handlers.hpp"
#include "commands/session/new_contacts.hpp"

#include "geometry/polyhedra/plane.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/contact/load_before.hpp"
#include "model/edit/copy_blocks.hpp"
#include "model/edit/excavation.hpp"
#include "model/kinds/groups.hpp"

#include <fmt/format.h>
#include <map>

namespace kaya {

void run(Session& session, const lang::Group& command) {
    const auto rows = session.pick(command.kind, command.range);
    if (rows.empty()) return;
    auto& column = *own_groups(session.engine.model, command.kind);
    std::map<std::int32_t, std::int32_t> renamed; // few numbers, many rows
    for (const Row row : rows) {
        const auto [entry, is_new] = renamed.try_emplace(column[row], 0);
        if (is_new)
            entry->second = command.remove ? without_group(session.engine.model, column[row], command.name)
                                           : with_group(session.engine.model, column[row], command.name);
        column[row] = entry->second;
    }
}

void run(Session& session, const lang::Mark& command) {
    for (const Row block : session.pick(ObjectKind::block, command.range))
        session.engine.model.blocks.region[block] = static_cast<std::int32_t>(command.region);
}

namespace {

void mark_joints(Session& session, const lang::MarkJoint& command) {
    auto& model = session.engine.model;
    find_joints(session);
    const auto faces = session.pick(ObjectKind::face, command.range);
    for (const Row face : faces) model.faces.joint_set[face] = static_cast<std::int32_t>(command.joint_set);
    // A contact has the number of its face, as when it was found.
    auto& contacts = model.contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Row face = contacts.face1[c] != no_row ? contacts.face1[c] : contacts.face2[c];
        contacts.joint_set[c] = face != no_row ? model.faces.joint_set[face] : 0;
    }
}

} // namespace

void run(Session& session, const lang::MarkJoint& command) {
    all_or_nothing(session, [&] { mark_joints(session, command); });
}

void run(Session& session, const lang::Excavate& command) {
    const auto blocks = session.pick(ObjectKind::block, command.range);
    if (blocks.empty()) return;
    lose_joints_of(session.engine.model, blocks);
    excavate_blocks(session.engine.model, blocks);
}

void run(Session& session, const lang::Fill& command) {
    const Model kept = excavated_model(session.engine.model);
    const auto test =
        range_test(kept, session.deck.ranges, command.range, ObjectKind::block, session.range_extras(true));
    const auto rows = select(kept, ObjectKind::block, test);
    if (rows.empty())
        return session.warn(Diagnostic(kept.blocks.empty()
                                           ? std::string("no block was excavated")
                                           : fmt::format("0 of {} excavated blocks matched", kept.blocks.size()),
                                       "the command has no effect")
                                .at(command.range.place));
    fill_blocks(session.engine.model, rows);
}

void run(Session& session, const lang::Copy& command) {
    const auto blocks = session.pick(ObjectKind::block, command.range);
    if (blocks.empty()) return;
    Model& model = session.engine.model;
    const Vec3 normal =
        command.normal ? Vec3(command.normal->normalized()) : normal_from_dip(command.dip, command.dip_direction);
    std::vector<Placement> placements;
    for (std::int64_t i = 1; i <= command.number; ++i) {
        placements.push_back(command.mirror ? reflection(normal, command.origin) : Placement{});
        if (command.offset) placements.back().shift += static_cast<double>(i) * *command.offset;
    }
    const Row first = copy_blocks(model, blocks, placements);
    for (Row b = first; b < static_cast<Row>(model.blocks.size()); ++b) {
        if (command.region) model.blocks.region[b] = static_cast<std::int32_t>(*command.region);
        if (!command.group.empty()) model.blocks.group[b] = with_group(model, model.blocks.group[b], command.group);
    }
    session.program.output.say(
        fmt::format("{} of {}", counted(command.number, "copy"), counted(blocks.size(), "block")));
    warn_of_overlaps(session, first, command.place);
}

void add_handlers(HandlerTable& table, lang::SelectionCommands list) { fill(table, list); }

} // namespace kaya
