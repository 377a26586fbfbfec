#include "base/diagnostic.hpp"
#include "base/nearest_words.hpp"

#include "base/terminal_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <functional>
#include <numeric>

namespace kaya {

namespace {

const char* name_of(Severity severity) {
    switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
    }
    return "error";
}

const char* colour_of(Severity severity) {
    switch (severity) {
    case Severity::note: return "\033[36m";
    case Severity::warning: return "\033[35m";
    case Severity::error: return "\033[31m";
    }
    return "";
}

/// Bytes that continue a UTF-8 character take no column on the screen.
bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The source line with an underline below it. Long lines are cut to a window around the place.
std::string underlined(const Diagnostic& d) {
    if (d.place.line > static_cast<int>(d.place.source->lines.size())) return {};
    std::string line = d.place.source->lines[d.place.line - 1];
    int column = std::clamp(d.place.column, 1, static_cast<int>(line.size()) + 1);
    int length = std::max(1, d.place.length);

    constexpr int window = 100;
    if (static_cast<int>(line.size()) > window) {
        // No character of UTF-8 is longer than four bytes; text of another encoding may look like one that is.
        int from = std::max(0, column - 1 - window / 2);
        for (int back = 0; back < 3 && from > 0 && continues_character(line[from]); ++back) --from;
        std::size_t to = std::min(line.size(), static_cast<std::size_t>(from + window));
        for (int on = 0; on < 3 && to < line.size() && continues_character(line[to]); ++on) ++to;
        line = line.substr(from, to - from);
        column -= from;
        if (from > 0) {
            line = "..." + line;
            column += 3;
        }
    }
    length = std::min<int>(length, std::max<int>(1, static_cast<int>(line.size()) - column + 1));

    // Control characters take more columns on the screen than bytes in the line.
    const auto from = static_cast<std::size_t>(column - 1),
               to = std::min(line.size(), from + static_cast<std::size_t>(length));
    const std::string before = terminal_text(std::string_view(line).substr(0, from)),
                      marked = terminal_text(std::string_view(line).substr(from, to - from)),
                      after = terminal_text(std::string_view(line).substr(to));
    std::string below;
    for (const char c : before) {
        if (c == '\t') below += '\t';
        else if (!continues_character(c)) below += ' ';
    }
    below.append(std::max<std::size_t>(1, std::ranges::count_if(marked, std::not_fn(continues_character))), '^');
    return fmt::format("  {:>4} | {}{}{}\n  {:>4} | {}", d.place.line, before, marked, after, "", below);
}

/// Mistakes between a word as typed and one that may have been meant.
struct Mistakes {
    int whole;     ///< when all of it was meant
    int beginning; ///< of an abbreviation: the language takes any beginning of a word
};

/// More mistakes than this are too many for "did you mean".
constexpr int most_mistakes = 3;

/// Three rows of the table of distances, kept from one word to the next.
using Rows = std::array<std::vector<int>, 3>;

/// Edit distance in which a swap of neighbours counts as one (optimal string alignment). Exact up to `most`;
/// beyond that some number that is larger.
Mistakes mistakes(std::string_view typed, std::string_view meant, Rows& rows, int most = most_mistakes) {
    const std::size_t n = typed.size(), m = meant.size();
    for (auto& row : rows) row.resize(m + 1);
    auto [before, last, row] = std::array{rows[0].data(), rows[1].data(), rows[2].data()};
    std::iota(last, last + m + 1, 0);
    for (std::size_t i = 1; i <= n; ++i) {
        row[0] = static_cast<int>(i);
        int least = row[0];
        for (std::size_t j = 1; j <= m; ++j) {
            const int cost = typed[i - 1] == meant[j - 1] ? 0 : 1;
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + cost});
            if (i > 1 && j > 1 && typed[i - 1] == meant[j - 2] && typed[i - 2] == meant[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
            least = std::min(least, row[j]);
        }
        // No row below can have less than the least of the two above.
        if (least > most + 1) return {least, least};
        std::swap(before, last);
        std::swap(last, row);
    }
    int beginning = last[m];
    for (std::size_t j = 3; j < m; ++j) beginning = std::min(beginning, last[j]);
    return {last[m], beginning};
}

/// A message may hold a word of the deck, and that may be a whole file: its beginning is enough, and its end.
std::string readable(const std::string& message) {
    constexpr std::size_t longest = 500, kept = 200;
    if (message.size() <= longest) return terminal_text(message);
    std::size_t from = kept, to = message.size() - kept;
    while (from > 0 && continues_character(message[from])) --from;
    while (to < message.size() && continues_character(message[to])) ++to;
    return fmt::format("{} ... {}", terminal_text(message.substr(0, from)), terminal_text(message.substr(to)));
}

} // namespace

std::string render(const Diagnostic& d, bool colour, bool with_code) {
    const std::string kind =
        colour ? fmt::format("{}{}\033[0m", colour_of(d.severity), name_of(d.severity)) : name_of(d.severity);
    // The code for `kaya explain`: for readers of a screen or a log, not for programs at the end of a pipe.
    std::string code = with_code && !d.code.empty() ? fmt::format(" [{}]", d.code) : std::string();
    if (colour && !code.empty()) code = fmt::format(" \033[2m[{}]\033[0m", d.code);
    std::string text;
    if (d.place) {
        text = fmt::format("{}:{}:{}: {}: {}{}", terminal_text(d.place.source->name), d.place.line, d.place.column,
                           kind, readable(d.message), code);
        const std::string lines = underlined(d);
        if (!lines.empty()) text += "\n" + lines;
        if (!d.hint.empty()) text += (lines.empty() ? "\n  " : " ") + terminal_text(d.hint);
    } else {
        text = fmt::format("{}: {}{}", kind, readable(d.message), code);
        if (!d.hint.empty()) text += "\n  " + terminal_text(d.hint);
    }
    for (const auto& line : d.context) text += "\n  " + terminal_text(line);
    return text;
}

std::string_view did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
    if (word.empty()) return {};
    // One mistake in a word of up to four letters, two in one of five, three in a longer one: beyond that a guess hurts
    // more than it helps.
    // In halves, so that a shortened word loses against a whole one with as many mistakes, and that the same
    // letters in another order, the commonest slip, win.
    const int limit = 2 * (word.size() <= 4 ? 1 : word.size() <= 5 ? 2 : most_mistakes);
    std::string_view best;
    // An error in an abbreviation counts as well: genn for generate.
    int best_halves = std::max(limit + 1, 4);
    Rows rows;
    for (const auto candidate : candidates) {
        // A word that is so much longer has too many mistakes; it may be a whole file without a blank.
        if (candidate.empty() || word.size() > candidate.size() + static_cast<std::size_t>(limit)) continue;
        const auto [whole, beginning] = mistakes(word, candidate, rows);
        int halves = 2 * whole;
        if (std::is_permutation(word.begin(), word.end(), candidate.begin(), candidate.end())) --halves;
        if (whole >= static_cast<int>(std::max(word.size(), candidate.size()))) continue; // nothing in common
        if (word.size() >= 3 && beginning <= 1) halves = std::min(halves, 2 * beginning + 1);
        // Between equals the one that starts like the word is the likelier.
        const bool likelier =
            halves == best_halves && !best.empty() && candidate.front() == word.front() && best.front() != word.front();
        if (halves < best_halves || likelier) {
            best = candidate;
            best_halves = halves;
        }
    }
    return best;
}

std::vector<std::string_view> nearest_words(std::string_view word, std::vector<std::string_view> candidates,
                                            std::size_t count) {
    constexpr std::size_t longest = 64; // of a word that is compared letter by letter
    const std::string_view typed = word.substr(0, longest);
    Rows rows;
    std::vector<std::pair<int, std::string_view>> ranked;
    for (const auto candidate : candidates) {
        const auto [whole, beginning] = mistakes(typed, candidate, rows, static_cast<int>(longest));
        ranked.emplace_back(std::min(whole, beginning), candidate);
    }
    std::ranges::stable_sort(ranked, {}, &std::pair<int, std::string_view>::first);
    candidates.clear();
    for (std::size_t k = 0; k < std::min(count, ranked.size()); ++k) candidates.push_back(ranked[k].second);
    return candidates;
}

} // namespace kaya
