// Scripts with which a shell completes the words of a `kaya` command line.
#pragma once

#include "app/tool_tree.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// bash, zsh and fish, as `kaya completion` takes them.
std::vector<std::string> completed_shells();

/// The script for one of them. Throws Diagnostic for another.
std::string completion_script(const std::vector<ToolNode>& tree, std::string_view shell);

} // namespace kaya
