// The part of a save file that is not the model, walked by save and restore alike.
#pragma once

#include "io/save.hpp"

namespace kaya {

template <class Archive> void visit_extras(Archive& archive, SaveExtras& extras) {
    archive.text("program_version", extras.program_version);
    archive.text("title", extras.title);
    const auto visit_item = [&](SaveExtras::Item& item) {
        archive.text("name", item.name);
        std::vector<std::uint8_t> bytes(item.content.begin(), item.content.end());
        archive.list("content", bytes);
        item.content.assign(bytes.begin(), bytes.end());
    };
    archive.records("scripts", extras.scripts, visit_item);
    archive.records("decks", extras.decks, visit_item);
}

} // namespace kaya
