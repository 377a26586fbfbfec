// Walks over the words of one statement and reads typed values, with a message for each mistake.
#pragma once

#include "lang/interp/spec.hpp"
#include "lang/interp/value.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace kaya::lang {

/// The line holds a `?`: a question and not a mistake. Severity note, code "choices".
class Choices : public Diagnostic {
public:
    Choices(const std::string& text, std::vector<std::string> list, const Place& where);
    std::vector<std::string> words; ///< empty where a number or a name of the user must follow
};

/// The whole words of abbreviated ones, by number of the word in its statement.
using Spelled = std::map<std::size_t, std::string_view>;

class Reader {
public:
    /// Without a source of values, @name and [expression] are accepted where a value is valid and return a wildcard (1, or the text as
    /// typed); late() then tells that the statement must be read again.
    Reader(const Statement& statement, std::size_t first, std::size_t end, const ValueSource* values)
        : statement_(statement), next_(first), end_(end), values_(values) {}

    /// Where spell() stores the whole words; not set: nowhere.
    void keep_spelling(Spelled* spelled) { spelled_ = spelled; }
    /// The word just taken is an abbreviation of this one.
    void spell(std::string_view whole) {
        if (spelled_ != nullptr) (*spelled_)[next_ - 1] = whole;
    }

    bool at_end() const { return next_ >= end_; }
    const Word* peek() const { return at_end() ? nullptr : &statement_.words[next_]; }
    const Word& take(); ///< throws Diagnostic when the word is never closed; not at the end
    const Word& previous() const { return statement_.words[next_ == 0 ? 0 : next_ - 1]; }
    const Statement& statement() const { return statement_; }
    /// Everything that is left, as typed.
    std::string take_raw();

    /// A number, or something that may turn out to be one.
    bool at_number() const;
    /// Whether the next word is a value of the argument's kind, or may turn out to be one; of a text anything but the end.
    bool at(const ArgumentSpec& argument) const;

    double real(const ArgumentSpec& argument);
    std::int64_t integer(const ArgumentSpec& argument);
    std::string text(const ArgumentSpec& argument);
    bool on_off(const ArgumentSpec& argument);
    Vec3 vector(const ArgumentSpec& argument); ///< three numbers, or one @name that is a vector
    /// The next value as integer, real or text.
    Value any(const ArgumentSpec& argument);
    /// The name of a variable or function, written @name; without the @.
    std::string symbol(const ArgumentSpec& argument);

    template <class T> T read(const ArgumentSpec& argument);

    bool late() const { return late_; }
    /// True while @names are wildcards: checks of values against each other must wait.
    bool wildcards() const { return late_ && !has_values(); }

    /// Throws: a value is missing at the place after the last word.
    [[noreturn]] void missing(const ArgumentSpec& argument) const;
    /// Throws: the next word is not among the candidates. `what` is their kind: "a keyword of bound". When none is near, the message lists
    /// `listed`, or all of them.
    [[noreturn]] void unknown(std::string_view what, const std::vector<std::string_view>& candidates,
                              const std::vector<std::string_view>& listed = {}) const;

private:
    bool has_values() const { return values_ && *values_; }
    Value value_of(const Word& word);
    void check_limits(const ArgumentSpec& argument, double value) const; ///< of the word just taken
    /// Name of the word just taken in a message: the name of the argument, or, when that is only a letter, the keyword before it.
    std::string name_of_value(const ArgumentSpec& argument) const;
    const Word& take_value(const ArgumentSpec& argument);

    const Statement& statement_;
    std::size_t next_, end_;
    const ValueSource* values_;
    Spelled* spelled_ = nullptr;
    bool late_ = false;
};

/// Reads keywords of the table while the next word is one of them.
void read_keywords(Reader& reader, const std::vector<KeywordSpec>& keywords, void* target);

template <> inline double Reader::read<double>(const ArgumentSpec& a) { return real(a); }
template <> inline std::int64_t Reader::read<std::int64_t>(const ArgumentSpec& a) { return integer(a); }
template <> inline std::string Reader::read<std::string>(const ArgumentSpec& a) { return text(a); }
template <> inline bool Reader::read<bool>(const ArgumentSpec& a) { return on_off(a); }
template <> inline Vec3 Reader::read<Vec3>(const ArgumentSpec& a) { return vector(a); }
template <> inline std::array<double, 2> Reader::read<std::array<double, 2>>(const ArgumentSpec& a) {
    const double first = real(a);
    return {first, real(a)};
}
template <> inline std::array<double, 6> Reader::read<std::array<double, 6>>(const ArgumentSpec& a) {
    std::array<double, 6> values{};
    for (double& v : values) v = real(a);
    return values;
}

} // namespace kaya::lang
