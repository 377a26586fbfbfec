// The running deck: its definitions so far, and the present position in it.
#pragma once

#include "base/units.hpp"
#include "commands/session/given_properties.hpp"
#include "commands/ranges/ranges.hpp"
#include "commands/ranges/surface_sets.hpp"

#include "lang/interp/interpreter.hpp"
#include "lang/script/values/world.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace kaya {

/// A word of `prop`.
struct PropertyWord {
    Place place;
    bool of_joints = false; ///< given for joints: `prop jmat`
};

class Deck {
public:
    explicit Deck(lang::InterpreterHost& host);

    /// "tunnel.3dd:12" of the running command, "" outside a deck.
    std::string here() const;

    /// A file of a deck: beside the deck if it exists there, else in the current folder.
    std::filesystem::path next_to_deck(const std::string& name) const;

    /// Keeps the text of a command for save files.
    void take_source(const Place& place);

    lang::Interpreter interpreter;
    NamedRanges ranges;
    SurfaceSets surface_sets;
    std::map<std::string, script::Value> parameters; ///< of `param` and `kaya --set`, by folded name; `new` keeps them
    GivenProperties given_properties;                ///< of `param` and `kaya --set`; they replace values of the deck
    std::string title;
    Units units;      ///< `set units`
    std::string file; ///< name of the deck that runs, for default names of output files
    std::vector<std::shared_ptr<const SourceText>> sources; ///< texts of the decks that ran, for save files
    std::map<std::pair<std::int32_t, std::string>, PropertyWord> property_words; ///< of `prop`, for late messages
    Place last_place;         ///< of the last command, for errors without a place
    bool modern_line = false; ///< the last command is of the modern dialect

    /// The one of two texts that has the words of that line.
    template <class Text> Text in_words(Text classic, Text modern) const { return modern_line ? modern : classic; }
};

/// Checks when a deck is bound, before its first command runs: whether FISH compiles.
lang::Checks deck_checks();

} // namespace kaya
