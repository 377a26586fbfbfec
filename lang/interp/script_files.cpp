#include "lang/interp/script_files.hpp"

#include <algorithm>
#include <array>

namespace kaya::lang {

bool may_write_files(std::string_view script) {
    static constexpr std::array<std::string_view, 8> writers{"open", "io",  "write",  "save",
                                                             "call", "lua", "dofile", "require"};
    const auto in_word = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    for (std::size_t i = 0; i < script.size();) {
        const std::size_t first = i;
        while (i < script.size() && in_word(script[i])) ++i;
        if (i == first) {
            ++i;
            continue;
        }
        if (script.substr(first).starts_with("io.out")) continue; // prints
        if (std::ranges::find(writers, fold(script.substr(first, i - first))) != writers.end()) return true;
    }
    return false;
}

bool may_write_files(const BoundCommand& command) {
    if (command.spec->body_end.empty()) return false;
    const std::string text = command.text(); // a chunk begins with the word lua
    const auto first = text.find('\n');
    return first != text.npos && may_write_files(std::string_view(text).substr(first));
}

} // namespace kaya::lang
