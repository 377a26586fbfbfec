#include "model/structures/structures.hpp"

#include "base/diagnostic.hpp"
#include "model/tables/model.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string>

namespace kaya {

namespace {

const char* noun_of(StructureKind kind) { return kind == cable_kind ? "cable" : kind == beam_kind ? "beam" : "liner"; }

const char* example_of(StructureKind kind) {
    if (kind == cable_kind) return "area 5e-4 young 2e11 yield 2.5e5 kbond 1e7 sbond 2e5";
    if (kind == beam_kind) return "area 6e-3 young 2e11 poisson 0.3 density 7800 moi-y 2e-5 moi-z 7e-6";
    return "thickness 0.1 young 1.5e10 poisson 0.2 density 2400";
}

/// One structure and the properties that it has by number.
class Check {
public:
    Check(const Structures& structures, StructureKind kind, std::int32_t number, std::int32_t property)
        : kind_(kind), number_(number), property_(property) {
        const auto found = structures.properties.find(property);
        if (found != structures.properties.end()) properties_ = &found->second;
    }

    void run() const {
        const StructureProperties fresh;
        const StructureProperties& p = properties_ == nullptr ? fresh : *properties_;
        if (kind_ != liner_kind) need(p.area, "area");
        else need(p.thickness, "thickness");
        need(p.young, "Young's modulus");
        if (kind_ != cable_kind) need(p.density, "density");
        if (kind_ == beam_kind) {
            need(p.moment_of_area_y, "moi-y");
            need(p.moment_of_area_z, "moi-z");
        }
        for (const auto& property : structure_properties())
            if (!(property.users & kind_) && is_given(p, property)) refuse_foreign(property);
        if (p.has_springs() && !(p.link_normal < p.unlimited && p.link_shear < p.unlimited))
            throw Diagnostic(fmt::format("{}, which give {} and no {}", beginning(),
                                         p.link_normal < p.unlimited ? "kn" : "ks",
                                         p.link_normal < p.unlimited ? "ks" : "kn"),
                             "give both; without them the nodes go along with the rock");
    }

private:
    std::string beginning() const {
        return fmt::format("{} {} has the properties {}", noun_of(kind_), number_, property_);
    }
    void need(double value, const char* what) const {
        if (value > 0) return;
        throw Diagnostic(fmt::format("{}, which have no {}", beginning(), what),
                         fmt::format("write for example: structure property {} {}", property_, example_of(kind_)));
    }
    [[noreturn]] void refuse_foreign(const StructureProperty& property) const {
        std::string users;
        for (const auto kind : {cable_kind, beam_kind, liner_kind})
            if (property.users & kind) users += fmt::format("{}{}s", users.empty() ? "" : " and ", noun_of(kind));
        throw Diagnostic(fmt::format("{}, which give {}: that is for {}", beginning(), property.name, users),
                         fmt::format("give {}s separate properties, under another number", noun_of(kind_)));
    }

    StructureKind kind_;
    std::int32_t number_, property_;
    const StructureProperties* properties_ = nullptr;
};

/// Friction of grout needs stress around the cable, and rigid blocks have none.
void check_grout(const Model& model, Row cable) {
    const auto& cables = model.structures.cables;
    const auto& nodes = model.structures.cable_nodes;
    const StructureProperties& p = model.structures.properties.at(cables.property[cable]);
    if (p.grout_stiffness == 0 || p.grout_friction == 0 || p.grout_perimeter == 0) return;
    const Span span = cables.nodes[cable];
    for (Row node = span.first; node < span.end(); ++node) {
        const Row block = block_of_node(model, node);
        if (nodes.anchored[node] || block == no_row || nodes.zone[node] != no_row) continue;
        throw Diagnostic(
            fmt::format("the grout of cable {} has friction (fbond), and node {} lies in rigid block {}, where no "
                        "stress presses on it",
                        cables.number[cable], node - span.first + 1, model.blocks.number[block]),
            fmt::format("give the block zones, or the cable other properties: without fbond in structure property {}, "
                        "with sbond",
                        cables.property[cable]));
    }
}

/// Checks the link of a node to the rock.
void check_link(const Model& model, Row node) {
    const auto& nodes = model.structures.member_nodes;
    const Row member = nodes.member[node], block = rock_block(model, nodes, node);
    const auto text = [&](const char* what) {
        const auto& members = model.structures.members;
        return fmt::format("node {} of {} {} {} block {}", node - members.nodes[member].first + 1,
                           noun_of(static_cast<StructureKind>(members.kind[member])), members.number[member], what,
                           model.blocks.number[block]);
    };
    if (block != no_row && nodes.grip[node] == Grip::clamp && model.blocks.deformable[block])
        throw Diagnostic(text("is clamped, and lies in zones of"),
                         "zones do not turn: anchor it, or leave that block without zones");
    if (hold_of(model, node) == Hold::springs && nodes.normal[node].isZero(0))
        throw Diagnostic(text("lies on no face of"),
                         "springs kn and ks need a face: put the beam on one, give a tolerance, or anchor its nodes");
}

} // namespace

void place_structures(Model& model) {
    auto& nodes = model.structures.cable_nodes;
    const auto any_to_place = [&model](const auto& points) {
        for (Row row = 0; row < static_cast<Row>(points.size()); ++row)
            if (!is_placed(model, points, row)) return true;
        return false;
    };
    if (!any_to_place(nodes) && !any_to_place(model.structures.member_nodes)) return;
    const BlockFinder finder(model);
    for (Row cable = 0; cable < static_cast<Row>(model.structures.cables.size()); ++cable) {
        bool moved = false;
        const Span span = model.structures.cables.nodes[cable];
        for (Row node = span.first; node < span.end(); ++node) {
            if (is_placed(model, nodes, node)) continue;
            place_in_rock(model, finder, nodes, node, nodes.position[node]);
            moved = moved || is_placed(model, nodes, node); // not in the air
        }
        if (moved) share_bars(model, cable);
    }
    place_member_nodes(model, finder);
}

void take_structure_properties(Model& model) {
    const auto& [cables, cable_nodes, members, member_nodes, beams, liners, properties, next_number] = model.structures;
    for (std::size_t cable = 0; cable < cables.size(); ++cable) {
        Check(model.structures, cable_kind, cables.number[cable], cables.property[cable]).run();
        check_grout(model, static_cast<Row>(cable));
    }
    for (std::size_t member = 0; member < members.size(); ++member)
        Check(model.structures, static_cast<StructureKind>(members.kind[member]), members.number[member],
              members.property[member])
            .run();
    for (Row node = 0; node < static_cast<Row>(member_nodes.size()); ++node) check_link(model, node);
    tighten_cables(model);
}

} // namespace kaya
