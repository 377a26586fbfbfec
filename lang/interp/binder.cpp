#include "lang/interp/binder.hpp"

#include "lang/interp/command_words.hpp"
#include "lang/interp/habits.hpp"
#include "lang/interp/other_languages.hpp"
#include "lang/interp/word_slips.hpp"
#include "lang/interp/short_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <optional>

namespace kaya::lang {

namespace {

void add_words(std::vector<std::string_view>& to, const std::vector<Spelling>& words) {
    for (const Spelling& s : words)
        if (std::find(to.begin(), to.end(), s.word) == to.end()) to.push_back(s.word);
}

/// Includes words that are not supported yet, unless only supported ones are `offered`.
void add_words(std::vector<std::string_view>& to, const std::vector<KeywordSpec>& keywords, bool offered = false) {
    for (const auto& k : keywords)
        if (!offered || k.support != Support::not_yet) add_words(to, k.words);
}

/// The canonical spellings, for lists of valid words.
std::vector<std::string_view> first_words(const std::vector<KeywordSpec>& keywords) {
    std::vector<std::string_view> words;
    for (const auto& k : keywords)
        if (k.support != Support::not_yet) words.push_back(k.words.front().word);
    return words;
}

/// A beginning that several commands share, and of none enough letters.
void refuse_ambiguous(const Word& word, const std::vector<std::string_view>& candidates) {
    std::set<std::string_view> fitting;
    for (const auto candidate : candidates)
        if (candidate.starts_with(word.folded)) fitting.insert(candidate);
    if (fitting.size() < 2) return;
    constexpr std::size_t most_shown = 8;
    std::string list;
    std::size_t shown = 0;
    for (const auto candidate : fitting) {
        if (shown++ == most_shown) break;
        list += (list.empty() ? "" : ", ") + std::string(candidate);
    }
    Diagnostic d(fmt::format("{} is ambiguous: several commands begin with it", word.shown()),
                 fmt::format("one of: {}{}", list, fitting.size() > most_shown ? ", ..." : ""));
    d.code = "unknown-command";
    throw d.at(word.place);
}

/// "poly brick" for `brick poly 0 1`: the second word is a command, and the first one of its forms.
std::string in_other_order(const Language& language, const Statement& statement) {
    if (statement.words.size() < 2) return {};
    const Word &first = statement.words[0], &second = statement.words[1];
    if (second.kind != WordKind::word) return {};
    for (const auto* spec : commands_called(language, second.folded))
        if (spec->form.size() == 1 && is_one_of(spec->form.front(), first))
            return fmt::format("{} {}", second.text, first.text);
    return {};
}

/// "fix range" for `fixrange`: a command, and one of the words that may follow it.
std::string two_words(const Language& language, const Word& word) {
    std::string found;
    for_each_command(language, [&](const CommandSpec& command) {
        for (const auto& first : command.words) {
            if (first.word.size() < 3 || !word.folded.starts_with(first.word)) continue;
            std::string_view rest = std::string_view(word.folded).substr(first.word.size());
            if (rest.size() > 1 && std::string_view("_-./").find(rest.front()) != rest.npos) rest.remove_prefix(1);
            std::vector<std::string_view> followers{"range"};
            for (const auto& keyword : command.keywords) add_words(followers, keyword.words);
            if (!command.form.empty()) add_words(followers, command.form.front());
            if (std::find(followers.begin(), followers.end(), rest) != followers.end())
                found = fmt::format("{} {}", first.word, rest);
        }
    });
    return found;
}

std::string hint_for_unknown(const Language& language, const Statement& statement,
                             const std::vector<std::string_view>& candidates) {
    const Word& word = statement.words.front();
    if (const auto odd = odd_line_hint(statement); !odd.empty()) return std::string(odd);
    if (auto slip = slip_hint(statement, 0); !slip.empty()) return slip;
    if (const auto ordered = in_other_order(language, statement); !ordered.empty())
        return fmt::format("did you mean '{}'?", ordered);
    if (const auto habit = habit_hint("a command", word.folded); !habit.empty()) return std::string(habit);
    if (const auto apart = two_words(language, word); !apart.empty()) return fmt::format("did you mean '{}'?", apart);
    const bool letters = !word.folded.empty() && word.folded.front() >= 'a' && word.folded.front() <= 'z';
    const auto near = word.kind == WordKind::word && letters ? did_you_mean(word.folded, candidates) : "";
    return near.empty() ? "'kaya help' lists the commands" : fmt::format("did you mean '{}'?", near);
}

/// Throws when the line is of the dialect that is not read here.
void refuse_other_dialect(const Language& language, const Statement& statement) {
    if (statement.dialects == Dialects::both || language.modern == nullptr) return;
    const bool modern = statement.dialects == Dialects::modern;
    const Language& other = modern ? language : *language.modern;
    const Word& word = statement.words.front();
    if (word.kind != WordKind::word || commands_called(other, word.folded).empty()) return;
    Diagnostic d(fmt::format("{} is a command of the {} dialect", word.shown(), modern ? "classic" : "modern"),
                 fmt::format("lines of the {} dialect only are read here: write `dialect both` before it",
                             modern ? "modern" : "classic"));
    d.code = "unknown-command";
    throw d.at(word.place);
}

/// The candidates for a misspelt first word whose commands know the second word: `xmodel new` is `model new`, and not jmodel. All when none
/// of these is near.
std::vector<std::string_view> fitting(const Language& language, const Statement& statement,
                                      const std::vector<std::string_view>& candidates) {
    std::vector<std::string_view> fit;
    for (const std::string_view candidate : candidates)
        for (const Language* dialect : {&language, language.modern})
            if (dialect != nullptr && words_known(commands_called(*dialect, candidate), statement) > 0) {
                fit.push_back(candidate);
                break;
            }
    return did_you_mean(statement.words.front().folded, fit).empty() ? candidates : fit;
}

[[noreturn]] void unknown_command(const Language& language, const Statement& statement) {
    refuse_other_dialect(language, statement);
    std::vector<std::string_view> candidates;
    for (const Language* dialect : {&language, language.modern})
        if (dialect != nullptr)
            for_each_command(*dialect, [&](const CommandSpec& command) { add_words(candidates, command.words); });
    const Word& word = statement.words.front();
    if (word.text == "?" || word.kind == WordKind::open)
        Reader(statement, 0, 1, nullptr).unknown("a command", candidates);
    if (word.kind == WordKind::word) refuse_ambiguous(word, candidates);
    Diagnostic d(fmt::format("{} is not a command", word.shown()),
                 hint_for_unknown(language, statement, fitting(language, statement, candidates)));
    d.code = "unknown-command";
    throw d.at(word.place);
}

/// Whether the words of a command are the first ones of another.
bool begins_alike(const CommandSpec& spec, const CommandSpec& other) {
    for (std::size_t i = 0; i < spec.form.size(); ++i)
        if (other.form[i].front().word != spec.form[i].front().word) return false;
    return true;
}

/// The next word is not a keyword: throws with all words that are valid there.
[[noreturn]] void unknown_keyword(const Language& language, const CommandSpec& spec, const Reader& reader) {
    std::vector<std::string_view> candidates, listed = first_words(spec.keywords);
    for (const auto& argument : spec.otherwise_arguments) listed.push_back(argument.name);
    const bool asked = reader.peek() && reader.peek()->text == "?";
    add_words(candidates, spec.keywords, asked);
    // Words that would make another command of this one: `model list range`.
    const std::size_t depth = spec.form.size();
    const auto& words = reader.statement().words;
    if (words.size() > depth + 1 && reader.peek() == &words[depth + 1])
        for (const auto* other : commands_called(language, spec.words.front().word)) {
            if (other->form.size() <= depth || !begins_alike(spec, *other)) continue;
            if (!asked || other->support != Support::not_yet) add_words(candidates, other->form[depth]);
            if (other->support != Support::not_yet) listed.push_back(other->form[depth].front().word);
        }
    if (spec.range_elements) {
        candidates.push_back("range");
        listed.push_back("range");
    }
    // Suggested when near, not listed: the list of keywords is long enough.
    if (spec.range_without_word) add_words(candidates, *spec.range_elements, asked);
    const std::string name = spec.name();
    try {
        reader.unknown(fmt::format("a keyword of {}", name), candidates,
                       ShortList(listed, name, reader.peek()).words());
    } catch (Diagnostic& mistake) {
        // `print` is used for variables, too.
        const bool is_word = reader.peek()->kind == WordKind::word;
        if (name == "list" && is_word && words.front().folded.starts_with("pr") &&
            mistake.hint.starts_with("expected: "))
            mistake.message += fmt::format(": a FISH variable is @{}", reader.peek()->text);
        throw;
    }
}

/// True when the next word opens the range phrase.
bool at_range(const CommandSpec& spec, const Reader& reader) {
    if (!spec.range_elements) return false;
    const Word* word = reader.peek();
    if (!word || word->kind != WordKind::word) return false;
    if (Spelling{"range", 2}.matches(word->folded)) return true;
    return spec.range_without_word && find_keyword(*spec.range_elements, word->folded);
}

/// Whether the next word is neither a keyword nor close to one: where a number is valid, it is read as a number.
bool is_no_keyword(const CommandSpec& spec, const Reader& reader) {
    const Word* word = reader.peek();
    if (!word || spec.otherwise || word->text == "?" || word->text == "&") return false;
    if (word->kind != WordKind::word) return true;
    std::vector<std::string_view> candidates;
    add_words(candidates, spec.keywords);
    if (spec.range_elements) candidates.push_back("range");
    if (spec.range_without_word) add_words(candidates, *spec.range_elements);
    const bool known = find_keyword(spec.keywords, word->folded) || at_range(spec, reader);
    return !known && did_you_mean(word->folded, candidates).empty();
}

/// `ignored` gets the keywords that are without effect.
void read_rest(const Language& language, const CommandSpec& spec, Reader& reader, void* target, bool range_allowed,
               std::vector<std::string_view>& ignored) {
    while (const Word* word = reader.peek()) {
        const KeywordSpec* keyword = word->kind == WordKind::word ? find_keyword(spec.keywords, word->folded) : nullptr;
        if (keyword) {
            if (keyword->support == Support::not_yet) {
                const auto typed =
                    std::ranges::find_if(keyword->words, [&](const Spelling& s) { return s.matches(word->folded); });
                not_supported_yet(fmt::format("{} {}", spec.name(), typed->word), keyword->help, word->place);
            }
            if (keyword->support == Support::ignored) ignored.push_back(keyword->words.front().word);
            reader.take();
            reader.spell(keyword->words.front().word);
            keyword->read(reader, target);
        } else if (range_allowed && at_range(spec, reader)) {
            try {
                spec.read_range(reader, target);
            } catch (Diagnostic& problem) {
                const Word* wrong = reader.peek();
                if (problem.code == "unknown-word" && wrong && find_keyword(spec.keywords, wrong->folded))
                    problem.hint = "the range phrase must stand last on the line";
                throw;
            }
        } else if (!(spec.otherwise && spec.otherwise(reader, target))) {
            unknown_keyword(language, spec, reader);
        }
    }
}

/// The words begin a command, and no valid form follows.
[[noreturn]] void no_form(const std::vector<const CommandSpec*>& commands, const Statement& statement) {
    // The words that may follow a form are not offered when its options were in the line.
    const auto depth_of = [&](const CommandSpec& spec) {
        return std::min(form_depth(spec, statement), spec.form.size() - 1);
    };
    std::size_t depth = 0;
    for (const auto* spec : commands) depth = std::max(depth, depth_of(*spec));
    std::size_t at = 1 + depth;
    std::string name(commands.front()->words.front().word);
    std::vector<std::string_view> forms, all_forms;
    const CommandSpec* with_options = nullptr;
    for (const auto* spec : commands) {
        if (depth_of(*spec) < depth) continue;
        if (all_forms.empty())
            for (std::size_t i = 0; i < depth; ++i) name.append(" ").append(spec->form[i].front().word);
        add_words(all_forms, spec->form[depth]);
        if (spec->support != Support::not_yet) add_words(forms, spec->form[depth]);
        if (spec->options_before_form && spec->form.size() == depth + 1) with_options = spec;
    }
    if (with_options != nullptr) at = past_options(*with_options, statement, at);
    Reader reader(statement, at, statement.words.size(), nullptr);
    if (!reader.at_end()) {
        std::vector<std::string_view> candidates = reader.peek()->text == "?" ? forms : all_forms;
        if (with_options != nullptr) add_words(candidates, with_options->keywords);
        const ShortList shown(forms, name, reader.peek());
        reader.unknown(fmt::format("a kind of {}", name), candidates, shown.words());
    }
    Place place = reader.previous().place;
    place.column += place.length;
    place.length = 1;
    Diagnostic d(fmt::format("a word is missing after '{}'", reader.previous().text),
                 ShortList(forms, name, nullptr).expected());
    d.code = "missing-value";
    throw d.at(place);
}

} // namespace

namespace {

FoundCommand find_in(const Language& dialect, const Language& language, const Statement& statement) {
    const Word& first = statement.words.front();
    std::string_view typed = first.folded;
    if (first.late()) typed = "@"; // a line that starts with a name calls a function
    else if (first.kind != WordKind::word) unknown_command(language, statement);
    const auto& commands = commands_called(dialect, typed);
    if (commands.empty()) unknown_command(language, statement);

    const CommandSpec* plain = nullptr;
    FoundCommand found; // with the most words: the first of these
    for (const auto* spec : commands) {
        if (spec->form.empty()) {
            const bool bare = statement.words.size() == 1;
            if (!plain || (bare && spec->body_needs_bare_line)) plain = spec;
            if (!bare && plain->body_needs_bare_line) plain = spec;
        } else if (found.spec == nullptr || spec->form.size() > found.spec->form.size()) {
            if (const auto at = find_form(*spec, statement)) found = {spec, at};
        }
    }
    if (found.spec != nullptr) return found;
    if (plain) return {plain, 0};
    no_form(commands, statement);
}

/// The whole words of the name of a command.
void spell_name(const FoundCommand& found, const Statement& statement, Spelled& spelled) {
    const CommandSpec& spec = *found.spec;
    if (!statement.words.front().late()) spelled[0] = spec.words.front().word;
    for (std::size_t i = 0; i < spec.form.size(); ++i)
        spelled[i + 1 < spec.form.size() ? i + 1 : found.form_at] = spec.form[i].front().word;
}

} // namespace

FoundCommand find_command(const Language& language, const Statement& statement) {
    return find_in(dialect_of(language, statement), language, statement);
}

BoundCommand bind_statement(const Language& language, const Statement& statement, const ValueSource* values,
                            Spelled* spelled) {
    const Language& dialect = dialect_of(language, statement);
    const FoundCommand found = find_in(dialect, language, statement);
    const CommandSpec& spec = *found.spec;
    if (spelled != nullptr) spell_name(found, statement, *spelled);

    if (spec.support == Support::not_yet)
        not_supported_yet(spec.name(), spec.help, statement.words[found.form_at].place);
    BoundCommand bound;
    bound.spec = &spec;
    bound.language = &language;
    bound.modern = &dialect == language.modern;
    bound.dialects = statement.dialects;
    bound.place = statement.words.front().place;
    bound.last_line = statement.last_line;
    bound.command = spec.make();
    void* target = spec.address(bound.command);
    if (spec.start) spec.start(statement, target);
    if (spec.raw) return bound;

    // Options stand between the last word of the form and the words before it.
    Reader before_form(statement, std::max<std::size_t>(spec.form.size(), 1), std::max<std::size_t>(found.form_at, 1),
                       values);
    before_form.keep_spelling(spelled);
    read_rest(dialect, spec, before_form, target, false, bound.ignored);

    Reader reader(statement, found.form_at + 1, statement.words.size(), values);
    reader.keep_spelling(spelled);
    for (const auto& positional : spec.arguments) {
        if (positional.argument.optional && !reader.at(positional.argument) &&
            !(positional.argument.kind == ArgumentKind::real && is_no_keyword(spec, reader)))
            continue;
        positional.read(reader, target);
    }
    read_rest(dialect, spec, reader, target, true, bound.ignored);
    if (spec.finish) spec.finish(reader, target);
    bound.late = before_form.late() || reader.late();
    return bound;
}

namespace {

std::optional<Diagnostic> mistake_in(const Language& language, const Statement& statement) {
    try {
        (void)bind_statement(language, statement);
        return std::nullopt;
    } catch (const Diagnostic& problem) { return problem; }
}

/// A text that a command takes unparsed may also be on the line below, as after `title` alone. A line that is a command, or may be a
/// misspelt one, is not taken as such a text.
void take_text_below(const Language& language, Lexer& lexer, Statement& statement) {
    const auto& commands = commands_called(dialect_of(language, statement), statement.words.front().folded);
    if (statement.words.size() > 1 || commands.size() != 1 || !commands.front()->raw ||
        commands.front()->support != Support::runs)
        return;
    const int below = statement.last_line + 1;
    if (below > static_cast<int>(lexer.source()->lines.size())) return;
    Statement next;
    next.words = lexer.words_of_line(below);
    if (next.words.empty()) return;
    next.first_line = next.last_line = below;
    std::optional<Diagnostic> problem = mistake_in(language, next);
    if (!problem) return;
    // A title such as "Block on a slope" begins with a word of the modern tree.
    const bool no_leaf = &dialect_of(language, next) == language.modern &&
                         (problem->code == "unknown-word" || problem->code == "not-supported-yet");
    if (!no_leaf && problem->code != "unknown-command") return;
    const std::string text = next.raw(0);
    const std::string_view hint = problem->hint;
    if (const auto from = hint.find('\''); !no_leaf && from != hint.npos && hint.starts_with("did you mean")) {
        next.words.front().text = next.words.front().folded =
            hint.substr(from + 1, hint.find('\'', from + 1) - from - 1);
        if (!mistake_in(language, next)) return; // cylce 100
    }
    statement.body = text;
    statement.last_line = below;
    lexer.go_to(below + 1);
}

/// The line of the second lone `end` after a line, where each `end` closes the body of one function; 0 if there is none. It shows that one
/// function was written inside another.
int second_end(const Lexer& lexer, int from, int last, std::string_view end) {
    int found = 0;
    for (int line = from + 1; line <= last; ++line) {
        const auto words = lexer.words_of_line(line);
        if (words.size() == 2 && words[0].folded.starts_with("def")) return 0;
        if (words.size() == 1 && words[0].folded == end && ++found == 2) return line;
    }
    return 0;
}

} // namespace

bool next_statement(const Language& language, Lexer& lexer, Statement& statement) {
    if (!lexer.next(statement)) return false;
    const Word& first = statement.words.front();
    if (first.kind != WordKind::word) return true;
    if (first.folded == "dialect" && statement.words.size() == 2)
        lexer.read_only(dialects_of(statement.words[1].folded));
    take_text_below(language, lexer, statement);
    const CommandSpec* opens = nullptr;
    for (const auto* spec : commands_called(dialect_of(language, statement), first.folded))
        if (!spec->body_end.empty() && !(spec->body_needs_bare_line && statement.words.size() > 1) &&
            (spec->form.empty() || find_form(*spec, statement)))
            opens = spec;
    if (!opens) return true;

    const auto& lines = lexer.source()->lines;
    const int count = static_cast<int>(lines.size());
    // The body of a script includes its first line when that is part of the script (def NAME), else it starts below (lua).
    const int body_first = opens->body_needs_bare_line ? statement.last_line + 1 : statement.first_line;
    const auto never_ended = [&](int next_line, std::string_view next_name = {}) {
        lexer.go_to(next_line);
        const std::string name = statement.words.size() > 1 ? " '" + statement.words.back().text + "'" : "";
        const std::string before = next_name.empty()
                                       ? "after its last line"
                                       : fmt::format("before '{}' begins in line {}", next_name, next_line);
        Diagnostic d(fmt::format("{}{} is never ended", opens->name(), name),
                     fmt::format("write a line '{}' {}", opens->body_end, before));
        d.code = "never-ended";
        return d.at(first.place);
    };
    for (int line = statement.last_line + 1; line <= count; ++line) {
        const auto words = lexer.words_of_line(line);
        if (words.empty() || words[0].kind != WordKind::word) continue;
        const bool assigns = lines[static_cast<std::size_t>(line - 1)].find('=') != std::string::npos;
        if (words.size() == 2 && !opens->body_needs_bare_line && !assigns && words[1].kind == WordKind::word &&
            std::any_of(opens->words.begin(), opens->words.end(),
                        [&](const Spelling& s) { return s.matches(words[0].folded); })) {
            if (const int end = second_end(lexer, line, count, opens->body_end); end > 0) {
                lexer.go_to(end + 1);
                Diagnostic d(fmt::format("'{}' stands inside of {} '{}'", words[1].text, opens->name(),
                                         statement.words.back().text),
                             "functions cannot be nested: put it before or after that one");
                d.code = "never-ended";
                throw d.at(words[0].place);
            }
            throw never_ended(line, words[1].text); // the next function starts: reading continues there
        }
        if (words.size() != 1 || words[0].folded != opens->body_end) continue;

        const int body_last = opens->body_needs_bare_line ? line - 1 : line;
        for (int i = body_first; i <= body_last; ++i) statement.body += lines[static_cast<std::size_t>(i - 1)] + "\n";
        statement.body_place = {lexer.source(), body_first, 1, 1};
        statement.last_line = line;
        lexer.go_to(line + 1);
        return true;
    }
    throw never_ended(count + 1);
}

std::string BoundCommand::text() const {
    Lexer lexer(place.source, place.line);
    Statement statement;
    if (!lexer.next(statement)) return {};
    if (!statement.body.empty()) return statement.body.substr(0, statement.body.size() - 1);
    std::string text = statement.raw(0);
    for (int line = lexer.line(); line <= last_line; ++line)
        text += "\n" + place.source->lines[static_cast<std::size_t>(line - 1)];
    return text;
}

} // namespace kaya::lang
