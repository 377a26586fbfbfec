#include "lang/interp/command_words.hpp"

#include "lang/interp/binder.hpp"

#include <algorithm>
#include <numeric>

namespace kaya::lang {

bool is_one_of(const std::vector<Spelling>& spellings, const Word& word) {
    return word.kind == WordKind::word &&
           std::any_of(spellings.begin(), spellings.end(), [&](const Spelling& s) { return s.matches(word.folded); });
}

namespace {

std::vector<const CommandSpec*> find_commands(const Language& language, std::string_view typed) {
    std::string_view exact, beginning;
    for_each_command(language, [&](const CommandSpec& command) {
        for (const Spelling& s : command.words) {
            if (exact.empty() && s.word == typed) exact = command.words.front().word;
            if (beginning.empty() && s.matches(typed)) beginning = command.words.front().word;
        }
    });
    const std::string_view canonical = exact.empty() ? beginning : exact;
    std::vector<const CommandSpec*> commands;
    if (canonical.empty()) return commands;
    for_each_command(language, [&](const CommandSpec& command) {
        if (command.words.front().word == canonical) commands.push_back(&command);
    });
    return commands;
}

/// The option that begins at this word, or null. It may be one of the words that belong to the option before it.
const KeywordSpec* option_at(const CommandSpec& spec, const Word& word, const KeywordSpec* before = nullptr) {
    if (word.kind != WordKind::word) return nullptr;
    const KeywordSpec* own = before != nullptr ? find_keyword(before->keywords, word.folded) : nullptr;
    return own != nullptr ? own : find_keyword(spec.keywords, word.folded);
}

/// How many words at least belong to an option, itself included.
std::size_t length_of(const KeywordSpec& option) {
    return std::accumulate(option.arguments.begin(), option.arguments.end(), std::size_t{1},
                           [](std::size_t sum, const ArgumentSpec& argument) {
                               return sum + (argument.optional ? 0 : static_cast<std::size_t>(argument.count));
                           });
}

} // namespace

const std::vector<const CommandSpec*>& commands_called(const Language& language, std::string_view typed) {
    static const std::vector<const CommandSpec*> none;
    const auto* found = language.called.find(typed);
    if (found == nullptr) found = language.called.keep(typed, find_commands(language, typed));
    return found != nullptr ? *found : none;
}

std::size_t form_depth(const CommandSpec& spec, const Statement& statement) {
    std::size_t depth = 0;
    while (depth < spec.form.size() && depth + 1 < statement.words.size() &&
           is_one_of(spec.form[depth], statement.words[depth + 1]))
        ++depth;
    return depth;
}

std::size_t find_form(const CommandSpec& spec, const Statement& statement) {
    const std::size_t depth = form_depth(spec, statement), size = spec.form.size();
    if (depth == size) return size;
    if (!spec.options_before_form || depth + 1 < size) return 0;
    const std::size_t last = past_options(spec, statement, size);
    return last < statement.words.size() && is_one_of(spec.form.back(), statement.words[last]) ? last : 0;
}

std::size_t past_options(const CommandSpec& spec, const Statement& statement, std::size_t at) {
    const auto& words = statement.words;
    const KeywordSpec* option = nullptr;
    while (at < words.size()) {
        if (!spec.form.empty() && is_one_of(spec.form.back(), words[at])) break;
        option = option_at(spec, words[at], option);
        if (option == nullptr) break;
        at += length_of(*option);
        while (at < words.size() && words[at].kind != WordKind::word) ++at; // further values
    }
    return std::min(at, words.size());
}

namespace {

/// A whole command before a number that it does not take: `structure liner property 2` is a liner and its property.
bool refuses_number(const CommandSpec& spec, const Statement& statement, std::size_t depth) {
    return depth > 0 && depth == spec.form.size() && depth + 1 < statement.words.size() &&
           statement.words[depth + 1].kind == WordKind::number && spec.arguments.empty() && !spec.otherwise &&
           !spec.raw;
}

} // namespace

std::size_t words_known(const std::vector<const CommandSpec*>& commands, const Statement& statement) {
    std::size_t most = 0;
    for (const CommandSpec* spec : commands) {
        const std::size_t depth = form_depth(*spec, statement);
        if (!refuses_number(*spec, statement, depth)) most = std::max(most, depth);
        if (!spec->form.empty() || statement.words.size() < 2) continue;
        const Word& second = statement.words[1];
        const bool number_first =
            !spec->arguments.empty() && spec->arguments.front().argument.kind == ArgumentKind::integer;
        const bool text_first = !spec->arguments.empty() && spec->arguments.front().argument.kind == ArgumentKind::text;
        const bool known = option_at(*spec, second) != nullptr || (text_first && second.kind == WordKind::text) ||
                           (number_first && second.kind == WordKind::number);
        most = std::max<std::size_t>(most, known ? 1 : 0);
    }
    return most;
}

namespace {

bool has_whole_word(const std::vector<const CommandSpec*>& commands, std::string_view typed) {
    return std::ranges::any_of(commands, [&](const CommandSpec* command) {
        return std::ranges::any_of(command->words, [&](const Spelling& s) { return s.word == typed; });
    });
}

} // namespace

Dialects dialects_of(std::string_view word) {
    return word == "modern" ? Dialects::modern : word == "classic" ? Dialects::classic : Dialects::both;
}

const Language& dialect_of(const Language& language, const Statement& statement) {
    const Word& first = statement.words.front();
    if (language.modern == nullptr || first.kind != WordKind::word || first.folded == "dialect") return language;
    if (statement.dialects != Dialects::both)
        return statement.dialects == Dialects::modern ? *language.modern : language;
    const auto& modern = commands_called(*language.modern, first.folded);
    const auto& classic = commands_called(language, first.folded);
    if (modern.empty()) return language;
    if (classic.empty()) return *language.modern;
    const bool whole_modern = has_whole_word(modern, first.folded);
    const bool whole_classic = has_whole_word(classic, first.folded);
    if (whole_modern != whole_classic) return whole_modern ? *language.modern : language;
    return words_known(modern, statement) > words_known(classic, statement) ? *language.modern : language;
}

} // namespace kaya::lang
