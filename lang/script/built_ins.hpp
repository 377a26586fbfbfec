// The names that FISH knows without a definition. Each file below adds its own to the tables A and W.
#pragma once

#include "lang/script/lua_headers.hpp"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kaya::script {

struct Machine;
class World;

/// One row of a table of built-ins. Both functions are wrapped by `guarded`.
struct BuiltInFunction {
    const char* name;
    int least, most; ///< arguments when it is read
    lua_CFunction read;
    lua_CFunction write = nullptr; ///< arguments, then the value; null: read only
};

void add_built_ins(Machine& machine, std::span<const BuiltInFunction> functions);
/// Takes the function at the top of the stack as reader or writer of `name`.
void add_reader(Machine& machine, std::string_view name, int least, int most);
void add_writer(Machine& machine, std::string_view name);

void add_mathematics(Machine& machine);   ///< sin, max, vector, urand, ...
void add_texts(Machine& machine);         ///< string, parse, type, out, error, ...
void add_tables(Machine& machine);        ///< table, xtable, ytable, ...
void add_run_functions(Machine& machine); ///< history_value, stop_reason, ...
void add_ranges(Machine& machine);        ///< find_range, in_range, inbox
void add_files(Machine& machine);         ///< open, close, read, write
void add_accessors(Machine& machine);     ///< fields and globals of the world, by their classic names
void add_traversals(Machine& machine);    ///< block_head, b_next, c_cx, gp_near, b_extra, ...
void add_materials(Machine& machine);     ///< m_density, m_jkn, ...
/// Each with the classic name that means the same.
std::vector<std::pair<std::string, std::string>> modern_names(const World& world);
void add_finders(Machine& machine);      ///< block.find, block.gp.num, block.isgroup, ...: of every kind of object
void add_modern_names(Machine& machine); ///< math.sin, block.head, ...: the same functions; comes last

} // namespace kaya::script
