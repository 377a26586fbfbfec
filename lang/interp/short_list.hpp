// The words that a hint shows for a place: all if they are few; else the nearest ones and the topic of `kaya help` that lists all.
#pragma once

#include "lang/interp/lexer.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya::lang {

class ShortList {
public:
    /// `typed` is the word that is not in the list, or null when no word was typed. A question (`?`) lists all words.
    ShortList(std::vector<std::string_view> all, std::string_view topic, const Word* typed);
    ShortList(const ShortList&) = delete;
    ShortList& operator=(const ShortList&) = delete;

    /// The words, and after those of a long list "...; 'kaya help TOPIC' lists all".
    const std::vector<std::string_view>& words() const { return words_; }
    /// "expected: ratio, force, cycles"
    std::string expected() const;

private:
    std::string rest_;
    std::vector<std::string_view> words_;
};

} // namespace kaya::lang
