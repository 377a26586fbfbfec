// Writes one entry of a command table and ties each word to a member of the command's struct.
// The ties are pointers to members or typed lambdas: when the struct changes, the table stops compiling.
#pragma once

#include "lang/commands/commands.hpp"
#include "lang/commands/parts.hpp"

#include <concepts>
#include <functional>
#include <utility>

namespace kaya::lang {

/// An incomplete line: "change needs mat, cons, jmat or jcons".
[[noreturn]] void incomplete_line(const Reader& reader, std::string message, std::string hint = {});

/// A list of keywords that act on one struct.
template <class Struct> class Keywords {
public:
    /// A word and its parts.
    Keywords& keyword(std::vector<Spelling> words, const Parts<Struct>& parts, std::string_view help) {
        list_.push_back({std::move(words), parts.arguments(), help,
                         [parts](Reader& reader, void* at) { parts.read(reader, *static_cast<Struct*>(at)); },
                         parts.keywords()});
        list_.back().write = parts.write();
        return *this;
    }
    /// One argument, stored in one member.
    template <class T, class Target>
    Keywords& keyword(std::vector<Spelling> words, const Argument<T>& argument, Target target, std::string_view help) {
        return keyword(std::move(words), Parts<Struct>().then(argument, target), help);
    }
    /// No argument: calls a function on the struct.
    template <std::invocable<Struct&> Action>
    Keywords& action(std::vector<Spelling> words, Action action, std::string_view help) {
        return keyword(std::move(words), Parts<Struct>().set(action), help);
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

    /// The words added last are printed so.
    Keywords& prints(Write write) { return list_.back().write = std::move(write), *this; }

    /// A keyword of another table, whose target is the same struct.
    Keywords& add(KeywordSpec keyword) { return list_.push_back(std::move(keyword)), *this; }

    /// The words added last are a spelling of these classic ones.
    Keywords& said(std::string_view classic) { return list_.back().classic = classic, *this; }
    /// The words added last cannot end a line.
    Keywords& between() { return list_.back().between = true, *this; }
    /// The words added last fill `member`; a line has them once. Otherwise a Diagnostic with these texts.
    template <class Member>
    Keywords& once(std::optional<Member> Struct::*member, std::string mistake, std::string hint) {
        auto& read = list_.back().read;
        read = [first = read, member, mistake, hint](Reader& reader, void* at) {
            if ((static_cast<Struct*>(at)->*member).has_value()) incomplete_line(reader, mistake, hint);
            first(reader, at);
        };
        return *this;
    }
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
        spec_.hash = hash_struct<Command>;
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
        return this->argument(Parts<Command>().then(argument, target));
    }
    Entry& argument(const Parts<Command>& parts) {
        spec_.arguments.push_back(
            {parts.arguments().front(),
             [parts](Reader& reader, void* at) { parts.read(reader, *static_cast<Command*>(at)); }, parts.write()});
        return *this;
    }

    Entry& keyword(std::vector<Spelling> words, const Parts<Command>& parts, std::string_view help) {
        keywords_.keyword(std::move(words), parts, help);
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

    Entry& between() { return keywords_.between(), *this; }
    template <class Member> Entry& once(std::optional<Member> Command::*member, std::string mistake, std::string hint) {
        return keywords_.once(member, std::move(mistake), std::move(hint)), *this;
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

    /// Values that no word announces; `begins(reader, struct)`: the next word is one.
    template <std::predicate<Reader&, Command&> Begins>
    Entry& values(const Parts<Command>& parts, Begins begins, std::vector<ArgumentSpec> arguments = {}) {
        otherwise(arguments.empty() ? parts.arguments() : std::move(arguments),
                  [parts, begins](Reader& reader, Command& command) {
                      if (!begins(reader, command)) return false;
                      parts.read(reader, command);
                      return true;
                  });
        return prints(parts);
    }

    /// What `otherwise` reads is printed so; `last`: after the keywords.
    Entry& prints(const Parts<Command>& parts, bool last = false) {
        spec_.values.write = parts.write();
        spec_.values_last = last;
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
        spec_.range_of = [phrase](const void* at) { return &(static_cast<const Command*>(at)->*phrase); };
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
    /// The line of a struct whose words are not those of a table.
    template <std::invocable<const Command&> Line> Entry& whole_line(Line line) {
        spec_.whole_line = [line](const void* at) { return line(*static_cast<const Command*>(at)); };
        return *this;
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

/// A name with @ or without: the name itself and not its value.
std::string name_at(Reader& reader, const ArgumentSpec& name);
/// `@name value`, or also `name value`.
Parts<std::pair<std::string, Value>> fish_variable(bool needs_mark);

} // namespace kaya::lang
