// Checks of a whole deck after reading and before running: names of FISH, Lua, files to be read.
#pragma once

#include "commands/deck_materials.hpp"
#include "commands/deck_names.hpp"
#include "commands/deck_properties.hpp"
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
    using Folders = std::vector<std::filesystem::path>;
    /// Names and scripts are kept by reference. `folders` are searched for data files, `own_joints` for models.
    DeckReview(const lang::BareNames& bare, const script::Scripts& scripts, Folders folders, const Folders& own_joints)
        : bare_(bare), folders_(std::move(folders)), names_(scripts) {
        laws_.set_path(own_joints);
    }

    // Optional callbacks that see the files of the review.
    std::function<void(const lang::BoundFile&)> on_file;
    std::function<void(const lang::BoundCommand&)> on_statement;
    /// A command inside a function that does not bind, or (empty) that is known at run time only.
    std::function<void(const Diagnostic*)> on_inner;

    void file(const lang::BoundFile& file);

    /// Errors are certain failures when their line is reached, warnings are likely misspellings.
    std::vector<Diagnostic> findings();

private:
    void statement(const lang::BoundCommand& command, bool inside);
    void inside(const lang::FishDefinition& definition);
    void doubt_last_line(const SourceText& source);
    void doubt_values(const lang::Set& set, const lang::BoundCommand& command);
    void find_file(const lang::BoundCommand& command);
    void anything_may_be_made();
    void check_script(std::string_view text);
    void check_lua_file(const std::filesystem::path& path, const std::string& name, const Place& place);

    const lang::BareNames& bare_;
    Folders folders_;
    DeckNames names_;
    DeckMaterials materials_;
    DeckProperties properties_;
    JointRegistry laws_;
    std::vector<Diagnostic> other_;
    std::set<const lang::BoundFile*> seen_;
    std::set<std::string> earlier_words_; ///< a command in front that names a file may write it
    std::set<std::string> defined_;       ///< functions of the deck, whose text is known
    bool may_have_written_ = false;       ///< set by scripts that can write files, and by lines known at run time only
};

} // namespace kaya
