#include "lang/interp/format.hpp"

#include "lang/interp/deck.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::lang {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

std::string without_blanks_at_end(std::string text) {
    while (!text.empty() && is_space(text.back())) text.pop_back();
    return text;
}

/// The text between words or after the last one: runs of blanks become one, a comment is unchanged.
std::string tidied(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == ';') return result.append(text.substr(i));
        if (!is_space(text[i])) result += text[i];
        else if (result.empty() || result.back() != ' ') result += ' ';
    }
    return result;
}

class Formatter {
public:
    Formatter(const Language& language, const Source& source) : language_(language), source_(source) {}

    std::string text() {
        Lexer lexer(source_);
        Statement statement;
        while (problems_.size() < most_errors_shown) {
            try {
                if (!next_statement(language_, lexer, statement)) break;
                if (add(statement) == Flow::leave_file) break;
            } catch (const Diagnostic& problem) {
                // A line that is not supported yet may be right: it is unchanged.
                if (problem.code != "not-supported-yet") problems_.push_back(problem);
            }
        }
        if (!problems_.empty()) throw DeckErrors(std::move(problems_));
        copy_up_to(static_cast<int>(source_->lines.size()));
        return std::move(result_);
    }

private:
    Flow add(const Statement& statement) {
        Spelled spelled;
        const BoundCommand bound = bind_with_names(language_, statement, names_, &spelled);
        names_.learn(*bound.spec, statement);
        const bool bracket = statement.words.front().late() && !statement.body.empty();
        // Names that look like words, and brackets over several lines: the lines are unchanged.
        if (!bound.bare.empty() || bracket) return bound.spec->flow;
        copy_up_to(statement.first_line - 1);
        // The lines of a body follow the line of the last word.
        const int last = statement.body.empty() ? statement.last_line : statement.words.back().place.line;
        for (int line = statement.first_line; line <= last; ++line) add_line(statement, spelled, bound.spec->raw, line);
        done_ = last;
        copy_up_to(statement.last_line);
        return bound.spec->flow;
    }

    void add_line(const Statement& statement, const Spelled& spelled, bool raw, int number) {
        const std::string& line = source_->lines[static_cast<std::size_t>(number - 1)];
        const bool inner = number > statement.first_line;
        std::string text;
        std::size_t at = 0;
        for (std::size_t i = 0; i < statement.words.size(); ++i) {
            const Word& word = statement.words[i];
            if (word.place.line != number) continue;
            if (raw && i > 0) break; // a title, a plot: the rest is unchanged
            const auto from = static_cast<std::size_t>(word.place.column - 1);
            text += tidied(std::string_view(line).substr(at, from - at));
            const auto whole = spelled.find(i);
            text += whole != spelled.end() ? std::string(whole->second) : word.raw_text();
            at = from + static_cast<std::size_t>(word.place.length);
        }
        const std::string_view ending = std::string_view(line).substr(at);
        const std::string rest = raw ? std::string(ending) : tidied(ending);
        // A mark that is joined to its word is set apart, so that every editor can read it.
        const bool joined = !raw && at > 0 && (rest.starts_with('&') || rest.starts_with("..."));
        text = without_blanks_at_end(fmt::format("{}{}{}", text, joined ? " " : "", rest));
        const auto first = std::min(text.find_first_not_of(' '), text.size());
        result_ += fmt::format("{}{}\n", inner && first < text.size() ? "    " : "", text.substr(first));
    }

    /// Lines without a statement: comments, empty lines, functions.
    void copy_up_to(int last) {
        for (; done_ < last; ++done_)
            result_ += fmt::format("{}\n", without_blanks_at_end(source_->lines[static_cast<std::size_t>(done_)]));
    }

    const Language& language_;
    const Source& source_;
    BareNames names_;
    std::string result_;
    int done_ = 0; ///< lines that are in the result
    std::vector<Diagnostic> problems_;
};

} // namespace

std::string format_deck(const Language& language, const Source& source) { return Formatter(language, source).text(); }

} // namespace kaya::lang
