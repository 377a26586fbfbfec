#include "lang/fish/expression_parser.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::fish {

namespace {

/// Lua's own parser stops at 200 levels; this limit is well below, and the message has the place.
constexpr int deepest = 60;
constexpr std::size_t most_arguments = 50;
/// Every operator of a long sum is a level of the tree.
constexpr int most_operators = 1000;

struct Comparison {
    std::string_view fish, lua;
};
constexpr std::array<Comparison, 9> comparisons{{{"=", "=="},
                                                 {"==", "=="},
                                                 {"#", "~="},
                                                 {"!=", "~="},
                                                 {"<>", "~="},
                                                 {"<", "<"},
                                                 {">", ">"},
                                                 {"<=", "<="},
                                                 {">=", ">="}}};

const Comparison* comparison_of(const Token& token) {
    if (token.kind != TokenKind::sign) return nullptr;
    for (const auto& comparison : comparisons)
        if (token.text == comparison.fish) return &comparison;
    return nullptr;
}

/// Words that close or continue a block: as a value they would only hide that a value is missing.
constexpr std::array<std::string_view, 8> reserved{"then",  "else",    "elseif",     "end",
                                                   "endif", "endloop", "endsection", "endcase"};

bool is_reserved(std::string_view word) { return std::find(reserved.begin(), reserved.end(), word) != reserved.end(); }

Node binary(std::string_view sign, Place place, Node left, Node right) {
    Node node;
    node.kind = NodeKind::binary;
    node.text = sign;
    node.place = std::move(place);
    node.children.push_back(std::move(left));
    node.children.push_back(std::move(right));
    return node;
}

Node unary(NodeKind kind, Place place, Node child) {
    Node node;
    node.kind = kind;
    node.place = std::move(place);
    node.children.push_back(std::move(child));
    return node;
}

std::string shown(const Token& token) {
    switch (token.kind) {
    case TokenKind::end_of_line: return "the end of the line";
    case TokenKind::text: return fmt::format("the text '{}'", token.text);
    default: return fmt::format("'{}'", token.text);
    }
}

class ExpressionParser {
public:
    explicit ExpressionParser(Line& line) : line_(line) {}

    Node disjunction() {
        const Depth depth(*this);
        Node left = conjunction();
        while (line_.peek().is_sign("|") || is_word("or")) {
            const Place place = take_operator().place;
            left = binary("|", place, std::move(left), conjunction());
        }
        return left;
    }

    Node name() {
        Node node;
        node.kind = NodeKind::name;
        const Token* token = &line_.expect_name("a name");
        const bool makes_structure =
            modern() && (token->text == "struct" || token->text == "structure") && line_.peek().kind == TokenKind::name;
        if (makes_structure) {
            node.kind = NodeKind::structure;
            token = &line_.take();
        }
        node.text = token->text;
        node.place = token->place;
        arguments(node);
        return members(std::move(node));
    }

private:
    /// (a, b), when the line is there
    void arguments(Node& node) {
        if (!line_.take_sign("(")) return;
        node.parentheses = true;
        if (line_.take_sign(")")) return;
        do {
            node.children.push_back(argument());
            if (node.children.size() > most_arguments)
                throw Diagnostic(fmt::format("'{}' is given more than {} arguments", node.text, most_arguments))
                    .at(node.place);
        } while (line_.take_sign(","));
        line_.expect_sign(")", fmt::format("the arguments of '{}'", node.text));
    }

    /// `::list` is each of its elements.
    Node argument() {
        if (!line_.peek().is_sign("::")) return disjunction();
        const Place place = line_.take().place;
        return unary(NodeKind::split, place, disjunction());
    }

    /// ->a->b(c) after a value
    Node members(Node whole) {
        int count = 0;
        while (line_.take_sign("->")) {
            if (++count > deepest)
                throw Diagnostic(fmt::format("more than {} members follow each other", deepest)).at(whole.place);
            Node node;
            node.kind = NodeKind::member;
            const Token& token = line_.expect_name("the name of a member after '->'");
            node.text = token.text;
            node.place = token.place;
            node.children.push_back(std::move(whole));
            arguments(node);
            whole = std::move(node);
        }
        return whole;
    }

    struct Depth {
        explicit Depth(ExpressionParser& parser) : owner(parser) {
            if (++owner.depth_ > deepest)
                throw Diagnostic("the expression is nested too deeply",
                                 "give a part of it to a variable on a line before")
                    .at(owner.line_.peek().place);
        }
        ~Depth() { --owner.depth_; }
        ExpressionParser& owner;
    };

    Token take_operator() {
        if (++operators_ > most_operators)
            throw Diagnostic(fmt::format("the expression has more than {} operators", most_operators),
                             "give a part of it to a variable on a line before")
                .at(line_.peek().place);
        return line_.take();
    }

    Node conjunction() {
        Node left = negation();
        while (line_.peek().is_sign("&") || is_word("and")) {
            const Place place = take_operator().place;
            left = binary("&", place, std::move(left), negation());
        }
        return left;
    }

    /// An operator that the modern dialect has as a word.
    bool is_word(std::string_view word) const { return modern() && line_.peek().is_name(word); }
    bool modern() const { return line_.dialect == Dialect::modern; }

    Node negation() {
        // `not(x)` is the classic function, `not x` the operator of newer decks.
        if (is_word("not") || line_.peek().is_sign("~") ||
            (line_.peek().is_name("not") && !line_.peek(1).is_sign("("))) {
            const Depth depth(*this);
            const Place place = line_.take().place;
            return unary(NodeKind::logical_not, place, negation());
        }
        return comparison();
    }

    Node comparison() {
        Node left = sum();
        const Comparison* sign = comparison_of(line_.peek());
        if (!sign) return left;
        const Place place = line_.take().place;
        left = binary(sign->lua, place, std::move(left), sum());
        if (comparison_of(line_.peek()))
            throw Diagnostic("two comparisons in a row", "join them with '&', or put one in parentheses")
                .at(line_.peek().place);
        return left;
    }

    Node sum() {
        Node left = product();
        while (line_.peek().is_sign("+") || line_.peek().is_sign("-")) {
            const Token sign = take_operator();
            left = binary(sign.text, sign.place, std::move(left), product());
        }
        return left;
    }

    Node product() {
        Node left = signed_power();
        constexpr std::array<std::string_view, 4> signs{"*", "/", "//", "%"};
        while (line_.peek().kind == TokenKind::sign && std::ranges::find(signs, line_.peek().text) != signs.end()) {
            const Token sign = take_operator();
            left = binary(sign.text, sign.place, std::move(left), signed_power());
        }
        return left;
    }

    Node signed_power() {
        const Depth depth(*this);
        if (line_.peek().is_sign("-")) {
            const Place place = line_.take().place;
            return unary(NodeKind::minus, place, signed_power());
        }
        if (line_.take_sign("+")) return signed_power();
        Node base = primary();
        if (!line_.peek().is_sign("^")) return base;
        const Place place = line_.take().place;
        return binary("^", place, std::move(base), signed_power());
    }

    Node primary() {
        const Token& token = line_.peek();
        Node node;
        node.place = token.place;
        switch (token.kind) {
        case TokenKind::integer: node.integer = line_.take().integer; return node;
        case TokenKind::real:
            node.kind = NodeKind::real;
            node.real = line_.take().real;
            return node;
        case TokenKind::text:
            node.kind = NodeKind::text;
            node.text = line_.take().text;
            return node;
        case TokenKind::name:
            if (is_reserved(token.text)) break;
            return name();
        default: break;
        }
        if (line_.take_sign("(")) {
            Node inner = disjunction();
            line_.expect_sign(")", "the parenthesis");
            return members(std::move(inner));
        }
        fail_expected(line_, "a value");
    }

    Line& line_;
    int depth_ = 0;
    int operators_ = 0;
};

} // namespace

bool Line::take_sign(std::string_view sign) {
    if (!peek().is_sign(sign)) return false;
    take();
    return true;
}

bool Line::take_name(std::string_view name) {
    if (!peek().is_name(name)) return false;
    take();
    return true;
}

void Line::expect_sign(std::string_view sign, std::string_view why) {
    if (!take_sign(sign)) fail_expected(*this, fmt::format("'{}' for {}", sign, why));
}

const Token& Line::expect_name(std::string_view what) {
    if (peek().kind != TokenKind::name) fail_expected(*this, what);
    return take();
}

void Line::expect_end(std::string_view after) {
    if (done()) return;
    const Token& rest = peek();
    std::string hint = "one statement stands on one line";
    if (rest.is_name("and") || rest.is_name("or")) hint = "FISH writes & for and, | for or";
    if (rest.is_name("mod")) hint = "the remainder is a - b * int(a / b)";
    if (rest.is_sign(",")) hint = "numbers have a point: 3.5; values of one call stand in its parentheses";
    throw Diagnostic(fmt::format("{} is left over after {}", shown(rest), after), std::move(hint)).at(rest.place);
}

namespace {

/// The likely meaning of a sign where a value is missing.
std::string_view hint_for_missing(const Token& found) {
    if (found.is_sign("*")) return "a value stands before it; powers are written a ^ b";
    if (found.is_sign("/")) return "a comment begins with ;";
    if (found.is_sign("=")) return "one '=' is enough: it compares after `if`, and gives a value elsewhere";
    return "a number, a text in quotes, a name or a parenthesis belongs there";
}

} // namespace

void fail_expected(const Line& line, std::string_view expected, std::string hint) {
    if (hint.empty() && expected == "a value") hint = hint_for_missing(line.peek());
    throw Diagnostic(fmt::format("expected {}, found {}", expected, shown(line.peek())), std::move(hint))
        .at(line.peek().place);
}

std::string hint_for_missing_equals(const Line& line, std::string_view name) {
    // Lines of decks that are written in functions by mistake.
    constexpr std::array<std::string_view, 16> words_of_commands{"print", "list", "cycle",  "cyc", "step", "solve",
                                                                 "poly",  "prop", "delete", "gen", "hist", "save",
                                                                 "plot",  "fix",  "bound",  "grav"};
    const Token &sign = line.peek(), &next = line.peek(1);
    if ((sign.is_sign("+") || sign.is_sign("-")) && (next.is_sign("=") || next.is_sign(sign.text))) // a += 1, a++
        return fmt::format("write: {0} = {0} {1} {2}", name, sign.text, next.is_sign("=") ? "..." : "1");
    if (sign.is_sign("==")) return "one '=' gives a value; '==' compares, after `if` and `loop while`";
    if (std::ranges::find(words_of_commands, name) != words_of_commands.end())
        return "a command stands between the lines `command` and `endcommand`";
    return {};
}

Node parse_expression(Line& line) { return ExpressionParser(line).disjunction(); }
Node parse_name(Line& line) { return ExpressionParser(line).name(); }

} // namespace kaya::fish
