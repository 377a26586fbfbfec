// Lua source from the syntax tree of FISH.
#pragma once

#include "lang/fish/meaning.hpp"
#include "lang/fish/syntax.hpp"

#include <string>
#include <vector>

namespace kaya::fish {

std::string generate_function(const FunctionTree& tree, const Dictionary& dictionary);
std::string generate_expression(const ExpressionTree& tree, const Dictionary& dictionary);

/// Names that are not local, sorted, each once.
std::vector<std::string> outside_names(const FunctionTree& tree);
std::vector<std::string> outside_names(const ExpressionTree& tree);

} // namespace kaya::fish
