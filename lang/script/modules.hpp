// The Lua modules that ship with the program, compiled in from stdlib/lua.
#pragma once

#include <span>
#include <string_view>

namespace kaya::script {

struct Module {
    std::string_view name; ///< what `require` is given
    std::string_view text;
};

std::span<const Module> built_in_modules();

} // namespace kaya::script
