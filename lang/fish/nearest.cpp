#include "lang/fish/nearest.hpp"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <array>

namespace kaya::fish {

namespace {

/// "gp_" of gp_xvel, "block.gp." of block.gp.vel; empty for a name without parts.
std::string_view family(std::string_view name) {
    const auto point = name.rfind('.');
    const auto end = point != name.npos ? point : name.find('_');
    return end == name.npos ? std::string_view{} : name.substr(0, end + 1);
}

/// Letters that number objects: names that differ by one of them only are different objects of the same kind.
bool both_count(char a, char b) {
    constexpr std::array<std::string_view, 5> series{"0123456789", "xyz", "ijklmn", "abcd", "uvw"};
    return std::ranges::any_of(series, [=](std::string_view letters) {
        return letters.find(a) != letters.npos && letters.find(b) != letters.npos;
    });
}

} // namespace

std::string_view nearest_name(std::string_view word, const std::vector<std::string_view>& candidates) {
    const std::string_view kind = family(word);
    if (kind.empty()) return did_you_mean(word, candidates);
    const std::string_view what = word.substr(kind.size());
    std::vector<std::string_view> kinds, same_kind; // of names with the same end, ends of names with the same beginning
    std::vector<std::string_view> same_end;
    for (const auto candidate : candidates) {
        const std::string_view its_kind = family(candidate);
        if (its_kind == kind) same_kind.push_back(candidate.substr(kind.size()));
        if (its_kind.empty() || candidate.substr(its_kind.size()) != what) continue;
        kinds.push_back(its_kind);
        same_end.push_back(candidate);
    }
    const auto whole = [&](std::string_view start, std::string_view end) {
        const auto found = std::ranges::find_if(candidates, [&](std::string_view c) {
            return c.size() == start.size() + end.size() && c.starts_with(start) && c.ends_with(end);
        });
        return found == candidates.end() ? std::string_view{} : *found;
    };
    if (const auto near = did_you_mean(kind, kinds); !near.empty()) return whole(near, what);
    constexpr std::size_t telling = 4; // letters that two names do not share by chance
    if (!same_end.empty() && what.size() >= telling) return same_end.front();
    if (const auto near = did_you_mean(what, same_kind); !near.empty()) return whole(kind, near);
    return did_you_mean(word, candidates);
}

bool is_one_slip(std::string_view one, std::string_view other) {
    if (one.size() > other.size()) std::swap(one, other);
    const auto [left, right] = std::ranges::mismatch(one, other);
    const std::string_view rest(left, one.end()), other_rest(right, other.end());
    if (other.size() == one.size() + 1) // one letter more
        return rest == other_rest.substr(1) && !both_count(other_rest.front(), '0');
    if (other.size() != one.size() || rest.empty()) return false;
    if (rest.substr(1) == other_rest.substr(1)) {
        const bool first = rest.size() == one.size(), last = rest.size() == 1;
        const bool alone = (first || one[one.size() - rest.size() - 1] == '_') && (last || rest[1] == '_');
        return !alone && !both_count(rest.front(), other_rest.front()); // i_max and n_max are two
    }
    return rest.size() >= 2 && rest[0] == other_rest[1] && rest[1] == other_rest[0] &&
           rest.substr(2) == other_rest.substr(2);
}

} // namespace kaya::fish
