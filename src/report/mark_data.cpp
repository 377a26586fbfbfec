#include "report/mark_data.hpp"

#include "model/measure/measure.hpp"
#include "report/packed.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace kaya {

namespace {

/// Of a larger model every second, third ... mark is shown: more would cover each other.
constexpr std::size_t most_marks = 15000;

/// Marks at places: one vector each, or three at right angles with their signed lengths.
struct Marks {
    const char *name, *unit;
    int axes = 1;
    std::vector<Vec3> places, vectors;
    std::vector<float> values; ///< of three vectors: compression is negative
};

std::string packed_numbers(const std::vector<Vec3>& all, std::size_t each, std::size_t step, const Vec3& origin) {
    std::vector<float> numbers;
    for (std::size_t i = 0; i < all.size(); i += each * step)
        for (std::size_t k = 0; k < each; ++k)
            for (int axis = 0; axis < 3; ++axis)
                numbers.push_back(rounded(static_cast<float>(all[i + k][axis] - origin[axis])));
    return packed(std::span<const float>(numbers));
}

std::string json_of(const Marks& marks, const Vec3& centre) {
    const auto axes = static_cast<std::size_t>(marks.axes);
    const std::size_t step = (marks.places.size() + most_marks - 1) / most_marks;
    std::vector<float> values;
    for (std::size_t i = 0; i < marks.values.size(); i += axes * step)
        for (std::size_t k = 0; k < axes; ++k) values.push_back(rounded(marks.values[i + k]));
    return fmt::format(R"({{"name":"{}","unit":"{}","axes":{},"places":"{}","vectors":"{}","values":"{}"}})",
                       marks.name, marks.unit, marks.axes, packed_numbers(marks.places, 1, step, centre),
                       packed_numbers(marks.vectors, axes, step, Vec3::Zero()), packed(std::span<const float>(values)));
}

bool is_shown(const Model& model, Row block) { return !model.blocks.hidden[block]; }

/// At the centroids of rigid blocks and of zones.
Marks motion(const Model& model, const char* name, const char* unit, Vec3 (*of_block)(const Model&, Row),
             Vec3 (*of_gridpoint)(const Model&, Row)) {
    Marks marks{name, unit, 1, {}, {}, {}};
    const auto add = [&](const Vec3& place, const Vec3& vector) {
        marks.places.push_back(place), marks.vectors.push_back(vector);
    };
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) {
        if (!is_shown(model, block)) continue;
        const Span zones = model.blocks.zones[block];
        if (zones.count == 0) add(block_centroid(model, block), of_block(model, block));
        for (Row zone = zones.first; zone < zones.end(); ++zone) {
            Vec3 sum = Vec3::Zero();
            for (const Row gridpoint : model.zones.gridpoints[zone]) sum += of_gridpoint(model, gridpoint);
            add(zone_centroid(model, zone), sum / 4);
        }
    }
    return marks;
}

/// On the second block of each contact, at the centre of its pressure.
Marks contact_forces(const Model& model) {
    Marks marks{"contact force", "force", 1, {}, {}, {}};
    const auto& contacts = model.contacts;
    const auto& points = model.sub_contacts;
    for (Row contact = 0; contact < static_cast<Row>(contacts.size()); ++contact) {
        if (!is_shown(model, contacts.block1[contact]) || !is_shown(model, contacts.block2[contact])) continue;
        Vec3 force = Vec3::Zero(), place = Vec3::Zero();
        double weight = 0;
        const Span span = contacts.sub_contacts[contact];
        for (Row row = span.first; row < span.end(); ++row) {
            const Vec3 at_point = points.normal_force[row] * contacts.normal[contact] + points.shear_force[row];
            force += at_point;
            place += at_point.norm() * points.position[row];
            weight += at_point.norm();
        }
        if (!(weight > 0)) continue;
        marks.places.push_back(place / weight);
        marks.vectors.push_back(force);
    }
    return marks;
}

Marks principal_stress(const Model& model) {
    Marks marks{"principal stress", "stress", 3, {}, {}, {}};
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block) {
        const Span zones = model.blocks.zones[block];
        for (Row zone = zones.first; is_shown(model, block) && zone < zones.end(); ++zone) {
            const auto [stresses, directions] = principal_axes(model, zone);
            marks.places.push_back(zone_centroid(model, zone));
            for (int k = 0; k < 3; ++k) {
                marks.vectors.emplace_back(stresses[k] * directions.col(k));
                marks.values.push_back(static_cast<float>(stresses[k]));
            }
        }
    }
    return marks;
}

Vec3 gridpoint_displacement(const Model& model, Row gridpoint) { return model.gridpoints.displacement[gridpoint]; }

} // namespace

std::string marks_json(const Model& model, const Vec3& centre) {
    std::vector<std::string> all;
    const auto add = [&](const Marks& marks) {
        const auto moves = [](const Vec3& vector) { return vector.norm() > 0; };
        if (std::ranges::any_of(marks.vectors, moves)) all.push_back(json_of(marks, centre));
    };
    add(motion(model, "displacement", "length", block_displacement, gridpoint_displacement));
    add(motion(model, "velocity", "velocity", block_velocity, gridpoint_velocity));
    add(contact_forces(model));
    add(principal_stress(model));
    return fmt::format("[{}]", fmt::join(all, ","));
}

} // namespace kaya
