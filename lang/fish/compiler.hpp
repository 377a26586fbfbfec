// From the text of a FISH function to the text of a Lua function. No Lua is needed here: the result is a string, and the Lua functions that
// it calls are listed at the end of this file.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/fish/dialect.hpp"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace kaya::fish {

struct FunctionTree;
struct ExpressionTree;

/// Meaning of a name that is neither local nor an argument.
enum class NameKind {
    variable, ///< a global variable, or something that does not exist yet
    function, ///< a FISH function, or a function written in Lua
    built_in, ///< sin, cx_nforce, b_near, time, ...
};

struct Meaning {
    NameKind kind = NameKind::variable;
    int least = 0; ///< number of arguments
    int most = 0;
    bool writable = false;  ///< a built-in that may stand left of `=`
    bool exists = false;    ///< a variable that has a value
    std::string whole = {}; ///< of a built-in that the name shortens: block.gp.disp for block.gp.di
};

/// Throws Diagnostic when a function, or a built-in name, is called with a wrong number of arguments.
void check_arguments(const std::string& name, int given, const Meaning& meaning, const Place& place);

/// True for the names of values: true, false, on, off, null.
bool is_constant(std::string_view name);

/// True for list, map, tensor, boolean: they make values in the modern dialect and are names of variables in the classic one.
bool makes_value(std::string_view name);

/// Returns the present meaning of a name (in lower case) to the code generator.
using Dictionary = std::function<Meaning(std::string_view name)>;

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
