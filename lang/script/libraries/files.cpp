// Files of FISH, one at a time: open(name, mode, format), read(array, n), write(array, n), close.
#include "lang/script/libraries/files.hpp"

#include "base/lower_case.hpp"
#include "lang/script/base/open_file.hpp"
#include "lang/script/base/options.hpp"
#include "lang/script/libraries/families.hpp"
#include "lang/script/names/built_ins.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/fish_library.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace kaya::script {

namespace {

bool writes(const std::string& mode) { return mode.find_first_of("wa+") != mode.npos; }

/// Throws Diagnostic when the script may not open the file with a mode of fopen.
void require_allowed(lua_State* L, const std::string& name, const std::string& mode) {
    if (options_of(L).trusted) return;
    Gate& gate = *options_of(L).gate;
    if (writes(mode)) gate.may_write(name);
    else gate.may_read(name);
}

/// The same, and opens it. Null: errno has the reason.
door::Stream open_allowed(lua_State* L, const std::string& name, const std::string& mode) {
    require_allowed(L, name, mode);
    return door::open_stream(name, writes(mode) ? Use::write : Use::read, mode);
}

enum Mode { reading = 0, writing = 1, appending = 2 };

/// The number of a mode or format, which may be given as its word: open('f', 'write', 'text').
template <std::size_t size>
std::int64_t word_or_number(lua_State* L, int index, const std::array<std::string_view, size>& words) {
    if (lua_type(L, index) != LUA_TSTRING) return integer_argument(L, index, "open");
    const std::string word = lower_case(text_argument(L, index, "open"));
    const auto found = std::ranges::find(words, word);
    if (found == words.end())
        throw Diagnostic(fmt::format("'open' is given '{}'", word),
                         "'read', 'write' or 'append' as mode, and 'text' as format", Fault::run);
    return found - words.begin();
}

/// 0 when it is done, 1 when the file cannot be opened.
int open(lua_State* L) {
    OpenFile& file = fish_of(L).file;
    const std::string name = text_argument(L, 1, "open");
    const std::int64_t mode = word_or_number<3>(L, 2, {"read", "write", "append"});
    const std::int64_t format = word_or_number<2>(L, 3, {"binary", "text"});
    if (mode < reading || mode > appending)
        throw Diagnostic(fmt::format("'open' is given the mode {}", mode), "0 reads, 1 writes, 2 appends", Fault::run);
    if (format != 1)
        throw Diagnostic("FISH's own binary files cannot be read or written", "use 1 as third argument: plain text",
                         Fault::run);
    if (file.reading || file.writing)
        throw Diagnostic("a file is open already", "call 'close' before the next 'open'", Fault::run);
    const char* const words[] = {"r", "w", "a"};
    const std::string word = words[mode];
    bool done = true;
    if (is_restoring(L)) {
        require_allowed(L, name, word);
    } else {
        door::Stream& stream = mode == reading ? file.reading : file.writing;
        stream = open_allowed(L, name, word);
        done = static_cast<bool>(stream);
    }
    lua_pushinteger(L, done ? 0 : 1);
    return 1;
}

int close(lua_State* L) {
    OpenFile& file = fish_of(L).file;
    const bool failed = file.writing && std::ferror(file.writing.get()) != 0;
    const bool closed = !file.writing || std::fclose(file.writing.release()) == 0;
    file.reading.reset();
    if (failed || !closed)
        throw Diagnostic("the file could not be written to its end", "is the disk full?", Fault::run);
    lua_pushinteger(L, 0);
    return 1;
}

/// Number of elements of the array that the arguments (array, n) name; all elements of dimension one.
lua_Integer element_count(lua_State* L, const char* function) {
    if (lua_type(L, 1) != LUA_TTABLE) fail_argument(L, 1, function, "an array");
    const auto size = static_cast<lua_Integer>(lua_rawlen(L, 1));
    const std::int64_t wanted = lua_isnoneornil(L, 2) ? size : integer_argument(L, 2, function);
    if (wanted < 0 || wanted > size)
        throw Diagnostic(fmt::format("'{}' is to use {} lines, but the array has {} elements", function, wanted, size),
                         {}, Fault::run);
    return wanted;
}

/// A line without its end; false at the end of the file.
bool read_line(std::FILE* file, std::string& line) {
    line.clear();
    int c = std::getc(file);
    if (c == EOF) return false;
    for (; c != EOF && c != '\n'; c = std::getc(file)) line += static_cast<char>(c);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
}

/// 0: all lines were read; -1: no file is open; else the number of lines before the file ended.
int read(lua_State* L) {
    std::FILE* file = fish_of(L).file.reading.get();
    const lua_Integer wanted = element_count(L, "read");
    if (file == nullptr) {
        lua_pushinteger(L, -1);
        return 1;
    }
    std::string line;
    lua_Integer i = 0;
    for (; i < wanted && read_line(file, line); ++i) {
        lua_pushlstring(L, line.data(), line.size());
        lua_rawseti(L, 1, i + 1);
    }
    lua_pushinteger(L, i == wanted ? 0 : i);
    return 1;
}

/// One line for each element. A number gets a blank in front, as the classic program writes it.
int write(lua_State* L) {
    std::FILE* file = fish_of(L).file.writing.get();
    const lua_Integer wanted = element_count(L, "write");
    if (file == nullptr && !is_restoring(L)) {
        lua_pushinteger(L, -1);
        return 1;
    }
    for (lua_Integer i = 1; i <= wanted; ++i) {
        lua_rawgeti(L, 1, i);
        const std::string line = (lua_type(L, -1) == LUA_TSTRING ? "" : " ") + text_at(L, -1) + "\n";
        if (!is_restoring(L)) std::fwrite(line.data(), 1, line.size(), file);
        lua_pop(L, 1);
    }
    if (!is_restoring(L) && std::ferror(file) != 0)
        throw Diagnostic("the file could not be written", "is the disk full?", Fault::run);
    lua_pushinteger(L, 0);
    return 1;
}

constexpr std::array file_functions{
    BuiltInFunction{"open", 3, 3, guarded<open>},
    BuiltInFunction{"close", 0, 0, guarded<close>},
    BuiltInFunction{"read", 2, 2, guarded<read>},
    BuiltInFunction{"write", 1, 2, guarded<write>},
};

int close_file(lua_State* L) {
    auto* file = static_cast<luaL_Stream*>(luaL_checkudata(L, 1, LUA_FILEHANDLE));
    return luaL_fileresult(L, std::fclose(file->f) == 0, nullptr);
}

} // namespace

int require_file(lua_State* L) {
    require_allowed(L, text_argument(L, 1, "io.open"), text_argument(L, 2, "io.open"));
    return 0;
}

int open_file(lua_State* L) {
    const std::string name = text_argument(L, 1, "io.open");
    auto* file = static_cast<luaL_Stream*>(lua_newuserdatauv(L, sizeof(luaL_Stream), 0));
    file->closef = nullptr; // not open yet
    luaL_setmetatable(L, LUA_FILEHANDLE);
    file->f = open_allowed(L, name, text_argument(L, 2, "io.open")).release();
    if (file->f == nullptr) return luaL_fileresult(L, 0, name.c_str());
    file->closef = close_file;
    return 1;
}

void add_files(lua_State* L) { add_built_ins(L, file_functions); }

} // namespace kaya::script
