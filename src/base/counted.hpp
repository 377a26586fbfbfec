// Numbers of things in sentences: "1 cycle", "3 cycles", "2 histories".
#pragma once

#include <fmt/format.h>
#include <string>
#include <string_view>

namespace kaya {

template <typename Number> std::string counted(Number number, std::string_view noun) {
    if (number == 1) return fmt::format("{} {}", number, noun);
    if (noun.ends_with("y")) return fmt::format("{} {}ies", number, noun.substr(0, noun.size() - 1));
    return fmt::format("{} {}s", number, noun);
}

} // namespace kaya
