#include "report/scene_data.hpp"

#include "io/history_csv.hpp"
#include "model/fields/field.hpp"
#include "model/measure/joint_polygons.hpp"
#include "report/block_corners.hpp"
#include "report/field_data.hpp"
#include "base/json_text.hpp"
#include "report/packed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace kaya {

namespace {

/// Corners on the surface, and the lines and triangles between them. Indices count within a block: they are small.
struct Surface {
    CornerPlaces places;
    std::vector<Row> gridpoints;                          ///< of each corner
    std::vector<std::uint32_t> corners, triangles, lines; ///< numbers of them, by block
    std::vector<std::uint32_t> triangle_corners, line_corners;
    std::vector<std::uint32_t> numbers; ///< of blocks
};

/// Edges of a face: edges that belong to one of its triangles only.
void add_lines(const Model& model, Row block, const std::map<Row, std::uint32_t>& corner_of, Surface& surface) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> all;
    const Span faces = model.blocks.faces[block];
    for (Row face = faces.first; face < faces.end(); ++face) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
        const Span triangles = model.faces.triangles[face];
        for (Row t = triangles.first; t < triangles.end(); ++t)
            for (int k = 0; k < 3; ++k) {
                const auto& g = model.triangles.gridpoints[t];
                ++count[std::minmax(corner_of.at(g[k]), corner_of.at(g[(k + 1) % 3]))];
            }
        for (const auto& [line, times] : count)
            if (times == 1) all.insert(line);
    }
    for (const auto& [from, to] : all) surface.line_corners.insert(surface.line_corners.end(), {from, to});
    surface.lines.push_back(static_cast<std::uint32_t>(all.size()));
}

void add_block(const Model& model, Row block, const Vec3& centre, Surface& surface) {
    const BlockCorners corners(model, block);
    surface.places.add(model, corners.rows, centre);
    surface.gridpoints.insert(surface.gridpoints.end(), corners.rows.begin(), corners.rows.end());
    const Span triangles = model.blocks.triangles[block];
    for (Row t = triangles.first; t < triangles.end(); ++t)
        for (const Row g : model.triangles.gridpoints[t]) surface.triangle_corners.push_back(corners.number.at(g));
    surface.corners.push_back(static_cast<std::uint32_t>(corners.rows.size()));
    surface.triangles.push_back(static_cast<std::uint32_t>(triangles.count));
    surface.numbers.push_back(static_cast<std::uint32_t>(model.blocks.number[block]));
    add_lines(model, block, corners.number, surface);
}

struct Box {
    Vec3 low, high;
};

Box box_of(const Model& model) {
    if (model.gridpoints.position.empty()) return {Vec3::Zero(), Vec3::Zero()};
    Box box{Vec3::Constant(std::numeric_limits<double>::infinity()),
            Vec3::Constant(-std::numeric_limits<double>::infinity())};
    for (const Vec3& place : model.gridpoints.position)
        box.low = box.low.cwiseMin(place), box.high = box.high.cwiseMax(place);
    return box;
}

} // namespace

Vec3 report_centre(const Model& model) {
    const Box box = box_of(model);
    return 0.5 * (box.low + box.high);
}

ReportState report_state(const Model& model, const Vec3& centre) {
    return {model.clock.time, model.clock.cycle, scene_json(model, centre)};
}

namespace {

std::string surface_json(const Surface& surface, const Vec3& centre, double size,
                         const std::vector<std::string>& fields) {
    return fmt::format(R"({{"centre":[{},{},{}],"size":{},{},{},{},{},{},{},{},"fields":[{}]}})", centre.x(),
                       centre.y(), centre.z(), size, column_json("numbers", surface.numbers),
                       column_json("corners", surface.corners), column_json("triangles", surface.triangles),
                       column_json("lines", surface.lines), surface.places.json(),
                       column_json("triangleCorners", surface.triangle_corners),
                       column_json("lineCorners", surface.line_corners), fmt::join(fields, ","));
}

void add_joint(const Model& model, Row contact, const Vec3& centre, Surface& surface) {
    std::uint32_t corners = 0, triangles = 0, lines = 0;
    for (const auto& polygon : joint_polygons(model, contact)) {
        const auto count = static_cast<std::uint32_t>(polygon.size());
        for (std::uint32_t k = 0; k < count; ++k) {
            const Vec3 place = polygon[k] - centre;
            surface.places.add(place, Vec3::Zero());
            surface.line_corners.insert(surface.line_corners.end(), {corners + k, corners + (k + 1) % count});
        }
        for (std::uint32_t k = 2; k < count; ++k)
            surface.triangle_corners.insert(surface.triangle_corners.end(), {corners, corners + k - 1, corners + k});
        corners += count, triangles += count - 2, lines += count;
    }
    surface.corners.push_back(corners);
    surface.triangles.push_back(triangles);
    surface.lines.push_back(lines);
    surface.numbers.push_back(static_cast<std::uint32_t>(model.contacts.number[contact]));
}

/// The largest of a field over the sub-contacts of each contact.
std::string largest_json(const Model& model, const char* name, const char* title, const std::vector<Row>& contacts) {
    const Field* field = find_field(ObjectKind::sub_contact, name);
    std::vector<float> values;
    for (const Row contact : contacts) {
        double largest = -std::numeric_limits<double>::infinity();
        const Span span = model.contacts.sub_contacts[contact];
        for (Row row = span.first; row < span.end(); ++row)
            largest = std::max(largest, length_of(model, field->get(model, row)));
        values.push_back(static_cast<float>(largest));
    }
    return numbers_json(title, field->unit, "block", values);
}

/// The states of a joint in the words of its model, "slips now, failed before"; of all its sub-contacts.
std::string joint_states_json(const Model& model, const ReportOrder& order, const std::vector<Row>& contacts) {
    std::map<std::string, std::vector<std::string>> words; // of each model
    std::vector<std::string> texts;
    for (const Row contact : contacts) {
        std::int64_t bits = 0;
        const Span span = model.contacts.sub_contacts[contact];
        for (Row row = span.first; row < span.end(); ++row)
            bits |= static_cast<std::int64_t>(model.sub_contacts.state[row]);
        const Row set = model.contacts.properties[contact];
        const std::string name = set == no_row ? "" : model.joint_properties[static_cast<std::size_t>(set)].model;
        auto found = words.find(name);
        if (found == words.end())
            found =
                words.emplace(name, order.law_names ? order.law_names(name).states : std::vector<std::string>{}).first;
        std::vector<std::string_view> said;
        for (std::size_t bit = 0; bit < found->second.size(); ++bit)
            if ((bits >> bit & 1) != 0) said.push_back(found->second[bit]);
        texts.push_back(said.empty() ? "elastic" : fmt::format("{}", fmt::join(said, ", ")));
    }
    return names_json("state", texts);
}

/// The largest slip of the joints around each block.
std::string slip_json(const Model& model, const std::vector<Row>& blocks) {
    std::vector<double> largest(model.blocks.size());
    const auto& contacts = model.contacts;
    for (Row contact = 0; contact < static_cast<Row>(contacts.size()); ++contact) {
        const Span span = contacts.sub_contacts[contact];
        for (Row row = span.first; row < span.end(); ++row) {
            const double slip = Vec3(model.sub_contacts.shear_displacement[row]).norm();
            for (const Row block : {contacts.block1[contact], contacts.block2[contact]})
                largest[block] = std::max(largest[block], slip);
        }
    }
    std::vector<float> values;
    for (const Row block : blocks) values.push_back(static_cast<float>(largest[block]));
    return numbers_json("joint slip", "length", "block", values);
}

} // namespace

std::string joint_scene_json(const Model& model, const ReportOrder& order) {
    const Vec3& centre = order.centre;
    const Box box = box_of(model);
    Surface surface;
    std::vector<Row> shown;
    for (Row contact = 0; contact < static_cast<Row>(model.contacts.size()); ++contact) {
        const auto& contacts = model.contacts;
        if (contacts.sub_contacts[contact].count == 0 || model.blocks.hidden[contacts.block1[contact]] ||
            model.blocks.hidden[contacts.block2[contact]])
            continue;
        if (contacts.face1[contact] == no_row || contacts.face2[contact] == no_row) continue;
        add_joint(model, contact, centre, surface);
        shown.push_back(contact);
    }
    if (shown.empty()) return "null";
    std::vector<std::string> fields{largest_json(model, "shear_displacement", "shear displacement", shown),
                                    largest_json(model, "normal_displacement", "opening", shown),
                                    largest_json(model, "normal_stress", "normal stress", shown),
                                    largest_json(model, "shear_stress", "shear stress", shown),
                                    joint_states_json(model, order, shown)};
    for (const char* name : {"area", "joint_set", "model", "block1", "block2"})
        if (const Field* field = find_field(ObjectKind::contact, name))
            fields.push_back(field_json(model, *field, "block", shown));
    return surface_json(surface, centre, (box.high - box.low).norm(), fields);
}

std::string scene_json(const Model& model, const Vec3& centre) {
    const Box box = box_of(model);
    Surface surface;
    std::vector<Row> blocks;
    for (Row block = 0; block < static_cast<Row>(model.blocks.size()); ++block)
        if (!model.blocks.hidden[block]) add_block(model, block, centre, surface), blocks.push_back(block);
    std::vector<std::string> fields = corner_fields_json(model, surface.gridpoints);
    fields.push_back(slip_json(model, blocks));
    for (const char* name : {"group", "material", "region", "id", "volume"})
        if (const Field* field = find_field(ObjectKind::block, name))
            fields.push_back(field_json(model, *field, "block", blocks));
    return surface_json(surface, centre, (box.high - box.low).norm(), fields);
}

std::string curve_json(std::string_view title, std::span<const double> along, std::span<const double> values) {
    return fmt::format(R"({{"title":{},"times":"{}","values":"{}"}})", json_text(title), packed(along), packed(values));
}

std::string with_units(std::string_view json, const Units& units) {
    constexpr std::string_view mark = R"("unit":")";
    if (!units.given()) return std::string(json);
    std::string result;
    for (std::size_t at = 0; at < json.size();) {
        const std::size_t found = json.find(mark, at);
        if (found == std::string_view::npos) return result.append(json.substr(at));
        const std::size_t first = found + mark.size(), end = json.find('"', first);
        result.append(json.substr(at, first - at)) += units.label(json.substr(first, end - first));
        at = end;
    }
    return result;
}

std::string histories_json(const Histories& histories, const Units& units) {
    std::vector<std::string> all;
    for (const auto& history : histories.all) {
        const auto first = static_cast<std::ptrdiff_t>(std::min(history.first_sample, histories.time.size()));
        const std::vector<double> times(histories.time.begin() + first, histories.time.end());
        all.push_back(curve_json(units.in_brackets(column_title(history)), times, history.values));
    }
    return fmt::format("[{}]", fmt::join(all, ","));
}

} // namespace kaya
