// The slot of a group: `group wall slot side` is the group `side=wall`.
#pragma once

#include "lang/commands/builder.hpp"

namespace kaya::lang {

/// The word `slot` after the name of a group. Its target is the name, which becomes `slot=name`.
const std::vector<KeywordSpec>& slot_words();

/// `slot` as a keyword of a command: `name(command)` is the name of its group.
template <class Command, class Name> void add_slot(Entry<Command>& entry, Name name) {
    const KeywordSpec& slot = slot_words().front();
    entry.special(
        slot.words, slot.arguments,
        [&slot, name](Reader& reader, Command& command) { slot.read(reader, &name(command)); }, slot.help);
}

} // namespace kaya::lang
