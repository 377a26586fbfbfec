// add_joints and add_arrows.
#include "geometry/polyhedra/plane.hpp"
#include "model/measure/joint_polygons.hpp"
#include "model/measure/measure.hpp"
#include "pictures/colouring.hpp"
#include "pictures/half_space.hpp"

#include <algorithm>
#include <cmath>

namespace kaya {

namespace {

/// The outline of a face that is seen edge-on, where the face itself is a line without width.
void add_edge_on(Layer& outlines, const Polygon& face, const Vec3& eye) {
    constexpr double nearly = 0.1; // sine of 6 degrees
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 2; i < face.size(); ++i)
        area += (face[i - 1].place - face[0].place).cross(face[i].place - face[0].place);
    if (std::abs(area.dot(eye)) > nearly * area.norm()) return;
    for (std::size_t i = 0; i < face.size(); ++i) add_line(outlines, face[i], face[(i + 1) % face.size()]);
}

/// The layers of joints: their faces, and those seen edge-on as thick lines.
struct JointLayers {
    Layer faces, outlines;
    Vec3 eye; ///< from the picture to it
};

void add_joint(JointLayers& layers, const Model& model, const Shown& shown, Row contact, Colouring& colouring) {
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
        add_polygon(layers.faces, part);
        add_edge_on(layers.outlines, part, layers.eye);
    }
}

} // namespace

void add_joints(Scene& scene, const Model& model, const Shown& shown, const ColourField& field) {
    Colouring colouring(field);
    JointLayers layers{{}, {}, normal_from_dip(scene.dip, scene.dip_direction)};
    layers.outlines.kind = Layer::Kind::lines;
    layers.outlines.width = 4;
    for (Row contact = 0; contact < static_cast<Row>(model.contacts.size()); ++contact) {
        const bool both = std::ranges::binary_search(shown.blocks, model.contacts.block1[contact]) &&
                          std::ranges::binary_search(shown.blocks, model.contacts.block2[contact]);
        if (both) add_joint(layers, model, shown, contact, colouring);
    }
    layers.faces.bar = layers.outlines.bar = static_cast<std::int32_t>(scene.bars.size());
    scene.bars.push_back(colouring.bar());
    scene.layers.push_back(std::move(layers.faces));
    if (!layers.outlines.points.empty()) scene.layers.push_back(std::move(layers.outlines));
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
