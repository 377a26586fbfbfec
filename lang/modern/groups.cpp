#include "lang/modern/groups.hpp"

#include <fmt/format.h>

namespace kaya::lang {

namespace {

const std::vector<KeywordSpec>& slot_words() {
    static const std::vector<KeywordSpec> words = {slot_word()};
    return words;
}

const std::vector<KeywordSpec>& classic_group_words() {
    for (const KeywordSpec& element : range_elements())
        if (element.words.front().word == "group") return element.keywords;
    throw std::logic_error("there is no classic range element 'group'");
}

} // namespace

KeywordSpec slot_word() {
    const ArgumentSpec name = text("slot").spec;
    Keywords<char> words;
    words.special(
        {"slot"}, {name},
        [name](Reader& reader, char&) {
            const Place place = reader.peek() ? reader.peek()->place : Place{};
            const std::string slot = fold(reader.text(name));
            if (slot != "default" && slot != "any" && slot != "1")
                not_supported_yet("slot " + slot, "several groups of one object", place);
        },
        "the slot of the group: Default");
    return std::move(words).list().front();
}

void read_slot(Reader& reader) {
    char nothing = 0;
    read_keywords(reader, slot_words(), &nothing);
}

void group_element(Keywords<RangePhrase>& table) {
    const ArgumentSpec name = text("name").spec;
    table.special(
        {"group"}, {name},
        [name](Reader& reader, RangePhrase& phrase) {
            RangeElement element;
            element.kind = RangeElement::Kind::group;
            element.place = reader.previous().place;
            element.name = reader.text(name);
            read_keywords(reader, classic_group_words(), &element);
            phrase.elements.push_back(std::move(element));
        },
        "members of a group; a contact belongs to the groups of its two blocks", classic_group_words());
}

} // namespace kaya::lang
