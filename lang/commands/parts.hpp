// What stands after a word of a line, as a sequence of parts that are tied to the members of a struct. Reading and printing walk over the
// same parts, so a struct prints as it reads.
#pragma once

#include "lang/commands/printer.hpp"
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

/// A value that is not stored as it is read: `set(struct, value)`, and `get(struct)` for the value, or nothing.
template <class Set, class Get> struct Through {
    Set set;
    Get get;
};
template <class Set, class Get> Through(Set, Get) -> Through<Set, Get>;

namespace detail {

template <class Member, class T>
concept HoldsExactly = std::same_as<Member, T> || std::same_as<Member, std::optional<T>>;

template <class Target>
concept GoesThrough = requires(const Target& target) {
    target.set, target.get;
};

/// Puts a value in its place: a member (pointer to member or lambda that gives a reference), a function that takes the struct and the value,
/// or both directions of one. Conversions are refused: a whole number stays one.
template <class Struct, class T, class Target> void put(Struct& to, T value, const Target& target) {
    if constexpr (GoesThrough<Target>) {
        target.set(to, std::move(value));
    } else if constexpr (std::invocable<const Target&, Struct&, T>) {
        std::invoke(target, to, std::move(value));
    } else {
        using Member = std::remove_cvref_t<std::invoke_result_t<const Target&, Struct&>>;
        static_assert(HoldsExactly<Member, T>, "the member has another type than the argument");
        std::invoke(target, to) = std::move(value);
    }
}

/// Only a function that takes the value cannot be read backwards.
template <class Struct, class T, class Target> constexpr bool gives =
    GoesThrough<Target> || !std::invocable<const Target&, Struct&, T>;

template <class Struct, class T, class Target> std::optional<T> got(const Struct& from, const Target& target) {
    if constexpr (GoesThrough<Target>) return target.get(from);
    else return std::invoke(target, const_cast<Struct&>(from)); // the lambda gives a reference and changes nothing
}

template <class Struct, class T, class Target>
void read_into(Reader& reader, Struct& to, const ArgumentSpec& spec, const Target& target) {
    T value = reader.read<T>(spec);
    if constexpr (GoesThrough<Target> || std::invocable<const Target&, Struct&, T>) {
        try {
            put(to, std::move(value), target);
        } catch (Diagnostic& refused) {
            refused.at(reader.previous().place); // of the value
            throw;
        }
    } else {
        put(to, std::move(value), target);
    }
}

} // namespace detail

/// A part of a struct that has its own parts.
template <class Struct, class Part> struct Lens {
    std::function<Part&(Struct&)> open;
    std::function<const Part*(const Struct& wanted, const Struct& present)> wanted; ///< null: there is none to print
};

/// A new item at the end of a list.
template <class Struct, class Item> Lens<Struct, Item> next_of(std::vector<Item> Struct::*list) {
    return {[list](Struct& to) -> Item& { return (to.*list).emplace_back(); },
            [list](const Struct& wanted, const Struct& present) {
                const std::size_t at = (present.*list).size();
                return at < (wanted.*list).size() ? &(wanted.*list)[at] : nullptr;
            }};
}
/// The last item of a list that has one.
template <class Struct, class Item> Lens<Struct, Item> last_of(std::vector<Item> Struct::*list) {
    return {[list](Struct& to) -> Item& { return (to.*list).back(); },
            [list](const Struct& wanted, const Struct& present) {
                const std::size_t count = (present.*list).size();
                return count > 0 && count <= (wanted.*list).size() ? &(wanted.*list)[count - 1] : nullptr;
            }};
}
template <class Struct, class Part> Lens<Struct, Part> member(Part Struct::*part) {
    return {[part](Struct& to) -> Part& { return to.*part; },
            [part](const Struct& wanted, const Struct&) { return &(wanted.*part); }};
}
/// A part that may be missing: a new one. `part(struct)` is the optional.
template <class Struct, class Part, class Access> Lens<Struct, Part> made_at(Access part) {
    return {[part](Struct& to) -> Part& { return part(to).emplace(); },
            [part](const Struct& wanted, const Struct&) -> const Part* {
                const auto& there = part(const_cast<Struct&>(wanted));
                return there ? &*there : nullptr;
            }};
}
template <class Struct, class Part> Lens<Struct, Part> made(std::optional<Part> Struct::*part) {
    return made_at<Struct, Part>([part](Struct & to) -> auto& { return to.*part; });
}
/// The same, which the words before it have made.
template <class Struct, class Part> Lens<Struct, Part> there(std::optional<Part> Struct::*part) {
    return {[part](Struct& to) -> Part& { return *(to.*part); },
            [part](const Struct& wanted, const Struct& present) {
                return wanted.*part && present.*part ? &*(wanted.*part) : nullptr;
            }};
}
/// The same, which stays when it is there.
template <class Struct, class Part> Lens<Struct, Part> kept(std::optional<Part> Struct::*part) {
    Lens<Struct, Part> lens = made(part);
    lens.open = [part](Struct& to) -> Part& { return to.*part ? *(to.*part) : (to.*part).emplace(); };
    return lens;
}
/// The only item of a list, which the first word about it makes.
template <class Struct, class Item> Lens<Struct, Item> only_of(std::vector<Item> Struct::*list) {
    return {[list](Struct& to) -> Item& { return (to.*list).empty() ? (to.*list).emplace_back() : (to.*list).front(); },
            [list](const Struct& wanted, const Struct&) {
                return (wanted.*list).size() == 1 ? &(wanted.*list).front() : nullptr;
            }};
}
/// One of the kinds of a part.
template <class Kind, class Struct, class Variant> Lens<Struct, Kind> as(Variant Struct::*part) {
    return {[part](Struct& to) -> Kind& { return (to.*part).template emplace<Kind>(); },
            [part](const Struct& wanted, const Struct&) { return std::get_if<Kind>(&(wanted.*part)); }};
}

/// Takes the next word, one of `words`, which may be abbreviated, and returns its number. Throws Diagnostic when there is none, or another;
/// `what` is their kind: "a law of sizes".
std::size_t word_among(Reader& reader, const ArgumentSpec& spec, std::string_view what,
                       const std::vector<std::string_view>& words);

template <class Struct> class Parts {
public:
    /// Words of a line, and the struct after them.
    struct Form {
        PrintedWords words;
        Struct after;
        bool left_out = false; ///< a value that may be left out is; those after it must be, too
    };
    using Forms = std::vector<Form>;
    using WriteStep = std::function<Forms(Form, const Struct& wanted)>;

    /// A part with its own reader and writer, for what none of the others can say. Without a writer: no word, and no change.
    Parts& by(std::function<void(Reader&, Struct&)> read, WriteStep write) {
        steps_.push_back({std::move(read), std::move(write)});
        return *this;
    }
    /// These parts follow.
    Parts& then(const Parts& more) {
        add(steps_, more.steps_);
        add(arguments_, more.arguments_);
        add(keywords_, more.keywords_);
        return *this;
    }
    /// What help says of parts without a description.
    Parts& argument(const ArgumentSpec& argument) { return arguments_.push_back(argument), *this; }
    Parts& described(const std::vector<KeywordSpec>& keywords) { return add(keywords_, keywords), *this; }

    /// What the words before it, or the word itself, mean without a value.
    template <std::invocable<Struct&> Action> Parts& set(Action action) {
        return by([action](Reader&, Struct& to) { action(to); },
                  [action](Form form, const Struct&) {
                      action(form.after);
                      return Forms{std::move(form)};
                  });
    }
    template <class Member, class Value> Parts& set(Member Struct::*member, Value value) {
        return set([member, value](Struct& to) { to.*member = value; });
    }

    /// One value.
    template <class T, class Target> Parts& then(const Argument<T>& argument, Target target) {
        arguments_.push_back(argument.spec);
        return by([spec = argument.spec,
                   target](Reader& reader, Struct& to) { detail::read_into<Struct, T>(reader, to, spec, target); },
                  writes<T>(target));
    }
    /// A value that may be left out.
    template <class T, class Target> Parts& maybe(const Argument<T>& argument, Target target) {
        arguments_.push_back(argument.spec);
        return by(
            [spec = argument.spec, target](Reader& reader, Struct& to) {
                if (reader.at(spec)) detail::read_into<Struct, T>(reader, to, spec, target);
            },
            [write = writes<T>(target)](Form form, const Struct& wanted) {
                Forms forms = form.left_out ? Forms{} : write(form, wanted);
                form.left_out = true;
                forms.push_back(std::move(form));
                return forms;
            });
    }
    /// One more value of a list.
    template <class T> Parts& next(const Argument<T>& argument, std::vector<T> Struct::*list) {
        arguments_.push_back(argument.spec);
        return by(
            [spec = argument.spec, list](Reader& reader, Struct& to) { (to.*list).push_back(reader.read<T>(spec)); },
            [list](Form form, const Struct& wanted) {
                const std::size_t at = (form.after.*list).size();
                if (at >= (wanted.*list).size()) return Forms{};
                (form.after.*list).push_back((wanted.*list)[at]);
                return print_value(form.words, (wanted.*list)[at]) ? Forms{form} : Forms{};
            });
    }
    /// One value or more, up to the next word.
    template <class T> Parts& each(const Argument<T>& argument, std::vector<T> Struct::*list, std::size_t least = 1) {
        arguments_.push_back(argument.spec);
        arguments_.back().repeated = true;
        return by(
            [spec = arguments_.back(), list, least](Reader& reader, Struct& to) {
                for (std::size_t i = 0; i < least || reader.at_number(); ++i)
                    (to.*list).push_back(reader.read<T>(spec));
            },
            [list, least](Form form, const Struct& wanted) {
                const auto& all = wanted.*list;
                auto& have = form.after.*list;
                if (all.size() < have.size() + least) return Forms{};
                for (std::size_t i = have.size(); i < all.size(); ++i) {
                    if (!print_value(form.words, all[i])) return Forms{};
                    have.push_back(all[i]);
                }
                return Forms{std::move(form)};
            });
    }

    /// Parts of a part.
    template <class Part> Parts& in(Lens<Struct, Part> lens, Parts<Part> parts) {
        add(arguments_, parts.arguments());
        add(keywords_, parts.keywords());
        return by([lens, parts](Reader& reader, Struct& to) { parts.read(reader, lens.open(to)); },
                  [lens, parts](Form form, const Struct& wanted) {
                      Forms forms;
                      const Part* part = lens.wanted(wanted, form.after);
                      if (part == nullptr) return forms;
                      Part& before = lens.open(form.after);
                      for (auto& inner : parts.forms({form.words, before}, *part)) {
                          before = std::move(inner.after);
                          forms.push_back({std::move(inner.words), form.after});
                      }
                      return forms;
                  });
    }

    /// One item or more of a list that begin with a number.
    template <class Item> Parts& each_of(std::vector<Item> Struct::*list, const Parts<Item>& item) {
        add(arguments_, item.arguments());
        return by(
            [list, item](Reader& reader, Struct& to) {
                do item.read(reader, (to.*list).emplace_back());
                while (reader.at_number());
            },
            [list, item](Form form, const Struct& wanted) {
                auto& have = form.after.*list;
                if (have.size() >= (wanted.*list).size()) return Forms{};
                for (std::size_t i = have.size(); i < (wanted.*list).size(); ++i) {
                    auto forms = item.forms({std::move(form.words), Item{}}, (wanted.*list)[i]);
                    if (forms.empty()) return Forms{};
                    form.words = std::move(forms.front().words);
                    have.push_back(std::move(forms.front().after));
                }
                return Forms{std::move(form)};
            });
    }

    struct Choice {
        std::string_view word;
        Parts parts;
    };
    /// One of several words with its parts, or nothing.
    Parts& perhaps(std::vector<Choice> choices) {
        return by(
            [choices](Reader& reader, Struct& to) {
                const Word* next = reader.peek();
                if (next == nullptr || next->kind != WordKind::word) return;
                const auto chosen = std::ranges::find(choices, next->folded, &Choice::word);
                if (chosen == choices.end()) return;
                reader.take();
                chosen->parts.read(reader, to);
            },
            also(chosen_of(choices)));
    }
    /// One of several words, which may be abbreviated, with its parts. `what` is their kind: "a law of sizes".
    Parts& one_of(ArgumentSpec argument, std::string_view what, std::vector<Choice> choices) {
        arguments_.push_back(argument);
        return by(
            [=](Reader& reader, Struct& to) {
                std::vector<std::string_view> words;
                for (const Choice& choice : choices) words.push_back(choice.word);
                choices[word_among(reader, argument, what, words)].parts.read(reader, to);
            },
            chosen_of(choices));
    }

    /// One of several keywords. `what` is their kind, `missing` the message when there is none, `listed` all that may stand there.
    Parts& one_of(std::vector<KeywordSpec> keywords, ArgumentSpec missing, std::string_view what,
                  std::vector<std::string_view> listed) {
        add(keywords_, keywords);
        return by(
            [=](Reader& reader, Struct& to) {
                const Word* word = reader.peek();
                if (!word) reader.missing(missing);
                const KeywordSpec* found =
                    word->kind == WordKind::word ? find_keyword(keywords, word->folded) : nullptr;
                if (!found) reader.unknown(what, listed);
                reader.take();
                found->read(reader, &to);
            },
            [=](Form form, const Struct& wanted) {
                Forms forms;
                for (const KeywordSpec& keyword : keywords)
                    for (const Wording& wording : keyword.write(&wanted, &form.after)) {
                        Form said{form.words, *static_cast<const Struct*>(wording.after.get())};
                        said.words.push_back({std::string(keyword.words.front().word)});
                        add(said.words, wording.words);
                        forms.push_back(std::move(said));
                    }
                return forms;
            });
    }

    /// Words in any order, any number of times.
    Parts& words(std::vector<KeywordSpec> keywords) {
        add(keywords_, keywords);
        return by(
            [keywords](Reader& reader, Struct& to) { read_keywords(reader, keywords, &to); },
            [keywords](Form form, const Struct& wanted) { return Forms{printed(keywords, wanted, std::move(form))}; });
    }
    /// Words in any order that fill a text, and `finish(reader, text, struct)` makes its members; `text_of(struct)` is the inverse.
    template <class Text, class Finish, class TextOf>
    Parts& words(std::vector<KeywordSpec> keywords, Finish finish, TextOf text_of) {
        add(keywords_, keywords);
        return by(
            [keywords, finish](Reader& reader, Struct& to) {
                Text text;
                read_keywords(reader, keywords, &text);
                finish(reader, text, to);
            },
            [keywords, text_of](Form form, const Struct& wanted) {
                const Text text = text_of(wanted);
                auto said = Parts<Text>::printed(keywords, text, {std::move(form.words), Text{}});
                return Forms{{std::move(said.words), wanted}};
            });
    }

    /// Called while the line is read: checks, places.
    template <std::invocable<Reader&, Struct&> Test> Parts& check(Test test) { return by(test, {}); }
    /// The place of the word read last.
    Parts& mark(Place Struct::*place) {
        return check([place](Reader& reader, Struct& to) { to.*place = reader.previous().place; });
    }

    const std::vector<ArgumentSpec>& arguments() const { return arguments_; }
    const std::vector<KeywordSpec>& keywords() const { return keywords_; }

    void read(Reader& reader, Struct& to) const {
        for (const Step& each : steps_) each.read(reader, to);
    }
    Forms forms(Form begun, const Struct& wanted) const {
        Forms forms{std::move(begun)};
        for (const Step& each : steps_) {
            if (!each.write) continue;
            Forms further;
            for (Form& form : forms) add(further, each.write(std::move(form), wanted));
            forms = std::move(further);
        }
        return forms;
    }
    Write write() const {
        return [parts = *this](const void* wanted, const void* present) {
            std::vector<Wording> wordings;
            const auto& from = *static_cast<const Struct*>(present);
            for (Form& form : parts.forms({{}, from}, *static_cast<const Struct*>(wanted)))
                wordings.push_back({std::move(form.words), std::make_shared<Struct>(std::move(form.after))});
            return wordings;
        };
    }

    static Form printed(const std::vector<KeywordSpec>& keywords, const Struct& wanted, Form begun) {
        StructPrinter printer(&wanted, std::make_shared<Struct>(begun.after), hash_struct<Struct>);
        printer.print(pointers_to(keywords));
        Wording wording = std::move(printer).result();
        add(begun.words, wording.words);
        return {std::move(begun.words), *static_cast<Struct*>(wording.after.get())};
    }

private:
    struct Step {
        std::function<void(Reader&, Struct&)> read;
        WriteStep write;
    };

    template <class T, class Target> static WriteStep writes(Target target) {
        return [target](Form form, const Struct& wanted) {
            if constexpr (detail::gives<Struct, T, Target>) {
                const std::optional<T> value = detail::got<Struct, T>(wanted, target);
                if (!value || !print_value(form.words, *value)) return Forms{};
                detail::put(form.after, *value, target);
                return Forms{std::move(form)};
            } else {
                (void)target;
                return Forms{};
            }
        };
    }
    static WriteStep chosen_of(const std::vector<Choice>& choices) {
        return [choices](Form form, const Struct& wanted) {
            Forms forms;
            for (const Choice& choice : choices) {
                Form begun = form;
                begun.words.push_back({std::string(choice.word)});
                add(forms, choice.parts.forms(std::move(begun), wanted));
            }
            return forms;
        };
    }
    static WriteStep also(WriteStep write) {
        return [write](Form form, const Struct& wanted) {
            Forms forms{form};
            add(forms, write(std::move(form), wanted));
            return forms;
        };
    }
    template <class List> static void add(List& to, const List& more) { to.insert(to.end(), more.begin(), more.end()); }

    std::vector<Step> steps_;
    std::vector<ArgumentSpec> arguments_;
    std::vector<KeywordSpec> keywords_;
};

} // namespace kaya::lang
