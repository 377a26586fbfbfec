// The parser of FISH functions: blocks and declarations in parser.cpp, statements in statement_parser.cpp.
#pragma once

#include "lang/fish/expression_parser.hpp"
#include "lang/fish/open_block.hpp"
#include "lang/fish/parser.hpp"

namespace kaya::fish {

class Parser {
public:
    Parser(const std::string& text, const Place& first) : lexer_(text, first), first_(first) {}
    ParsedFunction function();
    ExpressionTree expression(Dialect dialect);

private:
    bool next_line();
    void read_as(Dialect dialect);
    bool modern() const { return line_.dialect == Dialect::modern; }

    // --- blocks -----------------------------------------------------------------------------------
    /// Statements up to a word that closes `opened`; the line is then at that word.
    std::vector<Statement> block(const Block& opened);
    [[noreturn]] void fail_unclosed(const Block& opened);
    [[noreturn]] void fail_wrong_closer(const Block& opened, const Token& word);
    bool inside(std::string_view opening) const;
    void close(std::string_view what);

    // --- statements -------------------------------------------------------------------------------
    using Rule = void (Parser::*)(Statement&);
    struct Keyword {
        std::string_view word;
        Rule rule;
    };
    void statement(std::vector<Statement>& body);
    /// An assignment, or an expression that is evaluated for its side effects.
    Statement simple();
    /// `left = value` or, in the modern dialect, `left += value`, when the line is at the sign.
    bool take_assignment(Node& left, Statement& made);
    void add_arguments();
    void add_default(const Token& name);
    void add_local(const std::string& name);
    void declaration(std::vector<Statement>& body, bool local);
    void arrays(std::vector<Statement>& body, bool local);
    void argument(Statement&);
    void nothing(Statement&);
    void whilestepping(Statement&);
    void stray(Statement& made);
    void nested_function(Statement& made);
    void loop(Statement& made);
    void set_target(Statement& made, const Token& name);
    void loop_for(Statement& made);
    Statement part_of_loop_for();
    void branches(Statement& made);
    /// if CONDITION then STATEMENT, on one line
    void short_branch(Statement& made, Branch branch);
    void choice(Statement& made);
    void section(Statement& made);
    void exit(Statement& made);
    void next_round(Statement& made);
    void give_back(Statement& made);
    void command(Statement& made);
    void structure(Statement& made);

    Lexer lexer_;
    Place first_;
    Line line_;
    std::vector<Block> open_;
    ParsedFunction result_;
};

} // namespace kaya::fish
