#include "commands/ranges/range_tests.hpp"

#include "base/lower_case.hpp"
#include "mechanics/assign/contact_properties.hpp"
#include "mechanics/common/property_sets.hpp"
#include "model/kinds/groups.hpp"

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
    throw Diagnostic(
        fmt::format("'{}' picks contacts, but this command acts on {}", word, info_of(context.kind).plural), hint)
        .at(e.place);
}

namespace {

using Kind = RangeElement::Kind;

GroupMembers members_of(const RangeElement& e, const std::string& name, const RangeContext& context) {
    GroupMembers members(context.model, name);
    if (!members.empty()) return members;
    const auto names = all_groups(context.model);
    const std::vector<std::string_view> known(names.begin(), names.end());
    const auto near = did_you_mean(name, known);
    std::string hint = known.empty()  ? "no group has been made yet"
                       : near.empty() ? fmt::format("groups are: {}", fmt::join(known, ", "))
                                      : fmt::format("did you mean '{}'?", near);
    throw Diagnostic(fmt::format("there is no group '{}'", name), std::move(hint)).at(e.place);
}

/// An object is in a group itself, or because its block is; a contact because one of its blocks is, or both.
RangeTest in_group(const RangeElement& e, RangeContext& context) {
    const auto members = members_of(e, e.name, context);
    const auto through_block = on_blocks(
        [members](const Model& model, Row block) { return members.contains(model.blocks.group[block]); }, e.both);
    return [=](const Model& model, ObjectKind kind, Row row) {
        return members.contains(group_of(model, kind, row)) || through_block(model, kind, row);
    };
}

RangeTest in_joint_group(const RangeElement& e, RangeContext& context) {
    needs_contacts(e, context, "jgroup", "use 'group' for groups of blocks, faces and zones");
    const auto members = members_of(e, e.name, context);
    return [members](const Model& model, ObjectKind kind, Row row) {
        return members.contains(group_of(model, kind, row));
    };
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

RangeTest by_joint_material(const RangeElement& e, RangeContext& context) {
    needs_contacts(e, context, "jmat", "use 'mat' for the material of blocks");
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    return [=](const Model& model, ObjectKind kind, Row row) {
        const double number = model.contacts.material[contact_of(model, kind, row)];
        return number >= low && number <= high;
    };
}

RangeTest by_joint_model(const RangeElement& e, RangeContext& context) {
    needs_contacts(e, context, "jmodel");
    // `jcons n` gives a number, `jmodel NAME` a name.
    std::string name;
    try {
        name = lower_case(JointRegistry::keyword_of(
            e.name.empty() ? joint_model_of_number(context.model, static_cast<std::int32_t>(e.low)) : e.name));
    } catch (Diagnostic& mistake) { throw mistake.at(e.place); }
    return [name](const Model& model, ObjectKind kind, Row row) {
        const Row set = model.contacts.properties[contact_of(model, kind, row)];
        return set != no_row && lower_case(model.joint_properties[set].model) == name;
    };
}

RangeTest by_volume(const RangeElement& e, RangeContext&) {
    // As wide as two numbers that were meant to be the same are apart.
    const double low = e.low * (1 - 1e-6), high = e.high * (1 + 1e-6);
    return on_blocks([=](const Model& model, Row block) {
        return model.blocks.volume[block] >= low && model.blocks.volume[block] <= high;
    });
}

RangeTest by_joint_set(const RangeElement& e, RangeContext& context) {
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    const auto passes = [low, high](double number) { return number >= low && number <= high; };
    switch (context.kind) {
    case ObjectKind::contact:
    case ObjectKind::sub_contact:
        return [=](const Model& m, ObjectKind kind, Row row) {
            return passes(m.contacts.joint_set[contact_of(m, kind, row)]);
        };
    case ObjectKind::face: return [=](const Model& m, ObjectKind, Row row) { return passes(m.faces.joint_set[row]); };
    case ObjectKind::triangle:
        return [=](const Model& m, ObjectKind, Row row) { return passes(m.faces.joint_set[m.triangles.face[row]]); };
    default: break;
    }
    throw Diagnostic(
        fmt::format("'jset' picks contacts and faces, but this command acts on {}", info_of(context.kind).plural))
        .at(e.place);
}

/// The number that users see.
double number_of(const Model& model, ObjectKind kind, Row row) {
    const auto number = info_of(kind).number;
    return number == nullptr ? row + 1.0 : static_cast<double>(number(model, row));
}

RangeTest by_id(const RangeElement& e, RangeContext&) {
    const double low = std::min(e.low, e.high), high = std::max(e.low, e.high);
    return [=](const Model& model, ObjectKind kind, Row row) {
        const double number = number_of(model, kind, row);
        return number >= low && number <= high;
    };
}

RangeTest by_id_list(const RangeElement& e, RangeContext&) {
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
                         near.empty() ? "'range name NAME ...' makes one" : fmt::format("did you mean '{}'?", near))
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

template <auto column> RangeTest by_number(const RangeElement& e, RangeContext&) { return by_block_number(e, column); }

constexpr std::array other_tests{
    RangeEntry{Kind::group, in_group},
    RangeEntry{Kind::joint_group, in_joint_group},
    RangeEntry{Kind::material, by_number<&Blocks::material>},
    RangeEntry{Kind::constitutive, by_number<&Blocks::constitutive>},
    RangeEntry{Kind::region, by_number<&Blocks::region>},
    RangeEntry{Kind::block_id, by_number<&Blocks::number>},
    RangeEntry{Kind::joint_material, by_joint_material},
    RangeEntry{Kind::joint_model, by_joint_model},
    RangeEntry{Kind::joint_set, by_joint_set},
    RangeEntry{Kind::id, by_id},
    RangeEntry{Kind::id_list, by_id_list},
    RangeEntry{Kind::volume, by_volume},
    RangeEntry{Kind::named, by_name},
    RangeEntry{Kind::material_intersection,
               [](const RangeElement& e, RangeContext& context) {
                   return between(e, context, "mintersection", &Blocks::material, e.low, e.high);
               }},
    RangeEntry{Kind::region_intersection,
               [](const RangeElement& e, RangeContext& context) {
                   return between(e, context, "rintersection", &Blocks::region, e.low, e.high);
               }},
    RangeEntry{Kind::group_intersection,
               [](const RangeElement& e, RangeContext& context) -> RangeTest {
                   needs_contacts(e, context, "gintersection");
                   const auto first = members_of(e, e.name, context), second = members_of(e, e.second_name, context);
                   return [=](const Model& model, ObjectKind kind, Row row) {
                       const Row contact = contact_of(model, kind, row);
                       const std::int32_t one = model.blocks.group[model.contacts.block1[contact]];
                       const std::int32_t two = model.blocks.group[model.contacts.block2[contact]];
                       return (first.contains(one) && second.contains(two)) ||
                              (first.contains(two) && second.contains(one));
                   };
               }},
    RangeEntry{Kind::deformable,
               [](const RangeElement&, RangeContext&) {
                   return on_blocks([](const Model& model, Row block) { return model.blocks.deformable[block] != 0; });
               }},
    RangeEntry{Kind::visible,
               [](const RangeElement&, RangeContext&) {
                   return on_blocks([](const Model& model, Row block) { return model.blocks.hidden[block] == 0; });
               }},
    RangeEntry{Kind::excavated,
               [](const RangeElement&, RangeContext& context) -> RangeTest {
                   return [excavated = context.extras.excavated](const Model&, ObjectKind, Row) { return excavated; };
               }},
};

RangeTest element_test(const RangeElement& e, RangeContext& context) {
    if (!e.numbers.empty() && e.kind != Kind::id_list) return by_any_number(e, context);
    for (const auto entries : {tests_of_places(), tests_of_faces(), tests_of_blocks(), tests_of_fractures(),
                               std::span<const RangeEntry>(other_tests)})
        for (const RangeEntry& entry : entries)
            if (entry.kind == e.kind) return entry.test(e, context);
    throw std::logic_error("a range element of no known kind");
}

RangeTest phrase_test(const lang::RangePhrase& phrase, RangeContext& context) {
    const bool whole_outside = std::exchange(context.whole, context.whole || phrase.whole);
    std::vector<std::pair<RangeTest, bool>> tests;
    for (const auto& element : phrase.elements) tests.emplace_back(element_test(element, context), element.negated);
    context.whole = whole_outside;
    if (phrase.any)
        return [tests](const Model& model, ObjectKind kind, Row row) {
            return std::ranges::any_of(tests, [&](const auto& t) { return t.first(model, kind, row) != t.second; });
        };
    return [tests](const Model& model, ObjectKind kind, Row row) {
        return std::ranges::all_of(tests, [&](const auto& t) { return t.first(model, kind, row) != t.second; });
    };
}

} // namespace

namespace {

/// Whether an element of the phrase, or of a named range in it, passes.
template <class Passes> bool any_element(const NamedRanges& named, const lang::RangePhrase& phrase, Passes passes) {
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
    return any_element(named, phrase, [](Kind kind) {
        return std::ranges::none_of(tests_of_places(), [kind](const RangeEntry& entry) { return entry.kind == kind; });
    });
}

RangeTest range_test(const Model& model, const NamedRanges& named, const lang::RangePhrase& phrase, ObjectKind kind,
                     const RangeExtras& extras) {
    if (phrase.elements.empty()) return {};
    RangeContext context{model, named, kind, 1e-6 * model_size(model), extras, false, {}};
    return phrase_test(phrase, context);
}

} // namespace kaya
