// Files of FISH, one at a time: open(name, mode, format), read(array, n), write(array, n), close.
#include "lang/script/files.hpp"

#include "lang/script/built_ins.hpp"
#include "lang/script/context.hpp"
#include "lang/script/guard.hpp"
#include "lang/script/scripts.hpp"
#include "lang/script/values.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::script {

std::filesystem::path allowed_path(lua_State* L, const std::string& name, Access access) {
    if (options_of(L).trusted) return name;
    Gate& gate = *options_of(L).gate;
    if (access == Access::writing) gate.may_write(name);
    else gate.may_read(name);
    return resolved(name);
}

namespace {

enum Mode { reading = 0, writing = 1, appending = 2 };

/// 0 when it is done, 1 when the file cannot be opened.
int open(lua_State* L) {
    OpenFile& file = file_of(L);
    const std::string name = text_argument(L, 1, "open");
    const std::int64_t mode = integer_argument(L, 2, "open");
    const std::int64_t format = integer_argument(L, 3, "open");
    if (mode < reading || mode > appending)
        throw Diagnostic(fmt::format("'open' is given the mode {}", mode), "0 reads, 1 writes, 2 appends", Fault::run);
    if (format != 1)
        throw Diagnostic("FISH's own binary files cannot be read or written", "use 1 as third argument: plain text",
                         Fault::run);
    if (file.reading.is_open() || file.writing.is_open())
        throw Diagnostic("a file is open already", "call 'close' before the next 'open'", Fault::run);
    const auto path = allowed_path(L, name, mode == reading ? Access::reading : Access::writing);
    bool done = true;
    if (!is_restoring(L)) {
        if (mode == reading) file.reading.open(path);
        else file.writing.open(path, mode == writing ? std::ios::trunc : std::ios::app);
        done = file.reading.is_open() || file.writing.is_open();
    }
    lua_pushinteger(L, done ? 0 : 1);
    return 1;
}

int close(lua_State* L) {
    OpenFile& file = file_of(L);
    bool done = true;
    if (file.writing.is_open()) {
        file.writing.flush();
        done = file.writing.good();
        file.writing.close();
    }
    file.writing.clear();
    if (file.reading.is_open()) file.reading.close();
    file.reading.clear();
    if (!done) throw Diagnostic("the file could not be written to its end", "is the disk full?", Fault::run);
    lua_pushinteger(L, 0);
    return 1;
}

/// Number of elements of the array that the arguments (array, n) name; all elements of dimension one.
lua_Integer element_count(lua_State* L, const char* function) {
    if (lua_type(L, 1) != LUA_TTABLE) fail_argument(L, 1, function, "an array");
    const auto size = static_cast<lua_Integer>(lua_rawlen(L, 1));
    const std::int64_t wanted = integer_argument(L, 2, function);
    if (wanted < 0 || wanted > size)
        throw Diagnostic(fmt::format("'{}' is to use {} lines, but the array has {} elements", function, wanted, size),
                         {}, Fault::run);
    return wanted;
}

/// 0: all lines were read; -1: no file is open; else the number of lines before the file ended.
int read(lua_State* L) {
    std::ifstream& file = file_of(L).reading;
    const lua_Integer wanted = element_count(L, "read");
    if (!file.is_open()) {
        lua_pushinteger(L, -1);
        return 1;
    }
    std::string line;
    lua_Integer i = 0;
    for (; i < wanted && std::getline(file, line); ++i) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        lua_pushlstring(L, line.data(), line.size());
        lua_rawseti(L, 1, i + 1);
    }
    lua_pushinteger(L, i == wanted ? 0 : i);
    return 1;
}

/// One line for each element. A number gets a blank in front, as the classic program writes it.
int write(lua_State* L) {
    std::ofstream& file = file_of(L).writing;
    const lua_Integer wanted = element_count(L, "write");
    if (!file.is_open() && !is_restoring(L)) {
        lua_pushinteger(L, -1);
        return 1;
    }
    for (lua_Integer i = 1; i <= wanted; ++i) {
        lua_rawgeti(L, 1, i);
        if (!is_restoring(L)) file << (lua_type(L, -1) == LUA_TSTRING ? "" : " ") << text_at(L, -1) << '\n';
        lua_pop(L, 1);
    }
    if (!is_restoring(L) && !file.good())
        throw Diagnostic("the file could not be written", "is the disk full?", Fault::run);
    lua_pushinteger(L, 0);
    return 1;
}

constexpr std::array functions{
    BuiltInFunction{"open", 3, 3, guarded<open>},
    BuiltInFunction{"close", 0, 0, guarded<close>},
    BuiltInFunction{"read", 2, 2, guarded<read>},
    BuiltInFunction{"write", 2, 2, guarded<write>},
};

} // namespace

void add_files(Machine& machine) { add_built_ins(machine, functions); }

} // namespace kaya::script
