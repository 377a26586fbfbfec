#include "lang/interp/short_list.hpp"

#include "base/nearest_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace kaya::lang {

ShortList::ShortList(std::vector<std::string_view> all, std::string_view topic, const Word* typed)
    : words_(std::move(all)) {
    constexpr std::size_t most_listed = 8, shown = 6;
    if (words_.size() <= most_listed || (typed && typed->text == "?")) return;
    // No word is near to a number, or to nothing: the table begins with the commonest ones.
    if (typed && typed->kind == WordKind::word) words_ = nearest_words(typed->folded, std::move(words_), shown);
    words_.resize(shown);
    rest_ = fmt::format("...; 'kaya help {}' lists all", topic);
    words_.push_back(rest_);
}

std::string ShortList::expected() const { return fmt::format("expected: {}", fmt::join(words_, ", ")); }

} // namespace kaya::lang
