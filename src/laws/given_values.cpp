#include "laws/given_values.hpp"

#include "base/diagnostic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

std::size_t accepting_property(const LawTable& law, const char* noun, const std::string& word, double value) {
    const auto index = law.find_property(word);
    if (!index) {
        const auto near = did_you_mean(word, law.property_words());
        std::vector<std::string_view> names;
        for (const auto& property : law.properties) names.push_back(property.name);
        Diagnostic d(fmt::format("{} '{}' has no property '{}'", noun, law.name, word),
                     near.empty() ? fmt::format("it has: {}", fmt::join(names, ", "))
                                  : fmt::format("did you mean '{}'?", near));
        d.code = "unknown-property";
        throw d;
    }
    const auto& property = law.properties[*index];
    if (!property.holds(value))
        throw Diagnostic(fmt::format("'{}' is {:.6g}, but for {} {} it must be {}", word, value, noun, law.name,
                                     property.limits_in_words()));
    return *index;
}

std::vector<double> values_of(const LawTable& law, const char* noun,
                              const std::vector<std::pair<std::string, double>>& given) {
    std::vector<double> values;
    for (const auto& p : law.properties) values.push_back(p.initial);
    for (const auto& [word, value] : given) values[accepting_property(law, noun, word, value)] = value;
    return values;
}

} // namespace kaya
