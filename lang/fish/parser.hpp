// Statements of FISH. Expressions are read by expression_parser.
#pragma once

#include "lang/fish/lexer.hpp"
#include "lang/fish/syntax.hpp"

namespace kaya::fish {

struct ParsedFunction {
    FunctionTree tree;
    bool whilestepping = false;
};

/// `def name(a,b) ... end`. Throws Diagnostic at the first mistake.
ParsedFunction parse_function(const std::string& text, const Place& first);

/// An expression or an assignment on one line.
ExpressionTree parse_expression_line(const std::string& text, const Place& first, Dialect dialect);

} // namespace kaya::fish
