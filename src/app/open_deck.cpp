#include "app/open_deck.hpp"

#include "lang/interp/binder.hpp"
#include "lang/modern/language.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

namespace kaya {

namespace {

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool in_name(char c) {
    return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '$';
}
bool in_word(char c) { return in_name(c) || c == '-'; }

/// Bytes of the character of UTF-8 that begins there; 1 for what is none.
std::size_t bytes_of(char first) {
    const auto c = static_cast<unsigned char>(first);
    return c < 0xc0 ? 1 : c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4;
}

/// Commands whose words may be names of functions, by the beginning of their first word.
bool names_functions(const std::string& first) {
    constexpr std::array commands{"fish", "set", "history", "print", "list", "program", "whilestepping"};
    return first.size() > 1 &&
           std::ranges::any_of(commands, [&](std::string_view whole) { return whole.starts_with(first); });
}

/// Where the comment of a line begins; its length where there is none.
std::size_t comment_of(const std::string& line, bool lua) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\'' || line[i] == '"') {
            const auto close = line.find(line[i], i + 1);
            if (close == line.npos) return line.size();
            i = close;
        } else if (lua ? line.compare(i, 2, "--") == 0 : line[i] == ';') return i;
    }
    return line.size();
}

/// Calls see(begin, end) for each name of a line; texts in quotes and comments are passed over.
template <class See>
void names_of_line(const std::string& line, std::size_t from, std::size_t to, bool lua, const See& see) {
    to = std::min(to, comment_of(line, lua));
    for (std::size_t i = from; i < to;) {
        const char c = line[i];
        const std::size_t begin = i;
        if (c == '\'' || c == '"') {
            const auto close = line.find(c, i + 1);
            if (close == line.npos) return;
            i = close + 1;
        } else if (begins_name(c)) {
            while (i < to && in_name(line[i]) && !(lua && line[i] == '.')) ++i;
            see(begin, i);
        } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
            while (i < to && in_name(line[i])) ++i; // 1e5
        } else ++i;
    }
}

} // namespace

std::size_t utf16_of(std::string_view line, std::size_t byte) {
    std::size_t units = 0;
    for (std::size_t i = 0; i < std::min(byte, line.size());) {
        const std::size_t bytes = bytes_of(line[i]);
        units += bytes == 4 ? 2 : 1;
        i += bytes;
    }
    return units;
}

std::size_t byte_of(std::string_view line, std::size_t utf16) {
    std::size_t i = 0;
    for (std::size_t units = 0; i < line.size() && units < utf16;) {
        const std::size_t bytes = bytes_of(line[i]);
        units += bytes == 4 ? 2 : 1;
        i += bytes;
    }
    return std::min(i, line.size());
}

OpenDeck::OpenDeck(std::string_view text) {
    const auto source = lang::source_from_text("deck", text);
    lines_ = source->lines;
    lang::Lexer lexer(source);
    lang::Statement statement;
    for (;;) {
        const int begin = lexer.line();
        bool more = true;
        try {
            more = lang::next_statement(lang::language(), lexer, statement);
        } catch (const Diagnostic&) { // a function without end: the rest of the text is its body
            if (lexer.line() <= begin) lexer.go_to(begin + 1);
            statement.first_line = begin;
            statement.last_line = begin;
        }
        if (!more) break;
        Stretch stretch;
        stretch.first = statement.first_line - 1;
        stretch.last = std::min(std::max(lexer.line() - 2, stretch.first), static_cast<int>(lines_.size()) - 1);
        stretch.body = stretch.last + 1;
        if (statement.body_place && !statement.words.empty()) // after the line that begins it
            stretch.body = std::max(statement.body_place.line - 1, statement.words.back().place.line);
        stretch.lua = !statement.words.empty() && statement.words.front().folded == "lua";
        stretch.statement = statement;
        stretches_.push_back(std::move(stretch));
        statement = {};
    }
    find_functions();
}

void OpenDeck::find_functions() {
    for (const auto& stretch : stretches_) {
        if (stretch.body > stretch.last || stretch.lua || stretch.statement.words.size() < 2) continue;
        const auto& words = stretch.statement.words;
        const std::size_t at = words.front().folded == "fish" && words.size() > 2 ? 2 : 1;
        const std::string& text = words[at].text;
        const std::string name =
            text.substr(0, std::ranges::find_if(text, [](char c) { return !in_name(c); }) - text.begin());
        if (name.empty()) continue;
        const std::size_t begin = static_cast<std::size_t>(std::max(words[at].place.column - 1, 0));
        FishFunction function{name, {stretch.first, begin, begin + name.size()}, {}};
        int above = stretch.first;
        while (above > 0 && lines_[static_cast<std::size_t>(above) - 1].find_first_not_of(" \t") != std::string::npos &&
               lines_[static_cast<std::size_t>(above) - 1]
                     [lines_[static_cast<std::size_t>(above) - 1].find_first_not_of(" \t")] == ';')
            --above;
        for (int line = above; line <= stretch.first; ++line)
            function.head += lines_[static_cast<std::size_t>(line)] + "\n";
        functions_.push_back(std::move(function));
    }
}

const OpenDeck::FishFunction* OpenDeck::function(std::string_view folded) const {
    const auto found =
        std::ranges::find_if(functions_, [&](const FishFunction& one) { return lang::fold(one.name) == folded; });
    return found == functions_.end() ? nullptr : &*found;
}

const OpenDeck::Stretch* OpenDeck::stretch_at(int line) const {
    const auto after = std::ranges::upper_bound(stretches_, line, {}, &Stretch::first);
    if (after == stretches_.begin()) return nullptr;
    const Stretch& found = *std::prev(after);
    return line <= found.last ? &found : nullptr;
}

std::string OpenDeck::text_of(const Piece& piece) const {
    return lines_[static_cast<std::size_t>(piece.line)].substr(piece.begin, piece.end - piece.begin);
}

std::optional<OpenDeck::Piece> OpenDeck::word_at(const Spot& spot) const {
    if (spot.line < 0 || static_cast<std::size_t>(spot.line) >= lines_.size()) return std::nullopt;
    const std::string& line = lines_[static_cast<std::size_t>(spot.line)];
    const Stretch* stretch = stretch_at(spot.line);
    if (spot.byte > comment_of(line, stretch != nullptr && stretch->lua)) return std::nullopt;
    const bool name = in_fish(spot);
    const auto belongs = [&](char c) { return name ? in_name(c) : in_word(c); };
    std::size_t begin = std::min(spot.byte, line.size()), end = begin;
    while (begin > 0 && belongs(line[begin - 1])) --begin;
    while (end < line.size() && belongs(line[end])) ++end;
    if (begin == end) return std::nullopt;
    return Piece{spot.line, begin, end};
}

template <class See> void OpenDeck::for_each_name(const See& see) const {
    for (const auto& stretch : stretches_) {
        for (int line = stretch.body; line <= stretch.last; ++line) {
            const std::string& text = lines_[static_cast<std::size_t>(line)];
            names_of_line(text, 0, text.size(), stretch.lua, [&](std::size_t begin, std::size_t end) {
                see(Piece{line, begin, end}, true);
            });
        }
        const auto& words = stretch.statement.words;
        const bool defines = stretch.body <= stretch.last && !stretch.lua;
        for (std::size_t k = 0; k < words.size(); ++k) {
            const auto& word = words[k];
            if (!word.place || word.place.line < 1 || static_cast<std::size_t>(word.place.line) > lines_.size())
                continue;
            const int line = word.place.line - 1;
            const std::string& text = lines_[static_cast<std::size_t>(line)];
            const std::size_t begin =
                                  std::min(static_cast<std::size_t>(std::max(word.place.column - 1, 0)), text.size()),
                              end = std::min(begin + static_cast<std::size_t>(std::max(word.place.length, 0)),
                                             text.size());
            // A word is a name where a function is defined, called or named by a command; in other commands it is a keyword.
            const bool sure = word.late() || (defines && k > 0);
            const bool bare = word.kind == lang::WordKind::word && (k == 0 || names_functions(words.front().folded));
            if (!sure && !bare) continue;
            names_of_line(text, begin, end, false, [&](std::size_t from, std::size_t to) {
                see(Piece{line, from, to}, sure);
            });
        }
    }
}

std::vector<OpenDeck::Piece> OpenDeck::uses_of(std::string_view folded, bool is_function) const {
    std::vector<Piece> uses;
    for_each_name([&](const Piece& piece, bool sure) {
        if ((sure || is_function) && lang::fold(text_of(piece)) == folded) uses.push_back(piece);
    });
    return uses;
}

std::vector<std::string> OpenDeck::names() const {
    std::map<std::string, std::string> found;
    for_each_name([&](const Piece& piece, bool sure) {
        if (sure) found.emplace(lang::fold(text_of(piece)), text_of(piece));
    });
    std::vector<std::string> names;
    for (auto& [folded, name] : found) names.push_back(std::move(name));
    return names;
}

bool OpenDeck::in_fish(const Spot& spot) const {
    const Stretch* stretch = stretch_at(spot.line);
    if (stretch == nullptr) return false;
    if (spot.line >= stretch->body) return true;
    return std::ranges::any_of(stretch->statement.words, [&](const lang::Word& word) {
        const auto begin = static_cast<std::size_t>(std::max(word.place.column - 1, 0));
        return word.late() && word.place.line - 1 == spot.line && spot.byte >= begin &&
               spot.byte <= begin + static_cast<std::size_t>(std::max(word.place.length, 0));
    });
}

OpenDeck::Typed OpenDeck::typed_at(const Spot& spot) const {
    if (spot.line < 0 || static_cast<std::size_t>(spot.line) >= lines_.size()) return {};
    Typed typed;
    typed.line = lines_[static_cast<std::size_t>(spot.line)].substr(0, spot.byte);
    const Stretch* stretch = stretch_at(spot.line);
    if (stretch == nullptr || stretch->first == spot.line) return typed;
    std::string above;
    for (int line = stretch->first; line < spot.line; ++line) above += lines_[static_cast<std::size_t>(line)] + "\n";
    if (spot.line >= stretch->body) {
        typed.before = above;
        return typed;
    }
    std::string continued;
    for (const auto& word : stretch->statement.words)
        if (word.place.line - 1 < spot.line) continued += word.raw_text() + " ";
    typed.line = continued + typed.line;
    return typed;
}

} // namespace kaya
