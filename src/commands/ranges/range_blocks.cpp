// Range elements for the shape of blocks and bodies, for exposed faces, and for joint states.
#include "commands/ranges/range_tests.hpp"

#include "base/diagnostic.hpp"
#include "lang/interp/lexer.hpp"
#include "geometry/polyhedra/quality.hpp"
#include "laws/joint_model.hpp"
#include "model/edit/build.hpp"
#include "model/measure/covered_faces.hpp"
#include "model/edit/joined.hpp"
#include "model/edit/ties.hpp"
#include "model/measure/measure.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>

namespace kaya {

using lang::RangeElement;

namespace {

/// As wide as two numbers that were meant to be the same are apart.
constexpr double same_number = 1e-6;

bool between(double value, double low, double high) {
    return value >= low * (1 - same_number) && value <= high * (1 + same_number);
}

/// The block's shape without the corners that its zones put on its edges.
Polyhedron outline_of(const Model& model, Row block) {
    Polyhedron shape = shape_of(model, block);
    for (auto& face : shape.faces) {
        std::vector<int> corners;
        const auto& loop = face.vertices;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3& at = shape.vertices[static_cast<std::size_t>(loop[i])];
            const Vec3 in = at - shape.vertices[static_cast<std::size_t>(loop[(i + loop.size() - 1) % loop.size()])];
            const Vec3 out = shape.vertices[static_cast<std::size_t>(loop[(i + 1) % loop.size()])] - at;
            if (in.cross(out).norm() > same_number * in.norm() * out.norm()) corners.push_back(loop[i]);
        }
        face.vertices = std::move(corners);
    }
    return shape;
}

/// A test of one number of each block's shape, computed once for all parts of the block.
template <class Number> RangeTest by_shape(const RangeElement& e, Number number) {
    const auto known = std::make_shared<std::map<Row, bool>>();
    return on_blocks([low = e.low, high = e.high, number, known](const Model& model, Row block) {
        const auto [found, is_new] = known->try_emplace(block, false);
        if (is_new) found->second = between(number(block_quality(outline_of(model, block))), low, high);
        return found->second;
    });
}

/// A body is convex when its faces that have all of it on one side enclose its whole volume.
bool is_convex(const Model& model, std::span<const Row> members) {
    Vec3 centroid = Vec3::Zero();
    double volume = 0, margin = 0;
    for (const Row b : members) {
        centroid += model.blocks.volume[b] * block_centroid(model, b);
        volume += model.blocks.volume[b];
        margin = std::max(margin, 0.01 * model.blocks.margin[b]);
    }
    centroid /= volume;
    Vec3 open = Vec3::Zero();
    double enclosed = 0, area = 0;
    for (const Row b : members)
        for (Row f = model.blocks.faces[b].first; f < model.blocks.faces[b].end(); ++f) {
            const Vec3 vector = face_area_vector(model, f), place = face_centroid(model, f);
            const Vec3 normal = vector.normalized();
            const bool outermost = std::ranges::all_of(members, [&](Row other) {
                return all_corners(model, ObjectKind::block, other,
                                   [&](const Vec3& p) { return normal.dot(p - place) <= margin; });
            });
            if (!outermost) continue;
            open += vector;
            area += vector.norm();
            enclosed += vector.dot(place - centroid) / 3;
        }
    constexpr double rough = 1e-3;
    return open.norm() <= rough * area && std::abs(enclosed - volume) <= rough * volume;
}

/// Whether just in front of the middle of a face there is another block of its body.
bool leads_into(const Model& model, Row face, std::span<const Row> members) {
    const Row own = model.faces.block[face];
    const Vec3 before =
        face_centroid(model, face) + model.blocks.margin[own] * face_area_vector(model, face).normalized();
    return std::ranges::any_of(members, [&](Row other) {
        if (other == own) return false;
        for (Row f = model.blocks.faces[other].first; f < model.blocks.faces[other].end(); ++f)
            if (face_area_vector(model, f).dot(before - face_centroid(model, f)) > 0) return false;
        return true;
    });
}

RangeTest by_edge_length(const RangeElement& e, RangeContext&) {
    return by_shape(e, [](const BlockQuality& quality) { return quality.shortest_edge; });
}

RangeTest by_aspect_ratio(const RangeElement& e, RangeContext&) {
    return by_shape(e, [](const BlockQuality& quality) { return quality.longest_edge / std::cbrt(quality.volume); });
}

RangeTest by_face_area(const RangeElement& e, RangeContext&) {
    return by_shape(e, [](const BlockQuality& quality) { return quality.smallest_face; });
}

RangeTest by_leader(const RangeElement& e, RangeContext& context) {
    const auto& blocks = context.model.blocks;
    auto leader = std::make_shared<std::vector<std::int32_t>>(blocks.number.begin(), blocks.number.end());
    const JoinedBodies bodies = joined_bodies(context.model);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (const Row b : bodies.members(i)) (*leader)[b] = blocks.number[bodies.members(i).front()];
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    return on_blocks([=](const Model&, Row block) { return (*leader)[block] >= low && (*leader)[block] <= high; });
}

RangeTest in_concave_body(const RangeElement&, RangeContext& context) {
    auto concave = std::make_shared<std::vector<char>>(context.model.blocks.size(), 0);
    const JoinedBodies bodies = joined_bodies(context.model);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!is_convex(context.model, bodies.members(i)))
            for (const Row b : bodies.members(i)) (*concave)[b] = 1;
    return on_blocks([concave](const Model&, Row block) { return (*concave)[block] != 0; });
}

/// What another block covers of a face is not on the surface, as for `bound stress`.
RangeTest on_surface(const RangeElement& e, RangeContext& context) {
    if (is_contact(context.kind))
        throw Diagnostic("'surface' picks faces and what is on them, but this command acts on " +
                         std::string(info_of(context.kind).plural))
            .at(e.place);
    const Model& model = context.model;
    const CoveredFaces covered(model, tied_face_pairs(model));
    std::vector<char> inside(model.faces.size(), 0);
    const JoinedBodies bodies = joined_bodies(model);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (const Row b : bodies.members(i))
            for (Row f = model.blocks.faces[b].first; f < model.blocks.faces[b].end(); ++f)
                if (leads_into(model, f, bodies.members(i))) inside[f] = 1;
    auto points = std::make_shared<std::vector<char>>(model.gridpoints.size(), 0);
    auto faces = std::make_shared<std::vector<char>>(model.faces.size(), 0);
    auto blocks = std::make_shared<std::vector<char>>(model.blocks.size(), 0);
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        const Row face = model.triangles.face[t];
        if (inside[face] || covered.share(static_cast<Row>(t)) == 1) continue;
        (*faces)[face] = (*blocks)[model.faces.block[face]] = 1;
        for (const Row g : model.triangles.gridpoints[t]) (*points)[g] = 1;
    }
    return [=](const Model& m, ObjectKind kind, Row row) {
        switch (kind) {
        case ObjectKind::block: return (*blocks)[row] != 0;
        case ObjectKind::gridpoint: return (*points)[row] != 0;
        case ObjectKind::face: return (*faces)[row] != 0;
        case ObjectKind::triangle: return (*faces)[m.triangles.face[row]] != 0;
        case ObjectKind::zone:
            return std::ranges::count_if(m.zones.gridpoints[row], [&](Row g) { return (*points)[g] != 0; }) >= 3;
        default: return false;
        }
    };
}

RangeTest by_joint_state(const RangeElement& e, RangeContext& context) {
    needs_contacts(e, context, "state");
    if (context.extras.joints == nullptr) throw std::logic_error("a range of states without joint models");
    const JointRegistry& joints = *context.extras.joints;
    // The bits of that name in each set of properties; "slip" stands for slip-now and slip-past.
    const Model& model = context.model;
    std::vector<std::uint32_t> bits;
    std::set<std::string, std::less<>> known;
    bool found = false;
    for (const auto& properties : model.joint_properties) {
        std::uint32_t mask = 0;
        if (const JointModel* joint = joints.find(properties.model))
            for (std::size_t i = 0; i < joint->states.size(); ++i) {
                const std::string& state = joint->states[i];
                known.insert(state);
                if (lang::fold(state) == lang::fold(e.name) || lang::fold(state).starts_with(lang::fold(e.name) + "-"))
                    mask |= 1u << i;
            }
        found = found || mask != 0;
        bits.push_back(mask);
    }
    if (!found)
        throw Diagnostic(fmt::format("no joint model of the contacts has a state '{}'", e.name),
                         known.empty() ? "no joint model is in use"
                                       : fmt::format("states are: {}", fmt::join(known, ", ")))
            .at(e.place);
    return [bits](const Model& m, ObjectKind kind, Row row) {
        const Row contact = contact_of(m, kind, row);
        const Row set = m.contacts.properties[contact];
        if (set == no_row) return false;
        const auto passes = [&](Row s) { return (m.sub_contacts.state[s] & bits[set]) != 0; };
        if (kind == ObjectKind::sub_contact) return passes(row);
        const Span span = m.contacts.sub_contacts[contact];
        for (Row s = span.first; s < span.end(); ++s)
            if (passes(s)) return true;
        return false;
    };
}

using Kind = RangeElement::Kind;
constexpr std::array block_tests{
    RangeEntry{Kind::edge_length, by_edge_length}, RangeEntry{Kind::aspect_ratio, by_aspect_ratio},
    RangeEntry{Kind::face_area, by_face_area},     RangeEntry{Kind::leader, by_leader},
    RangeEntry{Kind::concave, in_concave_body},    RangeEntry{Kind::surface, on_surface},
    RangeEntry{Kind::joint_state, by_joint_state},
};

} // namespace

std::span<const RangeEntry> tests_of_blocks() { return block_tests; }

} // namespace kaya
