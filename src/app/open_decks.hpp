// The decks of an editor: those that it shows, as they are typed, and those that they call, as their files are.
#pragma once

#include "app/open_deck.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace kaya {

/// "file:///a%20b" as a path, and back.
std::string path_of(const std::string& uri);
std::string uri_of(const std::filesystem::path& path);

/// The file of a line `call NAME` of the deck at `path`; none for other lines, and where the name is known at run time only.
std::optional<std::filesystem::path> called_file(const OpenDeck::Stretch& stretch, const std::string& path);

class OpenDecks {
public:
    void open(const std::string& uri, std::string text);
    void close(const std::string& uri) { open_.erase(uri); }
    /// Null when the editor does not show it. After a change of the text, `changed` is called.
    std::string* text(const std::string& uri);
    void changed(const std::string& uri);
    /// Of an open deck. Throws Diagnostic when the text is not that of a deck.
    const OpenDeck& deck(const std::string& uri);

    struct Member {
        std::string uri;
        const OpenDeck* deck;
    };
    /// The decks that share the names of an open one: itself, those that it calls, and the open ones that call it, with theirs. Valid until
    /// the next change.
    std::vector<Member> family(const std::string& uri);

private:
    struct Text {
        std::string text;
        std::unique_ptr<OpenDeck> deck;
    };
    struct File {
        std::filesystem::file_time_type written;
        std::unique_ptr<OpenDeck> deck;
    };

    /// The deck of a file, open or not; null where there is no such file. Throws Diagnostic when it is not a deck.
    Member member(const std::filesystem::path& path);
    /// Adds the deck and those that it calls, which are not in `seen`.
    void add_tree(const Member& root, std::vector<Member>& to, std::set<std::filesystem::path>& seen);

    std::map<std::string, Text> open_;            ///< by uri
    std::map<std::filesystem::path, File> files_; ///< called, and not open
};

} // namespace kaya
