#include "laws/given_values.hpp"

#include "base/diagnostic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kaya {

std::vector<double> values_of(const LawTable& law, const char* noun,
                              const std::vector<std::pair<std::string, double>>& given) {
    std::vector<double> values;
    for (const auto& p : law.properties) values.push_back(p.initial);
    for (const auto& [word, value] : given) {
        const auto index = law.find_property(word);
        if (!index) {
            const auto names = law.property_words();
            const auto near = did_you_mean(word, names);
            throw Diagnostic(fmt::format("{} {} has no property '{}'", noun, law.name, word),
                             near.empty() ? fmt::format("its properties: {}", fmt::join(names, ", "))
                                          : fmt::format("did you mean '{}'?", near));
        }
        const auto& p = law.properties[*index];
        if (!p.holds(value))
            throw Diagnostic(fmt::format("{} is {:g}; it must be {}", p.name, value, p.limits_in_words()),
                             "give a value within the limits");
        values[*index] = value;
    }
    return values;
}

} // namespace kaya
