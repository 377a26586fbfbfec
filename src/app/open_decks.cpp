#include "app/open_decks.hpp"

#include "lang/commands/language.hpp"
#include "lang/interp/binder.hpp"
#include "lang/interp/command_words.hpp"
#include "lang/interp/source.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <system_error>

namespace kaya {

namespace fs = std::filesystem;

namespace {

fs::path same_path(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

} // namespace

std::string path_of(const std::string& uri) {
    constexpr std::string_view scheme = "file://";
    if (!uri.starts_with(scheme)) return uri;
    std::string path;
    for (std::size_t i = scheme.size(); i < uri.size(); ++i) {
        unsigned code = 0;
        const char* const digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
            path += static_cast<char>(code);
            i += 2;
        } else path += uri[i];
    }
    return path;
}

std::string uri_of(const fs::path& path) {
    constexpr std::string_view plain = "/-_.~";
    std::string uri = "file://";
    for (const char c : same_path(path).string())
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || plain.find(c) != plain.npos) uri += c;
        else uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return uri;
}

std::optional<fs::path> called_file(const OpenDeck::Stretch& stretch, const std::string& path) {
    try {
        const auto found = lang::find_command(lang::language(), stretch.statement);
        if (found.spec->flow != lang::Flow::call) return std::nullopt;
        const auto bound = lang::bind_statement(lang::language(), stretch.statement);
        if (bound.late) return std::nullopt;
        return lang::find_deck(found.spec->called_file(bound.command), {fs::path(path).parent_path(), "."});
    } catch (const Diagnostic&) { return std::nullopt; } // check reports it
}

void OpenDecks::open(const std::string& uri, std::string text) { open_[uri] = {std::move(text), nullptr}; }

std::string* OpenDecks::text(const std::string& uri) {
    const auto found = open_.find(uri);
    return found == open_.end() ? nullptr : &found->second.text;
}

void OpenDecks::changed(const std::string& uri) { open_.at(uri).deck.reset(); }

const OpenDeck& OpenDecks::deck(const std::string& uri) {
    Text& open = open_.at(uri);
    if (!open.deck) open.deck = std::make_unique<OpenDeck>(open.text);
    return *open.deck;
}

OpenDecks::Member OpenDecks::member(const fs::path& path) {
    for (const auto& [uri, open] : open_)
        if (same_path(path_of(uri)) == path) return {uri, &deck(uri)};
    const std::string uri = uri_of(path);
    std::error_code failed;
    const auto written = fs::last_write_time(path, failed);
    if (failed) return {uri, nullptr};
    File& file = files_[path];
    if (file.deck && file.written == written) return {uri, file.deck.get()};
    const auto source = lang::read_source(path, path.string());
    std::string text;
    for (const auto& line : source->lines) text += line + "\n";
    file = {written, std::make_unique<OpenDeck>(text)};
    return {uri, file.deck.get()};
}

void OpenDecks::add_tree(const Member& root, std::vector<Member>& to, std::set<fs::path>& seen) {
    const fs::path path = same_path(path_of(root.uri));
    if (root.deck == nullptr || !seen.insert(path).second) return;
    to.push_back(root);
    for (const auto& stretch : root.deck->stretches()) {
        const auto called = called_file(stretch, path.string());
        if (!called) continue;
        try {
            add_tree(member(same_path(*called)), to, seen);
        } catch (const Diagnostic&) { continue; } // check reports it
    }
}

std::vector<OpenDecks::Member> OpenDecks::family(const std::string& uri) {
    std::vector<Member> all;
    std::set<fs::path> seen;
    add_tree({uri, &deck(uri)}, all, seen);
    for (const auto& [other, open] : open_) {
        std::vector<Member> tree;
        std::set<fs::path> of_tree;
        try {
            add_tree({other, &deck(other)}, tree, of_tree);
        } catch (const Diagnostic&) { continue; } // not a deck
        if (!of_tree.contains(same_path(path_of(uri)))) continue;
        for (auto& one : tree)
            if (seen.insert(same_path(path_of(one.uri))).second) all.push_back(std::move(one));
    }
    return all;
}

} // namespace kaya
