#include "lang/script/state/lua_state.hpp"

#include "base/terminal_text.hpp"

#include <cstdio>
#include <cstdlib>
#include <new>

namespace kaya::script {

namespace {

/// Small pieces are given beyond the limit as well, so that there is room for the error message.
constexpr std::size_t small_piece = 4096, spare_room = 1 << 20;

/// Lua's allocator with a limit. The old size is that of the piece, or a kind of object when there is none.
void* limited_memory(void* memory_of_state, void* piece, std::size_t old_size, std::size_t size) {
    auto& memory = *static_cast<Memory*>(memory_of_state);
    const std::size_t before = piece ? old_size : 0;
    if (size == 0) {
        std::free(piece);
        memory.used -= before;
        return nullptr;
    }
    if (size > before) {
        const std::size_t room = memory.limit + (size < small_piece ? spare_room : 0);
        if (memory.used + (size - before) > room) return nullptr;
    }
    void* moved = std::realloc(piece, size);
    if (moved) memory.used += size - before; // wraps around rightly when it shrinks
    return moved;
}

} // namespace

LuaState::LuaState(World& the_world, Options the_options, const Owners& owners)
    : world(the_world), options(std::move(the_options)) {
    if (!options.gate) {
        options.gate = std::make_shared<Gate>();
        Gate::Policy policy;
        policy.folders = {"."};
        options.gate->shut(std::move(policy));
    }
    lua = luaL_newstate();
    if (!lua) throw std::bad_alloc();
    *static_cast<const Owners**>(lua_getextraspace(lua)) = &owners;
    if (options.memory > 0) {
        const auto used = static_cast<std::size_t>(lua_gc(lua, LUA_GCCOUNT)) * 1024 +
                          static_cast<std::size_t>(lua_gc(lua, LUA_GCCOUNTB));
        memory = {used, options.memory};
        lua_setallocf(lua, limited_memory, &memory);
    }
}

LuaState::~LuaState() { lua_close(lua); }

void push_runtime(lua_State* L, const char* function) {
    push_anchor(L, state_of(L).runtime);
    lua_getfield(L, -1, function);
    lua_remove(L, -2);
}

bool is_array(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TTABLE || !lua_getmetatable(L, index)) return false;
    const LuaState& state = state_of(L);
    const void* const kind = lua_topointer(L, -1);
    lua_pop(L, 1);
    return kind == state.array_address || kind == state.grid_address;
}

void print_line(lua_State* L, const std::string& line) {
    if (is_restoring(L)) return;
    if (const auto& sink = state_of(L).sink) sink(line);
    else print_text(stdout, line + "\n");
}

} // namespace kaya::script
