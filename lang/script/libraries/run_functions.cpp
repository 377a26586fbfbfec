// Built-in functions of FISH that read results of a run: samples of histories, the reason of its end, the output of a command.
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

/// The first argument is the number or label of a history.
World::Samples samples(lua_State* L, const char* function) {
    const std::string name = lua_isinteger(L, 1) ? std::to_string(lua_tointeger(L, 1)) : text_argument(L, 1, function);
    const auto found = world_of(L).history(name);
    if (!found)
        throw Diagnostic(fmt::format("there is no history '{}'", name), "name it by its number or its label: list hist",
                         Fault::run);
    return *found;
}

World::Samples some_samples(lua_State* L, const char* function) {
    const World::Samples all = samples(L, function);
    if (all.values.empty())
        throw Diagnostic(fmt::format("'{}' reads a history that has no sample", function), "cycle before it is read",
                         Fault::run);
    return all;
}

/// (history, i): the i-th of its samples or of their times
double sample(lua_State* L, const char* function, bool time) {
    const World::Samples all = samples(L, function);
    const std::int64_t i = integer_argument(L, 2, function);
    const auto size = static_cast<std::int64_t>(all.values.size());
    if (i < 1 || i > size)
        throw Diagnostic(fmt::format("the history has samples 1 to {}, not {}", size, i), {}, Fault::run);
    return (time ? all.times : all.values)[static_cast<std::size_t>(i - 1)];
}

int size(lua_State* L) {
    lua_pushinteger(L, static_cast<lua_Integer>(samples(L, "history_size").values.size()));
    return 1;
}

int value(lua_State* L) {
    lua_pushnumber(L, sample(L, "history_value", false));
    return 1;
}

int time(lua_State* L) {
    lua_pushnumber(L, sample(L, "history_time", true));
    return 1;
}

int least(lua_State* L) {
    lua_pushnumber(L, std::ranges::min(some_samples(L, "history_min").values));
    return 1;
}

int greatest(lua_State* L) {
    lua_pushnumber(L, std::ranges::max(some_samples(L, "history_max").values));
    return 1;
}

int last(lua_State* L) {
    lua_pushnumber(L, some_samples(L, "history_last").values.back());
    return 1;
}

int stop_reason(lua_State* L) {
    const std::string& text = world_of(L).stopped_by;
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

/// (command lines): their output
int command_output(lua_State* L) {
    const std::string text = text_argument(L, 1, "command_output");
    std::string printed;
    if (!is_restoring(L)) printed = world_of(L).command(text, "command_output", 1, true);
    while (printed.ends_with('\n')) printed.pop_back();
    lua_pushlstring(L, printed.data(), printed.size());
    return 1;
}

constexpr std::array run_functions{
    BuiltInFunction{"history_size", 1, 1, guarded<size>},
    BuiltInFunction{"history_value", 2, 2, guarded<value>},
    BuiltInFunction{"history_time", 2, 2, guarded<time>},
    BuiltInFunction{"history_min", 1, 1, guarded<least>},
    BuiltInFunction{"history_max", 1, 1, guarded<greatest>},
    BuiltInFunction{"history_last", 1, 1, guarded<last>},
    BuiltInFunction{"stop_reason", 0, 0, guarded<stop_reason>},
    BuiltInFunction{"command_output", 1, 1, guarded<command_output>},
};

} // namespace

void add_run_functions(lua_State* L) { add_built_ins(L, run_functions); }

} // namespace kaya::script
