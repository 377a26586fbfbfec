#include "lang/interp/lexer.hpp"

#include "lang/interp/brackets.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace kaya::lang {

namespace {

/// These separate words and mean nothing else: (1,2) = 1 2.
bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '(' || c == ')' || c == ',' || c == '=' || c == '\f' || c == '\v';
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Makes a number of the word when the whole of it is one: 3, 3., .5, +0.01, 1e-6.
void read_number(Word& word) {
    std::string_view text = word.text;
    if (text.starts_with('+')) text.remove_prefix(1);
    std::string_view digits = text;
    if (digits.starts_with('-')) digits.remove_prefix(1);
    // from_chars also takes "inf" and "nan", which are names here.
    const bool starts = !digits.empty() && (is_digit(digits[0]) || (digits[0] == '.' && digits.size() > 1));
    if (!starts || (word.text[0] == '+' && text[0] == '-')) return;

    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || error == std::errc::invalid_argument) return;
    if (error == std::errc::result_out_of_range) {
        const auto exponent = text.find_first_of("eE");
        const bool tiny = exponent != std::string_view::npos && text.substr(exponent + 1).starts_with('-');
        value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    }
    word.kind = WordKind::number;
    word.number = value;
    const auto whole = std::from_chars(text.data(), text.data() + text.size(), word.integer);
    word.whole = whole.ec == std::errc{} && whole.ptr == text.data() + text.size();
}

/// Nothing but blanks and a comment, from there to the end of the line.
bool ends_at(std::string_view line, std::size_t from) {
    const auto rest = line.find_first_not_of(" \t", from);
    return rest == std::string_view::npos || line[rest] == ';';
}

} // namespace

std::string fold(std::string_view text) {
    std::string folded(text);
    for (char& c : folded)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return folded;
}

bool Lexer::read_line(int line_number, std::vector<Word>& words) const {
    const std::string_view line = source_->lines[static_cast<std::size_t>(line_number - 1)];
    const std::size_t size = line.size();
    std::size_t i = 0;
    bool continued = false;

    const auto add = [&](WordKind kind, std::size_t from, std::size_t to, std::string text) {
        Word word;
        word.kind = kind;
        word.text = std::move(text);
        word.place = {source_, line_number, static_cast<int>(from) + 1, static_cast<int>(to - from)};
        if (kind == WordKind::word) read_number(word);
        word.folded = fold(word.text);
        words.push_back(std::move(word));
    };
    /// After a continuation mark only blanks and a comment may follow; otherwise it is not a mark.
    const auto ends_after = [&](std::size_t from) { return ends_at(line, from); };

    while (i < size) {
        const char c = line[i];
        if (c == ';') break;
        if (is_blank(c)) {
            ++i;
            continue;
        }
        if ((c == '&' && ends_after(i + 1)) || (line.substr(i, 3) == "..." && ends_after(i + 3))) {
            continued = true;
            break;
        }
        const std::size_t from = i;
        if (c == '\'' || c == '"') {
            std::string text;
            bool closed = false;
            for (++i; i < size; ++i) {
                if (line[i] != c) text += line[i];
                else if (i + 1 < size && line[i + 1] == c) text += line[i++];
                else {
                    closed = true;
                    ++i;
                    break;
                }
            }
            add(closed ? WordKind::text : WordKind::open, from, i, closed ? text : std::string(line.substr(from)));
            continue;
        }
        if (c == '[') {
            const auto end = past_closing(line, i, '[', ']');
            i = end == std::string_view::npos ? size : end;
            const bool closed = end != std::string_view::npos;
            add(closed ? WordKind::expression : WordKind::open, from, i,
                std::string(closed ? line.substr(from + 1, i - from - 2) : line.substr(from)));
            continue;
        }
        while (i < size && !is_blank(line[i]) && line[i] != ';') ++i;
        if (c == '@' && i < size && line[i] == '(' && i > from + 1) {
            const auto end = past_closing(line, i, '(', ')');
            i = end == std::string_view::npos ? size : end;
            const bool closed = end != std::string_view::npos;
            add(closed ? WordKind::symbol : WordKind::open, from, i,
                std::string(line.substr(from + (closed ? 1 : 0), i - from - (closed ? 1 : 0))));
            continue;
        }
        // A mark may be glued to the last word of the line: "10&", "10...".
        std::size_t to = i;
        if (ends_after(i)) {
            const std::string_view word = line.substr(from, i - from);
            if (word.ends_with('&')) to = i - 1;
            else if (word.ends_with("...")) to = i - 3;
            continued = to < i;
        }
        if (c == '@') add(WordKind::symbol, from, to, std::string(line.substr(from + 1, to - from - 1)));
        else add(WordKind::word, from, to, std::string(line.substr(from, to - from)));
        if (continued) break;
    }
    return continued;
}

namespace {

/// Whether a mark at the end of the text, before a comment, says that the line below belongs to it.
bool is_continued(std::string_view text) {
    for (const std::string_view mark : {"&", "..."})
        if (const auto at = text.rfind(mark); at != text.npos && ends_at(text, at + mark.size())) return true;
    return false;
}

} // namespace

/// A bracket that is closed on a later line: each line in it is an expression or an assignment of FISH, and one word. Without such lines it
/// there is no statement.
bool Lexer::read_bracket(Statement& statement) {
    const auto& lines = source_->lines;
    const auto text_of = [&](int number) -> const std::string& { return lines[static_cast<std::size_t>(number - 1)]; };
    const std::size_t open = text_of(line_).find_first_not_of(" \t");
    if (open == std::string::npos || text_of(line_)[open] != '[') return false;
    int depth = 0, last = line_;
    std::size_t end = past_last_closing(text_of(last), open, depth);
    if (end != std::string::npos) return false;
    while (end == std::string::npos && ++last <= static_cast<int>(lines.size()))
        end = past_last_closing(text_of(last), 0, depth);
    if (end == std::string::npos || !ends_at(text_of(last), end)) return false;

    bool goes_on = false;
    for (int number = line_; number <= last; ++number) {
        const std::string& line = text_of(number);
        statement.body += line + "\n";
        const std::string_view inner = std::string_view(line).substr(0, number == last ? end - 1 : line.size());
        const std::size_t from = inner.find_first_not_of(" \t", number == line_ ? open + 1 : 0);
        if (from == std::string_view::npos || inner[from] == ';') continue;
        if (goes_on) {
            statement.words.back().text.append("\n").append(inner);
        } else {
            Word word;
            word.kind = WordKind::expression;
            word.text = inner.substr(from);
            word.place = {source_, number, static_cast<int>(from) + 1, static_cast<int>(word.text.size())};
            statement.words.push_back(std::move(word));
        }
        goes_on = is_continued(inner);
    }
    for (Word& word : statement.words) word.folded = fold(word.text);
    statement.last_line = last;
    line_ = last + 1;
    return true;
}

bool Lexer::next(Statement& statement) {
    const int count = static_cast<int>(source_->lines.size());
    statement = {};
    statement.dialects = dialects_;
    while (line_ <= count) {
        if (statement.words.empty()) {
            statement.first_line = line_;
            if (read_bracket(statement)) {
                if (!statement.words.empty()) return true;
                statement.body.clear();
                continue;
            }
        }
        const std::string& line = source_->lines[static_cast<std::size_t>(line_ - 1)];
        const bool continued = read_line(line_++, statement.words);
        statement.last_line = line_ - 1;
        // A line that holds only a comment does not end the statement around it.
        const auto start = line.find_first_not_of(" \t");
        const bool comment = start != std::string::npos && line[start] == ';';
        if (!continued && !comment && !statement.words.empty()) return true;
    }
    return !statement.words.empty();
}

std::vector<Word> Lexer::words_of_line(int line) const {
    std::vector<Word> words;
    read_line(line, words);
    return words;
}

std::string Word::shown() const {
    return kind == WordKind::text ? fmt::format("the text {}", raw_text()) : fmt::format("'{}'", raw_text());
}

bool Lexer::continued(int line) const {
    std::vector<Word> words;
    return read_line(line, words);
}

std::string Word::raw_text() const {
    const std::string& line = place.source->lines[static_cast<std::size_t>(place.line - 1)];
    return line.substr(static_cast<std::size_t>(place.column - 1), static_cast<std::size_t>(place.length));
}

std::string Statement::raw(std::size_t first) const {
    std::string text;
    for (std::size_t i = first; i < words.size();) {
        const Place& from = words[i].place;
        std::size_t last = i;
        while (last + 1 < words.size() && words[last + 1].place.line == from.line) ++last;
        const Place& to = words[last].place;
        if (!text.empty()) text += ' ';
        const std::string& line = from.source->lines[static_cast<std::size_t>(from.line - 1)];
        auto begin = static_cast<std::size_t>(from.column - 1);
        auto end = static_cast<std::size_t>(to.column + to.length - 1);
        // Brackets are blanks to the language and text to the reader: f(a), f ( a ), (one) brick
        for (std::size_t at = begin; at > 0 && std::string_view("( \t").find(line[at - 1]) != std::string_view::npos;
             --at)
            if (line[at - 1] == '(') begin = at - 1;
        while (line.find_first_not_of(" \t", end) < line.size() && line[line.find_first_not_of(" \t", end)] == ')')
            end = line.find(')', end) + 1;
        text += line.substr(begin, end - begin);
        i = last + 1;
    }
    return text;
}

} // namespace kaya::lang
