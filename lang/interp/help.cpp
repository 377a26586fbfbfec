#include "lang/interp/help.hpp"

#include "lang/interp/binder.hpp"
#include "lang/interp/command_words.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <set>

namespace kaya::lang {

namespace {

std::string optional_part(std::string_view text, bool optional) {
    return optional ? fmt::format("[{}]", text) : std::string(text);
}

std::string arguments_of(const KeywordSpec& keyword) {
    std::string text;
    for (const auto& argument : keyword.arguments)
        text.append(" ").append(optional_part(argument.name, argument.optional));
    for (const auto& inner : keyword.keywords)
        text += fmt::format(" [{}{}]", inner.words.front().word, arguments_of(inner));
    return text;
}

/// "material (mat)"
std::string spellings(const std::vector<Spelling>& words) {
    std::string text(words.front().word);
    for (std::size_t i = 1; i < words.size(); ++i) text += fmt::format("{}{}", i == 1 ? " (" : ", ", words[i].word);
    return words.size() > 1 ? text + ")" : text;
}

/// Brackets on the left are what may be omitted, those on the right hold quantities.
void add_line(std::string& text, const std::string& left, std::string_view meaning, const Units& units = {}) {
    constexpr std::size_t column = 34;
    const std::string right = units.in_brackets(meaning);
    if (left.size() <= column) text += fmt::format("    {:<{}} {}\n", left, column, right);
    else text += fmt::format("    {}\n    {:<{}} {}\n", left, "", column, right);
}

void add_keywords(std::string& text, const std::vector<KeywordSpec>& keywords, const Units& units) {
    for (const auto& keyword : keywords) {
        std::string right(keyword.help);
        if (keyword.support == Support::not_yet) right = "not supported yet: " + right;
        for (const auto& argument : keyword.arguments)
            if (!argument.unit.empty() && right.find('[') == std::string::npos)
                right += fmt::format(" [{}]", argument.unit);
        add_line(text, spellings(keyword.words) + arguments_of(keyword), right, units);
    }
}

/// Breaks a usage line between its parts.
std::string wrapped(const std::string& line) {
    std::string text;
    std::size_t column = 0, depth = 0;
    for (const char c : line) {
        if (c == '[') ++depth;
        if (c == ']') --depth;
        ++column;
        if (c == ' ' && depth == 0 && column > 70) {
            text += "\n       ";
            column = 7;
        }
        text += c;
    }
    return text;
}

std::string about_command(const CommandSpec& command, const Units& units) {
    std::string text = fmt::format("{}\n    {}\n", wrapped(usage(command)), command.help);
    if (command.words.size() > 1) text += fmt::format("    also spelled: {}\n", spellings(command.words));
    if (!command.arguments.empty()) {
        text += "\n  Arguments\n";
        for (const auto& positional : command.arguments)
            add_line(text, optional_part(positional.argument.name, positional.argument.optional),
                     fmt::format("{}{}({})", positional.argument.help, positional.argument.help.empty() ? "" : " ",
                                 describe(positional.argument)),
                     units);
    }
    if (!command.keywords.empty()) {
        text += "\n  Keywords\n";
        add_keywords(text, command.keywords, units);
    }
    if (command.range_elements)
        text += "\n  May end with a range phrase; without one it acts on all visible objects: help range\n";
    if (!command.right.empty()) text += "\n  Examples\n";
    for (const auto& example : command.right) {
        std::string lines(example.text);
        for (std::size_t at = lines.find('\n'); at != std::string::npos; at = lines.find('\n', at + 1))
            lines.insert(at + 1, "    ");
        text += fmt::format("    {}\n", lines);
        if (!example.classic.empty() && example.classic.find('\n') == std::string_view::npos)
            text += fmt::format("        classic: {}\n", example.classic);
    }
    return text;
}

std::string about_range(const Language& language, const Units& units) {
    std::string text = "range ELEMENT ...\n    selects the objects of a command; all elements must "
                       "hold\n\n  Elements\n";
    add_keywords(text, language.range_elements, units);
    return text;
}

/// Visits the commands of a language and of its second dialect.
template <class Visit> void for_each_dialect(const Language& language, Visit visit) {
    visit(language);
    if (language.modern != nullptr) visit(*language.modern);
}

/// The positions of a word below `before`: among the keywords, and inside of each of them.
void add_places(std::string& text, const std::string& before, const std::vector<KeywordSpec>& keywords,
                std::string_view word, const Units& units) {
    if (const KeywordSpec* found = find_keyword(keywords, word))
        text += fmt::format("{} {}{}\n    {}\n", before, found->words.front().word, arguments_of(*found),
                            units.in_brackets(found->help));
    for (const auto& keyword : keywords)
        add_places(text, fmt::format("{} {} ...", before, keyword.words.front().word), keyword.keywords, word, units);
}

/// The positions of a word that is not a command; empty when there are none.
std::string about_keyword(const Language& language, std::string_view word, const Units& units) {
    std::string text;
    for_each_dialect(language, [&](const Language& dialect) {
        for_each_command(dialect, [&](const CommandSpec& command) {
            add_places(text, fmt::format("{} ...", command.name()), command.keywords, word, units);
        });
        add_places(text, &dialect == &language ? "... range" : "block ... range", dialect.range_elements, word, units);
    });
    return text;
}

void add_words(std::set<std::string_view>& to, const std::vector<Spelling>& spelled) {
    for (const Spelling& s : spelled) to.insert(s.word);
}

void add_words(std::set<std::string_view>& to, const std::vector<KeywordSpec>& keywords) {
    for (const auto& keyword : keywords) {
        add_words(to, keyword.words);
        add_words(to, keyword.keywords);
    }
}

std::vector<std::string_view> all_words(const Language& language) {
    std::set<std::string_view> words = {"range"};
    for_each_dialect(language, [&](const Language& dialect) {
        for_each_command(dialect, [&](const CommandSpec& command) {
            add_words(words, command.words);
            add_words(words, command.keywords);
        });
        add_words(words, dialect.range_elements);
    });
    return {words.begin(), words.end()};
}

} // namespace

std::string usage(const CommandSpec& command) {
    std::string text = command.name();
    if (command.raw) return text + (command.words.front().word == "@" ? "name" : " ...");
    for (const auto& positional : command.arguments)
        text.append(" ").append(optional_part(positional.argument.name, positional.argument.optional));
    for (const auto& argument : command.otherwise_arguments) text += fmt::format(" [{} ...]", argument.name);
    for (const auto& keyword : command.keywords)
        if (keyword.support != Support::not_yet)
            text += fmt::format(" [{}{}]", keyword.words.front().word, arguments_of(keyword));
    if (command.range_elements) text += " [range ...]";
    if (!command.body_end.empty()) text += fmt::format(" ... {}", command.body_end);
    return text;
}

std::string help_list(const Language& language) {
    std::string text;
    for_each_dialect(language, [&](const Language& dialect) {
        for (const auto& family : dialect.families) {
            text += fmt::format("{}: {}\n", family.name, family.help);
            for (const auto& command : family.commands) add_line(text, command.name(), command.help);
            text += "\n";
        }
    });
    return text + "help WORD explains a command or a keyword; ? in place of a word lists the valid words.\n";
}

namespace {

/// The commands that begin with the first words of the statement, as many as any command knows.
std::vector<const CommandSpec*> begun_by(const Language& dialect, const Statement& statement) {
    const auto& all = commands_called(dialect, statement.words.front().folded);
    std::size_t most = 0;
    for (const auto* command : all) most = std::max(most, form_depth(*command, statement));
    std::vector<const CommandSpec*> commands;
    std::ranges::copy_if(all, std::back_inserter(commands),
                         [&](const CommandSpec* command) { return form_depth(*command, statement) == most; });
    return commands;
}

} // namespace

std::string help_on(const Language& language, std::string_view words, const Units& units) {
    Lexer lexer(source_from_text("help", words));
    Statement statement;
    if (!lexer.next(statement)) return help_list(language);
    const Word& first = statement.words.front();

    std::string text;
    const auto add = [&](const CommandSpec& command) {
        if (!text.empty()) text += '\n';
        text += about_command(command, units);
    };
    if (Spelling{"range", 2}.matches(first.folded)) text = about_range(language, units);
    const Language& dialect = dialect_of(language, statement);
    try {
        // Of a command with several forms: the one that was named, else all.
        const FoundCommand found = find_command(language, statement);
        for_each_command(dialect, [&](const CommandSpec& command) {
            const bool same_word = command.words.front().word == found.spec->words.front().word;
            if (found.form_at > 0 ? &command == found.spec : same_word) add(command);
        });
        return text;
    } catch (const Diagnostic& problem) {
        if (problem.code != "unknown-command") { // a command that needs further words
            const std::vector<const CommandSpec*> commands = begun_by(dialect, statement);
            constexpr std::size_t many = 12;
            if (commands.size() <= many)
                for (const auto* command : commands) add(*command);
            else
                for (const auto* command : commands) add_line(text, command->name(), command->help, units);
            if (!text.empty()) return text;
        }
    }
    text = about_keyword(language, first.folded, units);
    if (!text.empty()) return text;
    const auto near = did_you_mean(first.folded, all_words(language));
    throw Diagnostic(fmt::format("there is no command and no keyword '{}'", first.text),
                     near.empty() ? "'kaya help' lists the commands" : fmt::format("did you mean '{}'?", near));
}

std::vector<std::string> completions(const Language& language, std::string_view line) {
    const auto blank = line.find_last_of(" \t=,()");
    const std::size_t from = blank == std::string_view::npos ? 0 : blank + 1;
    const std::string typed = fold(line.substr(from));
    const std::string asked = fmt::format("{}?", line.substr(0, from));
    Lexer lexer(source_from_text("prompt", asked));
    Statement statement;
    std::vector<std::string> words;
    if (!lexer.next(statement)) return words; // the line is a comment up to here
    try {
        (void)bind_statement(language, statement);
    } catch (const Choices& choices) {
        for (const auto& word : choices.words)
            if (word.starts_with(typed)) words.push_back(word);
    } catch (const Diagnostic&) {
        // A mistake further left: nothing to offer.
    }
    return words;
}

} // namespace kaya::lang
