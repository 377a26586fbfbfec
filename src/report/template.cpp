#include "report/template.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace kaya {

namespace {

constexpr std::string_view opens = "{{", closes = "}}";

const std::string& value_of(const TemplateValues& values, std::string_view name) {
    const auto found = values.find(name);
    if (found == values.end()) throw std::logic_error(fmt::format("the template has no value for {}", name));
    return found->second;
}

} // namespace

std::string filled(std::string_view text, const TemplateValues& values) {
    std::string result;
    for (auto at = text.find(opens); at != text.npos; at = text.find(opens)) {
        const auto end = text.find(closes, at);
        if (end == text.npos) throw std::logic_error("a name in the template has no end");
        result += text.substr(0, at);
        std::string_view name = text.substr(at + opens.size(), end - at - opens.size());
        text.remove_prefix(end + closes.size());
        if (!name.starts_with('#')) {
            result += value_of(values, name);
            continue;
        }
        name.remove_prefix(1);
        if (text.starts_with('\n')) text.remove_prefix(1);
        const std::string ending = fmt::format("{{{{/{}}}}}\n", name);
        const auto last = text.find(ending);
        if (last == text.npos) throw std::logic_error(fmt::format("the part {} of the template has no end", name));
        if (!value_of(values, name).empty()) result += filled(text.substr(0, last), values);
        text.remove_prefix(last + ending.size());
    }
    result += text;
    return result;
}

} // namespace kaya
