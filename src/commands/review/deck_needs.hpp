// What blocks and joints need before the first cycle of a deck, and no line gives them.
#pragma once

#include "lang/commands/property_words.hpp"
#include "geometry/polyhedra/box_pairs.hpp"
#include "lang/commands/commands.hpp"
#include "lang/interp/bare_names.hpp"

#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace kaya {

/// Fed with the statements of a deck in their order, before any of it runs.
class DeckNeeds {
public:
    void check(const lang::BoundCommand& command, bool inside);
    /// A text of FISH or Lua, which may give properties.
    void check_script(std::string_view text);
    void anything_may_be_given() { open_ = true; }

    std::vector<Diagnostic> findings() const { return found_; }

private:
    void learn(const lang::BoundCommand& command);
    void learn_materials(const lang::BoundCommand& command);
    void learn_moduli(const std::vector<lang::Property::Item>& items);
    void learn_structures(const lang::BoundCommand& command);
    void check_needs(const Place& cycle);
    void check_moduli();
    void check_structures();

    std::set<std::int64_t> dense_;       ///< materials with a density
    std::map<std::int64_t, Place> used_; ///< materials of blocks, and the line that gives each first
    std::vector<Box> bricks_;
    bool blocks_ = false, cut_ = false;         ///< there are blocks, several of one shape
    bool some_held_ = false, all_held_ = false; ///< they need no density
    bool dense_by_range_ = false;               ///< blocks have separate densities
    bool joint_properties_ = false, joined_ = false;
    std::map<lang::BlockProperty, Place> moduli_; ///< properties of blocks, and the place of each first
    std::map<std::int64_t, Place> structures_;    ///< their properties, and the line that uses each first
    std::set<std::int64_t> structure_properties_;
    bool checked_ = false, open_ = false;
    std::vector<Diagnostic> found_;
};

} // namespace kaya
