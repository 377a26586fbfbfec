// add_joints and add_arrows.
#include "model/joint_polygons.hpp"
#include "model/measure.hpp"
#include "pictures/colouring.hpp"
#include "pictures/half_space.hpp"

#include <algorithm>

namespace kaya {

namespace {

void add_joint(Layer& layer, const Model& model, const Shown& shown, Row contact, Colouring& colouring) {
    if (model.contacts.sub_contacts[contact].count == 0) return;
    for (const auto& corners : joint_polygons(model, contact)) {
        Polygon part;
        for (const Vec3& place : corners) part.push_back({place, 0});
        if (shown.cut) part = kept_part(part, *shown.cut);
        if (part.empty()) continue;
        Vec3 middle = Vec3::Zero();
        for (const Corner& corner : part) middle += corner.place / static_cast<double>(part.size());
        const float value = colouring.value(model, nearest_sub_contact(model, contact, middle));
        // Values between two names have no meaning.
        for (Corner& corner : part)
            corner.value = colouring.gives_names()
                               ? value
                               : colouring.value(model, nearest_sub_contact(model, contact, corner.place));
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
            add(model.blocks.centroid[block],
                velocity ? block_velocity(model, block) : block_displacement(model, block));
            continue;
        }
        const Span points = model.blocks.gridpoints[block];
        for (Row row = points.first; row < points.end(); ++row)
            add(g.position[row], velocity ? g.velocity[row] : g.displacement[row]);
    }
    if (longest == 0) return;
    if (scale == 0) scale = model_size(model) / 12 / longest;
    for (float& part : layer.vectors) part = static_cast<float>(part * scale);
    layer.bar = static_cast<std::int32_t>(scene.bars.size());
    scene.bars.push_back(colour_bar(velocity ? "velocity [length/time]" : "displacement [length]", 0, longest));
    scene.layers.push_back(std::move(layer));
}

} // namespace kaya
