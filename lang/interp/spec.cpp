#include "lang/interp/spec.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya::lang {

std::string CommandSpec::name() const {
    std::string text(words.front().word);
    for (const auto& spellings : form) text.append(" ").append(spellings.front().word);
    return text;
}

const KeywordSpec* find_keyword(const std::vector<KeywordSpec>& keywords, std::string_view typed) {
    return resolve(
        keywords, typed, [](const KeywordSpec& k) -> const auto& { return k.words; });
}

void not_supported_yet(std::string_view name, std::string_view help, const Place& place) {
    Diagnostic d(fmt::format("'{}' is known, but kaya does not support it yet", name),
                 fmt::format("it is about {}", help));
    d.code = "not-supported-yet";
    throw d.at(place);
}

std::string describe(const ArgumentSpec& argument) {
    static constexpr const char* kinds[] = {"a number", "a whole number", "a word or a text in quotes", "on or off"};
    const char* kind = kinds[static_cast<int>(argument.kind)];
    // A name of one letter adds nothing to the keyword before it.
    const bool named = argument.name.size() > 1 && argument.kind != ArgumentKind::on_off;
    std::string text = named ? fmt::format("{}, {}", argument.name, kind) : kind;
    if (argument.count > 1) text = fmt::format("{} numbers {}", argument.count, argument.name);
    const Limits& l = argument.limits;
    const bool low = std::isfinite(l.low), high = std::isfinite(l.high);
    if (low) text += fmt::format(", {} {:g}", l.low_excluded ? "greater than" : "at least", l.low);
    if (high) text += fmt::format("{} {} {:g}", low ? " and" : ",", l.high_excluded ? "less than" : "at most", l.high);
    if (!argument.unit.empty()) text += fmt::format(" [{}]", argument.unit);
    return text;
}

} // namespace kaya::lang
