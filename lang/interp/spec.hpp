// The language as data: names, arguments and explanations of commands. The binder, help, completion, pages, editor grammars and the fuzz
// dictionary are made from these tables.
#pragma once

#include "base/abbreviation.hpp"
#include "lang/interp/lexer.hpp"
#include "lang/interp/printed.hpp"

#include <any>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <vector>

namespace kaya::lang {

class Reader;
struct RangePhrase;
struct MemberHash;
using MemberHashes = std::vector<MemberHash>;

enum class ArgumentKind {
    real,    ///< a number
    integer, ///< a whole number
    text,    ///< a word or a quoted text
    on_off   ///< on|off, true|false, yes|no
};

struct Limits {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    bool low_excluded = false, high_excluded = false;

    bool hold(double value) const {
        return (low_excluded ? value > low : value >= low) && (high_excluded ? value < high : value <= high);
    }
};

/// One value, or several of the same kind ("x1 x2").
struct ArgumentSpec {
    std::string_view name; ///< "edge"; several values: their names with blanks between
    ArgumentKind kind = ArgumentKind::real;
    int count = 1;
    bool optional = false;
    bool repeated = false;      ///< as many as there are
    std::string_view unit = {}; ///< the quantity: "length", "stress", ...; kaya never converts units
    Limits limits = {};
    std::string_view help = {};
};

/// A word that may be typed, and how much of it is enough.
struct Spelling {
    std::string_view word;
    std::size_t shortest = 2; ///< letters; the whole word is always enough

    Spelling(const char* text) : word(text) {}
    Spelling(std::string_view text, std::size_t letters) : word(text), shortest(letters) {}

    /// `typed` is folded. A word with hyphens may be abbreviated in each of its parts: pos-x for position-x. Every hyphen must be typed.
    bool matches(std::string_view typed) const {
        return typed == word || (typed.size() >= shortest && word.starts_with(typed)) ||
               shortens_each_part(typed, word, '-');
    }
};

/// How a word of the tables is treated.
enum class Support {
    runs,
    ignored, ///< read, and without effect here
    not_yet  ///< refused as not supported yet, which helps more than "unknown"
};

/// A word inside a command and its arguments. `target` of read is the struct of the command.
struct KeywordSpec {
    std::vector<Spelling> words; ///< the first is the canonical one
    std::vector<ArgumentSpec> arguments;
    std::string_view help;
    std::function<void(Reader&, void* target)> read;
    std::vector<KeywordSpec> keywords; ///< that belong to this one: sphere center .. radius ..
    Support support = Support::runs;
    /// Of a modern keyword: the classic word of the same meaning, "" when there is none. Several words: each takes one of the values. A
    /// blank: the values alone say it.
    std::string classic = {};
    Write write = {};     ///< what may follow the word; not set: the word is never printed
    bool between = false; ///< is not the last word of a line
};

/// The arguments before the keywords, in order.
struct PositionalSpec {
    ArgumentSpec argument;
    std::function<void(Reader&, void* target)> read;
    Write write = {};
};

/// Right when `message` is empty, else the line gives exactly this message.
struct Example {
    std::string_view text;
    std::string_view message;
    std::string_view classic = {}; ///< of a modern line: the classic line that means the same
};

/// What the interpreter itself does at the command.
enum class Flow {
    next, ///< the handler runs, then the next command
    call, ///< another file runs
    leave_file,
    leave_all
};

struct CommandSpec {
    std::size_t index = 0;       ///< of its struct among those of all commands
    std::vector<Spelling> words; ///< first word, the first spelling is the canonical one
    std::vector<std::vector<Spelling>>
        form; ///< the words after it where there are such, each like the first: poly brick
    std::string_view help;
    std::vector<PositionalSpec> arguments;
    std::vector<KeywordSpec> keywords;
    std::vector<Example> right, wrong;

    Support support = Support::runs;
    /// Of a modern command: the classic one that may say the same, with the words that follow its name: "set dt"; "" when there is none.
    std::string_view classic = {};
    bool options_before_form = false; ///< poly region 1 brick ...
    Flow flow = Flow::next;
    std::string_view body_end;         ///< "end": the lines up to this word belong to the command
    bool body_needs_bare_line = false; ///< only a line without further words opens a body (lua)
    bool raw = false;                  ///< takes the rest of the line unparsed

    /// Elements of a range phrase, when the command takes one.
    const std::vector<KeywordSpec>* range_elements = nullptr;
    bool range_without_word = false; ///< `hide z 0 1`, in place of `hide range z 0 1`

    // The links to the struct, made and type-checked by the builder.
    std::function<std::any()> make;
    std::function<void*(std::any&)> address;
    std::function<void(Reader&, void*)> read_range;
    std::function<void(const Statement&, void*)> start; ///< place and body, before anything is read
    std::function<bool(Reader&, void*)> otherwise;      ///< for a word that is not a keyword; false: not taken
    std::vector<ArgumentSpec> otherwise_arguments;
    std::function<void(const Reader&, void*)> finish;        ///< checks of the whole line
    std::function<std::string(const std::any&)> called_file; ///< of Flow::call

    // The links for printing.
    std::function<MemberHashes(const void*)> hash;
    std::function<const RangePhrase*(const void*)> range_of;
    KeywordSpec values;                                 ///< prints what `otherwise` reads
    bool values_last = false;                           ///< after the keywords
    std::function<std::string(const void*)> whole_line; ///< of a command that takes its line unparsed

    std::string name() const; ///< "poly brick"
};

struct Family {
    std::string_view name; ///< "geometry"
    std::string_view help;
    std::vector<CommandSpec> commands;
};

/// Cache of the commands that words stand for: decks use the same few words again and again. Sessions in several threads share a language. A
/// copy of a language has its own commands, so the cache is not copied.
class CommandsCalled {
public:
    using Commands = std::vector<const CommandSpec*>;

    CommandsCalled() = default;
    CommandsCalled(const CommandsCalled&) {}
    CommandsCalled& operator=(const CommandsCalled&) {
        of_.clear();
        return *this;
    }
    /// Null for a word that is not kept. What is kept stays where it is.
    const Commands* find(std::string_view word) const {
        const std::shared_lock lock(mutex_);
        const auto found = of_.find(word);
        return found == of_.end() ? nullptr : &found->second;
    }
    /// Null for a word without commands, once the cache is full.
    const Commands* keep(std::string_view word, Commands commands) {
        // The words of one dialect are unknown to the other, line after line; others may be any number.
        constexpr std::size_t most = 4096; // beyond the first words of all dialects, which are some hundreds
        const std::unique_lock lock(mutex_);
        if (commands.empty() && of_.size() >= most) return nullptr;
        return &of_.emplace(word, std::move(commands)).first->second;
    }

private:
    mutable std::shared_mutex mutex_;
    std::map<std::string, Commands, std::less<>> of_;
};

/// A whole dialect. The order of families and of commands in them resolves abbreviated words.
struct Language {
    std::vector<Family> families;
    std::vector<KeywordSpec> range_elements;
    const Language* modern = nullptr; ///< a second dialect: lines whose first words it knows are of that dialect
    mutable CommandsCalled called{};
};

/// The first entry that is exactly the word, else the first in order that starts with it.
template <class Table, class WordsOf> auto* resolve(Table& table, std::string_view typed, WordsOf words_of) {
    for (auto& entry : table)
        for (const Spelling& s : words_of(entry))
            if (s.word == typed) return &entry;
    for (auto& entry : table)
        for (const Spelling& s : words_of(entry))
            if (s.matches(typed)) return &entry;
    using Entry = std::remove_reference_t<decltype(*std::begin(table))>;
    return static_cast<Entry*>(nullptr);
}

const KeywordSpec* find_keyword(const std::vector<KeywordSpec>& keywords, std::string_view typed);

/// Throws the Diagnostic of a word that is known and not supported yet. `name` is the word in full; `help` explains it.
[[noreturn]] void not_supported_yet(std::string_view name, std::string_view help, const Place& place);

/// "edge, a number greater than 0 [length]"
std::string describe(const ArgumentSpec& argument);

} // namespace kaya::lang
