// Range elements for what fractures have cut. A joint set number leads from a face or a contact to its fracture.
#include "commands/ranges/range_tests.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>
#include <set>

namespace kaya {

using lang::RangeElement;

namespace {

using JointSets = std::set<std::int32_t>;

bool has_face_of(const Model& model, Row block, const JointSets& sets) {
    for (Row f = model.blocks.faces[block].first; f < model.blocks.faces[block].end(); ++f)
        if (sets.contains(model.faces.joint_set[f])) return true;
    return false;
}

/// Objects on faces of these joint sets, or with `on` false on all other faces.
RangeTest on_faces_of(JointSets numbers, bool on = true) {
    const auto sets = std::make_shared<const JointSets>(std::move(numbers));
    return [sets, on](const Model& m, ObjectKind kind, Row row) {
        switch (kind) {
        case ObjectKind::contact:
        case ObjectKind::sub_contact: return sets->contains(m.contacts.joint_set[contact_of(m, kind, row)]) == on;
        case ObjectKind::face: return sets->contains(m.faces.joint_set[row]) == on;
        case ObjectKind::triangle: return sets->contains(m.faces.joint_set[m.triangles.face[row]]) == on;
        default: break;
        }
        const Row block = block_of(m, kind, row);
        return block != no_row && has_face_of(m, block, *sets) == on;
    };
}

const std::map<std::string, Network>& networks_of(const RangeContext& context) {
    if (!context.extras.networks) throw std::logic_error("a range of fractures without networks");
    return context.extras.networks();
}

RangeTest by_fracture(const RangeElement& e, RangeContext& context) {
    const auto id = static_cast<std::int64_t>(e.low);
    JointSets all, own;
    bool found = id == 0;
    for (const auto& [name, fractures] : networks_of(context))
        for (const Fracture& fracture : fractures) {
            found = found || fracture.id == id;
            if (fracture.joint_set == 0) continue;
            all.insert(fracture.joint_set);
            if (fracture.id == id) own.insert(fracture.joint_set);
        }
    if (!found)
        throw Diagnostic(fmt::format("there is no fracture {}", id), "fracture list shows their numbers").at(e.place);
    return id == 0 ? on_faces_of(std::move(all), false) : on_faces_of(std::move(own));
}

RangeTest by_network(const RangeElement& e, RangeContext& context) {
    const auto& networks = networks_of(context);
    const auto found = networks.find(lower_case(e.name));
    if (found == networks.end())
        throw Diagnostic(fmt::format("there is no network of fractures named '{}'", e.name),
                         "make it before: fracture create dfn 'name' ...")
            .at(e.place);
    if (e.side == 1)
        return on_place(context, [fractures = found->second, most = e.distance + context.tolerance](const Vec3& place) {
            return std::ranges::any_of(fractures, [&](const Fracture& f) { return distance_to(f, place) <= most; });
        });
    JointSets own;
    for (const Fracture& fracture : found->second)
        if (fracture.joint_set != 0) own.insert(fracture.joint_set);
    return on_faces_of(std::move(own));
}

constexpr std::array fracture_tests{
    RangeEntry{RangeElement::Kind::fracture, by_fracture},
    RangeEntry{RangeElement::Kind::network, by_network},
};

} // namespace

std::span<const RangeEntry> tests_of_fractures() { return fracture_tests; }

} // namespace kaya
