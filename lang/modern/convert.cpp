#include "lang/modern/convert.hpp"

#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/commands/print.hpp"
#include "lang/commands/struct_text.hpp"
#include "lang/interp/bare_names.hpp"
#include "lang/interp/command_words.hpp"
#include "lang/interp/deck.hpp"
#include "lang/modern/language.hpp"
#include "lang/modern/line_shapes.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <optional>
#include <sstream>

namespace kaya::lang {

namespace {

/// New texts of words, by their number in the statement; a word with the empty text is left out, with the blanks before it.
using Replaced = std::map<std::size_t, std::string>;

const KeywordSpec* with_first_word(const std::vector<KeywordSpec>& keywords, std::string_view word) {
    const auto found =
        std::ranges::find_if(keywords, [&](const KeywordSpec& k) { return k.words.front().word == word; });
    return found == keywords.end() ? nullptr : &*found;
}

/// The keyword of a list that says the same as a classic word.
const KeywordSpec* with_classic(const std::vector<KeywordSpec>& keywords, std::string_view classic) {
    const auto found = std::ranges::find_if(keywords, [&](const KeywordSpec& k) { return k.classic == classic; });
    return found == keywords.end() ? nullptr : &*found;
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/// One statement with its words in whole.
struct Line {
    const Statement& statement;
    const BoundCommand& bound;
    const Spelled& spelled;

    /// The first word of the range phrase, or the end.
    std::size_t range_at() const {
        for (std::size_t i = 1; i < statement.words.size(); ++i) {
            const auto whole = spelled.find(i);
            if (whole == spelled.end()) continue;
            if (whole->second == "range") return i;
            const bool element = bound.spec->range_without_word && bound.spec->range_elements != nullptr &&
                                 with_first_word(bound.spec->keywords, whole->second) == nullptr &&
                                 with_first_word(*bound.spec->range_elements, whole->second) != nullptr;
            if (element && i > bound.spec->form.size()) return i;
        }
        return statement.words.size();
    }
};

/// The words that a modern command puts behind the name of its classic one: `history interval` is `history ncyc`. Nothing when the classic
/// command is another one.
std::optional<std::vector<std::string>> fixed_words(const CommandSpec& modern_command,
                                                    const std::string& classic_name) {
    const std::string_view said = modern_command.classic;
    if (!said.starts_with(classic_name)) return std::nullopt;
    const std::string_view rest = said.substr(classic_name.size());
    if (!rest.empty() && rest.front() != ' ') return std::nullopt;
    return words_of(std::string(rest));
}

/// The name of the command in new words, in place of the words up to `last`.
void replace_name(std::string name, std::size_t last, Replaced& replaced) {
    replaced[0] = std::move(name);
    for (std::size_t i = 1; i <= last; ++i) replaced[i] = "";
}

/// A modern keyword in classic words. Several words take one value each, velocity 1 2 3 is xvel 1 yvel 2 zvel 3, or stand for a keyword
/// without values: velocity of a list is show velocity.
void replace_keyword(const Line& line, std::size_t at, const KeywordSpec& keyword, Replaced& replaced) {
    const auto words = words_of(keyword.classic);
    if (keyword.arguments.empty() && words.size() > 1) {
        replaced[at] = keyword.classic;
        return;
    }
    if (words.empty()) {
        const bool silent = !keyword.classic.empty();
        if (silent || (keyword.support == Support::ignored && keyword.arguments.empty())) replaced[at] = "";
        return;
    }
    replaced[at] = words.front();
    for (std::size_t k = 1; k < words.size() && at + 1 + k < line.statement.words.size(); ++k)
        replaced[at + 1 + k] = fmt::format("{} {}", words[k], line.statement.words[at + 1 + k].raw_text());
}

/// The words after the first `before` ones in classic words, below another beginning.
Replaced in_classic_words(const Line& line, std::string beginning, std::size_t before) {
    Replaced replaced;
    const CommandSpec& spec = *line.bound.spec;
    const std::size_t range = line.range_at();
    for (const auto& [at, whole] : line.spelled) {
        if (at < before) continue;
        const auto& table = at < range ? spec.keywords : modern().range_elements;
        if (const KeywordSpec* keyword = with_first_word(table, whole)) replace_keyword(line, at, *keyword, replaced);
    }
    replace_name(std::move(beginning), before - 1, replaced);
    return replaced;
}

/// A keyword that classic lines leave out before its values: the word position of histories.
const KeywordSpec* silent_keyword(const CommandSpec& spec) {
    const auto found = std::ranges::find_if(spec.keywords, [](const KeywordSpec& keyword) {
        return !keyword.classic.empty() && words_of(keyword.classic).empty();
    });
    return found == spec.keywords.end() ? nullptr : &*found;
}

/// The words after the first `before` ones in those of a modern command, below its beginning.
Replaced in_words_of(const Line& line, const CommandSpec& target, std::string beginning, std::size_t before) {
    const auto& words = line.statement.words;
    Replaced replaced;
    const std::size_t range = line.range_at();
    const KeywordSpec* silent = silent_keyword(target);
    for (const auto& [at, whole] : line.spelled) {
        if (at < before) continue;
        const auto& table = at < range ? target.keywords : modern().range_elements;
        const KeywordSpec* keyword = with_classic(table, whole);
        if (const auto next = line.spelled.find(at + 1); keyword == nullptr && next != line.spelled.end())
            if ((keyword = with_classic(table, fmt::format("{} {}", whole, next->second))) != nullptr)
                replaced[at + 1] = "";
        if (keyword == nullptr) continue;
        replaced[at] = keyword->words.front().word;
        const bool value = at + 1 < range && !line.spelled.contains(at + 1);
        if (silent != nullptr && value && keyword->arguments.empty())
            replaced[at] += fmt::format(" {}", silent->words.front().word);
    }
    // `hide z 0 1` needs the word range.
    if (range < words.size() && line.spelled.at(range) != "range") {
        const auto known = replaced.find(range);
        replaced[range] = "range " + (known != replaced.end() ? known->second : words[range].raw_text());
    }
    replace_name(std::move(beginning), before - 1, replaced);
    return replaced;
}

std::optional<Replaced> in_modern_words(const Line& line, const CommandSpec& target) {
    const auto fixed = fixed_words(target, line.bound.spec->name());
    if (!fixed) return std::nullopt;
    std::size_t last = line.bound.spec->form.size();
    for (const auto& word : *fixed) {
        const auto whole = line.spelled.find(++last);
        if (whole == line.spelled.end() || whole->second != word) return std::nullopt;
    }
    return in_words_of(line, target, target.name(), last + 1);
}

/// The modern command whose name begins a line.
const CommandSpec* modern_command_of(std::string_view beginning) {
    const CommandSpec* found = nullptr;
    for_each_command(modern(), [&](const CommandSpec& command) {
        const std::string name = command.name();
        const bool begins = beginning == name || beginning.starts_with(name + " ");
        if (begins && (found == nullptr || found->name().size() < name.size())) found = &command;
    });
    return found;
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// The lines of a statement with some words replaced.
std::vector<std::string> rewritten(const Statement& statement, const Replaced& replaced) {
    const auto& source = statement.words.front().place.source;
    std::vector<std::string> lines;
    for (int number = statement.first_line; number <= statement.last_line; ++number) {
        const std::string& line = source->lines[static_cast<std::size_t>(number - 1)];
        std::string text;
        std::size_t at = 0;
        for (std::size_t i = 0; i < statement.words.size(); ++i) {
            const Word& word = statement.words[i];
            if (word.place.line != number) continue;
            const auto from = static_cast<std::size_t>(word.place.column - 1);
            text += line.substr(at, from - at);
            const auto found = replaced.find(i);
            if (found == replaced.end()) text += word.raw_text();
            else if (!found->second.empty()) text += found->second;
            else
                while (!text.empty() && is_blank(text.back())) text.pop_back();
            at = from + static_cast<std::size_t>(word.place.length);
        }
        lines.push_back(text + line.substr(at));
    }
    return lines;
}

/// Another line in place of a statement, with its indentation and its comments.
std::vector<std::string> line_instead(const Statement& statement, const std::string& line) {
    const auto& source = statement.words.front().place.source;
    const std::string& first = source->lines[static_cast<std::size_t>(statement.first_line - 1)];
    std::vector<std::string> lines{first.substr(0, std::min(first.find_first_not_of(" \t"), first.size())) + line};
    for (int number = statement.first_line; number <= statement.last_line; ++number) {
        const std::string& old = source->lines[static_cast<std::size_t>(number - 1)];
        std::size_t after = 0; // the words of this line
        for (const Word& word : statement.words)
            if (word.place.line == number) after = static_cast<std::size_t>(word.place.column + word.place.length - 1);
        const auto comment = old.find(';', after);
        if (comment == std::string::npos) continue;
        if (number == statement.first_line) lines.front() += " " + old.substr(comment);
        else lines.push_back(old.substr(comment));
    }
    return lines;
}

/// A long line over several, each but the last with the mark of its dialect at its end. Texts in quotes stay whole.
std::vector<std::string> in_several_lines(const std::string& line, std::string_view mark) {
    constexpr std::size_t most = 120, indentation = 5;
    std::vector<std::string> lines;
    std::size_t from = 0, blank = 0; // of the present line
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\'') quoted = !quoted;
        if (line[i] != ' ' || quoted) {
            if (i - from < most || blank <= from) continue;
            lines.push_back(
                fmt::format("{:{}}{} {}", "", lines.empty() ? 0 : indentation, line.substr(from, blank - from), mark));
            from = blank + 1;
        } else if (i > from) {
            blank = i;
        }
    }
    lines.push_back(fmt::format("{:{}}{}", "", lines.empty() ? 0 : indentation, line.substr(from)));
    return lines;
}

/// The lines of a statement with the beginning that the shape has in the other dialect; nothing when it begins in another way.
std::optional<std::vector<std::string>> in_shape(const Line& line, const LineShape& shape, To to) {
    const auto& [from, target] =
        to == To::modern ? std::pair(shape.classic, shape.modern) : std::pair(shape.modern, shape.classic);
    const auto taken = take_beginning(from, line.statement, *line.bound.spec, line.spelled);
    if (!taken) return std::nullopt;
    std::string beginning = write_beginning(target, *taken);
    // Commas after the last word belong to what it takes.
    if (taken->count == line.statement.words.size()) return line_instead(line.statement, beginning);
    if (to == To::classic) return rewritten(line.statement, in_classic_words(line, std::move(beginning), taken->count));
    const CommandSpec* command = modern_command_of(target);
    if (command == nullptr) return std::nullopt;
    return rewritten(line.statement, in_words_of(line, *command, std::move(beginning), taken->count));
}

/// Stands for the value of an expression: the same number for the same text.
Value stand_in(const std::string& expression, const Place&) {
    constexpr std::size_t numbers = 997;
    return Value(static_cast<std::int64_t>(1 + std::hash<std::string>{}(expression) % numbers));
}

/// What a command means: its struct, without places. Empty when it does not bind.
std::optional<std::string> meaning_of(const Statement& statement, const Language& language) {
    try {
        const BoundCommand bound = bind_statement(language, statement);
        std::string meaning = fmt::format("{} {}", bound.spec->index, struct_text(bound.command));
        if (!bound.late) return meaning;
        const ValueSource values = stand_in;
        try {
            meaning += struct_text(bind_statement(language, statement, &values).command);
        } catch (const Diagnostic&) {} // an expression that must be a text
        return meaning;
    } catch (const Diagnostic&) { return std::nullopt; }
}

/// The only statement of some lines; nothing when there is none, or more than one.
std::optional<Statement> only_statement(const std::vector<std::string>& lines, const Language& language) {
    try {
        Lexer lexer(source_from_text("", fmt::format("{}", fmt::join(lines, "\n"))));
        Statement statement, further;
        if (!next_statement(language, lexer, statement) || lexer.next(further)) return std::nullopt;
        return statement;
    } catch (const Diagnostic&) { return std::nullopt; }
}

std::optional<std::string> meaning_of(const std::vector<std::string>& lines, const Language& language) {
    const auto statement = only_statement(lines, language);
    return statement ? meaning_of(*statement, language) : std::nullopt;
}

/// The lines of a statement with the marks that its names lack: `0 width` becomes `0 @width`, `range left` becomes `range nrange left`.
std::vector<std::string> with_marks(const Statement& statement, const std::vector<BareName>& bare) {
    auto lines = rewritten(statement, {});
    Statement read = statement;
    std::map<std::pair<int, int>, std::string_view> marks; // by line and column
    for (const BareName& name : bare) {
        const Place& at = read.words[name.word].place;
        marks[{at.line, at.column}] = name.range ? "nrange " : "@";
        read_as_name(read, name);
    }
    for (auto mark = marks.rbegin(); mark != marks.rend(); ++mark) {
        const auto [line, column] = mark->first;
        lines[static_cast<std::size_t>(line - statement.first_line)].insert(static_cast<std::size_t>(column - 1),
                                                                            mark->second);
    }
    return lines;
}

std::string note_text(To to) {
    return fmt::format("; kept: no {} words for the command below", to == To::modern ? "modern" : "classic");
}

class Converter {
public:
    Converter(const Source& source, To to)
        : source_(source), to_(to), target_(to == To::modern ? modern() : classic()) {}

    ConvertedDeck run() {
        Lexer lexer(source_);
        Statement statement;
        std::vector<Diagnostic> problems;
        while (problems.size() < most_errors_shown) {
            try {
                if (!next_statement(language(), lexer, statement)) break;
                if (add(statement) == Flow::leave_file) break;
            } catch (const Diagnostic& problem) {
                if (problem.code != "not-supported-yet") problems.push_back(problem);
                else if (!is_of_target(statement)) keep(statement);
            }
        }
        if (!problems.empty()) throw DeckErrors(std::move(problems));
        copy_up_to(static_cast<int>(source_->lines.size()));
        return std::move(result_);
    }

private:
    bool is_of_target(const Statement& statement) const {
        return (&dialect_of(language(), statement) == &modern()) == (to_ == To::modern);
    }

    Flow add(const Statement& statement) {
        Spelled spelled;
        const BoundCommand bound = bind_with_names(language(), statement, names_, &spelled);
        names_.learn(*bound.spec, statement);
        if (bound.command.type() == typeid(ReadDialect)) {
            put(statement, rewritten(statement, {{1, "both"}})); // lines may stay
            return bound.spec->flow;
        }
        const bool function = !bound.spec->body_end.empty() || statement.words.front().late();
        if (function || bound.modern == (to_ == To::modern)) return bound.spec->flow;
        if (!statement.body.empty()) { // a title on the line below
            const auto lines = printed(statement, bound, *meaning_of(statement, language()));
            if (lines) replace(statement, *lines);
            else keep(statement);
        } else if (!bound.bare.empty()) {
            const auto plain = only_statement(with_marks(statement, bound.bare), language());
            if (!plain || !meaning_of(*plain, language())) keep(statement);
            else if (!plain->words.front().late()) change(statement, *plain);
        } else {
            change(statement, {statement, bound, spelled});
        }
        return bound.spec->flow;
    }

    void change(const Statement& statement, const Statement& with_marks) {
        Spelled spelled;
        const BoundCommand bound = bind_statement(language(), with_marks, nullptr, &spelled);
        change(statement, {with_marks, bound, spelled});
    }

    void change(const Statement& statement, const Line& line) {
        const auto meaning = meaning_of(line.statement, language());
        if (meaning_of(rewritten(statement, {}), target_) == meaning) return; // a line of both dialects
        const auto lines = in_other_words(line, *meaning);
        if (!lines) return keep(statement);
        replace(statement, *lines);
    }

    void replace(const Statement& statement, const std::vector<std::string>& lines) {
        put(statement, lines);
        ++result_.changed;
    }

    /// The line of the struct, in place of the words of the statement.
    std::optional<std::vector<std::string>> printed(const Statement& statement, const BoundCommand& bound,
                                                    const std::string& meaning) const {
        if (bound.late) return std::nullopt;
        const auto line = line_of(bound.command, target_);
        if (!line) return std::nullopt;
        auto parts = in_several_lines(*line, to_ == To::modern ? "..." : "&");
        auto lines = line_instead(statement, parts.front());
        lines.insert(lines.begin() + 1, parts.begin() + 1, parts.end());
        for (const Language* reader : {&target_, &language()})
            if (meaning_of(lines, *reader) != meaning) return std::nullopt;
        return lines;
    }

    void put(const Statement& statement, const std::vector<std::string>& lines) {
        copy_up_to(statement.first_line - 1);
        for (const auto& line : lines) result_.text += line + "\n";
        done_ = statement.last_line;
    }

    std::optional<std::vector<std::string>> in_other_words(const Line& line, const std::string& meaning) const {
        std::optional<std::vector<std::string>> found;
        const auto attempt = [&](std::vector<std::string> lines) {
            if (!found && meaning_of(lines, target_) == meaning) found = std::move(lines);
        };
        if (to_ == To::classic) {
            const CommandSpec& spec = *line.bound.spec;
            const auto words = in_classic_words(line, std::string(spec.classic), spec.form.size() + 1);
            if (!spec.classic.empty()) attempt(rewritten(line.statement, words));
        } else {
            for_each_command(modern(), [&](const CommandSpec& target) {
                if (found || target.classic.empty()) return;
                if (const auto replaced = in_modern_words(line, target)) attempt(rewritten(line.statement, *replaced));
            });
        }
        for_each_shape([&](const LineShape& shape) {
            auto lines = in_shape(line, shape, to_);
            // Commands that begin with `fish` are lines of both dialects.
            const bool of_both =
                lines && shape.modern.starts_with("fish ") && meaning_of(*lines, language()) == meaning;
            if (of_both) found = std::move(lines);
            else if (lines) attempt(std::move(*lines));
            return found.has_value();
        });
        return found ? found : printed(line.statement, line.bound, meaning);
    }

    /// The statement stays, below a comment.
    void keep(const Statement& statement) {
        copy_up_to(statement.first_line - 1);
        const bool noted = noted_ == done_; // the comment stands above the command before this one
        if (!noted) result_.text += note_text(to_) + "\n";
        copy_up_to(statement.last_line);
        noted_ = done_;
        Diagnostic said(fmt::format("{} words of '{}' are not known", to_ == To::modern ? "modern" : "classic",
                                    statement.words.front().text),
                        "the line stays as it is; kaya runs lines of both dialects in one file");
        said.severity = Severity::note;
        result_.kept.push_back(said.at(statement.words.front().place));
    }

    /// Comments of an earlier conversion are left out.
    void copy_up_to(int last) {
        for (; done_ < last; ++done_) {
            const std::string& line = source_->lines[static_cast<std::size_t>(done_)];
            if (line != note_text(To::modern) && line != note_text(To::classic)) result_.text += line + "\n";
        }
    }

    const Source& source_;
    To to_;
    const Language& target_;
    BareNames names_;
    ConvertedDeck result_;
    int done_ = 0;   ///< lines that are in the result
    int noted_ = -1; ///< the last line of a command that stays, when it is the last one in the result
};

} // namespace

ConvertedDeck convert_deck(const Source& source, To to) { return Converter(source, to).run(); }

} // namespace kaya::lang
