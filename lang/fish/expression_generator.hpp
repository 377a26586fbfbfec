// Expressions of FISH as Lua expressions.
#pragma once

#include "lang/fish/meaning.hpp"
#include "lang/fish/syntax.hpp"

#include <set>
#include <string>
#include <utility>

namespace kaya::fish {

/// Where the names of one function live in the generated Lua.
struct Scope {
    std::string function;          ///< own name: the return variable; empty for a bare expression
    std::set<std::string> locals;  ///< arguments and locals that are Lua locals `v_name`
    std::set<std::string> spilled; ///< locals beyond what Lua takes: fields of the table S
    Dialect dialect = Dialect::classic;

    bool is_local(const std::string& name) const {
        return name == function || locals.contains(name) || spilled.contains(name);
    }
};

class ExpressionGenerator {
public:
    ExpressionGenerator(const Scope& scope, const Dictionary& dictionary) : scope_(scope), dictionary_(dictionary) {}

    /// Lua expression with the value; truth values become 1 and 0.
    std::string value(const Node& node) const { return generated(node, 0); }
    /// Lua expression that is true or false.
    std::string condition(const Node& node) const;
    /// The value as another variable may hold it: of lists, maps and structures a copy.
    std::string owned(const Node& node) const;
    /// Whether the node calls a built-in that makes a new value, which nothing else holds.
    bool is_fresh(const Node& node) const;
    /// Lua statement `target = value`.
    /// `one_each`: the elements of a split target get those of the value.
    std::string assignment(const Node& target, const std::string& value, bool one_each = false) const;
    /// The place where a variable lives: `v_x`, `S["x"]` or `G.x`.
    std::string variable(const Node& name) const;
    /// "a, b, c"
    std::string list(const std::vector<Node>& nodes) const;
    /// Lua statements that make locals of the built-ins used so far, to be put before the function: the call of a local costs one look-up
    /// less than the call of a table's member.
    std::string shared_built_ins() const;

private:
    std::string generated(const Node& node, int strength) const;
    std::string binary(const Node& node, int strength) const;
    /// A call whose split arguments are variables, with the names of these and the lists, each after a comma.
    struct Split {
        Node one;
        std::string names, lists;
    };
    Split split(const Node& node) const;
    std::string name(const Node& node) const;
    std::string indexed(const Node& node) const;
    std::string member_value(const Node& node) const;
    std::string member_assignment(const Node& target, const std::string& value) const;
    /// Whether the node stands for something that can be assigned.
    bool is_place(const Node& node) const;
    bool modern() const { return scope_.dialect == Dialect::modern; }
    /// list(1, 2), map, ... that make a value
    bool makes_value(const Node& node) const;
    void check_arguments(const Node& node, const Meaning& meaning) const;
    /// Throws Diagnostic for a name that is reserved.
    Meaning meaning_of(const Node& name) const;
    /// How the function calls `name` of the table A or W.
    std::string built_in(char table, const std::string& name) const;

    const Scope& scope_;
    const Dictionary& dictionary_;
    mutable std::set<std::pair<char, std::string>> shared_; ///< table and name of built-ins that are locals
};

/// `.name`, or `["name"]` where the name is not a valid Lua name.
std::string member(std::string_view name);
/// A Lua text literal on one line.
std::string lua_string(std::string_view text);

} // namespace kaya::fish
