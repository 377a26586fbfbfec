#include "lang/commands/slots.hpp"

#include <fmt/format.h>

namespace kaya::lang {

const std::vector<KeywordSpec>& slot_words() {
    static const std::vector<KeywordSpec> words = [] {
        const ArgumentSpec name = text("slot").spec;
        Keywords<std::string> list;
        list.special(
            {Spelling{"slot", 3}}, {name},
            [name](Reader& reader, std::string& group) { group = fmt::format("{}={}", reader.text(name), group); },
            "the slot that the group is in; Default if not given. An object is in one group of each slot");
        return std::move(list).list();
    }();
    return words;
}

} // namespace kaya::lang
