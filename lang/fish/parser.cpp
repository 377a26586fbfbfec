#include "lang/fish/parser.hpp"

#include "lang/fish/command_lines.hpp"
#include "lang/fish/expression_parser.hpp"
#include "lang/fish/open_block.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::fish {

namespace {

constexpr std::size_t deepest_block = 40;
constexpr std::size_t most_arguments = 50;

class Parser {
public:
    Parser(const std::string& text, const Place& first) : lexer_(text, first), first_(first) {}

    ParsedFunction function() {
        if (!lexer_.next_line(line_.tokens)) throw Diagnostic("there is no function here").at(first_);
        line_.restart();
        line_.take_name("fish");
        const Token opening = line_.take();
        if (!opening.is_name("def") && !opening.is_name("define"))
            throw Diagnostic("a FISH function begins with 'def'").at(opening.place);
        auto& tree = result_.tree;
        tree.place = opening.place;
        tree.name = line_.expect_name("the name of the function").text;
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

    ExpressionTree expression() {
        ExpressionTree tree;
        tree.place = first_;
        if (!next_line()) throw Diagnostic("an expression is missing here").at(first_);
        for (const std::string_view word : {"global", "local"}) // `[global a = 1]`
            if (line_.peek().is_name(word) && line_.peek(1).kind == TokenKind::name) line_.take();
        Node value = parse_expression(line_);
        // `a = 3` reads as a comparison; only a name on the left makes it an assignment.
        if (value.kind == NodeKind::binary && value.text == "==" && value.children[0].kind == NodeKind::name &&
            line_.done() && has_single_equal()) {
            Statement statement;
            statement.kind = StatementKind::assign;
            statement.place = value.children[0].place;
            statement.target = std::move(value.children[0]);
            statement.value = std::move(value.children[1]);
            tree.assignment.push_back(std::move(statement));
            return tree;
        }
        line_.expect_end("the expression");
        tree.value = std::move(value);
        return tree;
    }

private:
    bool next_line() {
        const bool found = lexer_.next_line(line_.tokens);
        line_.restart();
        return found;
    }

    /// The sign of an assignment is `=` and stands outside of all parentheses.
    bool has_single_equal() const {
        int depth = 0;
        for (const auto& token : line_.tokens) {
            if (token.is_sign("(")) ++depth;
            if (token.is_sign(")")) --depth;
            if (depth == 0 && token.is_sign("=")) return true;
        }
        return false;
    }

    // --- blocks -----------------------------------------------------------------------------------

    /// Statements up to a word that closes `opened`; the line is then at that word.
    std::vector<Statement> block(const Block& opened) {
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

    [[noreturn]] void fail_unclosed(const Block& opened) {
        if (opened.opening == "def")
            throw Diagnostic(fmt::format("the function '{}' has no 'end'", result_.tree.name),
                             "write 'end' on a separate line after its last statement")
                .at(opened.place);
        throw Diagnostic(fmt::format("this '{}' has no '{}'", opened.opening, opened.closing)).at(opened.place);
    }

    [[noreturn]] void fail_wrong_closer(const Block& opened, const Token& word) {
        if (word.text == "case" && !inside("case_of"))
            throw Diagnostic("'case' stands outside of a case_of block", "it begins with a line: case_of EXPRESSION")
                .at(word.place);
        if (opened.opening == "def")
            throw Diagnostic(fmt::format("'{}' closes nothing: no block is open here", word.text)).at(word.place);
        throw Diagnostic(fmt::format("expected '{}' to close the '{}' of line {}, found '{}'", opened.closing,
                                     opened.opening, opened.place.line, word.text))
            .at(word.place);
    }

    bool inside(std::string_view opening) const {
        return std::any_of(open_.begin(), open_.end(), [&](const Block& b) { return b.opening == opening; });
    }

    void close(std::string_view what) {
        line_.take();
        line_.expect_end(what);
    }

    // --- statements -------------------------------------------------------------------------------

    using Rule = void (Parser::*)(Statement&);
    struct Keyword {
        std::string_view word;
        Rule rule;
    };

    void statement(std::vector<Statement>& body) {
        static constexpr std::array<Keyword, 19> keywords{{{"loop", &Parser::loop},
                                                           {"if", &Parser::branches},
                                                           {"case_of", &Parser::choice},
                                                           {"caseof", &Parser::choice},
                                                           {"section", &Parser::section},
                                                           {"exit", &Parser::exit},
                                                           {"continue", &Parser::next_round},
                                                           {"command", &Parser::command},
                                                           {"return", &Parser::give_back},
                                                           {"null", &Parser::nothing},
                                                           {"whilestepping", &Parser::whilestepping},
                                                           {"while_stepping", &Parser::whilestepping},
                                                           {"argument", &Parser::argument},
                                                           {"def", &Parser::nested_function},
                                                           {"define", &Parser::nested_function},
                                                           {"then", &Parser::stray},
                                                           {"foreach", &Parser::stray},
                                                           {"while", &Parser::stray},
                                                           {"for", &Parser::stray}}};
        const Token& word = line_.peek();
        const bool assigns = line_.peek(1).is_sign("=");
        if (word.kind == TokenKind::name && !assigns) {
            if (word.text == "array") return arrays(body, false);
            if (word.text == "local" || word.text == "global") return declaration(body, word.text == "local");
            for (const auto& keyword : keywords)
                if (word.text == keyword.word) {
                    Statement made;
                    made.place = word.place;
                    (this->*keyword.rule)(made);
                    body.push_back(std::move(made));
                    return;
                }
        }
        body.push_back(simple());
    }

    /// An assignment, or an expression that is evaluated for its side effects.
    Statement simple() {
        Statement made;
        made.place = line_.peek().place;
        if (line_.peek().kind != TokenKind::name) fail_expected(line_, "a statement");
        Node left = parse_name(line_);
        if (line_.take_sign("=")) {
            made.kind = StatementKind::assign;
            made.target = std::move(left);
            made.value = parse_expression(line_);
            line_.expect_end("the assignment");
            return made;
        }
        if (!line_.done()) {
            // A word that begins like a statement is more likely a misspelt statement than a name.
            const auto near = did_you_mean(left.text, {"loop", "if", "else", "elseif", "case_of", "case", "section",
                                                       "exit", "return", "local", "global", "array", "argument"});
            if (!near.empty() && !left.parentheses && !line_.peek().is_sign("("))
                throw Diagnostic(fmt::format("'{}' does not begin a statement", left.text),
                                 fmt::format("did you mean '{}'?", near))
                    .at(made.place);
            fail_expected(line_, fmt::format("'=' after '{}'", left.text), hint_for_missing_equals(line_, left.text));
        }
        made.kind = StatementKind::evaluate;
        made.value = std::move(left);
        return made;
    }

    void add_arguments() {
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
        } while (line_.take_sign(","));
    }

    void add_local(const std::string& name) {
        auto& tree = result_.tree;
        const bool known = name == tree.name ||
                           std::find(tree.arguments.begin(), tree.arguments.end(), name) != tree.arguments.end() ||
                           std::find(tree.locals.begin(), tree.locals.end(), name) != tree.locals.end();
        if (!known) tree.locals.push_back(name);
    }

    void declaration(std::vector<Statement>& body, bool local) {
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
                made.value = parse_expression(line_);
            } else if (!local) {
                made.kind = StatementKind::evaluate; // a global exists from its first mention on
                made.value = target;
            }
            body.push_back(std::move(made));
        } while (line_.take_sign(",") || line_.peek().kind == TokenKind::name);
        line_.expect_end("the declaration");
    }

    void arrays(std::vector<Statement>& body, bool local) {
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

    void argument(Statement&) {
        line_.take();
        add_arguments();
        line_.expect_end("the arguments");
    }

    void nothing(Statement&) { close("'null'"); }

    void whilestepping(Statement&) {
        close("'whilestepping'");
        result_.whilestepping = true;
    }

    void stray(Statement& made) {
        const std::string& word = line_.peek().text;
        throw Diagnostic(fmt::format("'{}' cannot begin a statement", word),
                         word == "then" ? "" : fmt::format("loops begin with `loop`: loop {} ... endloop", word))
            .at(made.place);
    }

    void nested_function(Statement& made) {
        throw Diagnostic(
            "a function begins inside of another one",
            fmt::format("the function '{}' of line {} has no 'end' yet", result_.tree.name, result_.tree.place.line))
            .at(made.place);
    }

    void loop(Statement& made) {
        const Place opening = line_.take().place;
        if (line_.take_name("while")) {
            made.kind = StatementKind::loop_while;
            made.value = parse_expression(line_);
        } else if (line_.take_name("foreach")) {
            made.kind = StatementKind::loop_each;
            const bool local = line_.take_name("local");
            const Token name = line_.expect_name("the loop variable");
            if (local) add_local(name.text);
            set_target(made, name);
            made.value = parse_expression(line_);
        } else if (line_.peek().is_name("for") && line_.peek(1).is_sign("(")) {
            line_.take();
            loop_for(made);
        } else {
            made.kind = StatementKind::loop_range;
            if (line_.take_name("local")) add_local(line_.peek().text);
            set_target(made, line_.expect_name("the loop variable, 'while', 'foreach' or 'for'"));
            const auto near = did_you_mean(made.target.text, {"while", "foreach", "for"});
            if (!line_.peek().is_sign("(") && !line_.done() && !near.empty())
                throw Diagnostic(fmt::format("'{}' is not a kind of loop", made.target.text),
                                 fmt::format("did you mean '{}'?", near))
                    .at(made.target.place);
            if (!line_.peek().is_sign("(") && !line_.done())
                fail_expected(line_, "'(' for the limits of the loop",
                              fmt::format("write: loop {} (from, to)", made.target.text));
            line_.expect_sign("(", "the limits of the loop");
            do made.expressions.push_back(parse_expression(line_));
            while (line_.take_sign(","));
            line_.expect_sign(")", "the limits of the loop");
            if (made.expressions.size() < 2 || made.expressions.size() > 3)
                throw Diagnostic(fmt::format("a loop needs two limits, and a step if wanted; this one has {}",
                                             made.expressions.size()),
                                 "write: loop i (1, 10) or loop i (10, 1, -1)")
                    .at(made.target.place);
        }
        line_.expect_end("the head of the loop");
        made.body = block({"loop", "endloop", loop_closers, opening});
        made.last_line = line_.peek().place.line;
        close("'endloop'");
    }

    void set_target(Statement& made, const Token& name) {
        made.target.kind = NodeKind::name;
        made.target.text = name.text;
        made.target.place = name.place;
    }

    void loop_for(Statement& made) {
        made.kind = StatementKind::loop_for;
        line_.expect_sign("(", "the head of the loop");
        made.init.push_back(part_of_loop_for());
        line_.expect_sign(",", "the condition of the loop");
        made.value = parse_expression(line_);
        line_.expect_sign(",", "the step of the loop");
        made.step.push_back(part_of_loop_for());
        line_.expect_sign(")", "the head of the loop");
    }

    Statement part_of_loop_for() {
        Statement part;
        part.kind = StatementKind::assign;
        part.place = line_.peek().place;
        const bool local = line_.take_name("local");
        if (line_.peek().kind != TokenKind::name) fail_expected(line_, "an assignment");
        part.target = parse_name(line_);
        if (local) add_local(part.target.text);
        line_.expect_sign("=", "the assignment");
        part.value = parse_expression(line_);
        return part;
    }

    void branches(Statement& made) {
        made.kind = StatementKind::branches;
        const Place opening = made.place;
        line_.take();
        bool has_else = false;
        for (;;) {
            Branch branch;
            branch.place = line_.peek().place;
            if (!has_else) {
                branch.condition.push_back(parse_expression(line_));
                line_.take_name("then");
                line_.expect_end("the condition");
            }
            branch.body = block({"if", "endif", if_closers, opening});
            made.branches.push_back(std::move(branch));
            made.last_line = line_.peek().place.line;
            const Token word = line_.take();
            if (word.text == "endif" || word.text == "end_if") break;
            if (has_else) throw Diagnostic(fmt::format("a second '{}' in one 'if'", word.text)).at(word.place);
            if (word.text == "else" && !line_.take_name("if")) {
                line_.expect_end("'else'");
                has_else = true;
            }
        }
        line_.expect_end("'endif'");
    }

    void choice(Statement& made) {
        made.kind = StatementKind::choice;
        const Place opening = line_.take().place;
        made.value = parse_expression(line_);
        line_.expect_end("the value of 'case_of'");
        made.body = block({"case_of", "endcase", case_closers, opening});
        while (line_.peek().is_name("case")) {
            Branch branch;
            branch.place = line_.take().place;
            branch.condition.push_back(parse_expression(line_));
            line_.expect_end("the value of 'case'");
            branch.body = block({"case_of", "endcase", case_closers, opening});
            made.branches.push_back(std::move(branch));
        }
        made.last_line = line_.peek().place.line;
        close("'endcase'");
    }

    void section(Statement& made) {
        made.kind = StatementKind::section;
        const Place opening = line_.take().place;
        line_.expect_end("'section'");
        made.body = block({"section", "endsection", section_closers, opening});
        made.last_line = line_.peek().place.line;
        close("'endsection'");
    }

    void exit(Statement& made) {
        line_.take();
        made.kind = StatementKind::exit_function;
        if (line_.take_name("loop")) {
            made.kind = StatementKind::exit_loop;
            if (!inside("loop")) throw Diagnostic("'exit loop' stands outside of any loop").at(made.place);
        } else if (line_.take_name("section")) {
            made.kind = StatementKind::exit_section;
            if (!inside("section")) throw Diagnostic("'exit section' stands outside of any section").at(made.place);
        }
        line_.expect_end("'exit'");
    }

    void next_round(Statement& made) {
        close("'continue'");
        made.kind = StatementKind::next_round;
        if (!inside("loop")) throw Diagnostic("'continue' stands outside of any loop").at(made.place);
    }

    void give_back(Statement& made) {
        line_.take();
        made.kind = StatementKind::exit_function;
        if (line_.done()) return;
        made.kind = StatementKind::give_back;
        made.value = parse_expression(line_);
        line_.expect_end("the value of 'return'");
    }

    void command(Statement& made) {
        made.kind = StatementKind::command;
        close("'command'");
        RawLine raw;
        for (;;) {
            if (!lexer_.next_raw_line(raw)) throw Diagnostic("this 'command' has no 'endcommand'").at(made.place);
            const std::string word = first_word(raw.text);
            if (word == "endcommand" || word == "end_command") break;
            if (!word.empty()) made.commands.push_back(read_command_line(raw));
        }
        made.last_line = raw.place.line;
    }

    Lexer lexer_;
    Place first_;
    Line line_;
    std::vector<Block> open_;
    ParsedFunction result_;
};

} // namespace

ParsedFunction parse_function(const std::string& text, const Place& first) { return Parser(text, first).function(); }

ExpressionTree parse_expression_line(const std::string& text, const Place& first) {
    return Parser(text, first).expression();
}

} // namespace kaya::fish
