#include "lang/interp/spec.hpp"

#include <cmath>
#include <fmt/format.h>

namespace kaya::lang {

std::string CommandSpec::name() const {
    std::string text(words.front().word);
    if (!form.empty()) text.append(" ").append(form.front().word);
    return text;
}

const KeywordSpec* find_keyword(const std::vector<KeywordSpec>& keywords, std::string_view typed) {
    return resolve(keywords, typed, [](const KeywordSpec& k) -> const auto& { return k.words; });
}

std::string describe(const ArgumentSpec& argument) {
    static constexpr const char* one[] = {"a number", "a whole number", "a word", "on or off"};
    std::string text = fmt::format("{}, {}", argument.name, one[static_cast<int>(argument.kind)]);
    if (argument.count > 1) text = fmt::format("{} numbers {}", argument.count, argument.name);
    const Limits& l = argument.limits;
    if (std::isfinite(l.low))
        text += fmt::format(", {} {:g}", l.low_excluded ? "greater than" : "at least", l.low);
    if (std::isfinite(l.high))
        text += fmt::format(", {} {:g}", l.high_excluded ? "less than" : "at most", l.high);
    if (!argument.unit.empty()) text += fmt::format(" [{}]", argument.unit);
    return text;
}

} // namespace kaya::lang
