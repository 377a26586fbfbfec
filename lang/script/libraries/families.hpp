// The families of names that FISH knows without a definition, each added by a file of this folder.
#pragma once

#include "lang/script/base/lua_headers.hpp"
#include "lang/script/values/world.hpp"

#include <string>
#include <utility>
#include <vector>

namespace kaya::script {

void add_mathematics(lua_State* L);   ///< sin, max, vector, urand, ...
void add_texts(lua_State* L);         ///< string, parse, type, out, error, ...
void add_tables(lua_State* L);        ///< table, xtable, ytable, ...
void add_run_functions(lua_State* L); ///< history_value, stop_reason, ...
void add_ranges(lua_State* L);        ///< find_range, in_range, inbox
void add_files(lua_State* L);         ///< open, close, read, write
void add_accessors(lua_State* L);     ///< fields and globals of the world, by their classic names
void add_traversals(lua_State* L);    ///< block_head, b_next, c_cx, gp_near, b_extra, ...
void add_materials(lua_State* L);     ///< m_density, m_jkn, ...
/// Each with the classic name that means the same.
std::vector<std::pair<std::string, std::string>> modern_names(const World& world);
void add_finders(lua_State* L);      ///< block.find, block.gp.num, block.isgroup, ...: of every kind of object
void add_modern_names(lua_State* L); ///< math.sin, block.head, ...: the same functions; comes last

} // namespace kaya::script
