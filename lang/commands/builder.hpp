// Writes one entry of a command table and ties each word to a member of the command's struct.
// The ties are pointers to members or typed lambdas: when the struct changes, the table stops compiling.
#pragma once

#include "lang/commands/commands.hpp"
#include "lang/interp/reader.hpp"

#include <concepts>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

namespace kaya::lang {

/// Description of one argument, with the C++ type that it is read as.
template <class T> struct Argument {
    ArgumentSpec spec;

    Argument unit(std::string_view name) && { return spec.unit = name, *this; }
    Argument help(std::string_view text) && { return spec.help = text, *this; }
    Argument optional() && { return spec.optional = true, *this; }
    Argument above(double low) && { return spec.limits.low = low, spec.limits.low_excluded = true, *this; }
    Argument below(double high) && { return spec.limits.high = high, spec.limits.high_excluded = true, *this; }
    Argument at_least(double low) && { return spec.limits.low = low, *this; }
    Argument at_most(double high) && { return spec.limits.high = high, *this; }
};

inline Argument<double> real(std::string_view name) { return {{.name = name}}; }
inline Argument<std::int64_t> integer(std::string_view name) { return {{.name = name, .kind = ArgumentKind::integer}}; }
inline Argument<std::string> text(std::string_view name) { return {{.name = name, .kind = ArgumentKind::text}}; }
inline Argument<bool> on_off() { return {{.name = "switch", .kind = ArgumentKind::on_off}}; }
inline Argument<Vec3> vector(std::string_view names) { return {{.name = names, .count = 3}}; }
inline Argument<std::array<double, 2>> pair(std::string_view names) { return {{.name = names, .count = 2}}; }
inline Argument<std::array<double, 6>> tensor(std::string_view names) { return {{.name = names, .count = 6}}; }

namespace detail {

template <class Member, class T>
concept HoldsExactly = std::same_as<Member, T> || std::same_as<Member, std::optional<T>>;

/// `target` is a member (pointer to member or lambda that gives a reference) or a function that takes
/// the struct and the value. Conversions are refused: a whole number stays one.
template <class Struct, class T, class Target>
std::function<void(Reader&, void*)> reads(ArgumentSpec spec, Target target) {
    return [spec, target](Reader& reader, void* at) {
        auto& to = *static_cast<Struct*>(at);
        if constexpr (std::invocable<const Target&, Struct&, T>) {
            T value = reader.read<T>(spec);
            try {
                std::invoke(target, to, std::move(value));
            } catch (Diagnostic& refused) {
                refused.at(reader.previous().place); // of the value
                throw;
            }
        } else {
            using Member = std::remove_cvref_t<std::invoke_result_t<const Target&, Struct&>>;
            static_assert(HoldsExactly<Member, T>, "the member has another type than the argument");
            std::invoke(target, to) = reader.read<T>(spec);
        }
    };
}

} // namespace detail

/// A list of keywords that act on one struct.
template <class Struct> class Keywords {
public:
    /// One argument, stored in one member.
    template <class T, class Target>
    Keywords& keyword(std::vector<Spelling> words, Argument<T> argument, Target target, std::string_view help) {
        list_.push_back({std::move(words), {argument.spec}, help, detail::reads<Struct, T>(argument.spec, target), {}});
        return *this;
    }

    /// No argument: calls a function on the struct.
    template <std::invocable<Struct&> Action>
    Keywords& action(std::vector<Spelling> words, Action action, std::string_view help) {
        list_.push_back(
            {std::move(words), {}, help, [action](Reader&, void* at) { action(*static_cast<Struct*>(at)); }, {}});
        return *this;
    }

    /// Any other form: `read` is called after the keyword; `arguments` describe what it reads.
    template <std::invocable<Reader&, Struct&> Read>
    Keywords& special(std::vector<Spelling> words, std::vector<ArgumentSpec> arguments, Read read,
                      std::string_view help, std::vector<KeywordSpec> keywords = {}) {
        list_.push_back({std::move(words), std::move(arguments), help,
                         [read](Reader& reader, void* at) { read(reader, *static_cast<Struct*>(at)); },
                         std::move(keywords)});
        return *this;
    }

    /// A keyword of another table, whose target is the same struct.
    Keywords& add(KeywordSpec keyword) { return list_.push_back(std::move(keyword)), *this; }

    /// The words added last are a spelling of these classic ones.
    Keywords& said(std::string_view classic) { return list_.back().classic = classic, *this; }
    /// The words added last are read without effect.
    Keywords& ignored() { return list_.back().support = Support::ignored, *this; }

    /// Words that are known and refused; `help` explains them.
    Keywords& not_yet(std::vector<Spelling> words, std::string_view help) {
        list_.push_back({std::move(words), {}, help, {}, {}, Support::not_yet});
        return *this;
    }

    std::vector<KeywordSpec> list() && { return std::move(list_); }
    std::vector<KeywordSpec> list() const& { return list_; }

private:
    std::vector<KeywordSpec> list_;
};

/// The elements of range phrases in one dialect; they fill a RangePhrase.
struct RangeGrammar {
    const std::vector<KeywordSpec>& elements;
    std::string_view example; ///< "range z 0 1"
};

/// The classic elements.
const std::vector<KeywordSpec>& range_elements();
const RangeGrammar& classic_ranges();
/// Reads `range ...`, or the elements alone, to the end of the line.
void read_range(Reader& reader, RangePhrase& phrase, const RangeGrammar& grammar = classic_ranges());

/// One command.
template <class Command> class Entry {
public:
    explicit Entry(std::vector<Spelling> words, std::vector<Spelling> form = {}) {
        spec_.words = std::move(words);
        if (!form.empty()) spec_.form.push_back(std::move(form));
        spec_.index = index_of<Command>;
        spec_.make = [] { return std::any(Command{}); };
        spec_.address = [](std::any& command) -> void* { return std::any_cast<Command>(&command); };
    }

    /// One more word of its name.
    Entry& then(std::vector<Spelling> words) { return spec_.form.push_back(std::move(words)), *this; }

    Entry& help(std::string_view text) { return spec_.help = text, *this; }
    Entry& right(std::string_view text) { return spec_.right.push_back({text, {}}), *this; }
    /// A line of another dialect, and the classic line that means the same.
    Entry& right(std::string_view text, std::string_view classic) {
        return spec_.right.push_back({text, {}, classic}), *this;
    }
    Entry& wrong(std::string_view text, std::string_view message) {
        return spec_.wrong.push_back({text, message}), *this;
    }

    template <class T, class Target> Entry& argument(Argument<T> argument, Target target) {
        spec_.arguments.push_back({argument.spec, detail::reads<Command, T>(argument.spec, target)});
        return *this;
    }

    template <class T, class Target>
    Entry& keyword(std::vector<Spelling> words, Argument<T> argument, Target target, std::string_view help) {
        keywords_.keyword(std::move(words), argument, target, help);
        return *this;
    }
    template <class Action> Entry& action(std::vector<Spelling> words, Action action, std::string_view help) {
        keywords_.action(std::move(words), action, help);
        return *this;
    }
    template <class Read> Entry& special(std::vector<Spelling> words, std::vector<ArgumentSpec> arguments, Read read,
                                         std::string_view help, std::vector<KeywordSpec> keywords = {}) {
        keywords_.special(std::move(words), std::move(arguments), read, help, std::move(keywords));
        return *this;
    }

    /// The keyword added last is read without effect.
    Entry& ignored() { return keywords_.ignored(), *this; }
    /// Keywords that are known and refused; `help` explains them.
    Entry& not_yet(std::vector<Spelling> words, std::string_view help) {
        keywords_.not_yet(std::move(words), help);
        return *this;
    }
    Entry& support(Support support) { return spec_.support = support, *this; }

    /// For words that are not keywords: names of properties, @names. `read` returns false, without taking a word, when the word does not
    /// belong to it.
    template <std::predicate<Reader&, Command&> Read> Entry& otherwise(std::vector<ArgumentSpec> arguments, Read read) {
        spec_.otherwise_arguments = std::move(arguments);
        spec_.otherwise = [read](Reader& reader, void* at) { return read(reader, *static_cast<Command*>(at)); };
        return *this;
    }

    /// `needs_word`: range elements are read only after the word range, because the line may hold names of properties that are not known
    /// yet.
    Entry& range(RangePhrase Command::*phrase, bool needs_word = false,
                 const RangeGrammar& grammar = classic_ranges()) {
        spec_.range_elements = &grammar.elements;
        spec_.range_without_word = !needs_word;
        spec_.read_range = [phrase, &grammar](Reader& reader, void* at) {
            read_range(reader, static_cast<Command*>(at)->*phrase, grammar);
        };
        return *this;
    }

    Entry& place(Place Command::*place) {
        return start([place](const Statement& s, Command& c) { c.*place = s.words.front().place; });
    }

    /// Called with the statement before anything is read.
    template <std::invocable<const Statement&, Command&> Start> Entry& start(Start start) {
        spec_.start = [start](const Statement& s, void* at) { start(s, *static_cast<Command*>(at)); };
        return *this;
    }

    /// Called after the last word, for checks that need the whole line.
    template <std::invocable<const Reader&, Command&> Finish> Entry& finish(Finish finish) {
        spec_.finish = [finish](const Reader& reader, void* at) { finish(reader, *static_cast<Command*>(at)); };
        return *this;
    }

    Entry& options_before_form() { return spec_.options_before_form = true, *this; }
    Entry& flow(Flow flow) { return spec_.flow = flow, *this; }
    Entry& calls(std::string Command::*file) {
        spec_.called_file = [file](const std::any& c) { return std::any_cast<const Command&>(c).*file; };
        return flow(Flow::call);
    }
    /// The rest of the line, unparsed.
    Entry& raw() { return spec_.raw = true, *this; }
    Entry& raw(std::string Command::*text) {
        spec_.raw = true;
        return start([text](const Statement& s, Command& c) { c.*text = s.raw(1); });
    }
    /// The lines up to the word `end`.
    Entry& body(std::string_view end, std::string Command::*text, Place Command::*place, bool needs_bare_line) {
        spec_.body_end = end;
        spec_.body_needs_bare_line = needs_bare_line;
        return start([=](const Statement& s, Command& c) {
            c.*text = s.body;
            c.*place = s.body_place;
        });
    }

    operator CommandSpec() const {
        CommandSpec spec = spec_;
        spec.keywords = keywords_.list();
        return spec;
    }

protected:
    CommandSpec spec_;
    Keywords<Command> keywords_;
};

/// Takes the next word, one of `words`, which may be abbreviated, and returns its number. Throws Diagnostic when there is none, or another;
/// `what` is their kind: "a law of sizes".
std::size_t word_among(Reader& reader, const ArgumentSpec& spec, std::string_view what,
                       const std::vector<std::string_view>& words);

/// An incomplete line: "change needs mat, cons, jmat or jcons".
[[noreturn]] void incomplete_line(const Reader& reader, std::string message, std::string hint = {});

} // namespace kaya::lang
