#include "lang/fish/command_lines.hpp"

#include "base/lower_case.hpp"

namespace kaya::fish {

namespace {

bool is_part_of_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '$' ||
           static_cast<unsigned char>(c) >= 0x80;
}

/// Position after the bracket that closes the one at `from`; npos when there is none.
std::size_t after_bracket(std::string_view text, std::size_t from) {
    char quote = 0;
    for (std::size_t i = from + 1; i < text.size(); ++i) {
        if (quote) quote = text[i] == quote ? 0 : quote;
        else if (text[i] == '\'' || text[i] == '"') quote = text[i];
        else if (text[i] == ']') return i + 1;
    }
    return std::string_view::npos;
}

/// Nothing but blanks and a comment.
bool is_blank(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == std::string_view::npos || text[first] == ';';
}

class CommandLineReader {
public:
    CommandLineReader(const RawLine& raw, Dialect dialect, ExpressionReader read_expression)
        : raw_(raw), dialect_(dialect), read_expression_(read_expression) {
        result_.line = raw.place.line;
    }

    CommandLine read() {
        char quote = 0;
        for (at_ = 0; at_ < raw_.text.size();) {
            const char c = raw_.text[at_];
            if (quote) quote = c == quote ? 0 : quote;
            else if (c == '\'' || c == '"') quote = c;
            else if (c == '[') {
                take_bracket();
                continue;
            } else if (c == '@' && at_ + 1 < raw_.text.size() && is_part_of_name(raw_.text[at_ + 1])) {
                take_name();
                continue;
            }
            plain_ += c;
            ++at_;
        }
        if (!result_.evaluated) flush();
        return std::move(result_);
    }

private:
    void flush() {
        if (!plain_.empty()) result_.pieces.push_back({plain_, {}});
        plain_.clear();
    }

    Place place_of(std::size_t from, std::size_t length) const {
        Place place = raw_.place;
        const std::string before = raw_.text.substr(0, from);
        for (const char c : before) place.line += c == '\n' ? 1 : 0;
        const auto line_start = before.rfind('\n');
        place.column = line_start == std::string::npos ? raw_.place.column + static_cast<int>(from)
                                                       : static_cast<int>(from - line_start);
        place.length = static_cast<int>(length);
        return place;
    }

    void take_bracket() {
        const std::size_t end = after_bracket(raw_.text, at_);
        if (end == std::string::npos)
            throw Diagnostic("the bracket is not closed", "put ] after the expression").at(place_of(at_, 1));
        result_.evaluated =
            is_blank(std::string_view(raw_.text).substr(0, at_)) && is_blank(std::string_view(raw_.text).substr(end));
        if (result_.evaluated) plain_.clear();
        flush();
        const std::string inner = raw_.text.substr(at_ + 1, end - at_ - 2);
        ExpressionTree tree = read_expression_(inner, place_of(at_ + 1, inner.size()), dialect_);
        CommandPiece piece;
        if (tree.assignment.empty()) {
            piece.expression.push_back(std::move(tree.value));
        } else {
            if (!result_.evaluated)
                throw Diagnostic("an assignment cannot stand inside of a command").at(place_of(at_ + 1, inner.size()));
            result_.one_each = tree.assignment.front().one_each;
            result_.target.push_back(std::move(tree.assignment.front().target));
            piece.expression.push_back(std::move(tree.assignment.front().value));
        }
        result_.pieces.push_back(std::move(piece));
        at_ = end;
    }

    void take_name() {
        flush();
        std::size_t end = at_ + 1;
        while (end < raw_.text.size() && is_part_of_name(raw_.text[end])) ++end;
        CommandPiece piece;
        piece.text = raw_.text.substr(at_, end - at_);
        Node name;
        name.kind = NodeKind::name;
        name.text = lower_case(piece.text.substr(1));
        name.place = place_of(at_, end - at_);
        piece.expression.push_back(std::move(name));
        result_.pieces.push_back(std::move(piece));
        at_ = end;
    }

    const RawLine& raw_;
    Dialect dialect_;
    ExpressionReader read_expression_;
    std::size_t at_ = 0;
    std::string plain_;
    CommandLine result_;
};

} // namespace

CommandLine read_command_line(const RawLine& raw, Dialect dialect, ExpressionReader read_expression) {
    return CommandLineReader(raw, dialect, read_expression).read();
}

std::string first_word(std::string_view text) {
    std::size_t from = text.find_first_not_of(" \t\r");
    if (from == std::string_view::npos) return {};
    std::size_t to = text.find_first_of(" \t\r", from);
    return lower_case(text.substr(from, to == std::string_view::npos ? to : to - from));
}

} // namespace kaya::fish
