// The Lua modules that ship with the program, compiled in from stdlib/lua.
#pragma once

#include <span>
#include <string_view>

namespace kaya::script {

struct Module {
    std::string_view name; ///< the argument of `require`
    std::string_view text;
    bool is_public = true; ///< false: a part of the program, which a deck must not require
};

std::span<const Module> built_in_modules();

/// Text of one module; empty when there is none of this name.
inline std::string_view built_in_module(std::string_view name) {
    for (const auto& module : built_in_modules())
        if (module.name == name) return module.text;
    return {};
}

} // namespace kaya::script
