#include "model/whole/consistency.hpp"

#include "model/edit/bounded.hpp"
#include "model/edit/excavation.hpp"
#include "model/edit/ties.hpp"
#include "model/kinds/kinds.hpp"
#include "model/measure/structure_rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

namespace kaya {

namespace {

/// Collects the first inconsistency; later ones are ignored.
class Findings {
public:
    const std::string& text() const { return text_; }
    bool clean() const { return text_.empty(); }

    void require(bool right, const char* table, std::size_t row, const std::string& what) {
        if (!right && clean()) text_ = fmt::format("row {} of {}: {}", row, table, what);
    }
    void require(bool right, const std::string& what) {
        if (!right && clean()) text_ = what;
    }

private:
    std::string text_;
};

bool inside(Row row, std::size_t size) { return row >= 0 && static_cast<std::size_t>(row) < size; }
bool inside_or_none(Row row, std::size_t size) { return row == no_row || inside(row, size); }

/// Spans must lie inside the other table, and their rows must name their owner.
void check_spans(Findings& findings, const char* table, const char* target, const Column<Span>& spans,
                 const Column<Row>& owners) {
    const auto size = static_cast<Row>(owners.size());
    std::size_t covered = 0;
    for (std::size_t i = 0; i < spans.size() && findings.clean(); ++i) {
        const Span span = spans[i];
        const bool fits = span.count >= 0 && span.first >= 0 && span.first <= size && span.count <= size - span.first;
        findings.require(fits, table, i,
                         fmt::format("{} {} and the {} after of {}", target, span.first, span.count, size));
        if (!fits) return;
        for (Row row = span.first; row < span.end(); ++row)
            findings.require(owners[static_cast<std::size_t>(row)] == static_cast<Row>(i), table, i,
                             fmt::format("{} {} belongs to another row", target, row));
        covered += static_cast<std::size_t>(span.count);
    }
    findings.require(covered == owners.size(), fmt::format("some rows of {} belong to no row of {}", target, table));
}

template <class Tag>
void check_ids(Findings& findings, const char* table, const IdMap<Tag>& ids, const Column<Id<Tag>>& column) {
    for (std::size_t i = 0; i < column.size() && findings.clean(); ++i)
        findings.require(ids.row(column[i]) == static_cast<Row>(i), table, i, "its id belongs to another row");
    std::size_t used = 0;
    for (const auto& slot : ids.slots()) {
        if (slot.row == no_row) continue;
        findings.require(inside(slot.row, column.size()), fmt::format("an id of {} has no row", table));
        ++used;
    }
    findings.require(used == column.size(), fmt::format("{} ids for {} rows of {}", used, column.size(), table));
    findings.require(ids.free_slots().size() + used == ids.slots().size(),
                     fmt::format("the number of free ids of {} is wrong", table));
    std::vector<bool> seen(ids.slots().size());
    for (const auto slot : ids.free_slots()) {
        const bool right = slot < seen.size() && !seen[slot] && ids.slots()[slot].row == no_row;
        findings.require(right, fmt::format("free id {} of {} is in use", slot, table));
        if (!right) return;
        seen[slot] = true;
    }
}

template <class T> bool between(T value, T first, T last) { return value >= first && value <= last; }

// Name and number of the rows that a column refers to.
template <class To> constexpr const char* noun = nullptr;
template <> constexpr const char* noun<Blocks> = "block";
template <> constexpr const char* noun<Gridpoints> = "gridpoint";
template <> constexpr const char* noun<Faces> = "face";
template <> constexpr const char* noun<Triangles> = "triangle";
template <> constexpr const char* noun<Zones> = "zone";
template <> constexpr const char* noun<Contacts> = "contact";
template <> constexpr const char* noun<SubContacts> = "sub-contact";
template <> constexpr const char* noun<TiedPairs> = "pair";
template <> constexpr const char* noun<Ties> = "tie";
template <> constexpr const char* noun<Cables> = "cable";
template <> constexpr const char* noun<CableNodes> = "node";
template <> constexpr const char* noun<Members> = "member";
template <> constexpr const char* noun<MemberNodes> = "node";
template <> constexpr const char* noun<BeamElements> = "beam";
template <> constexpr const char* noun<LinerElements> = "liner";
template <> constexpr const char* noun<Group> = "group";
template <> constexpr const char* noun<Roller> = "roller";
template <> constexpr const char* noun<JointProperties> = "property set";
template <> constexpr const char* noun<ZoneProperties> = "zone model";
template <> constexpr const char* noun<TimeFunction> = "function";

template <class Visit> void each_table(Model& model, Visit&& visit) {
    model.present_tables(visit);
    model.structure_tables(visit);
}

template <class To> std::size_t size_of(Model& model) {
    if constexpr (std::is_same_v<To, Group>) return model.group_names.size();
    else if constexpr (std::is_same_v<To, Roller>) return model.rollers.size();
    else if constexpr (std::is_same_v<To, JointProperties>) return model.joint_properties.size();
    else if constexpr (std::is_same_v<To, ZoneProperties>) return model.zone_properties.size();
    else if constexpr (std::is_same_v<To, TimeFunction>) return model.time_functions.size();
    else {
        std::size_t size = 0;
        each_table(model, [&](const char*, auto& table) {
            if constexpr (std::is_same_v<std::decay_t<decltype(table)>, To>) size = table.size();
        });
        return size;
    }
}

/// The column in which rows of `Part` name the row of `Whole` that they belong to; null when there is none.
template <class Whole, class Part> const Column<Row>* owners(Model& model) {
    const Column<Row>* found = nullptr;
    each_table(model, [&](const char*, auto& table) {
        if constexpr (std::is_same_v<std::decay_t<decltype(table)>, Part>)
            table.columns([&](std::string_view, auto& column, auto role) {
                if constexpr (std::is_same_v<decltype(role), ColumnRole<Whole>>)
                    if constexpr (std::is_same_v<std::decay_t<decltype(column)>, Column<Row>>) found = &column;
            });
    });
    return found;
}

template <class To> std::type_identity<To> target_of(const ColumnRole<To>&);

/// Checks that the targets of link columns exist. Corners and attachments are checked with their blocks.
void check_links(Findings& findings, Model& model) {
    each_table(model, [&](const char* name, auto& table) {
        using Whole = std::decay_t<decltype(table)>;
        table.columns([&]<class T, class RoleType>(std::string_view, Column<T>& column, RoleType role) {
            if constexpr (!std::is_same_v<RoleType, Role>) {
                using To = typename decltype(target_of(role))::type;
                if constexpr (std::is_same_v<T, Row>) {
                    const std::size_t size = size_of<To>(model);
                    for (std::size_t i = 0; i < column.size() && findings.clean(); ++i)
                        findings.require(role.may_be_none ? inside_or_none(column[i], size) : inside(column[i], size),
                                         name, i, fmt::format("{} {} of {}", noun<To>, column[i], size));
                } else if constexpr (std::is_same_v<T, Span>) {
                    if (const Column<Row>* belongs_to = owners<Whole, To>(model))
                        check_spans(findings, name, noun<To>, column, *belongs_to);
                }
            }
        });
    });
}

void check_rows_of_blocks(Findings& findings, const Model& model) {
    const auto& blocks = model.blocks;
    for (const auto* zones : {&model.zones, &model.excavated.zones})
        findings.require(zones->history_columns >= 0 && zones->history_columns <= KAYA_JMODEL_MAX_HISTORY,
                         "the number of history columns of zones is wrong");
    for (std::size_t i = 0; i < blocks.size() && findings.clean(); ++i) {
        findings.require((blocks.deformable[i] != 0) == (blocks.zones[i].count > 0), "blocks", i,
                         "it is deformable without zones, or has zones and is rigid");
        findings.require(blocks.cell_zones[i] == 0 ||
                             (blocks.cell_zones[i] > 0 && blocks.zones[i].count % blocks.cell_zones[i] == 0),
                         "blocks", i,
                         fmt::format("{} zones in cells of {}", blocks.zones[i].count, blocks.cell_zones[i]));
    }
    for (std::size_t i = 0; i < blocks.size() && findings.clean(); ++i)
        findings.require(blocks.number[i] >= 1 && blocks.number[i] < model.next_block_number, "blocks", i,
                         fmt::format("number {} where {} is the next", blocks.number[i], model.next_block_number));
    for (std::size_t i = 0; i < blocks.size() && findings.clean(); ++i)
        findings.require(blocks.shape[i] >= 1 && blocks.shape[i] < model.next_shape_number, "blocks", i,
                         fmt::format("shape {} where {} is the next", blocks.shape[i], model.next_shape_number));
}

/// The cycle asks for properties before it computes masses; of a model that has its masses they must be there.
void check_materials(Findings& findings, const Model& model) {
    const auto& blocks = model.blocks;
    for (std::size_t i = 0; i < blocks.size() && !model.stale.properties() && findings.clean(); ++i)
        findings.require(blocks.deformable[i] == 0 || model.materials.contains(blocks.material[i]), "blocks", i,
                         fmt::format("there is no material {}", blocks.material[i]));
}

void check_blocks(Findings& findings, const Model& model) {
    check_ids(findings, "blocks", model.blocks.ids, model.blocks.id);
    check_rows_of_blocks(findings, model);
    check_materials(findings, model);
}

/// Corners of triangles and zones belong to the block that the face or zone belongs to.
void check_geometry(Findings& findings, const Model& model) {
    // The triangles of a block are those of its faces, in order.
    Column<Row> owner;
    for (const Row face : model.triangles.face) owner.push_back(model.faces.block[static_cast<std::size_t>(face)]);
    check_spans(findings, "blocks", "triangle", model.blocks.triangles, owner);
    const auto check_corners = [&](const char* table, const auto& corners, const Column<Row>& block) {
        for (std::size_t i = 0; i < corners.size() && findings.clean(); ++i)
            for (const Row corner : corners[i])
                findings.require(inside(corner, model.gridpoints.size()) &&
                                     model.gridpoints.block[static_cast<std::size_t>(corner)] == block[i],
                                 table, i, fmt::format("gridpoint {} is not one of its block", corner));
    };
    check_corners("triangles", model.triangles.gridpoints, owner);
    check_corners("zones", model.zones.gridpoints, model.zones.block);
}

/// Excavated blocks are linked in the same way.
void check_excavated(Findings& findings, const Model& model) {
    if (model.excavated.blocks.empty() && model.excavated.gridpoints.empty()) return;
    Model kept = excavated_model(model);
    check_links(findings, kept);
    if (findings.clean()) check_rows_of_blocks(findings, kept);
    if (findings.clean()) check_geometry(findings, kept);
}

/// Faces of a contact are of its blocks; a plane that follows a face of a deformable block has that face.
void check_faces(Findings& findings, const Model& model, std::size_t i) {
    const auto& contacts = model.contacts;
    const std::int32_t reference = contacts.reference[i];
    findings.require(reference >= 0 && reference <= 2, "contacts", i,
                     fmt::format("its plane is that of side {}", reference));
    for (const int side : {1, 2}) {
        const Row face = side == 1 ? contacts.face1[i] : contacts.face2[i],
                  block = side == 1 ? contacts.block1[i] : contacts.block2[i];
        if (!findings.clean()) return;
        if (face == no_row)
            findings.require(reference != side || model.blocks.deformable[static_cast<std::size_t>(block)] == 0,
                             "contacts", i, "the face of its plane is missing");
        else
            findings.require(model.faces.block[static_cast<std::size_t>(face)] == block, "contacts", i,
                             fmt::format("face {} is not one of its block", face));
    }
}

void check_contacts(Findings& findings, const Model& model) {
    const auto& contacts = model.contacts;
    check_ids(findings, "contacts", contacts.ids, contacts.id);
    for (std::size_t i = 0; i < contacts.size() && findings.clean(); ++i) {
        findings.require(contacts.block1[i] != contacts.block2[i], "contacts", i, "a block is in contact with itself");
        check_faces(findings, model, i);
        findings.require(between(contacts.type[i], ContactType::face_face, ContactType::vertex_vertex), "contacts", i,
                         "its type is unknown");
        findings.require(between(contacts.kind[i], ContactKind::joint, ContactKind::overlap), "contacts", i,
                         "it is neither a joint nor an overlap");
        findings.require(contacts.number[i] >= 1 && contacts.number[i] < model.next_contact_number, "contacts", i,
                         fmt::format("number {} where {} is the next", contacts.number[i], model.next_contact_number));
    }
}

/// A side is attached to corners of its block, whose weights sum to 1, or to nothing; a corner that is left out has no weight.
void check_attachments(Findings& findings, const Model& model, const Column<Attachment>& side,
                       const Column<Row>& blocks) {
    constexpr double rounding = 1e-9;
    const auto& points = model.gridpoints;
    for (std::size_t i = 0; i < side.size() && findings.clean(); ++i) {
        const auto& weights = side[i].weights;
        findings.require(!side[i].attached() || std::abs(weights[0] + weights[1] + weights[2] - 1) < rounding,
                         "sub_contacts", i, "the weights of its corners do not sum to 1");
        const Row block = blocks[static_cast<std::size_t>(model.sub_contacts.contact[i])];
        for (std::size_t k = 0; k < side[i].gridpoints.size() && findings.clean(); ++k) {
            const Row row = side[i].gridpoints[k];
            findings.require(inside_or_none(row, points.size()), "sub_contacts", i,
                             fmt::format("gridpoint {} of {}", row, points.size()));
            if (row == no_row)
                findings.require(!side[i].attached() ? side[i] == Attachment{} : side[i].weights[k] == 0,
                                 "sub_contacts", i, "a corner of its attachment is missing");
            else if (findings.clean())
                findings.require(points.block[static_cast<std::size_t>(row)] == block, "sub_contacts", i,
                                 fmt::format("gridpoint {} is not one of its block", row));
        }
    }
}

void check_sub_contacts(Findings& findings, const Model& model) {
    const auto& sub = model.sub_contacts;
    check_ids(findings, "sub_contacts", sub.ids, sub.id);
    findings.require(sub.history_columns >= 0 && sub.history_columns <= KAYA_JMODEL_MAX_HISTORY,
                     "the number of history columns of sub-contacts is wrong");
    findings.require(sub.field_columns >= 0 && sub.field_columns <= KAYA_JMODEL_MAX_FIELDS,
                     "the number of fields of sub-contacts is wrong");
    check_attachments(findings, model, sub.side1, model.contacts.block1);
    check_attachments(findings, model, sub.side2, model.contacts.block2);
    for (std::size_t i = 0; i < sub.size() && findings.clean(); ++i) {
        findings.require(between(sub.type[i], SubContactType::vertex_face, SubContactType::face_face), "sub_contacts",
                         i, "its type is unknown");
        findings.require(sub.number[i] >= 1 && sub.number[i] < model.next_sub_contact_number, "sub_contacts", i,
                         fmt::format("number {} where {} is the next", sub.number[i], model.next_sub_contact_number));
    }
}

/// Rows of ties are relative to blocks that may have been deleted; only those of valid pairs are checked.
void check_ties(Findings& findings, const Model& model) {
    const auto& pairs = model.tied_pairs;
    const auto& ties = model.ties;
    for (std::size_t p = 0; p < pairs.size() && findings.clean(); ++p) {
        std::array<Row, 2> blocks;
        if (!blocks_of_pair(model, static_cast<Row>(p), blocks)) continue;
        const auto in_block = [&](const Column<Span>& spans, int side, Row row) {
            return inside(row, static_cast<std::size_t>(spans[blocks[side]].count));
        };
        for (Row t = pairs.ties[p].first; t < pairs.ties[p].end(); ++t) {
            bool right =
                in_block(model.blocks.faces, 0, ties.face1[t]) && in_block(model.blocks.faces, 1, ties.face2[t]) &&
                in_block(model.blocks.zones, 0, ties.zone1[t]) && in_block(model.blocks.zones, 1, ties.zone2[t]);
            for (int k = 0; k < 3; ++k)
                right = right && in_block(model.blocks.gridpoints, 0, ties.gridpoints1[t][k]) &&
                        in_block(model.blocks.gridpoints, 1, ties.gridpoints2[t][k]);
            findings.require(right, "ties", t, "its blocks have no such gridpoints, faces or zones");
        }
    }
}

void check_histories(Findings& findings, const Model& model) {
    const auto& histories = model.histories;
    const std::size_t samples = histories.time.size();
    findings.require(histories.cycle.size() == samples, "histories have different numbers of cycles and times");
    findings.require(histories.interval > 0, fmt::format("histories are sampled every {} cycles", histories.interval));
    for (std::size_t k = 0; k < histories.all.size(); ++k) {
        const auto& history = histories.all[k];
        const std::int32_t before = k == 0 ? 0 : histories.all[k - 1].number;
        findings.require(history.number > before, "histories", k, "its number is not above the one before");
        findings.require(history.first_sample <= samples && history.values.size() == samples - history.first_sample,
                         "histories", k, "its number of values is not that of the samples");
        findings.require(history.source.kind != ObjectKind::none && info_of(history.source.kind).history >= 0,
                         "histories", k, "its kind is unknown");
    }
}

void check_boundary_histories(Findings& findings, const Model& model) {
    const auto& histories = model.boundary_histories;
    using Kind = TimeFunction::Kind;
    for (std::size_t i = 0; i < model.time_functions.size(); ++i)
        findings.require(between(model.time_functions[i].kind, Kind::sine, Kind::script), "time_functions", i,
                         "its kind is unknown");
    for (std::size_t i = 0; i < histories.size() && findings.clean(); ++i) {
        const bool whole = histories.gridpoint[i] == no_row;
        const std::int32_t components = !whole ? 3
                                        : histories.what[i] == BoundaryHistories::What::load
                                            ? BoundaryHistories::loads
                                            : BoundaryHistories::motions;
        findings.require(between(histories.what[i], BoundaryHistories::What::velocity, BoundaryHistories::What::load),
                         "drives", i, "its kind is unknown");
        findings.require(between(histories.component[i], 0, components - 1), "drives", i, "it has no such component");
        const Row block = model.blocks.ids.row(histories.block[i]);
        findings.require(whole || block == no_row ||
                             inside(histories.gridpoint[i], model.blocks.gridpoints[block].count),
                         "drives", i, "its block has no such gridpoint");
    }
}

/// Blocks may have been deleted; a point whose block still has its shape must have its zone.
void check_rock_points(Findings& findings, const Model& model, const char* table, const RockPoints& points) {
    for (std::size_t i = 0; i < points.block.size() && findings.clean(); ++i) {
        const Row row = static_cast<Row>(i), block = rock_block(model, points, row);
        if (!is_placed(model, points, row)) continue;
        const auto zones = static_cast<std::size_t>(model.blocks.zones[block].count);
        findings.require(model.blocks.deformable[block] != 0 ? inside(points.zone[i], zones) : points.zone[i] == no_row,
                         table, i, "its block has no such zone");
    }
}

void check_cables(Findings& findings, const Model& model) {
    const auto& cables = model.structures.cables;
    const auto& nodes = model.structures.cable_nodes;
    const std::int32_t next_number = model.structures.next_number;
    for (std::size_t i = 0; i < cables.size() && findings.clean(); ++i) {
        const std::int32_t before = i == 0 ? 0 : cables.number[i - 1];
        findings.require(cables.number[i] > before && cables.number[i] < next_number, "cables", i,
                         fmt::format("number {}", cables.number[i]));
        findings.require(cables.nodes[i].count >= 2, "cables", i, "it has no bar");
    }
    check_rock_points(findings, model, "cable_nodes", nodes);
    for (std::size_t i = 0; i < nodes.size() && findings.clean(); ++i)
        findings.require(!has_bar(nodes, static_cast<Row>(i)) || nodes.bar_length[i] > 0, "cable_nodes", i,
                         "its bar has no length");
}

/// Elements must use distinct nodes of their member.
void check_members(Findings& findings, const Model& model) {
    const auto& structures = model.structures;
    const auto& members = structures.members;
    const auto& nodes = structures.member_nodes;
    for (std::size_t i = 0; i < members.size() && findings.clean(); ++i) {
        const std::int32_t before = i == 0 ? 0 : members.number[i - 1];
        findings.require(members.number[i] > before && members.number[i] < structures.next_number, "members", i,
                         fmt::format("number {}", members.number[i]));
        const bool beam = members.kind[i] == beam_kind, liner = members.kind[i] == liner_kind;
        findings.require(beam || liner, "members", i, "its kind is unknown");
        findings.require((members.beams[i].count > 0) == beam && (members.liners[i].count > 0) == liner, "members", i,
                         "its elements are not of its kind");
    }
    for (std::size_t i = 0; i < nodes.size() && findings.clean(); ++i) {
        findings.require(between(nodes.grip[i], Grip::link, Grip::clamp), "member_nodes", i, "its grip is unknown");
        const double turn = nodes.rotation[i].norm();
        findings.require(turn > 0.5 && turn < 2, "member_nodes", i, "its rotation is not a rotation");
    }
    check_rock_points(findings, model, "member_nodes", nodes);
    const auto check = [&](const char* table, const auto& corners, const Column<Row>& owners) {
        for (std::size_t i = 0; i < corners.size() && findings.clean(); ++i)
            for (std::size_t k = 0; k < corners[i].size() && findings.clean(); ++k) {
                const Row node = corners[i][k], next = corners[i][(k + 1) % corners[i].size()];
                const bool there = inside(node, nodes.size());
                findings.require(there && nodes.member[static_cast<std::size_t>(node)] == owners[i], table, i,
                                 fmt::format("node {} is not one of its member", node));
                findings.require(!there || !inside(next, nodes.size()) ||
                                     nodes.reference[static_cast<std::size_t>(node)] !=
                                         nodes.reference[static_cast<std::size_t>(next)],
                                 table, i, "it has no length");
            }
    };
    check("beams", structures.beams.nodes, structures.beams.member);
    check("liners", structures.liners.nodes, structures.liners.member);
}

void check_rows(Findings& findings, const char* table, std::string_view column, std::size_t has, std::size_t rows) {
    if (has != rows)
        findings.require(false, fmt::format("column {} of {} has {} rows of {}", column, table, has, rows));
}

} // namespace

std::string inconsistency(Model& model) {
    Findings findings;
    // Columns first: all checks below read as many rows as the table declares.
    const auto check_columns = [&](const char* name, auto& table) {
        table.columns([&](std::string_view column_name, auto& column, Role) {
            check_rows(findings, name, column_name, column.size(), table.size());
        });
    };
    model.tables(check_columns);
    model.structure_tables(check_columns);
    findings.require(!model.group_names.empty() && model.group_names.front().empty(), "group 0 has a name");
    findings.require(!model.rollers.empty() && model.rollers.front().count == 0, "roller 0 has directions");
    for (const Roller& roller : model.rollers)
        findings.require(between(roller.count, 0, 3), "a roller holds another number of directions than 0 to 3");
    findings.require(between(model.settings.damping, Damping::none, Damping::rayleigh), "the damping is unknown");
    findings.require(between(model.settings.water, Water::none, Water::ground), "the kind of water is unknown");
    findings.require(model.settings.water != Water::ground || !model.water_ground.empty(),
                     "the water table is not there");
    findings.require(inside_or_none(model.settings.default_properties, model.joint_properties.size()),
                     "the joint properties of new contacts are not there");
    for (const JointRule& rule : model.joint_rules)
        findings.require(between(rule.properties, 0, static_cast<std::int32_t>(model.joint_properties.size()) - 1),
                         "the joint properties of the material table are not there");
    findings.require(between(model.ruled_contacts, 0, model.next_contact_number),
                     "the material table has seen contacts that are not there");
    // Counters continue from here: no run reaches these limits.
    findings.require(between<std::int64_t>(model.clock.cycle, 0, std::int64_t{1} << 53),
                     fmt::format("{} cycles", model.clock.cycle));
    for (const auto next : {model.next_block_number, model.next_shape_number, model.next_contact_number,
                            model.next_sub_contact_number, model.structures.next_number})
        findings.require(between(next, 1, 2'000'000'000), fmt::format("{} is the next number", next));
    if (findings.clean()) check_links(findings, model);
    if (!findings.clean()) return findings.text();

    for (const auto check : {check_blocks, check_geometry, check_excavated, check_contacts, check_sub_contacts,
                             check_ties, check_histories, check_boundary_histories, check_cables, check_members}) {
        check(findings, model);
        if (!findings.clean()) break;
    }
    findings.require(model.clock.time_step != 0 || model.stale.properties(), "there is no time step");
    if (findings.clean()) return unbounded_number(model);
    return findings.text();
}

} // namespace kaya
