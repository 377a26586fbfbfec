#include "io/save_walk.hpp"

namespace kaya {

void visit_extras(Archive& archive, SaveExtras& extras) {
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
