// add_joints and add_arrows.
#include "model/measure.hpp"
#include "pictures/colouring.hpp"
#include "pictures/half_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace kaya {

namespace {

using Triangle = std::array<Vec3, 3>;

std::vector<Triangle> triangles_of(const Model& model, Row face) {
    std::vector<Triangle> all;
    const Span span = model.faces.triangles[face];
    for (Row t = span.first; t < span.end(); ++t) {
        const auto& ids = model.triangles.gridpoints[t];
        all.push_back({model.gridpoints.position[ids[0]], model.gridpoints.position[ids[1]], model.gridpoints.position[ids[2]]});
    }
    return all;
}

bool apart(const Triangle& a, const Triangle& b, double margin) {
    for (int k = 0; k < 3; ++k) {
        const auto [low_a, high_a] = std::minmax({a[0][k], a[1][k], a[2][k]});
        const auto [low_b, high_b] = std::minmax({b[0][k], b[1][k], b[2][k]});
        if (low_a > high_b + margin || low_b > high_a + margin) return true;
    }
    return false;
}

/// The part of a triangle that lies above or below another one, along the normal of the joint.
Polygon common_part(const Triangle& a, const Triangle& b, const Vec3& normal) {
    Polygon polygon;
    for (const Vec3& corner : a) polygon.push_back({corner, 0});
    const Vec3 middle = (b[0] + b[1] + b[2]) / 3;
    for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
        Vec3 outward = (b[(k + 1) % 3] - b[k]).cross(normal);
        if (outward.dot(b[k] - middle) < 0) outward = -outward;
        polygon = kept_part(polygon, {b[k], outward});
    }
    return polygon;
}

/// The sub-contact of a contact that is nearest to a place.
Row nearest_sub_contact(const Model& model, Row contact, const Vec3& place) {
    const Span span = model.contacts.sub_contacts[contact];
    Row best = span.first;
    double least = std::numeric_limits<double>::infinity();
    for (Row row = span.first; row < span.end(); ++row) {
        const Vec3 position = model.sub_contacts.position[row];
        const double distance = (position - place).squaredNorm();
        if (distance < least) least = distance, best = row;
    }
    return best;
}

void add_joint(Layer& layer, const Model& model, const Shown& shown, Row contact, Colouring& colouring) {
    const auto& contacts = model.contacts;
    if (contacts.face1[contact] == no_row || contacts.face2[contact] == no_row || contacts.sub_contacts[contact].count == 0) return;
    const double margin = model.blocks.margin[contacts.block1[contact]] + model.blocks.margin[contacts.block2[contact]];
    const auto second = triangles_of(model, contacts.face2[contact]);
    for (const Triangle& a : triangles_of(model, contacts.face1[contact]))
        for (const Triangle& b : second) {
            if (apart(a, b, margin)) continue;
            Polygon part = common_part(a, b, contacts.normal[contact]);
            if (shown.cut) part = kept_part(part, *shown.cut);
            if (part.empty()) continue;
            Vec3 middle = Vec3::Zero();
            for (const Corner& corner : part) middle += corner.place / static_cast<double>(part.size());
            const float value = colouring.value(model, nearest_sub_contact(model, contact, middle));
            // There is nothing between two names.
            for (Corner& corner : part)
                corner.value = colouring.gives_names() ? value : colouring.value(model, nearest_sub_contact(model, contact, corner.place));
            add_polygon(layer, part);
        }
}

} // namespace

void add_joints(Scene& scene, const Model& model, const Shown& shown, const ColourField& field) {
    Colouring colouring(field);
    Layer layer;
    for (Row contact = 0; contact < static_cast<Row>(model.contacts.size()); ++contact) {
        const bool both = std::ranges::binary_search(shown.blocks, model.contacts.block1[contact]) &&
                          std::ranges::binary_search(shown.blocks, model.contacts.block2[contact]);
        if (both) add_joint(layer, model, shown, contact, colouring);
    }
    layer.bar = static_cast<std::int32_t>(scene.bars.size());
    scene.bars.push_back(colouring.bar());
    scene.layers.push_back(std::move(layer));
}

void add_arrows(Scene& scene, const Model& model, const Shown& shown, bool velocity, double scale) {
    Layer layer;
    layer.kind = Layer::Kind::arrows;
    double longest = 0;
    const auto add = [&](const Vec3& place, const Vec3& vector) {
        if (shown.cut && (place - shown.cut->origin).dot(shown.cut->normal) > 0) return;
        if (!vector.allFinite() || vector.norm() == 0) return;
        for (int k = 0; k < 3; ++k) layer.points.push_back(static_cast<float>(place[k]));
        for (int k = 0; k < 3; ++k) layer.vectors.push_back(static_cast<float>(vector[k]));
        layer.values.push_back(static_cast<float>(vector.norm()));
        longest = std::max(longest, vector.norm());
    };
    const auto& g = model.gridpoints;
    for (const Row block : shown.blocks) {
        if (!model.blocks.deformable[block]) {
            add(model.blocks.centroid[block], velocity ? block_velocity(model, block) : block_displacement(model, block));
            continue;
        }
        const Span points = model.blocks.gridpoints[block];
        for (Row row = points.first; row < points.end(); ++row) add(g.position[row], velocity ? g.velocity[row] : g.displacement[row]);
    }
    if (longest == 0) return;
    if (scale == 0) scale = model_size(model) / 12 / longest;
    for (float& part : layer.vectors) part = static_cast<float>(part * scale);
    ColourBar bar;
    bar.title = velocity ? "velocity [length/time]" : "displacement [length]";
    bar.high = longest;
    layer.bar = static_cast<std::int32_t>(scene.bars.size());
    scene.bars.push_back(bar);
    scene.layers.push_back(std::move(layer));
}

} // namespace kaya
