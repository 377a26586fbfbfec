// Words of values with components, and of their factors over time.
#pragma once

#include "lang/modern/leaf.hpp"

#include <array>
#include <charconv>

namespace kaya::lang {

/// The modern word of a component, and the classic one.
struct ComponentWords {
    const char* words;
    const char* classic;
};
constexpr std::array<ComponentWords, 3> velocity_components{
    {{"velocity-x", "xvel"}, {"velocity-y", "yvel"}, {"velocity-z", "zvel"}}};

/// The words of the components, and one for all three: `member(command, k)` is the value of component k.
template <class Command, class Member> void vector_words(Leaf<Command>& leaf, const char* word,
                                                         const std::array<ComponentWords, 3>& components,
                                                         const char* unit, Member member, std::string_view help) {
    const Through each{[member](Command& command, const Vec3& value) {
                           for (std::size_t k = 0; k < 3; ++k) member(command, k) = value[static_cast<Eigen::Index>(k)];
                       },
                       [member](const Command& command) -> std::optional<Vec3> {
                           Vec3 value;
                           for (std::size_t k = 0; k < 3; ++k) {
                               const auto& component = member(const_cast<Command&>(command), k);
                               if (!component) return std::nullopt;
                               value[static_cast<Eigen::Index>(k)] = *component;
                           }
                           return value;
                       }};
    leaf.keyword({word}, vector("x y z").unit(unit), each, help);
    std::string all;
    for (const auto& component : components) all += (all.empty() ? "" : " ") + std::string(component.classic);
    leaf.said(all);
    for (const auto& component : components) leaf.word(component.words, component.classic);
}

/// The words of a command that puts objects into a group, or takes them out of one.
inline Leaf<Group> group_leaf(std::string_view words, std::string_view meaning) {
    Leaf<Group> leaf(words, meaning);
    leaf.arguments_of_meaning().word("slot", "slot").word("remove", "remove").ranged(&Group::range);
    return leaf;
}

/// A table by its name; a name of digits is a number.
inline TableValue table_named(std::string name) {
    TableValue table;
    const char* end = name.data() + name.size();
    const auto [stop, failed] = std::from_chars(name.data(), end, table.table);
    if (failed != std::errc() || stop != end) {
        table.table = 0;
        table.name = std::move(name);
    }
    return table;
}

/// The name of a table, in the place of its number.
inline const Through name_of_table{[](TableValue& table, std::string name) { table = table_named(std::move(name)); },
                                   [](const TableValue& table) {
                                       return std::optional(table.name.empty() ? std::to_string(table.table)
                                                                               : table.name);
                                   }};

/// `table s` or `fish s` after the values of a line: their factor over time.
template <class Command> void multiplier_words(Leaf<Command>& leaf) {
    const auto name = text("name");
    const auto factor = [](const auto& kind, const auto& parts) {
        const auto place = [](Reader& reader, Multiplier& multiplier) {
            multiplier.place = reader.peek() ? reader.peek()->place : Place{};
        };
        return Parts<Command>().in(made(&Command::multiplier), Parts<Multiplier>().check(place).in(kind, parts));
    };
    leaf.keyword({"table"},
                 factor(as<TableValue>(&Multiplier::function), Parts<TableValue>().then(name, name_of_table)),
                 "the values of the line are multiplied by this table over time");
    const auto symbol = Parts<ScriptValue>().argument(name.spec).by(
        [name](Reader& reader, ScriptValue& value) { value.symbol = name_at(reader, name.spec); },
        [](Parts<ScriptValue>::Form form, const ScriptValue& value) {
            form.words.push_back({value.symbol, true});
            form.after = value;
            return Parts<ScriptValue>::Forms{std::move(form)};
        });
    leaf.keyword({"fish"}, factor(as<ScriptValue>(&Multiplier::function), symbol),
                 "the values of the line are multiplied by this FISH function or variable in each cycle");
}

/// A line with a range that it needs.
template <class Command> void needs_range(const Reader& reader, const Command& command) {
    if (command.range.place) return;
    incomplete_line(reader, "a range must be given", "end the line with: range position-z 0 1");
}

} // namespace kaya::lang
