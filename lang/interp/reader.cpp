#include "lang/interp/reader.hpp"

#include "lang/interp/habits.hpp"
#include "lang/interp/number_hints.hpp"
#include "base/odd_letters.hpp"
#include "lang/interp/word_slips.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

namespace kaya::lang {

namespace {

Diagnostic wrong(std::string code, const Place& place, std::string message, std::string hint = {}) {
    Diagnostic d(std::move(message), std::move(hint));
    d.code = std::move(code);
    return d.at(place);
}

std::string expected(const ArgumentSpec& argument) { return "expected: " + describe(argument); }

/// Whether a word means on, or off; none for other words.
std::optional<bool> switched(const Word& word) {
    for (const auto yes : {"on", "true", "yes"})
        if (word.folded == yes) return true;
    for (const auto no : {"off", "false", "no"})
        if (word.folded == no) return false;
    return std::nullopt;
}

void refuse_open(const Word& word) {
    if (word.kind != WordKind::open) return;
    const char first = word.text.front();
    const char* what = first == '[' ? "the bracket '['" : first == '@' ? "the parenthesis '('" : "the quote";
    Diagnostic d = wrong("not-closed", word.place, fmt::format("{} is not closed on this line", what),
                         "close it before the end of the line");
    if (first != '@') d.place.length = 1;
    throw d;
}

bool is_question(const Word& word) { return word.kind == WordKind::word && word.text == "?"; }

const char* name_of(const Value& value) {
    static constexpr const char* names[] = {"nothing yet", "a truth value", "a whole number",
                                            "a number",    "a text",        "a vector"};
    return names[value.index()];
}

Diagnostic wrong_value(const Word& word, const Value& value, const ArgumentSpec& argument, const char* needed) {
    return wrong("wrong-type", word.place,
                 fmt::format("{} is {}, and must be {}", word.shown(), name_of(value), needed), expected(argument));
}

double as_real(const Word& word, const Value& got, const ArgumentSpec& argument) {
    double value = 0;
    if (const auto* r = std::get_if<double>(&got)) value = *r;
    else if (const auto* i = std::get_if<std::int64_t>(&got)) value = static_cast<double>(*i);
    else throw wrong_value(word, got, argument, "a number");
    if (!std::isfinite(value))
        throw wrong("wrong-type", word.place, fmt::format("{} is {}, not a usable number", word.shown(), value),
                    expected(argument));
    return value;
}

} // namespace

Choices::Choices(const std::string& text, std::vector<std::string> list, const Place& where)
    : Diagnostic(text), words(std::move(list)) {
    severity = Severity::note;
    code = "choices";
    place = where;
}

const Word& Reader::take() {
    refuse_open(statement_.words[next_]);
    return statement_.words[next_++];
}

std::string Reader::take_raw() {
    std::string text = at_end() ? std::string() : statement_.raw(next_);
    next_ = end_;
    return text;
}

std::string Reader::name_of_value(const ArgumentSpec& argument) const {
    if (argument.name.size() == 1 && next_ >= 2 && statement_.words[next_ - 2].kind == WordKind::word)
        return statement_.words[next_ - 2].text;
    return std::string(argument.name);
}

void Reader::check_limits(const ArgumentSpec& argument, double value) const {
    const Limits& l = argument.limits;
    if (l.hold(value)) return;
    const bool low = l.low_excluded ? value <= l.low : value < l.low;
    const char* relation =
        low ? (l.low_excluded ? "greater than" : "at least") : (l.high_excluded ? "less than" : "at most");
    throw wrong(
        "out-of-limits", previous().place,
        fmt::format("{} must be {} {:g}, not {:g}", name_of_value(argument), relation, low ? l.low : l.high, value));
}

bool Reader::at_number() const {
    const Word* word = peek();
    return word && (word->kind == WordKind::number || word->late());
}

bool Reader::at(const ArgumentSpec& argument) const {
    switch (argument.kind) {
    case ArgumentKind::real:
    case ArgumentKind::integer: return at_number();
    case ArgumentKind::on_off: return !at_end() && (peek()->late() || switched(*peek()));
    case ArgumentKind::text: break;
    }
    return !at_end();
}

void Reader::missing(const ArgumentSpec& argument) const {
    Place place = previous().place;
    const std::string after = previous().raw_text();
    place.column += place.length;
    place.length = 1;
    const bool number = argument.kind == ArgumentKind::real || argument.kind == ArgumentKind::integer;
    // The name of a property may be any word: `bulk 1 gpa`.
    const auto before = static_cast<std::size_t>(&previous() - statement().words.data());
    if (auto slip = previous().kind == WordKind::word ? slip_hint(statement(), before) : std::string(); !slip.empty())
        throw wrong("missing-value", previous().place, fmt::format("'{}' is not the name of a value", after),
                    std::move(slip));
    throw wrong("missing-value", place, fmt::format("a {} is missing after '{}'", number ? "number" : "word", after),
                expected(argument));
}

namespace {

/// 9,81: a number directly after a comma that directly follows a number.
bool follows_comma(const Word& word) {
    if (word.kind != WordKind::number || !word.place || word.place.column < 3) return false;
    const auto& lines = word.place.source->lines;
    if (word.place.line > static_cast<int>(lines.size())) return false;
    const std::string& line = lines[static_cast<std::size_t>(word.place.line - 1)];
    const auto comma = static_cast<std::size_t>(word.place.column - 2);
    return comma < line.size() && line[comma] == ',' && line[comma - 1] >= '0' && line[comma - 1] <= '9';
}

} // namespace

void Reader::unknown(std::string_view what, const std::vector<std::string_view>& candidates,
                     const std::vector<std::string_view>& listed) const {
    const Word& word = *peek();
    refuse_open(word);
    const std::string list = fmt::format("{}", fmt::join(listed.empty() ? candidates : listed, ", "));
    if (is_question(word))
        throw Choices(candidates.empty() ? "nothing more is allowed here" : fmt::format("{} may be: {}", what, list),
                      {candidates.begin(), candidates.end()}, word.place);
    auto slip = slip_hint(statement(), static_cast<std::size_t>(&word - statement().words.data()));
    if (candidates.empty()) {
        if (slip.empty())
            slip = follows_comma(word) ? "a comma separates values: numbers have a point"
                                       : "nothing more is expected here";
        throw wrong("left-over", word.place, fmt::format("unexpected {} after the end of the command", word.shown()),
                    std::move(slip));
    }
    if (word.kind != WordKind::word)
        throw wrong("not-a-word", word.place, fmt::format("expected {}, found {}", what, word.shown()),
                    slip.empty() ? "expected: " + list : std::move(slip));
    if (word.text == "&" || word.text == "...")
        throw wrong("unknown-word", word.place, fmt::format("'{}' stands in the middle of the line", word.text),
                    "a line is continued by a mark at its very end");
    if (slip.empty()) slip = habit_hint(what, word.folded);
    if (!slip.empty())
        throw wrong("unknown-word", word.place, fmt::format("'{}' is not {}", word.text, what), std::move(slip));
    const auto near = did_you_mean(word.folded, candidates);
    throw wrong("unknown-word", word.place, fmt::format("'{}' is not {}", word.text, what),
                near.empty() ? "expected: " + list : fmt::format("did you mean '{}'?", near));
}

Value Reader::value_of(const Word& word) {
    if (word.text.empty())
        throw wrong("missing-value", word.place, "a name is missing after '@'", "write for example @pressure");
    late_ = true;
    return (*values_)(word.text, word.place);
}

const Word& Reader::take_value(const ArgumentSpec& argument) {
    if (at_end()) missing(argument);
    const Word& word = take();
    if (is_question(word)) throw Choices(expected(argument), {}, word.place);
    if (word.late() && word.text.empty())
        throw wrong("missing-value", word.place, "a name is missing after '@'", "write for example @pressure");
    return word;
}

namespace {

std::string hint_for_number(const Word& word, const ArgumentSpec& argument) {
    if (auto odd = odd_digit_hint(word.text); !odd.empty()) return odd;
    auto hint = number_hint(word.text);
    return hint.empty() ? expected(argument) : hint;
}

std::string hint_for_whole_number(double number) {
    constexpr double most = 9e18; // 64 bits
    if (std::abs(number) > most) return fmt::format("it is too large: at most {:.0f} is possible", most);
    constexpr double most_exact = 9e15;
    if (std::trunc(number) == number && std::abs(number) <= most_exact)
        return fmt::format("write it as {:.0f}", number);
    return "write it without a point or an exponent";
}

} // namespace

double Reader::real(const ArgumentSpec& argument) {
    const Word& word = take_value(argument);
    if (word.late()) {
        late_ = true;
        if (!has_values()) return 1;
        const double value = as_real(word, value_of(word), argument);
        check_limits(argument, value);
        return value;
    }
    if (word.kind != WordKind::number)
        throw wrong("not-a-number", word.place, fmt::format("expected a number, found {}", word.shown()),
                    hint_for_number(word, argument));
    if (std::isinf(word.number))
        throw wrong("out-of-limits", word.place, fmt::format("{} is too large for a number", word.text),
                    "numbers end at 1.8e308: look at the exponent");
    check_limits(argument, word.number);
    return word.number;
}

std::int64_t Reader::integer(const ArgumentSpec& argument) {
    const Word& word = take_value(argument);
    std::int64_t value = word.integer;
    if (word.late()) {
        late_ = true;
        if (!has_values()) return 1;
        const Value got = value_of(word);
        if (const auto* i = std::get_if<std::int64_t>(&got)) value = *i;
        else if (const auto* r = std::get_if<double>(&got); r && *r == std::trunc(*r) && std::abs(*r) < 1e15)
            value = static_cast<std::int64_t>(*r);
        else throw wrong_value(word, got, argument, "a whole number");
    } else if (word.kind != WordKind::number) {
        throw wrong("not-a-number", word.place, fmt::format("expected a whole number, found {}", word.shown()),
                    hint_for_number(word, argument));
    } else if (!word.whole) {
        throw wrong("not-whole", word.place,
                    fmt::format("{} takes a whole number, not {}", name_of_value(argument), word.text),
                    hint_for_whole_number(word.number));
    }
    check_limits(argument, static_cast<double>(value));
    return value;
}

std::string Reader::text(const ArgumentSpec& argument) {
    const Word& word = take_value(argument);
    if (word.late()) {
        late_ = true;
        if (!has_values()) return word.raw_text();
        const Value got = value_of(word);
        if (const auto* s = std::get_if<std::string>(&got)) return *s;
        if (const auto* i = std::get_if<std::int64_t>(&got)) return fmt::format("{}", *i);
        if (const auto* r = std::get_if<double>(&got)) return fmt::format("{:g}", *r);
        throw wrong_value(word, got, argument, "a text");
    }
    if (word.kind == WordKind::text && word.text.empty())
        throw wrong("missing-value", word.place, fmt::format("{} is an empty text", argument.name), expected(argument));
    return word.text;
}

bool Reader::on_off(const ArgumentSpec& argument) {
    const Word& word = take_value(argument);
    if (word.late()) {
        late_ = true;
        if (!has_values()) return true;
        const Value got = value_of(word);
        if (const auto* b = std::get_if<bool>(&got)) return *b;
        if (const auto* i = std::get_if<std::int64_t>(&got)) return *i != 0;
        throw wrong_value(word, got, argument, "on or off");
    }
    if (const auto on = switched(word)) return *on;
    throw wrong("not-on-off", word.place, fmt::format("expected on or off, found {}", word.shown()),
                expected(argument));
}

Vec3 Reader::vector(const ArgumentSpec& argument) {
    const Word* word = peek();
    if (word && word->late()) {
        if (!has_values()) {
            // It may be a vector or the first of three numbers: the next words decide.
            (void)real(argument);
            for (int i = 1; i < 3 && at_number(); ++i) (void)real(argument);
            return Vec3::Ones();
        }
        const Value got = value_of(take());
        if (const auto* v = std::get_if<Vec3>(&got)) return *v;
        const double x = as_real(*word, got, argument), y = real(argument);
        return {x, y, real(argument)};
    }
    const double x = real(argument), y = real(argument);
    return {x, y, real(argument)};
}

Value Reader::any(const ArgumentSpec& argument) {
    const Word& word = take_value(argument);
    if (word.late()) {
        late_ = true;
        return has_values() ? value_of(word) : Value(1.0);
    }
    if (word.kind != WordKind::number) return word.text;
    if (word.whole) return word.integer;
    return word.number;
}

std::string Reader::symbol(const ArgumentSpec& argument) {
    const Word& word = take_value(argument);
    if (word.kind != WordKind::symbol)
        throw wrong("not-a-symbol", word.place, fmt::format("expected a name with @, found {}", word.shown()),
                    fmt::format("write @{}", word.text));
    return word.text;
}

void read_keywords(Reader& reader, const std::vector<KeywordSpec>& keywords, void* target) {
    while (const Word* word = reader.peek()) {
        if (is_question(*word)) {
            std::vector<std::string_view> words;
            for (const auto& keyword : keywords)
                for (const Spelling& s : keyword.words) words.push_back(s.word);
            reader.unknown("the next word", words);
        }
        const KeywordSpec* found = word->kind == WordKind::word ? find_keyword(keywords, word->folded) : nullptr;
        if (!found) return;
        if (found->support == Support::not_yet) not_supported_yet(found->words.front().word, found->help, word->place);
        reader.take();
        reader.spell(found->words.front().word);
        found->read(reader, target);
    }
}

} // namespace kaya::lang
