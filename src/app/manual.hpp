// The page of `man kaya`.
#pragma once

#include "app/tool_tree.hpp"

#include <string>
#include <vector>

namespace kaya {

/// In the language of man pages, from the help of subcommands and options. `version` as `kaya --version` gives it.
std::string manual_page(const std::vector<ToolNode>& tree, const std::string& version);

} // namespace kaya
