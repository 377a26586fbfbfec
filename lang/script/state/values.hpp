// Conversion of values to Lua and back.
#pragma once

#include "lang/script/base/lua_headers.hpp"
#include "lang/script/values/world.hpp"

#include <string>

namespace kaya::script {

/// For Lua: nothing and null are nil.
void push_lua_value(lua_State* L, const Value& value);
/// For FISH: nothing and null are the integer 0, truth is 1 or 0.
void push_fish_value(lua_State* L, const Value& value);
/// Converts a value of Lua at the top of the stack to one of FISH.
void make_fish_value(lua_State* L);

/// Throws Diagnostic for a table or a function: `what` names the value in the message.
Value value_at(lua_State* L, int index, const std::string& what);
/// "integer 3", "text 'abc'", "a pointer to a contact": for messages.
std::string describe_value(lua_State* L, int index);
/// The text that FISH prints.
std::string text_at(lua_State* L, int index);

bool is_vector(lua_State* L, int index);
void push_vector(lua_State* L, const Vec3& vector);
/// The vector itself; only when is_vector.
const Vec3& vector_at(lua_State* L, int index);

/// True when the function that called the running C function is translated FISH.
bool called_by_fish(lua_State* L);

// Arguments of built-ins; all throw Diagnostic that names the built-in.
double number_argument(lua_State* L, int index, const char* function);
std::int64_t integer_argument(lua_State* L, int index, const char* function);
std::string text_argument(lua_State* L, int index, const char* function);
Vec3 vector_argument(lua_State* L, int index, const char* function);
[[noreturn]] void fail_argument(lua_State* L, int index, const char* function, const char* wanted);

} // namespace kaya::script
