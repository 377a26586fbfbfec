// Names of FISH in a deck: which are used and never made, made and never used, called with too few arguments.
#pragma once

#include "lang/fish/name_uses.hpp"
#include "lang/interp/bare_names.hpp"
#include "lang/script/scripts/scripts.hpp"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// Fed with the statements of a deck in their order, before any of it runs.
class DeckNames {
public:
    /// `scripts` knows built-in names and those of earlier decks.
    explicit DeckNames(const script::Scripts& scripts) : scripts_(scripts) {}

    /// `inside`: the command stands in a FISH function, and its names may be local ones.
    void check(const lang::BoundCommand& command, bool inside);
    /// A text of Lua: any word of it may be a name that it sets or reads.
    void check_lua(std::string_view text);
    /// Files unknown before the run may create any name.
    void anything_may_be_made() { open_ = true; }

    /// In the order of use. Errors are certain failures when their line is reached, warnings are likely misspellings.
    std::vector<Diagnostic> findings() const;

private:
    void use_words(const lang::BoundCommand& command);
    void learn_function(const std::string& text, const Place& place);
    void learn_expression(const lang::Word& word);
    void add(fish::NameUse use, bool of_command);

    bool is_made(const std::string& name) const;
    fish::Meaning meaning_of(const std::string& name) const;
    std::vector<std::string_view> candidates() const;
    void find_unknown(std::vector<Diagnostic>& found) const;
    void find_early(std::vector<Diagnostic>& found) const;
    void find_unread(std::vector<Diagnostic>& found) const;

    struct Used {
        fish::NameUse use;
        bool of_command; ///< of a command of the deck: an undefined name fails
    };
    const script::Scripts& scripts_;
    std::map<std::string, fish::Meaning> functions_; ///< of the deck, with all accepted numbers of arguments
    std::set<std::string> mentioned_;                ///< exist, with the value 0 if nothing sets them
    std::set<std::string> made_, read_;
    std::vector<Used> used_;
    std::vector<fish::NameUse> set_;            ///< each name where it is set first
    std::map<std::string, Place> first_places_; ///< where each function stands, and each name is set first
    std::vector<fish::NameUse> early_;          ///< uses in commands of names that nothing before them makes
    std::vector<Diagnostic> broken_;            ///< expressions in brackets that cannot be read
    bool open_ = false;
};

} // namespace kaya
