#include "lang/fish/statement_parser.hpp"

#include "lang/fish/command_lines.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya::fish {

namespace {

/// Lists are values: such a line would change nothing.
void refuse_unused(const Node& call) {
    constexpr std::array<std::string_view, 6> makers{"list.append", "list.prepend", "list.insert",
                                                     "list.remove", "map.add",      "map.remove"};
    if (call.kind != NodeKind::name || !is_one_of(call.text, makers) || call.children.empty()) return;
    throw Diagnostic(fmt::format("the result of '{}' is not used: lists and maps are values", call.text),
                     fmt::format("write: a = {}(a, ...)", call.text))
        .at(call.place);
}

} // namespace

void Parser::statement(std::vector<Statement>& body) {
    static constexpr std::array<Keyword, 21> keywords{{{"loop", &Parser::loop},
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
                                                       {"struct", &Parser::structure},
                                                       {"structure", &Parser::structure},
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
            if (word.text == keyword.word && (modern() || keyword.rule != &Parser::structure)) {
                Statement made;
                made.place = word.place;
                (this->*keyword.rule)(made);
                body.push_back(std::move(made));
                return;
            }
    }
    body.push_back(simple());
}

Statement Parser::simple() {
    Statement made;
    made.place = line_.peek().place;
    if (line_.peek().kind != TokenKind::name) fail_expected(line_, "a statement");
    Node left = parse_name(line_);
    if (take_assignment(left, made)) {
        line_.expect_end("the assignment");
        return made;
    }
    if (!line_.done()) {
        // A word that begins like a statement is more likely a misspelt statement than a name.
        const auto near = did_you_mean(left.text, {"loop", "if", "else", "elseif", "case_of", "case", "section", "exit",
                                                   "return", "local", "global", "array", "argument"});
        if (!near.empty() && !left.parentheses && !line_.peek().is_sign("("))
            throw Diagnostic(fmt::format("'{}' does not begin a statement", left.text),
                             fmt::format("did you mean '{}'?", near))
                .at(made.place);
        fail_expected(line_, fmt::format("'=' after '{}'", left.text), hint_for_missing_equals(line_, left.text));
    }
    made.kind = StatementKind::evaluate;
    refuse_unused(left);
    made.value = std::move(left);
    return made;
}

bool Parser::take_assignment(Node& left, Statement& made) {
    Token sign = line_.peek();
    if (sign.kind != TokenKind::sign) return false;
    const bool split = std::ranges::any_of(left.children, [](const Node& c) { return c.kind == NodeKind::split; });
    made.one_each = sign.text.ends_with("=::");
    if (made.one_each) {
        if (!split)
            throw Diagnostic(fmt::format("'{}' needs a list that is split on its left", sign.text),
                             "write for example: block.group(::blocks) =:: names")
                .at(sign.place);
        sign.text.resize(sign.text.size() - 2);
    }
    constexpr std::array<std::string_view, 4> changes{"+=", "-=", "*=", "/="};
    const bool change = is_one_of(sign.text, changes);
    if (!change && sign.text != "=") return false;
    if (change && split) made.one_each = true;
    line_.take();
    made.kind = StatementKind::assign;
    made.value = parse_expression(line_);
    if (change) {
        Node whole;
        whole.kind = NodeKind::binary;
        whole.text = sign.text.substr(0, 1);
        whole.place = sign.place;
        whole.children = {left, std::move(made.value)};
        made.value = std::move(whole);
    }
    made.target = std::move(left);
    return true;
}

void Parser::nothing(Statement&) { close("'null'"); }

void Parser::whilestepping(Statement&) {
    close("'whilestepping'");
    result_.whilestepping = true;
}

void Parser::stray(Statement& made) {
    const std::string& word = line_.peek().text;
    throw Diagnostic(fmt::format("'{}' cannot begin a statement", word),
                     word == "then" ? "" : fmt::format("loops begin with `loop`: loop {} ... endloop", word))
        .at(made.place);
}

void Parser::nested_function(Statement& made) {
    throw Diagnostic(
        "a function begins inside of another one",
        fmt::format("the function '{}' of line {} has no 'end' yet", result_.tree.name, result_.tree.place.line))
        .at(made.place);
}

void Parser::loop(Statement& made) {
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
            throw Diagnostic(
                fmt::format("a loop needs two limits, and a step if wanted; this one has {}", made.expressions.size()),
                "write: loop i (1, 10) or loop i (10, 1, -1)")
                .at(made.target.place);
    }
    line_.expect_end("the head of the loop");
    made.body = block({"loop", "endloop", loop_closers, opening});
    made.last_line = line_.peek().place.line;
    close("'endloop'");
}

void Parser::set_target(Statement& made, const Token& name) {
    made.target.kind = NodeKind::name;
    made.target.text = name.text;
    made.target.place = name.place;
}

void Parser::loop_for(Statement& made) {
    made.kind = StatementKind::loop_for;
    line_.expect_sign("(", "the head of the loop");
    made.init.push_back(part_of_loop_for());
    line_.expect_sign(",", "the condition of the loop");
    made.value = parse_expression(line_);
    line_.expect_sign(",", "the step of the loop");
    made.step.push_back(part_of_loop_for());
    line_.expect_sign(")", "the head of the loop");
}

Statement Parser::part_of_loop_for() {
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

void Parser::branches(Statement& made) {
    made.kind = StatementKind::branches;
    const Place opening = made.place;
    line_.take();
    bool has_else = false;
    for (;;) {
        Branch branch;
        branch.place = line_.peek().place;
        if (!has_else) {
            branch.condition.push_back(parse_expression(line_));
            if (line_.take_name("then") && !line_.done() && modern() && made.branches.empty())
                return short_branch(made, std::move(branch));
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

void Parser::short_branch(Statement& made, Branch branch) {
    const Token& word = line_.peek();
    constexpr std::array<std::string_view, 8> openers{"loop",    "if",      "case_of", "caseof",
                                                      "section", "command", "local",   "array"};
    if (word.kind == TokenKind::name && is_one_of(word.text, openers) && !line_.peek(1).is_sign("="))
        throw Diagnostic(fmt::format("'{}' cannot follow 'then' on its line", word.text),
                         "put it on the next line, and 'endif' after it")
            .at(word.place);
    statement(branch.body);
    made.last_line = made.place.line;
    made.branches.push_back(std::move(branch));
}

void Parser::choice(Statement& made) {
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

void Parser::section(Statement& made) {
    made.kind = StatementKind::section;
    const Place opening = line_.take().place;
    line_.expect_end("'section'");
    made.body = block({"section", "endsection", section_closers, opening});
    made.last_line = line_.peek().place.line;
    close("'endsection'");
}

void Parser::exit(Statement& made) {
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

void Parser::next_round(Statement& made) {
    close("'continue'");
    made.kind = StatementKind::next_round;
    if (!inside("loop")) throw Diagnostic("'continue' stands outside of any loop").at(made.place);
}

void Parser::give_back(Statement& made) {
    line_.take();
    made.kind = StatementKind::exit_function;
    if (line_.done()) return;
    made.kind = StatementKind::give_back;
    made.value = parse_expression(line_);
    line_.expect_end("the value of 'return'");
}

/// struct NAME(a, b): a kind of structure and its members
void Parser::structure(Statement& made) {
    line_.take();
    made.kind = StatementKind::structure;
    if (line_.peek().kind != TokenKind::name) fail_expected(line_, "the name of the structure");
    made.target = parse_name(line_);
    for (const auto& member : made.target.children)
        if (member.kind != NodeKind::name || member.parentheses)
            throw Diagnostic(fmt::format("the members of the structure '{}' are names", made.target.text),
                             fmt::format("write: struct {}(one, two)", made.target.text))
                .at(member.place);
    line_.expect_end("the structure");
}

void Parser::command(Statement& made) {
    made.kind = StatementKind::command;
    close("'command'");
    RawLine raw;
    for (;;) {
        if (!lexer_.next_raw_line(raw)) throw Diagnostic("this 'command' has no 'endcommand'").at(made.place);
        const std::string word = first_word(raw.text);
        if (word == "endcommand" || word == "end_command") break;
        if (!word.empty()) made.commands.push_back(read_command_line(raw, line_.dialect, parse_expression_line));
    }
    made.last_line = raw.place.line;
}

} // namespace kaya::fish
