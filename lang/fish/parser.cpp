#include "lang/fish/parser.hpp"

#include "lang/fish/statement_parser.hpp"

#include "lang/fish/open_block.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::fish {

namespace {

constexpr std::array<std::string_view, 14> words_of_statements{"loop",    "endloop", "if",     "else",    "elseif",
                                                               "endif",   "case_of", "case",   "section", "exit",
                                                               "command", "end",     "return", "array"};
constexpr std::size_t deepest_block = 40;
constexpr std::size_t most_arguments = 50;

} // namespace

ParsedFunction Parser::function() {
    if (!lexer_.next_line(line_.tokens)) throw Diagnostic("there is no function here").at(first_);
    line_.restart();
    auto& tree = result_.tree;
    if (line_.take_name("fish")) tree.dialect = Dialect::modern;
    const Token opening = line_.take();
    const bool defines = opening.is_name("def") || opening.is_name("define");
    if (!defines && !(tree.dialect == Dialect::modern && opening.is_name("operator")))
        throw Diagnostic("a FISH function begins with 'def'").at(opening.place);
    read_as(tree.dialect);
    tree.place = opening.place;
    const Token& name = line_.expect_name("the name of the function");
    if (is_one_of(name.text, words_of_statements))
        throw Diagnostic(fmt::format("'{}' is a word of FISH and cannot be the name of a function", name.text),
                         "give the function another name")
            .at(name.place);
    tree.name = name.text;
    if (line_.take_sign("(")) {
        if (!line_.take_sign(")")) {
            add_arguments();
            line_.expect_sign(")", "the arguments of the function");
        }
    }
    line_.expect_end("the head of the function");
    tree.body = block({"def", "end", function_closers, opening.place});
    tree.last_line = line_.peek().place.line;
    line_.take();
    line_.expect_end("'end'");
    if (next_line()) throw Diagnostic("there is more text after the 'end' of the function").at(line_.peek().place);
    if (result_.whilestepping && !tree.arguments.empty())
        throw Diagnostic(fmt::format("'{}' runs in every cycle and cannot have arguments", tree.name),
                         "remove the arguments, or 'whilestepping'")
            .at(tree.place);
    return std::move(result_);
}

ExpressionTree Parser::expression(Dialect dialect) {
    ExpressionTree tree;
    tree.dialect = dialect;
    tree.place = first_;
    read_as(dialect);
    if (!next_line()) throw Diagnostic("an expression is missing here").at(first_);
    for (const std::string_view word : {"global", "local"}) // `[global a = 1]`
        if (line_.peek().is_name(word) && line_.peek(1).kind == TokenKind::name) line_.take();
    if (line_.peek().kind == TokenKind::name) {
        const std::size_t first = line_.at();
        Statement statement;
        statement.place = line_.peek().place;
        Node left = parse_name(line_);
        if (take_assignment(left, statement)) {
            line_.expect_end("the expression");
            tree.assignment.push_back(std::move(statement));
            return tree;
        }
        line_.restart(first);
    }
    tree.value = parse_expression(line_);
    line_.expect_end("the expression");
    return tree;
}

void Parser::read_as(Dialect dialect) {
    lexer_.read_as(dialect);
    line_.dialect = dialect;
}

bool Parser::next_line() {
    const bool found = lexer_.next_line(line_.tokens);
    line_.restart();
    return found;
}

std::vector<Statement> Parser::block(const Block& opened) {
    open_.push_back(opened);
    if (open_.size() > deepest_block)
        throw Diagnostic(fmt::format("more than {} blocks stand in each other", deepest_block),
                         "move the inner ones into another function")
            .at(opened.place);
    std::vector<Statement> body;
    for (;;) {
        if (!next_line()) fail_unclosed(opened);
        const Token& word = line_.peek();
        const bool assigns = line_.peek(1).is_sign("=");
        if (word.kind == TokenKind::name && !assigns) {
            if (is_one_of(word.text, opened.closers)) break;
            if (is_one_of(word.text, all_closers)) fail_wrong_closer(opened, word);
        }
        statement(body);
    }
    open_.pop_back();
    return body;
}

void Parser::fail_unclosed(const Block& opened) {
    if (opened.opening == "def")
        throw Diagnostic(fmt::format("the function '{}' has no 'end'", result_.tree.name),
                         "write 'end' on a separate line after its last statement")
            .at(opened.place);
    throw Diagnostic(fmt::format("this '{}' has no '{}'", opened.opening, opened.closing),
                     fmt::format("write a line '{}' after its last line", opened.closing))
        .at(opened.place);
}

void Parser::fail_wrong_closer(const Block& opened, const Token& word) {
    if (word.text == "case" && !inside("case_of"))
        throw Diagnostic("'case' stands outside of a case_of block", "it begins with a line: case_of EXPRESSION")
            .at(word.place);
    if (opened.opening == "def")
        throw Diagnostic(fmt::format("'{}' closes nothing: no block is open here", word.text)).at(word.place);
    throw Diagnostic(fmt::format("expected '{}' to close the '{}' of line {}, found '{}'", opened.closing,
                                 opened.opening, opened.place.line, word.text),
                     fmt::format("write a line '{}' before it", opened.closing))
        .at(word.place);
}

bool Parser::inside(std::string_view opening) const {
    return std::any_of(open_.begin(), open_.end(), [&](const Block& b) { return b.opening == opening; });
}

void Parser::close(std::string_view what) {
    line_.take();
    line_.expect_end(what);
}

void Parser::add_arguments() {
    auto& arguments = result_.tree.arguments;
    do {
        const Token& name = line_.expect_name("the name of an argument");
        if (std::find(arguments.begin(), arguments.end(), name.text) != arguments.end())
            throw Diagnostic(fmt::format("the argument '{}' is named twice", name.text)).at(name.place);
        if (name.text == result_.tree.name)
            throw Diagnostic("an argument has the name of its function", "give it another name").at(name.place);
        if (arguments.size() == most_arguments)
            throw Diagnostic(fmt::format("a function takes at most {} arguments", most_arguments)).at(name.place);
        arguments.push_back(name.text);
        add_default(name);
    } while (line_.take_sign(","));
}

void Parser::add_default(const Token& name) {
    auto& defaults = result_.tree.defaults;
    if (modern() && line_.take_sign("=")) return defaults.push_back(parse_expression(line_));
    if (!defaults.empty())
        throw Diagnostic(fmt::format("the argument '{}' needs a value too: one before it has one", name.text),
                         fmt::format("write: {} = 0, or move it before the others", name.text))
            .at(name.place);
}

void Parser::add_local(const std::string& name) {
    auto& tree = result_.tree;
    const bool known = name == tree.name ||
                       std::find(tree.arguments.begin(), tree.arguments.end(), name) != tree.arguments.end() ||
                       std::find(tree.locals.begin(), tree.locals.end(), name) != tree.locals.end();
    if (!known) tree.locals.push_back(name);
}

void Parser::declaration(std::vector<Statement>& body, bool local) {
    const Place place = line_.take().place;
    if (line_.peek().is_name("array")) return arrays(body, local);
    do {
        Statement made;
        made.place = place;
        Node target;
        target.kind = NodeKind::name;
        const Token name = line_.expect_name("the name of a variable");
        target.text = name.text;
        target.place = name.place;
        if (local) add_local(name.text);
        made.target = target;
        if (line_.take_sign("=")) {
            made.kind = StatementKind::assign;
            made.declares = !local;
            made.value = parse_expression(line_);
        } else if (!local) {
            made.kind = StatementKind::evaluate; // a global exists from its first mention on
            made.value = target;
        }
        body.push_back(std::move(made));
    } while (line_.take_sign(",") || line_.peek().kind == TokenKind::name);
    line_.expect_end("the declaration");
}

void Parser::arrays(std::vector<Statement>& body, bool local) {
    line_.take();
    do {
        Statement made;
        made.kind = StatementKind::array;
        made.place = line_.peek().place;
        if (line_.peek().kind != TokenKind::name) fail_expected(line_, "the name of an array");
        made.target = parse_name(line_);
        if (made.target.children.empty())
            throw Diagnostic(fmt::format("the array '{}' has no size", made.target.text),
                             fmt::format("write {}(n) or {}(n,m)", made.target.text, made.target.text))
                .at(made.target.place);
        if (local) add_local(made.target.text);
        body.push_back(std::move(made));
        line_.take_sign(",");
    } while (!line_.done());
}

void Parser::argument(Statement&) {
    line_.take();
    add_arguments();
    line_.expect_end("the arguments");
}

ParsedFunction parse_function(const std::string& text, const Place& first) { return Parser(text, first).function(); }

ExpressionTree parse_expression_line(const std::string& text, const Place& first, Dialect dialect) {
    return Parser(text, first).expression(dialect);
}

} // namespace kaya::fish
