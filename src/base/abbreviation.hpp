// Words that are shortened in each of their parts.
#pragma once

#include <string_view>

namespace kaya {

/// Whether each part of `typed` begins the same part of `word`: `gen-sub` shortens `generate-subcontacts`. False for a word of one part.
inline bool shortens_each_part(std::string_view typed, std::string_view word, char between) {
    if (typed.find(between) == std::string_view::npos) return false;
    for (;;) {
        const auto end = word.find(between), typed_end = typed.find(between);
        const std::string_view part = typed.substr(0, typed_end);
        if (part.empty() || !word.substr(0, end).starts_with(part)) return false;
        if (end == std::string_view::npos || typed_end == std::string_view::npos) return end == typed_end;
        word.remove_prefix(end + 1);
        typed.remove_prefix(typed_end + 1);
    }
}

} // namespace kaya
