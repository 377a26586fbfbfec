// Leaves of the modern tree: the words of a line, for a meaning that a classic command has as well. Arguments, units, limits and members of
// the meaning are those of the classic table; a leaf adds words only.
#pragma once

#include "lang/commands/builder.hpp"
#include "lang/commands/language.hpp"

#include <stdexcept>
#include <string_view>
#include <vector>

namespace kaya::lang {

/// "block gridpoint apply" as the words of a command; "exit|quit" are two spellings of one word.
std::vector<std::vector<Spelling>> tree_words(std::string_view words);
/// The classic command of this name, "poly brick". It exists, or the tables are wrong: std::logic_error.
const CommandSpec& classic_command(std::string_view name);
/// The keyword of a classic command by one of its words.
const KeywordSpec& classic_keyword(const CommandSpec& command, std::string_view word);

/// The modern range phrase.
const RangeGrammar& modern_ranges();

template <class Command> class Leaf : public Entry<Command> {
    using Base = Entry<Command>;

public:
    explicit Leaf(std::string_view words) : Base(tree_words(words).front()) {
        const auto all = tree_words(words);
        for (std::size_t i = 1; i < all.size(); ++i) Base::then(all[i]);
        if constexpr (requires(Command & c) { c.place = Place{}; }) Base::place(&Command::place);
    }
    /// A leaf on the meaning of a classic command.
    Leaf(std::string_view words, std::string_view classic) : Leaf(words) {
        meaning_ = &classic_command(classic);
        if (meaning_->index != index_of<Command>)
            throw std::logic_error("the leaf and its meaning have different structs");
        this->spec_.help = meaning_->help;
        this->spec_.start = meaning_->start;
        this->spec_.classic = classic;
    }
    /// A leaf that fills the struct in another way than the classic command does; the words of a line may still be those of that command.
    Leaf& means(std::string_view classic) { return this->spec_.classic = classic, *this; }

    /// The words for a keyword of the meaning.
    Leaf& word(std::string_view words, std::string_view classic, std::string_view help = {}) {
        KeywordSpec keyword = classic_keyword(*meaning_, classic);
        keyword.classic = keyword.words.front().word;
        keyword.words = tree_words(words).front();
        if (!help.empty()) keyword.help = help;
        this->keywords_.add(std::move(keyword));
        return *this;
    }
    /// The arguments before the keywords are those of the meaning.
    Leaf& arguments_of_meaning() { return this->spec_.arguments = meaning_->arguments, *this; }
    /// The argument of a keyword of the meaning follows the name.
    Leaf& argument_of(std::string_view classic) {
        const KeywordSpec& keyword = classic_keyword(*meaning_, classic);
        this->spec_.arguments = {{keyword.arguments.front(), keyword.read, keyword.write}};
        return *this;
    }
    /// So are the values that no word announces.
    Leaf& values_of_meaning() {
        this->spec_.otherwise = meaning_->otherwise;
        this->spec_.otherwise_arguments = meaning_->otherwise_arguments;
        this->spec_.values = meaning_->values;
        this->spec_.values_last = meaning_->values_last;
        return *this;
    }
    /// So are the checks of the whole line.
    Leaf& checks_of_meaning() { return this->spec_.finish = meaning_->finish, *this; }

    Leaf& ranged(RangePhrase Command::*phrase) { return Base::range(phrase, true, modern_ranges()), *this; }

    using Base::prints;
    /// The keyword added last is printed as another one.
    Leaf& prints(Write write) { return this->keywords_.prints(std::move(write)), *this; }

    /// The keyword added last has these classic words.
    Leaf& said(std::string_view classic) { return this->keywords_.said(classic), *this; }

    /// Words that are read without effect.
    Leaf& no_effect(std::string_view words, std::string_view help) {
        Base::action(
            tree_words(words).front(), [](Command&) {}, help)
            .ignored();
        return *this;
    }
    /// The same for words that take on or off.
    Leaf& no_effect_switch(std::string_view words, std::string_view help) {
        Base::keyword(
            tree_words(words).front(), on_off(), [](Command&, bool) {}, help)
            .ignored();
        return *this;
    }

private:
    const CommandSpec* meaning_ = nullptr;
};

/// A line that is accepted without effect; `instead` says why that is right.
CommandSpec ignored_line(std::string_view words, std::string_view help, const char* instead, std::string_view example);
/// The words that choose the columns of a list of objects.
void add_subjects(Leaf<List>& leaf, List::What what);
/// A line that shows a part of the model, or the columns that its words ask for. `wrong` is a line with a misspelt one.
CommandSpec list_line(std::string_view words, List::What what, std::string_view help, std::string_view example,
                      std::string_view classic, Example wrong = {});
/// A line that is known by name.
CommandSpec unsupported_line(std::string_view words, std::string_view about);

} // namespace kaya::lang
