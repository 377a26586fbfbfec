// The parts of a parsed FISH function.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/fish/dialect.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace kaya::fish {

enum class NodeKind {
    integer,
    real,
    text,
    name,        ///< text is the name; children are arguments
    member,      ///< a->b(c): text is b; children are a and the arguments
    structure,   ///< struct NAME(a, b): text is NAME; children are the values of its members
    split,       ///< ::a as an argument: one child
    element,     ///< of a split argument: text is its variable
    minus,       ///< one child
    logical_not, ///< one child
    binary,      ///< text is the sign: + - * / // % ^ == ~= < > <= >= & |
};

struct Node {
    NodeKind kind = NodeKind::integer;
    std::string text;
    std::int64_t integer = 0;
    double real = 0;
    bool parentheses = false; ///< name(...): called or indexed, even without arguments
    std::vector<Node> children;
    Place place;
};

enum class StatementKind {
    nothing,    ///< null, whilestepping, a declaration without a value
    assign,     ///< target = value
    evaluate,   ///< an expression evaluated for its side effects
    array,      ///< target(children are the dimensions)
    loop_range, ///< target from expressions[0] to [1], step [2] if given
    loop_while, ///< value
    loop_each,  ///< target over value
    loop_for,   ///< init; value; step
    branches,   ///< if
    choice,     ///< case_of value; body runs when no case fits
    section,
    exit_function,
    exit_loop,
    exit_section,
    next_round, ///< continue
    give_back,  ///< return value
    structure,  ///< target is the name of a kind of structure; its children are the members
    command,
};

struct Statement;

/// `if`, `else if`: condition and body; `else`: no condition. `case`: the value and the body.
struct Branch {
    std::vector<Node> condition; ///< none or one
    std::vector<Statement> body;
    Place place;
};

/// One line of a `command` block: texts and expressions in turn, to be joined at run time.
struct CommandPiece {
    std::string text;
    std::vector<Node> expression; ///< none or one; used instead of the text
};
struct CommandLine {
    std::vector<CommandPiece> pieces;
    int line = 0;
    bool evaluated = false;   ///< `[f(1)]` alone: the only piece is an expression, which is not part of a command
    std::vector<Node> target; ///< of `[x = 1]` alone: none or one; it gets the value of the piece
    bool one_each = false;    ///< of `[f(::l) =:: list]`: each element gets one
};

struct Statement {
    StatementKind kind = StatementKind::nothing;
    Place place;
    Node target;
    Node value;
    std::vector<Node> expressions;
    std::vector<Statement> body;
    std::vector<Statement> init, step; ///< of loop for: one assignment each
    std::vector<Branch> branches;
    std::vector<CommandLine> commands;
    bool declares = false; ///< global name = value
    bool one_each = false; ///< target =:: value: each element of the split target gets one of the value
    int last_line = 0;     ///< of the word that closes a block
};

struct FunctionTree {
    std::string name;
    Dialect dialect = Dialect::classic;
    std::vector<std::string> arguments;
    std::vector<Node> defaults;      ///< values of the last arguments when a call leaves them out
    std::vector<std::string> locals; ///< without the arguments
    std::vector<Statement> body;
    Place place;
    int last_line = 0;
};

struct ExpressionTree {
    Dialect dialect = Dialect::classic;
    std::vector<Statement> assignment; ///< none or one
    Node value;                        ///< when it is not an assignment
    Place place;
};

} // namespace kaya::fish
