#include "lang/script/names/chunks.hpp"

#include "system/whole_file.hpp"
#include "lang/script/base/modules.hpp"
#include "lang/script/names/hooks.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <sstream>

namespace kaya::script {

namespace {

namespace fs = std::filesystem;

bool read_file(lua_State* L, const fs::path& file, std::string& text) {
    std::error_code problem;
    if (!fs::exists(file, problem) || fs::is_directory(file, problem)) return false;
    options_of(L).gate->may_read_code(file);
    const auto whole = file_text(file);
    if (whole) text = *whole;
    return whole.has_value();
}

/// A file becomes a text that messages can point into.
Place beginning_of(const std::string& name, const std::string& text) {
    auto source = std::make_shared<SourceText>();
    source->name = name;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) source->lines.push_back(line);
    return {source, 1, 1, 1};
}

/// Loads the text with the user's global variables and leaves the function on the stack.
void load_chunk(lua_State* L, const std::string& text, const Place& place) {
    load_text(L, text, state_of(L).sources.add({"", place, false}));
    push_anchor(L, state_of(L).environment);
    lua_setupvalue(L, -2, 1);
}

/// Addresses of all functions that global variables hold, also as members of tables: what a chunk can define.
using Definitions = std::map<std::string, const void*>;

void collect_functions(lua_State* L, const std::string& prefix, int depth, Definitions& found) {
    luaL_checkstack(L, 4, "too many tables in tables");
    for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1)) {
        if (lua_type(L, -2) != LUA_TSTRING) continue;
        const std::string name = prefix + lua_tostring(L, -2);
        if (lua_isfunction(L, -1)) found[name] = lua_topointer(L, -1);
        else if (lua_istable(L, -1) && depth > 0) collect_functions(L, name + ".", depth - 1, found);
    }
}

Definitions definitions(lua_State* L) {
    Definitions found;
    push_anchor(L, state_of(L).environment);
    collect_functions(L, "", 2, found);
    lua_pop(L, 1);
    return found;
}

/// A chunk that runs in a loop and defines the same functions each time is stored once; hooks are added.
void keep_chunk(lua_State* L, StoredSource chunk) {
    auto& stored = chunks_of(L).stored;
    if (!hooks_of(L).registered)
        std::erase_if(stored, [&](const StoredSource& old) {
            return old.kind == chunk.kind && old.line == chunk.line && old.name == chunk.name && old.text == chunk.text;
        });
    stored.push_back(std::move(chunk));
}

void run_loaded_chunk(lua_State* L, const std::string& text, const Place& place) {
    const Definitions before = definitions(L);
    hooks_of(L).registered = false;
    load_chunk(L, text, place);
    call_protected(L, 0, 0);
    if (!state_of(L).unfinished_line.empty()) print_line(L, std::exchange(state_of(L).unfinished_line, {}));
    if (hooks_of(L).registered || definitions(L) != before)
        keep_chunk(
            L, {StoredSource::Kind::lua, "", place.source ? place.source->name : "", std::max(place.line, 1), text});
}

/// Where `require "a.b"` searches: next to the deck or the called file, in the folders of the options, in the working folder. The name of a
/// called file is relative to the folder of its caller.
std::vector<fs::path> candidates(lua_State* L, const std::string& name) {
    std::string file = name;
    std::replace(file.begin(), file.end(), '.', '/');
    file += ".lua";
    std::vector<fs::path> paths{chunks_of(L).script_folder / file};
    if (chunks_of(L).deck_folders)
        for (const auto& folder : chunks_of(L).deck_folders()) {
            paths.push_back(folder / file);
            paths.push_back(folder / chunks_of(L).script_folder / file);
        }
    for (const auto& folder : options_of(L).module_folders) paths.push_back(folder / file);
    paths.emplace_back(file);
    return paths;
}

bool is_module_name(const std::string& name) {
    return !name.empty() && name.front() != '.' && name.find("..") == std::string::npos &&
           name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") ==
               std::string::npos;
}

/// Runs the text of a module; its value, or true, is left on the stack and remembered.
void run_module(lua_State* L, const std::string& name, const std::string& shown, const std::string& text) {
    load_chunk(L, text, beginning_of(shown, text));
    lua_pushstring(L, name.c_str());
    call_protected(L, 1, 1);
    if (lua_isnil(L, -1)) {
        lua_pop(L, 1);
        lua_pushboolean(L, 1);
    }
    push_anchor(L, chunks_of(L).modules);
    lua_pushvalue(L, -2);
    lua_setfield(L, -2, name.c_str());
    lua_pop(L, 1);
}

} // namespace

void run_chunk(lua_State* L, const std::string& text, const Place& place) {
    if (place) chunks_of(L).script_folder = fs::path(place.source->name).parent_path();
    run_loaded_chunk(L, text, place);
}

void run_chunk_file(lua_State* L, const fs::path& file, const Place& place) {
    std::string text;
    if (!read_file(L, file, text))
        throw Diagnostic(fmt::format("the Lua file '{}' cannot be read: {}", file.string(), std::strerror(errno)),
                         "the path counts from the working folder")
            .at(place);
    chunks_of(L).script_folder = file.parent_path();
    run_loaded_chunk(L, text, beginning_of(file.string(), text));
}

void push_module(lua_State* L, const std::string& name, const Place& place) {
    push_anchor(L, chunks_of(L).modules);
    lua_getfield(L, -1, name.c_str());
    lua_remove(L, -2);
    if (!lua_isnil(L, -1)) return;
    lua_pop(L, 1);

    if (!is_module_name(name))
        throw Diagnostic(fmt::format("'{}' is not the name of a module", name),
                         "a name has letters, digits, '_' and '-'; a point stands for a folder", Fault::run);
    std::string text;
    for (const auto& path : candidates(L, name))
        if (read_file(L, path, text)) return run_module(L, name, path.string(), text);
    for (const auto& module : built_in_modules())
        if (module.name == name && module.is_public)
            return run_module(L, name, name + ".lua", std::string(module.text));
    throw Diagnostic(fmt::format("there is no module '{}'", name),
                     name.ends_with(".lua")
                         ? fmt::format("name it without its ending: {}", name.substr(0, name.size() - 4))
                         : fmt::format("it would be the file {}.lua next to the deck", name),
                     Fault::run)
        .at(place);
}

} // namespace kaya::script
