// Typing errors: words with one wrong letter.
#pragma once

#include <random>
#include <set>
#include <string>
#include <string_view>

namespace kaya {

/// Of `word`: each letter left out, doubled, exchanged with the next one, and twice replaced by any other (seeded).
inline std::set<std::string> one_letter_slips(std::string_view word, std::mt19937_64& random) {
    std::set<std::string> slips;
    std::uniform_int_distribution<int> letter('a', 'z');
    for (std::size_t i = 0; i < word.size(); ++i) {
        const std::string whole(word);
        slips.insert(std::string(whole).erase(i, 1));
        slips.insert(std::string(whole).insert(i, 1, word[i]));
        if (i + 1 < word.size()) {
            std::string swapped = whole;
            std::swap(swapped[i], swapped[i + 1]);
            slips.insert(swapped);
        }
        for (int k = 0; k < 2; ++k) {
            std::string replaced = whole;
            replaced[i] = static_cast<char>(letter(random));
            slips.insert(replaced);
        }
    }
    slips.erase(std::string(word));
    slips.erase("");
    return slips;
}

} // namespace kaya
