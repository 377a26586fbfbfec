#include "lang/fish/meaning.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::fish {

bool is_constant(std::string_view name) {
    return std::ranges::find(classic_constants, name, &ClassicConstant::name) != classic_constants.end();
}

bool makes_value(std::string_view name) {
    constexpr std::array<std::string_view, 5> makers{"list", "map", "tensor", "matrix", "boolean"};
    return std::ranges::find(makers, name) != makers.end();
}

void check_arguments(const std::string& name, int given, const Meaning& meaning, const Place& place) {
    if (given >= meaning.least && given <= meaning.most) return;
    const std::string wanted = meaning.least == meaning.most ? fmt::format("{}", meaning.least)
                                                             : fmt::format("{} to {}", meaning.least, meaning.most);
    throw Diagnostic(fmt::format("'{}' takes {} argument{}, here it is given {}", name, wanted,
                                 meaning.most == 1 ? "" : "s", given == 0 ? "none" : std::to_string(given)))
        .at(place);
}

} // namespace kaya::fish
