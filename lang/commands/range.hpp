// The bound range phrase: its words, before any object is selected.
#pragma once

#include "base/diagnostic.hpp"
#include "base/vector.hpp"
#include "lang/commands/range_kinds.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace kaya::lang {

/// One element of a range phrase.
struct RangeElement {
    using Kind = RangeKind;
    static constexpr Kind last_kind = RangeKind::network;
    Kind kind = Kind::x;
    double low = 0, high = 0;
    Vec3 centre = Vec3::Zero(), end2 = Vec3::Zero(), normal = Vec3::UnitZ();
    double radius1 = 0, radius2 = 0, distance = 0;
    int side = 0;
    std::string name, second_name;
    std::vector<std::string> sets; ///< of surfaces, in lower case
    std::vector<std::int64_t> numbers;
    std::vector<Vec3> vertices;
    bool both = false; ///< `matches 2`: both blocks of a contact
    bool negated = false;
    Place place;
};

struct RangePhrase {
    std::vector<RangeElement> elements; ///< none: everything visible
    bool any = false;                   ///< `union`: one element is enough
    Place place;                        ///< of the word `range`; empty when there is no phrase
    bool whole = false;                 ///< `extent`: all corners of an object, not only its place
};

} // namespace kaya::lang
