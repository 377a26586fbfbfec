// Quantities of cable nodes, each with the bar to the next one.
#include "model/structures/cables.hpp"
#include "model/fields/field_rows.hpp"

namespace kaya::field_rows {

namespace {

constexpr auto table = ObjectKind::cable_node;

const CableNodes& nodes_of(const Model& model) { return model.structures.cable_nodes; }

std::int64_t cable_number(const Model& model, Row node) {
    return model.structures.cables.number[nodes_of(model).cable[node]];
}
std::int64_t property(const Model& model, Row node) {
    return model.structures.cables.property[nodes_of(model).cable[node]];
}
Vec3 position(const Model& model, Row node) { return nodes_of(model).position[node]; }
Vec3 force(const Model& model, Row node) { return nodes_of(model).force[node]; }
double slip(const Model& model, Row node) { return nodes_of(model).slip[node]; }
double grout(const Model& model, Row node) {
    const double share = nodes_of(model).share[node];
    return share > 0 ? nodes_of(model).grout[node] / share : 0;
}
double bar_force(const Model& model, Row node) { return nodes_of(model).bar_force[node]; }
double stress(const Model& model, Row node) {
    const auto& properties = model.structures.properties;
    const auto found = properties.find(static_cast<std::int32_t>(property(model, node)));
    return found != properties.end() && found->second.area > 0 ? bar_force(model, node) / found->second.area : 0;
}
double plastic_strain(const Model& model, Row node) {
    const double length = nodes_of(model).bar_length[node];
    return length > 0 ? nodes_of(model).bar_yield[node] / length : 0;
}
std::int64_t bar_state(const Model& model, Row node) { return nodes_of(model).bar_state[node]; }
std::int64_t grout_state(const Model& model, Row node) { return nodes_of(model).grout_state[node]; }
std::int64_t anchored(const Model& model, Row node) { return nodes_of(model).anchored[node]; }

FieldValue block(const Model& model, Row node) { return Link{ObjectKind::block, block_of_node(model, node)}; }

} // namespace

const Fields& cable_fields() {
    static const Fields rows{
        {table, "id", "", "", "-", "number, from 1; changes when cables are deleted", call<count_from_one>, nullptr},
        {table, "cable", "", "", "-", "number of its cable", call<cable_number>, nullptr},
        {table, "property", "", "", "-", "number of its properties", call<property>, nullptr},
        {table, "block", "", "", "-", "block in which it lies", block, nullptr},
        {table, "position", "", "", "length", "place in the rock", call<position>, nullptr},
        {table, "x", "", "", "length", "x of it", call<position, 0>, nullptr},
        {table, "y", "", "", "length", "y of it", call<position, 1>, nullptr},
        {table, "z", "", "", "length", "z of it", call<position, 2>, nullptr},
        {table, "cable_force", "", "", "force", "tension of the cable: the mean of the bars on both sides",
         call<kaya::cable_force>, nullptr},
        {table, "slip", "", "", "length", "of the cable past the rock, towards its last end", call<slip>, nullptr},
        {table, "grout_force", "", "", "force/length", "of the rock on the cable, along it, per length", call<grout>,
         nullptr},
        {table, "grout_state", "", "", "-", "1: slips; 2: has slipped", call<grout_state>, nullptr},
        {table, "anchored", "", "", "-", "1 where the cable cannot slip", call<anchored>, nullptr},
        {table, "force", "", "", "force", "on the rock", call<force>, nullptr},
        {table, "x_force", "", "", "force", "x of it", call<force, 0>, nullptr},
        {table, "y_force", "", "", "force", "y of it", call<force, 1>, nullptr},
        {table, "z_force", "", "", "force", "z of it", call<force, 2>, nullptr},
        {table, "bar_force", "", "", "force", "tension of the bar to the next node; 0 at the last one", call<bar_force>,
         nullptr},
        {table, "bar_stress", "", "", "stress", "the same over the area of the cable", call<stress>, nullptr},
        {table, "plastic_strain", "", "", "-", "of that bar", call<plastic_strain>, nullptr},
        {table, "bar_state", "", "", "-", "1: yields; 2: has yielded; 4: is broken", call<bar_state>, nullptr},
    };
    return rows;
}

} // namespace kaya::field_rows
