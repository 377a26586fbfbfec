// What can be said of a whole deck when it has been read and before it runs: its names of FISH, its Lua, the files that
// it wants to read.
#pragma once

#include "commands/deck_materials.hpp"
#include "commands/deck_names.hpp"
#include "lang/commands/commands.hpp"
#include "lang/interp/deck.hpp"

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace kaya {

/// Walks over a deck, the files that it calls, and the commands inside its FISH functions.
class DeckReview {
public:
    /// All are kept by reference. `folders` are where files of data are looked for.
    DeckReview(const lang::BareNames& bare, const script::Scripts& scripts, std::vector<std::filesystem::path> folders)
        : bare_(bare), folders_(std::move(folders)), names_(scripts) {}

    // For those who want to see what the review sees; each may stay empty.
    std::function<void(const lang::BoundFile&)> on_file;
    std::function<void(const lang::BoundCommand&)> on_statement;
    /// A command inside a function that does not bind, or (empty) that is known at run time only.
    std::function<void(const Diagnostic*)> on_inner;

    void file(const lang::BoundFile& file);

    /// Errors are what must fail when its line is reached, warnings what may be a slip of the pen.
    std::vector<Diagnostic> findings() const;

private:
    void statement(const lang::BoundCommand& command, bool inside);
    void inside(const lang::FishDefinition& definition);
    void doubt_last_line(const SourceText& source);
    void doubt_values(const lang::Set& set, const lang::BoundCommand& command);
    void find_file(const lang::BoundCommand& command);
    void anything_may_be_made();
    void check_lua_file(const std::filesystem::path& path, const std::string& name, const Place& place);

    const lang::BareNames& bare_;
    std::vector<std::filesystem::path> folders_;
    DeckNames names_;
    DeckMaterials materials_;
    std::vector<Diagnostic> other_;
    std::set<const lang::BoundFile*> seen_;
    std::set<std::string> earlier_words_; ///< a command in front that names a file may write it
    std::set<std::string> defined_;       ///< functions of the deck, whose texts tell
    bool may_have_written_ = false; ///< so may a script that can write files, and a line that is known at run time only
};

} // namespace kaya
