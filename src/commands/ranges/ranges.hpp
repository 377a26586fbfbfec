// Range phrases of the language become tests of the engine.
#pragma once

#include "commands/ranges/surface_sets.hpp"
#include "lang/commands/range.hpp"
#include "geometry/ground/ground.hpp"
#include "model/kinds/selection.hpp"

#include <map>
#include <string>

namespace kaya {

class JointRegistry;

/// Phrases stored by `range name NAME ...`; names are lower case.
using NamedRanges = std::map<std::string, lang::RangePhrase>;

/// Additional inputs of some elements.
struct RangeExtras {
    const JointRegistry* joints = nullptr;                 ///< for states of joint models
    std::function<Ground(const std::string&)> ground = {}; ///< reads the file of a ground surface
    std::function<const PolygonSet*(const std::string&)> surfaces =
        {}; ///< a set of `geometry set`; null: there is none
    std::function<const std::map<std::string, Network>&()> networks = {}; ///< of fractures
    bool excavated = false; ///< the model is that of the blocks that fill can put back
};

/// Whether a phrase, or a named range in it, has an element of that kind.
bool has_element(const NamedRanges& named, const lang::RangePhrase& phrase, lang::RangeElement::Kind kind);

/// Whether a phrase needs more than a place.
bool asks_for_objects(const NamedRanges& named, const lang::RangePhrase& phrase);

/// The test of a phrase for objects of that kind. Limits are inclusive, with a tolerance of 1e-6 of the model's size; one value means a
/// plane. Properties of blocks (group, material, region) match a contact when one of its two blocks has them. An empty phrase gives an
/// empty test. Throws Diagnostic at the element: unknown group or named range, or an element that cannot select objects of that kind.
RangeTest range_test(const Model& model, const NamedRanges& named, const lang::RangePhrase& phrase, ObjectKind kind,
                     const RangeExtras& extras = {});

} // namespace kaya
