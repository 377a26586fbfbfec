#include "lang/interp/bare_names.hpp"

#include "lang/interp/brackets.hpp"

#include <algorithm>
#include <optional>

namespace kaya::lang {

namespace {

constexpr std::string_view name_letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_$";

bool begins_name(char c) { return c == '_' || c == '$' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// The first word of a line of a function, folded.
std::string first_word(std::string_view line) {
    const auto first = std::min(line.find_first_not_of(" \t\r"), line.size());
    const auto end = std::min(line.find_first_not_of(name_letters, first), line.size());
    return fold(line.substr(first, end - first));
}

/// A line that is one name, alone or with arguments in parentheses after it.
bool is_like_call(const Statement& statement) {
    if (statement.words.size() == 1) return true;
    const Place& first = statement.words.front().place;
    const std::string& line = first.source->lines[static_cast<std::size_t>(first.line - 1)];
    const auto next = line.find_first_not_of(" \t", static_cast<std::size_t>(first.column + first.length - 1));
    return next != std::string::npos && line[next] == '(' && statement.words[1].place.line == first.line;
}

bool after_word(const Statement& statement, std::size_t index, const Spelling& word) {
    const auto end = statement.words.begin() + static_cast<std::ptrdiff_t>(index);
    return std::any_of(statement.words.begin(), end,
                       [&](const Word& w) { return w.kind == WordKind::word && word.matches(w.folded); });
}

/// The word that a message points at, when it may be a name.
std::optional<BareName> name_at(const Statement& statement, const Place& place, const BareNames& names) {
    const auto found = std::ranges::find_if(statement.words, [&](const Word& word) {
        return word.place.line == place.line && word.place.column == place.column && word.kind == WordKind::word;
    });
    if (found == statement.words.end()) return std::nullopt;
    const auto index = static_cast<std::size_t>(found - statement.words.begin());
    if (index == 0) {
        if (names.is_function(found->folded) && is_like_call(statement)) return BareName{0, false};
        return std::nullopt;
    }
    if (names.is_range(found->folded) && after_word(statement, index, Spelling{"range", 2}))
        return BareName{index, true};
    if (names.is_name(found->folded)) return BareName{index, false};
    return std::nullopt;
}

} // namespace

void read_as_name(Statement& statement, const BareName& name) {
    const auto at = statement.words.begin() + static_cast<std::ptrdiff_t>(name.word);
    if (name.range) {
        Word before = *at;
        before.text = before.folded = "nrange";
        statement.words.insert(at, std::move(before));
        return;
    }
    Word& word = *at;
    word.kind = WordKind::symbol;
    const std::string& line = word.place.source->lines[static_cast<std::size_t>(word.place.line - 1)];
    const auto first = static_cast<std::size_t>(word.place.column - 1);
    const std::size_t open = first + static_cast<std::size_t>(word.place.length);
    if (open >= line.size() || line[open] != '(') return;
    const std::size_t end = past_closing(line, open, '(', ')');
    if (end == std::string::npos) return;
    word.text = line.substr(first, end - first);
    word.place.length = static_cast<int>(end - first);
    const auto inside = [&](const Word& other) {
        return other.place.line == word.place.line && other.place.column > word.place.column &&
               other.place.column <= static_cast<int>(end);
    };
    statement.words.erase(at + 1, std::find_if_not(at + 1, statement.words.end(), inside));
}

void BareNames::learn(const CommandSpec& spec, const Statement& statement) {
    for (const auto& word : statement.words)
        if (word.kind == WordKind::symbol) learn_words(word.text);
    const auto& words = statement.words;
    const std::string command = spec.name();
    if (command == "range name" && words.size() > 2) ranges_.insert(words[2].folded);
    if (command == "model range create" && words.size() > 3) ranges_.insert(words[3].folded);
    const bool function = !spec.body_end.empty() && !spec.body_needs_bare_line;
    if (!function || statement.body.empty()) return;
    const std::size_t name = 1 + spec.form.size();
    if (words.size() > name) functions_.insert(words[name].folded);
    learn_function(statement.body);
}

void BareNames::learn_function(const std::string& body) {
    bool commands = false; // words of commands are not names
    for (std::string_view rest = body; !rest.empty();) {
        const auto end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const std::string first = first_word(line);
        if (first == "endcommand" || first == "end_command") commands = false;
        else if (first == "command") commands = true;
        else if (!commands) learn_words(line);
    }
}

void BareNames::learn_words(std::string_view line) {
    for (std::size_t i = 0; i < line.size() && line[i] != ';';) {
        if (line[i] == '\'' || line[i] == '"') {
            const auto end = line.find(line[i], i + 1);
            i = end == std::string_view::npos ? line.size() : end + 1;
        } else if (name_letters.find(line[i]) != std::string_view::npos) {
            const auto end = std::min(line.find_first_not_of(name_letters, i), line.size());
            if (begins_name(line[i])) names_.insert(fold(line.substr(i, end - i)));
            i = end;
        } else {
            ++i;
        }
    }
}

BoundCommand bind_with_names(const Language& language, const Statement& statement, const BareNames& names,
                             Spelled* spelled) {
    try {
        return bind_statement(language, statement, nullptr, spelled);
    } catch (const Diagnostic& as_it_stands) {
        Statement with_names = statement;
        std::vector<BareName> bare;
        std::optional<Diagnostic>
            after_range; // the word is certainly the name of a range: the mistake is in the words after it
        Place place = as_it_stands.place;
        while (const auto name = name_at(with_names, place, names)) {
            if (bare.size() > statement.words.size()) break;
            bare.push_back(*name);
            read_as_name(with_names, *name);
            if (name->word == 0 && with_names.words.size() > 1) break; // a call must be the only word of its line
            try {
                BoundCommand bound = bind_statement(language, with_names);
                bound.bare = std::move(bare);
                return bound;
            } catch (const Diagnostic& next) {
                place = next.place;
                if (name->range) after_range = next;
            }
        }
        if (after_range) throw *after_range;
        throw;
    }
}

} // namespace kaya::lang
