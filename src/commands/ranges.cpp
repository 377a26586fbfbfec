#include "commands/ranges.hpp"

#include "mechanics/contact_properties.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <utility>

namespace kaya {

namespace {

using lang::RangeElement;
using Kind = RangeElement::Kind;

/// What an element needs to become a test.
struct Context {
    const Model& model;
    const NamedRanges& named;
    ObjectKind kind;
    double tolerance;
    bool whole = false; ///< all corners of an object must lie inside
    std::vector<std::string> open; ///< named ranges that are being looked into, against circles
};

bool is_contact(ObjectKind kind) { return kind == ObjectKind::contact || kind == ObjectKind::sub_contact; }

Row contact_of(const Model& model, ObjectKind kind, Row row) {
    return kind == ObjectKind::sub_contact ? model.sub_contacts.contact[row] : row;
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// True when the block, or one of the two blocks of a contact, passes; or both of them.
template <class Passes> RangeTest on_blocks(Passes passes, bool both = false) {
    return [passes, both](const Model& model, ObjectKind kind, Row row) {
        if (!is_contact(kind)) return passes(model, block_of(model, kind, row));
        const Row contact = contact_of(model, kind, row);
        const bool one = passes(model, model.contacts.block1[contact]);
        const bool two = passes(model, model.contacts.block2[contact]);
        return both ? one && two : one || two;
    };
}

/// Calls `passes` with the corners of an object, until one does not pass. What has no corners has its place.
template <class Passes> bool all_corners(const Model& model, ObjectKind kind, Row row, Passes passes) {
    const auto& position = model.gridpoints.position;
    const auto all = [&](const auto& rows) {
        return std::ranges::all_of(rows, [&](Row g) { return passes(position[g]); });
    };
    switch (kind) {
    case ObjectKind::block: {
        const Span span = model.blocks.gridpoints[row];
        return std::all_of(&position[span.first], &position[span.first] + span.count, passes);
    }
    case ObjectKind::zone:
        return all(model.zones.gridpoints[row]);
    case ObjectKind::triangle:
        return all(model.triangles.gridpoints[row]);
    case ObjectKind::face: {
        const Span span = model.faces.triangles[row];
        for (Row t = span.first; t < span.end(); ++t)
            if (!all(model.triangles.gridpoints[t])) return false;
        return true;
    }
    case ObjectKind::contact: {
        const Span span = model.contacts.sub_contacts[row];
        for (Row s = span.first; s < span.end(); ++s)
            if (!passes(model.sub_contacts.position[s])) return false;
        return true;
    }
    case ObjectKind::gridpoint:
    case ObjectKind::sub_contact:
        break;
    }
    return passes(reference_point(model, kind, row));
}

template <class Passes> RangeTest on_place(const Context& context, Passes passes) {
    if (context.whole)
        return [passes](const Model& model, ObjectKind kind, Row row) { return all_corners(model, kind, row, passes); };
    return [passes](const Model& model, ObjectKind kind, Row row) {
        return passes(reference_point(model, kind, row));
    };
}

RangeTest along_axis(const RangeElement& e, const Context& context, int axis) {
    const double low = std::min(e.low, e.high) - context.tolerance;
    const double high = std::max(e.low, e.high) + context.tolerance;
    return on_place(context, [=](const Vec3& p) { return p[axis] >= low && p[axis] <= high; });
}

RangeTest in_box(const RangeElement& e, const Context& context) {
    const Vec3 slack = Vec3::Constant(context.tolerance);
    const Vec3 low = e.centre.cwiseMin(e.end2) - slack, high = e.centre.cwiseMax(e.end2) + slack;
    return on_place(
        context, [=](const Vec3& p) { return (p.array() >= low.array()).all() && (p.array() <= high.array()).all(); });
}

RangeTest by_plane(const RangeElement& e, const Context& context) {
    const Vec3 normal = e.normal.normalized(), origin = e.centre;
    const double slack = context.tolerance, limit = e.distance + slack;
    const int side = e.side;
    return on_place(context, [=](const Vec3& p) {
        const double height = normal.dot(p - origin);
        if (side > 0) return height >= -slack;
        if (side < 0) return height <= slack;
        return std::abs(height) <= limit;
    });
}

RangeTest in_sphere(const RangeElement& e, const Context& context) {
    const Vec3 centre = e.centre;
    const double inner = e.radius1 - context.tolerance, outer = e.radius2 + context.tolerance;
    return on_place(context, [=](const Vec3& p) {
        const double distance = (p - centre).norm();
        return distance >= inner && distance <= outer;
    });
}

RangeTest in_cylinder(const RangeElement& e, const Context& context) {
    const Vec3 end1 = e.centre;
    const double length = (e.end2 - e.centre).norm();
    if (length <= context.tolerance)
        throw Diagnostic("the two ends of the cylinder are the same point").at(e.place);
    const Vec3 axis = (e.end2 - e.centre) / length;
    const double inner = e.radius1 - context.tolerance, outer = e.radius2 + context.tolerance,
                 slack = context.tolerance;
    return on_place(context, [=](const Vec3& p) {
        const double along = axis.dot(p - end1);
        const double distance = (p - end1 - along * axis).norm();
        return along >= -slack && along <= length + slack && distance >= inner && distance <= outer;
    });
}

std::int32_t group_number(const RangeElement& e, const std::string& name, const Context& context) {
    const auto& names = context.model.group_names;
    const std::string wanted = lower(name);
    for (std::size_t i = 1; i < names.size(); ++i)
        if (lower(names[i]) == wanted) return static_cast<std::int32_t>(i);
    const std::vector<std::string_view> known(names.begin() + 1, names.end());
    const auto near = did_you_mean(name, known);
    std::string hint = known.empty()  ? "no group has been made yet"
                       : near.empty() ? fmt::format("groups are: {}", fmt::join(known, ", "))
                                      : fmt::format("did you mean '{}'?", near);
    throw Diagnostic(fmt::format("there is no group '{}'", name), std::move(hint)).at(e.place);
}

RangeTest in_group(const RangeElement& e, const Context& context) {
    const auto group = group_number(e, e.name, context);
    return on_blocks([group](const Model& model, Row block) { return model.blocks.group[block] == group; }, e.both);
}

/// Numbers of blocks: the column is picked by `column`.
RangeTest by_block_number(const RangeElement& e, Column<std::int32_t> Blocks::*column) {
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    return on_blocks([=](const Model& model, Row block) {
        const double number = (model.blocks.*column)[block];
        return number >= low && number <= high;
    });
}

/// Contacts between a block of one number and a block of the other.
RangeTest between(const RangeElement& e, const Context& context, const char* word,
                  Column<std::int32_t> Blocks::*column, double a, double b) {
    if (!is_contact(context.kind))
        throw Diagnostic(
            fmt::format("'{}' picks contacts, but this command acts on {}", word, plural_of(context.kind)))
            .at(e.place);
    return [=](const Model& model, ObjectKind kind, Row row) {
        const Row contact = contact_of(model, kind, row);
        const double one = (model.blocks.*column)[model.contacts.block1[contact]];
        const double two = (model.blocks.*column)[model.contacts.block2[contact]];
        return (one == a && two == b) || (one == b && two == a);
    };
}

RangeTest by_joint_material(const RangeElement& e, const Context& context) {
    if (!is_contact(context.kind))
        throw Diagnostic(
            fmt::format("'jmat' picks contacts, but this command acts on {}", plural_of(context.kind)),
            "use 'mat' for the material of blocks")
            .at(e.place);
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    return [=](const Model& model, ObjectKind kind, Row row) {
        const double number = model.contacts.material[contact_of(model, kind, row)];
        return number >= low && number <= high;
    };
}

RangeTest by_joint_model(const RangeElement& e, const Context& context) {
    if (!is_contact(context.kind))
        throw Diagnostic(
            fmt::format("'jmodel' picks contacts, but this command acts on {}", plural_of(context.kind)))
            .at(e.place);
    // `jcons n` gives a number, `jmodel NAME` a name.
    std::string name;
    try {
        name = lower(e.name.empty() ? joint_model_of_number(context.model, static_cast<std::int32_t>(e.low)) : e.name);
    } catch (Diagnostic& mistake) {
        throw mistake.at(e.place);
    }
    return [name](const Model& model, ObjectKind kind, Row row) {
        const Row set = model.contacts.properties[contact_of(model, kind, row)];
        return set != no_row && lower(model.joint_properties[set].model) == name;
    };
}

RangeTest by_volume(const RangeElement& e) {
    // As wide as two numbers that were meant to be the same are apart.
    const double low = e.low * (1 - 1e-6), high = e.high * (1 + 1e-6);
    return on_blocks([=](const Model& model, Row block) {
        return model.blocks.volume[block] >= low && model.blocks.volume[block] <= high;
    });
}

RangeTest by_joint_set(const RangeElement& e, const Context& context) {
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    const auto passes = [low, high](double number) { return number >= low && number <= high; };
    switch (context.kind) {
    case ObjectKind::contact:
    case ObjectKind::sub_contact:
        return [=](const Model& m, ObjectKind kind, Row row) {
            return passes(m.contacts.joint_set[contact_of(m, kind, row)]);
        };
    case ObjectKind::face:
        return [=](const Model& m, ObjectKind, Row row) { return passes(m.faces.joint_set[row]); };
    case ObjectKind::triangle:
        return [=](const Model& m, ObjectKind, Row row) {
            return passes(m.faces.joint_set[m.triangles.face[row]]);
        };
    default:
        break;
    }
    throw Diagnostic(
        fmt::format("'jset' picks contacts and faces, but this command acts on {}", plural_of(context.kind)))
        .at(e.place);
}

/// The number that users see: blocks and contacts have one of their own, other rows count from 1.
double number_of(const Model& model, ObjectKind kind, Row row) {
    switch (kind) {
    case ObjectKind::block:
        return model.blocks.number[row];
    case ObjectKind::contact:
        return model.contacts.number[row];
    case ObjectKind::sub_contact:
        return model.sub_contacts.number[row];
    default:
        return row + 1.0;
    }
}

RangeTest by_id(const RangeElement& e) {
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    return [=](const Model& model, ObjectKind kind, Row row) {
        const double number = number_of(model, kind, row);
        return number >= low && number <= high;
    };
}

RangeTest by_id_list(const RangeElement& e) {
    std::vector<double> numbers(e.numbers.begin(), e.numbers.end());
    std::ranges::sort(numbers);
    return [numbers](const Model& model, ObjectKind kind, Row row) {
        return std::ranges::binary_search(numbers, number_of(model, kind, row));
    };
}

RangeTest phrase_test(const lang::RangePhrase& phrase, Context& context);

RangeTest by_name(const RangeElement& e, Context& context) {
    const std::string name = lower(e.name);
    const auto found = context.named.find(name);
    if (found == context.named.end()) {
        std::vector<std::string_view> known;
        for (const auto& [known_name, phrase] : context.named) known.push_back(known_name);
        const auto near = did_you_mean(name, known);
        throw Diagnostic(fmt::format("there is no named range '{}'", e.name),
                         near.empty() ? "'range name NAME ...' makes one"
                                      : fmt::format("did you mean '{}'?", near))
            .at(e.place);
    }
    if (std::ranges::find(context.open, name) != context.open.end())
        throw Diagnostic(fmt::format("the named range '{}' contains itself", e.name)).at(e.place);
    context.open.push_back(name);
    RangeTest test = phrase_test(found->second, context);
    context.open.pop_back();
    return test;
}

RangeTest element_test(const RangeElement& e, Context& context) {
    switch (e.kind) {
    case Kind::x:
        return along_axis(e, context, 0);
    case Kind::y:
        return along_axis(e, context, 1);
    case Kind::z:
        return along_axis(e, context, 2);
    case Kind::box:
        return in_box(e, context);
    case Kind::plane:
        return by_plane(e, context);
    case Kind::sphere:
        return in_sphere(e, context);
    case Kind::cylinder:
        return in_cylinder(e, context);
    case Kind::group:
        return in_group(e, context);
    case Kind::material:
        return by_block_number(e, &Blocks::material);
    case Kind::constitutive:
        return by_block_number(e, &Blocks::constitutive);
    case Kind::region:
        return by_block_number(e, &Blocks::region);
    case Kind::block_id:
        return by_block_number(e, &Blocks::number);
    case Kind::joint_material:
        return by_joint_material(e, context);
    case Kind::joint_set:
        return by_joint_set(e, context);
    case Kind::id:
        return by_id(e);
    case Kind::material_intersection:
        return between(e, context, "mintersection", &Blocks::material, e.low, e.high);
    case Kind::region_intersection:
        return between(e, context, "rintersection", &Blocks::region, e.low, e.high);
    case Kind::group_intersection:
        return between(e, context, "gintersection", &Blocks::group, group_number(e, e.name, context),
                       group_number(e, e.second_name, context));
    case Kind::joint_model:
        return by_joint_model(e, context);
    case Kind::volume:
        return by_volume(e);
    case Kind::deformable:
        return on_blocks([](const Model& model, Row block) { return model.blocks.deformable[block] != 0; });
    case Kind::visible:
        return on_blocks([](const Model& model, Row block) { return model.blocks.hidden[block] == 0; });
    case Kind::id_list:
        return by_id_list(e);
    case Kind::named:
        return by_name(e, context);
    }
    throw std::logic_error("a range element of no known kind");
}

RangeTest phrase_test(const lang::RangePhrase& phrase, Context& context) {
    const bool whole_outside = std::exchange(context.whole, context.whole || phrase.whole);
    std::vector<std::pair<RangeTest, bool>> tests;
    for (const auto& element : phrase.elements)
        tests.emplace_back(element_test(element, context), element.negated);
    context.whole = whole_outside;
    if (phrase.any)
        return [tests](const Model& model, ObjectKind kind, Row row) {
            return std::ranges::any_of(tests,
                                       [&](const auto& t) { return t.first(model, kind, row) != t.second; });
        };
    return [tests](const Model& model, ObjectKind kind, Row row) {
        return std::ranges::all_of(tests,
                                   [&](const auto& t) { return t.first(model, kind, row) != t.second; });
    };
}

} // namespace

RangeTest range_test(const Model& model, const NamedRanges& named, const lang::RangePhrase& phrase,
                     ObjectKind kind) {
    if (phrase.elements.empty()) return {};
    Context context{model, named, kind, 1e-6 * model_size(model), false, {}};
    return phrase_test(phrase, context);
}

const char* plural_of(ObjectKind kind) {
    static constexpr std::array names{"blocks", "gridpoints", "faces",       "triangles",
                                      "zones",  "contacts",   "sub-contacts"};
    return names[static_cast<std::size_t>(kind)];
}

} // namespace kaya
