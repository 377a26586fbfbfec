// Words and values that belong to a joint or zone model, which are known at run time only.
#pragma once

#include "lang/commands/builder.hpp"

namespace kaya::lang {

/// Reads a word and its value; false, without taking a word, when the next word is more likely a misspelt `range`, `model` or `load`.
bool read_property_item(Reader& reader, std::vector<Property::Item>& items);
/// Prints what it reads.
template <class Command> Parts<Command> property_items(std::vector<Property::Item> Command::*items) {
    return Parts<Command>().in(next_of(items), Parts<Property::Item>().by({}, [](Parts<Property::Item>::Form form,
                                                                                 const Property::Item& item) {
        form.words.push_back({item.word});
        form.after = item;
        const bool said =
            item.is_switch ? print_value(form.words, item.value != 0) : print_value(form.words, item.value);
        return said ? Parts<Property::Item>::Forms{form} : Parts<Property::Item>::Forms{};
    }));
}
/// The name of a model in a line that does this with it.
template <class Action> auto named_model(Action action) {
    return Through{[action](auto& command, std::string name) {
                       command.action = action;
                       command.model = std::move(name);
                   },
                   [action](const auto& command) {
                       return command.action == action ? std::optional(command.model) : std::nullopt;
                   }};
}
/// Names and values of properties that no table knows.
template <class Command> void property_values(Entry<Command>& line) {
    line.otherwise({real("property value").optional().spec},
                   [](Reader& reader, Command& command) { return read_property_item(reader, command.items); });
    line.prints(property_items(&Command::items), true);
}

} // namespace kaya::lang
