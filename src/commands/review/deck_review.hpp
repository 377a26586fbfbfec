// Checks of a whole deck after reading and before running: names of FISH, Lua, files to be read.
#pragma once

#include "commands/review/deck_lua.hpp"
#include "commands/review/deck_materials.hpp"
#include "commands/review/deck_names.hpp"
#include "commands/review/deck_needs.hpp"
#include "commands/review/deck_objects.hpp"
#include "commands/review/deck_properties.hpp"
#include "lang/commands/commands.hpp"
#include "lang/interp/deck.hpp"

#include <filesystem>
#include <functional>
#include <map>
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
        : bare_(bare), scripts_(scripts), folders_(std::move(folders)), model_folders_(folders_), names_(scripts) {
        laws_.set_path(own_joints);
    }

    // Optional callbacks that see the files of the review.
    std::function<void(const lang::BoundFile&)> on_file;
    std::function<void(const lang::BoundCommand&)> on_statement;
    /// A command inside a function that does not bind, or (empty) that is known at run time only.
    std::function<void(const Diagnostic*)> on_inner;

    void file(const lang::BoundFile& file);
    /// Models in these folders are there, and are not loaded.
    void models_are_in(const Folders& folders) {
        model_folders_.insert(model_folders_.end(), folders.begin(), folders.end());
    }
    /// A model is there already, with groups, tables, histories of other decks.
    void continues_a_model() {
        objects_.anything_may_be_made();
        needs_.anything_may_be_given();
    }

    /// Errors are certain failures when their line is reached, warnings are likely misspellings.
    std::vector<Diagnostic> findings();

private:
    void statement(const lang::BoundCommand& command, bool inside);
    void inside(const lang::FishDefinition& definition);
    void doubt_last_line(const SourceText& source);
    void doubt_values(const lang::Set& set, const lang::BoundCommand& command);
    void find_file(const lang::BoundCommand& command);
    void find_folder(const lang::BoundCommand& command);
    void doubt_text(const lang::BoundCommand& command);
    void doubt_letters(const lang::BoundCommand& command);
    void doubt_comment(const lang::BoundCommand& command);
    bool reads_as_command(const std::string& text) const;
    void doubt_second_definition(const lang::FishDefinition& definition, const std::string& name);
    bool may_write_when_called(const std::string& expression) const;
    void anything_may_be_made();
    void check_script(std::string_view text);
    void check_lua(std::string_view text, const Place& place);
    void check_lua_file(const std::filesystem::path& path, const std::string& name, const Place& place);

    const lang::BareNames& bare_;
    const script::Scripts& scripts_;
    Folders folders_, model_folders_;
    DeckNames names_;
    DeckMaterials materials_;
    DeckProperties properties_;
    DeckObjects objects_;
    DeckNeeds needs_;
    DeckLua lua_;
    JointRegistry laws_;
    std::vector<Diagnostic> other_;
    std::set<const lang::BoundFile*> seen_;
    std::set<std::string> earlier_words_;  ///< a command in front that names a file may write it
    std::map<std::string, Place> defined_; ///< functions of the deck, whose text is known
    std::set<std::string> unused_;         ///< functions behind the last line that is none
    bool may_have_written_ = false;        ///< set by scripts that can write files, and by lines known at run time only
};

} // namespace kaya
