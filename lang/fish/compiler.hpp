// From the text of a FISH function to the text of a Lua function. No Lua is needed here: the result is a string, and the Lua functions that
// it calls are listed at the end of this file.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/fish/dialect.hpp"
#include "lang/fish/meaning.hpp"

#include <memory>
#include <string>
#include <vector>

namespace kaya::fish {

struct FunctionTree;
struct ExpressionTree;

/// A function that was read, not yet translated.
struct Function {
    std::string name;
    std::vector<std::string> arguments;
    int least = 0; ///< number of arguments that a call must give
    Dialect dialect = Dialect::classic;
    bool whilestepping = false;        ///< to be run after every cycle from its definition on
    std::vector<std::string> mentions; ///< all outside names it uses, sorted: when the meaning of one of
                                       ///< them changes the function must be generated again
    Place place;                       ///< of the word `def`
    std::shared_ptr<const FunctionTree> tree;
};

/// Reads `def name(a,b) ... end`. Throws Diagnostic with the place of the first mistake.
/// `first` is the place where `text` begins: line n of the text is line first.line + n of first.source.
Function read_function(const std::string& text, const Place& first);

/// Lua source of the function. Line k of it belongs to line function.place.line + k - 1 of the deck. Throws Diagnostic for mistakes that
/// only the dictionary shows (number of arguments, read-only names).
std::string generate(const Function& function, const Dictionary& dictionary);

/// An expression outside of any function: `@name(1,2)`, `[a + 1]`, `[a = 3]`.
struct Expression {
    Dialect dialect = Dialect::classic;
    std::vector<std::string> mentions;
    std::string assigned; ///< variable left of `=`, or empty
    Place place;
    std::shared_ptr<const ExpressionTree> tree;
};

/// Modern when a bracket stands at the place, as in `[a + 1]`.
Dialect dialect_at(const Place& place);

/// `text` without the `@` or the brackets. An assignment is allowed; its value is the value assigned.
Expression read_expression(const std::string& text, const Place& place, Dialect dialect = Dialect::classic);
std::string generate(const Expression& expression, const Dictionary& dictionary);

// The generated chunk is called with (G, F, A, W, R) and returns the function:
//   G  values of the global variables, by name (an array is a table made by R.array)
//   F  functions, by name          A  built-ins that read          W  built-ins that write (value last)
//   R  the runtime: arithmetic and arrays where Lua and FISH differ; stdlib/lua/fish_runtime.lua

} // namespace kaya::fish
