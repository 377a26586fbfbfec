#include "commands/session/given_properties.hpp"

#include "base/diagnostic.hpp"
#include "commands/review/property_meaning.hpp"
#include "lang/interp/lexer.hpp"

#include <charconv>
#include <fmt/format.h>
#include <sstream>

namespace kaya {

void GivenProperties::give(const std::string& name, double value, const Place& place) {
    std::istringstream stream(lang::fold(name));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    const auto refuse = [&] {
        throw Diagnostic(fmt::format("'{}' is not the name of a property", name),
                         "write 'prop 1 jfric' or 'jmodel jfric'")
            .at(place);
    };
    std::int64_t number = of_jmodel;
    if (words.size() >= 3 && std::string("property").starts_with(words[0]) && words[0].size() >= 2) {
        words.erase(words.begin());
        if (words.size() == 3 && (words[0] == "mat" || words[0] == "jmat")) words.erase(words.begin());
        const char* end = words[0].data() + words[0].size();
        if (const auto [stop, failed] = std::from_chars(words[0].data(), end, number);
            failed != std::errc() || stop != end || number < 1)
            refuse();
    } else if (words.size() != 2 || words[0] != "jmodel") {
        refuse();
    }
    if (words.size() != 2) refuse();
    values_.try_emplace({number, whole_property_word(words[1])}, Given{name, value});
}

std::vector<lang::Property::Item> GivenProperties::replaced(std::vector<lang::Property::Item> items,
                                                            std::int64_t number) {
    if (values_.empty()) return items;
    for (auto& item : items) {
        const auto found = values_.find({number, whole_property_word(item.word)});
        if (found == values_.end()) continue;
        item.value = found->second.value;
        found->second.used = true;
    }
    return items;
}

std::vector<std::string> GivenProperties::unused() const {
    std::vector<std::string> names;
    for (const auto& [key, given] : values_)
        if (!given.used) names.push_back(given.name);
    return names;
}

} // namespace kaya
