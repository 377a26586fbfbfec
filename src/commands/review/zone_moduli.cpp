#include "commands/review/zone_moduli.hpp"

#include "base/diagnostic.hpp"
#include "base/lower_case.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace kaya {

namespace {

using Item = lang::Property::Item;
using Words = std::array<std::string_view, 3>;

constexpr Words young_words{"young", "ymod", "ymodulus"}, poisson_words{"poisson", "prat", "pratio"};

std::vector<Item>::const_iterator find_any(const std::vector<Item>& items, const Words& words) {
    return std::ranges::find_if(
        items, [&](const Item& item) { return std::ranges::find(words, lower_case(item.word)) != words.end(); });
}

} // namespace

std::vector<Item> with_moduli(const std::vector<Item>& items, const std::function<bool(const std::string&)>& has) {
    const auto young = find_any(items, young_words), poisson = find_any(items, poisson_words);
    if ((young == items.end() && poisson == items.end()) || has("young") || !has("bulk") || !has("shear")) return items;
    if (young == items.end() || poisson == items.end())
        throw Diagnostic("'young' and 'poisson' must stand on one line",
                         "they give bulk and shear: block zone property young 5e10 poisson 0.25")
            .at((young == items.end() ? poisson : young)->place);
    if (!(young->value > 0)) throw Diagnostic("'young' must be above 0").at(young->place);
    if (!(poisson->value > -1 && poisson->value < 0.5))
        throw Diagnostic("'poisson' must be above -1 and below 0.5").at(poisson->place);
    std::vector<Item> result;
    for (auto item = items.begin(); item != items.end(); ++item)
        if (item != young && item != poisson) result.push_back(*item);
    Item bulk = *young, shear = *young;
    bulk.word = "bulk";
    bulk.value = bulk_modulus(young->value, poisson->value);
    shear.word = "shear";
    shear.value = shear_modulus(young->value, poisson->value);
    result.insert(result.end(), {bulk, shear});
    return result;
}

} // namespace kaya
