#include "commands/range_tests.hpp"

#include "base/lower_case.hpp"
#include "mechanics/contact_properties.hpp"
#include "model/groups.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace kaya {

using lang::RangeElement;

void needs_contacts(const RangeElement& e, const RangeContext& context, const char* word, const char* hint) {
    if (is_contact(context.kind)) return;
    throw Diagnostic(fmt::format("'{}' picks contacts, but this command acts on {}", word, plural_of(context.kind)),
                     hint)
        .at(e.place);
}

namespace {

using Kind = RangeElement::Kind;

std::int32_t group_number(const RangeElement& e, const std::string& name, const RangeContext& context) {
    const std::int32_t group = find_group(context.model, name);
    if (group >= 0) return group;
    const auto& names = context.model.group_names;
    const std::vector<std::string_view> known(names.begin() + 1, names.end());
    const auto near = did_you_mean(name, known);
    std::string hint = known.empty()  ? "no group has been made yet"
                       : near.empty() ? fmt::format("groups are: {}", fmt::join(known, ", "))
                                      : fmt::format("did you mean '{}'?", near);
    throw Diagnostic(fmt::format("there is no group '{}'", name), std::move(hint)).at(e.place);
}

/// An object is in a group itself, or because its block is; a contact because one of its blocks is, or both.
RangeTest in_group(const RangeElement& e, const RangeContext& context) {
    const auto group = group_number(e, e.name, context);
    const auto through_block =
        on_blocks([group](const Model& model, Row block) { return model.blocks.group[block] == group; }, e.both);
    return [=](const Model& model, ObjectKind kind, Row row) {
        return group_of(model, kind, row) == group || through_block(model, kind, row);
    };
}

RangeTest in_joint_group(const RangeElement& e, const RangeContext& context) {
    needs_contacts(e, context, "jgroup", "use 'group' for groups of blocks, faces and zones");
    const auto group = group_number(e, e.name, context);
    return [group](const Model& model, ObjectKind kind, Row row) { return group_of(model, kind, row) == group; };
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
RangeTest between(const RangeElement& e, const RangeContext& context, const char* word,
                  Column<std::int32_t> Blocks::*column, double a, double b) {
    needs_contacts(e, context, word);
    return [=](const Model& model, ObjectKind kind, Row row) {
        const Row contact = contact_of(model, kind, row);
        const double one = (model.blocks.*column)[model.contacts.block1[contact]];
        const double two = (model.blocks.*column)[model.contacts.block2[contact]];
        return (one == a && two == b) || (one == b && two == a);
    };
}

RangeTest by_joint_material(const RangeElement& e, const RangeContext& context) {
    needs_contacts(e, context, "jmat", "use 'mat' for the material of blocks");
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    return [=](const Model& model, ObjectKind kind, Row row) {
        const double number = model.contacts.material[contact_of(model, kind, row)];
        return number >= low && number <= high;
    };
}

RangeTest by_joint_model(const RangeElement& e, const RangeContext& context) {
    needs_contacts(e, context, "jmodel");
    // `jcons n` gives a number, `jmodel NAME` a name.
    std::string name;
    try {
        name = lower_case(JointRegistry::keyword_of(e.name.empty() ? joint_model_of_number(context.model, static_cast<std::int32_t>(e.low)) : e.name));
    } catch (Diagnostic& mistake) {
        throw mistake.at(e.place);
    }
    return [name](const Model& model, ObjectKind kind, Row row) {
        const Row set = model.contacts.properties[contact_of(model, kind, row)];
        return set != no_row && lower_case(model.joint_properties[set].model) == name;
    };
}

RangeTest by_volume(const RangeElement& e) {
    // As wide as two numbers that were meant to be the same are apart.
    const double low = e.low * (1 - 1e-6), high = e.high * (1 + 1e-6);
    return on_blocks([=](const Model& model, Row block) {
        return model.blocks.volume[block] >= low && model.blocks.volume[block] <= high;
    });
}

RangeTest by_joint_set(const RangeElement& e, const RangeContext& context) {
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

RangeTest phrase_test(const lang::RangePhrase& phrase, RangeContext& context);

RangeTest by_name(const RangeElement& e, RangeContext& context) {
    const std::string name = lower_case(e.name);
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

RangeTest element_test(const RangeElement& e, RangeContext& context);

/// One of several numbers: region 1 2 5.
RangeTest by_any_number(const RangeElement& e, RangeContext& context) {
    std::vector<RangeTest> tests;
    for (const std::int64_t number : e.numbers) {
        RangeElement one = e;
        one.numbers.clear();
        one.low = one.high = static_cast<double>(number);
        tests.push_back(element_test(one, context));
    }
    return [tests](const Model& model, ObjectKind kind, Row row) {
        return std::ranges::any_of(tests, [&](const RangeTest& test) { return test(model, kind, row); });
    };
}

RangeTest element_test(const RangeElement& e, RangeContext& context) {
    if (!e.numbers.empty() && e.kind != Kind::id_list) return by_any_number(e, context);
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
    case Kind::joint_group:
        return in_joint_group(e, context);
    case Kind::excavated:
        return [excavated = context.extras.excavated](const Model&, ObjectKind, Row) { return excavated; };
    case Kind::named:
        return by_name(e, context);
    case Kind::joint_state:
        return by_joint_state(e, context);
    case Kind::surface:
        return on_surface(e, context);
    case Kind::orientation:
        return by_orientation(e, context);
    case Kind::concave:
        return in_concave_body(context);
    case Kind::edge_length:
        return by_edge_length(e);
    case Kind::aspect_ratio:
        return by_aspect_ratio(e);
    case Kind::leader:
        return by_leader(e, context);
    case Kind::polygon:
        return in_polygon(e, context);
    case Kind::ellipse:
        return in_ellipse(e, context);
    case Kind::ground:
        return by_ground(e, context);
    }
    throw std::logic_error("a range element of no known kind");
}

RangeTest phrase_test(const lang::RangePhrase& phrase, RangeContext& context) {
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

namespace {

/// Whether an element of the phrase, or of a named range in it, passes.
template <class Passes>
bool any_element(const NamedRanges& named, const lang::RangePhrase& phrase, Passes passes) {
    std::set<std::string> seen;
    const auto visit = [&](const auto& self, const lang::RangePhrase& in) -> bool {
        return std::ranges::any_of(in.elements, [&](const RangeElement& e) {
            if (e.kind != Kind::named) return passes(e.kind);
            if (!seen.insert(lower_case(e.name)).second) return false;
            const auto found = named.find(lower_case(e.name));
            return found != named.end() && self(self, found->second);
        });
    };
    return visit(visit, phrase);
}

} // namespace

bool has_element(const NamedRanges& named, const lang::RangePhrase& phrase, Kind kind) {
    return any_element(named, phrase, [kind](Kind other) { return other == kind; });
}

bool asks_for_objects(const NamedRanges& named, const lang::RangePhrase& phrase) {
    static const std::set<Kind> places{Kind::x,      Kind::y,        Kind::z,       Kind::box,    Kind::plane,
                                       Kind::sphere, Kind::cylinder, Kind::polygon, Kind::ellipse, Kind::ground};
    return any_element(named, phrase, [](Kind kind) { return !places.contains(kind); });
}

RangeTest range_test(const Model& model, const NamedRanges& named, const lang::RangePhrase& phrase,
                     ObjectKind kind, const RangeExtras& extras) {
    if (phrase.elements.empty()) return {};
    RangeContext context{model, named, kind, 1e-6 * model_size(model), extras, false, {}};
    return phrase_test(phrase, context);
}

const char* plural_of(ObjectKind kind) {
    static constexpr std::array names{"blocks", "gridpoints", "faces",       "triangles",
                                      "zones",  "contacts",   "sub-contacts", "cable nodes"};
    return names[static_cast<std::size_t>(kind)];
}

} // namespace kaya
