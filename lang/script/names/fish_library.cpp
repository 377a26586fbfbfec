#include "lang/script/names/fish_library.hpp"

#include "base/abbreviation.hpp"
#include "base/lower_case.hpp"
#include "lang/fish/lexer.hpp"
#include "lang/fish/name_uses.hpp"
#include "lang/fish/nearest.hpp"
#include "lang/fish/reserved.hpp"
#include "lang/script/names/chunks.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/hooks.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

namespace kaya::script {

namespace {

/// A Lua function accepts any number of arguments.
constexpr int most_lua_arguments = 50;

using fish::is_constant;

/// The built-in names that a name with points shortens.
std::vector<std::string_view> shortened(const Names& names, std::string_view name) {
    std::vector<std::string_view> whole;
    if (fish::find_reserved(name)) return whole;
    for (const auto& [known, built_in] : names.built_ins)
        if (shortens_each_part(name, known, '.')) whole.push_back(known);
    return whole;
}

bool variable_exists(lua_State* L, const std::string& name) {
    push_anchor(L, fish_of(L).globals);
    lua_pushlstring(L, name.data(), name.size());
    const bool exists = lua_rawget(L, -2) != LUA_TNIL;
    lua_pop(L, 2);
    return exists;
}

} // namespace

fish::Dictionary dictionary_of(lua_State* L, const fish::Function* coming) {
    return [L, coming](std::string_view name) -> fish::Meaning {
        const Fish& fish = fish_of(L);
        const auto& built_ins = names_of(L).built_ins;
        const auto function_meaning = [](const fish::Function& function) {
            const int most = static_cast<int>(function.arguments.size());
            return fish::Meaning{fish::NameKind::function, function.least, most, false};
        };
        if (coming && coming->name == name) return function_meaning(*coming);
        if (const auto found = fish.functions.find(name); found != fish.functions.end())
            return function_meaning(found->second.function);
        if (const auto found = built_ins.find(name); found != built_ins.end())
            return {fish::NameKind::built_in, found->second.least, found->second.most, found->second.writable};
        if (fish.lua_functions.contains(name)) return {fish::NameKind::function, 0, most_lua_arguments, false};
        if (const auto whole = shortened(names_of(L), name); whole.size() == 1) {
            const BuiltIn& meant = built_ins.find(whole.front())->second;
            return {.kind = fish::NameKind::built_in,
                    .least = meant.least,
                    .most = meant.most,
                    .writable = meant.writable,
                    .whole = std::string(whole.front())};
        }
        return {.exists = fish::makes_value(name) && variable_exists(L, std::string(name))};
    };
}

namespace {

[[noreturn]] void fail_unknown_name(lua_State* L, const std::string& name, const Place& place) {
    if (const auto* reserved = fish::find_reserved_family(name))
        throw fish::reserved_message(name, *reserved).at(place);
    if (const auto whole = shortened(names_of(L), name); whole.size() > 1) {
        constexpr std::size_t most_shown = 6;
        const std::span shown(whole.data(), std::min(whole.size(), most_shown));
        Diagnostic several(
            fmt::format("'{}' shortens several names of FISH", name),
            fmt::format("one of: {}{}", fmt::join(shown, ", "), whole.size() > most_shown ? ", ..." : ""));
        several.code = "unknown-fish-name";
        throw several.at(place);
    }
    const auto symbols = fish_symbols(L);
    std::vector<std::string_view> candidates(symbols.begin(), symbols.end());
    for (const auto& [known, built_in] : names_of(L).built_ins) candidates.push_back(known);
    const auto meant = fish::nearest_name(name, candidates);
    Diagnostic diagnostic(fmt::format("there is no FISH variable or function '{}'", name),
                          meant.empty() ? fmt::format("give it a value before: [{} = 1]", name)
                                        : fmt::format("did you mean '{}'?", meant));
    diagnostic.code = "unknown-fish-name";
    throw diagnostic.at(place);
}

/// Names with a point are functions of the program in the modern dialect, never variables.
void refuse_unknown_functions(lua_State* L, const std::vector<fish::NameUse>& uses,
                              const fish::Dictionary& dictionary) {
    for (const auto& use : uses)
        if (use.dialect == fish::Dialect::modern && use.name.find('.') != use.name.npos &&
            dictionary(use.name).kind == fish::NameKind::variable && !variable_exists(L, use.name))
            fail_unknown_name(L, use.name, use.place);
}

/// With `fish automatic-create off` a variable must be declared, or have a value.
void refuse_undeclared(lua_State* L, const fish::Function& function, const fish::Dictionary& dictionary) {
    if (fish_of(L).automatic_create) return;
    std::set<std::string, std::less<>> declared;
    const auto uses = fish::name_uses(function);
    for (const auto& use : uses)
        if (use.use == fish::Use::declare) declared.insert(use.name);
    for (const auto& use : uses) {
        const bool variable = dictionary(use.name).kind == fish::NameKind::variable && !is_constant(use.name);
        if (!variable || use.use == fish::Use::command || declared.contains(use.name) || variable_exists(L, use.name))
            continue;
        Diagnostic diagnostic(
            fmt::format("'{}' is not declared, and variables are not created automatically", use.name),
            fmt::format("write: local {0} = 0, or: global {0} = 0", use.name));
        diagnostic.code = "unknown-fish-name";
        throw diagnostic.at(use.place);
    }
}

/// A variable is the integer 0 from its first mention on.
void create_variables(lua_State* L, const std::vector<std::string>& mentions, const fish::Dictionary& dictionary) {
    for (const auto& name : mentions) {
        if (dictionary(name).kind != fish::NameKind::variable || is_constant(name)) continue;
        if (variable_exists(L, name)) continue;
        push_anchor(L, fish_of(L).globals);
        lua_pushinteger(L, 0);
        lua_setfield(L, -2, name.c_str());
        lua_pop(L, 1);
    }
}

/// Leaves the Lua function that the generated text makes on the stack.
void push_generated(lua_State* L, const std::string& text, const std::string& chunk_name) {
    load_text(L, text, chunk_name);
    const Fish& fish = fish_of(L);
    const Names& names = names_of(L);
    for (const int anchor : {fish.globals, fish.called, names.readers, names.writers, state_of(L).runtime})
        push_anchor(L, anchor);
    call_protected(L, 5, 1);
}

/// Translates the function with the current meaning of its names, puts it into F and on the stack.
void push_translated(lua_State* L, const std::string& name) {
    const auto found = fish_of(L).functions.find(name);
    if (found == fish_of(L).functions.end())
        throw Diagnostic(fmt::format("the function '{}' is gone", name), {}, Fault::run);
    const auto dictionary = dictionary_of(L);
    refuse_undeclared(L, found->second.function, dictionary);
    create_variables(L, found->second.function.mentions, dictionary);
    push_generated(L, fish::generate(found->second.function, dictionary), found->second.chunk_name);
    push_anchor(L, fish_of(L).called);
    lua_pushvalue(L, -2);
    lua_setfield(L, -2, name.c_str());
    lua_pop(L, 1);
}

/// Entry in F of a function that must be translated before it runs. Upvalue: its name. No object may live here during the call, because an
/// error jumps over this function.
int translate_and_call(lua_State* L) {
    push_translated(L, lua_tostring(L, lua_upvalueindex(1)));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, 1);
    return 1;
}

void set_translator(lua_State* L, const std::string& name) {
    push_anchor(L, fish_of(L).called);
    lua_pushstring(L, name.c_str());
    lua_pushcclosure(L, guarded<translate_and_call>, 1);
    lua_setfield(L, -2, name.c_str());
    lua_pop(L, 1);
}

void forget_expressions(lua_State* L) {
    for (const auto& [text, kept] : fish_of(L).expressions) luaL_unref(L, LUA_REGISTRYINDEX, kept);
    fish_of(L).expressions.clear();
}

void check_argument_count(lua_State* L, const std::string& name, int given) {
    const auto found = fish_of(L).functions.find(name);
    if (found == fish_of(L).functions.end()) return;
    const auto& function = found->second.function;
    const int most = static_cast<int>(function.arguments.size());
    if (given < function.least || given > most)
        throw Diagnostic(fmt::format("the FISH function '{}' takes {}{} argument{}, here it is given {}", name,
                                     function.least < most ? fmt::format("{} to ", function.least) : "", most,
                                     most == 1 ? "" : "s", given == 0 ? "none" : std::to_string(given)),
                         {}, Fault::run);
}

/// Called from Lua as fish.name(...). Upvalue: the name. No object may live here during the call.
int call_from_lua(lua_State* L) {
    const int given = lua_gettop(L);
    check_argument_count(L, lua_tostring(L, lua_upvalueindex(1)), given);
    push_anchor(L, fish_of(L).called);
    lua_getfield(L, -1, lua_tostring(L, lua_upvalueindex(1)));
    lua_remove(L, -2);
    for (int i = 1; i <= given; ++i) {
        lua_pushvalue(L, i);
        make_fish_value(L);
    }
    lua_call(L, given, 1);
    return 1;
}

/// Called from FISH. Upvalue: the name as Lua spells it.
int call_lua_function(lua_State* L) {
    push_anchor(L, state_of(L).environment);
    lua_getfield(L, -1, lua_tostring(L, lua_upvalueindex(1)));
    lua_remove(L, -2);
    if (!lua_isfunction(L, -1))
        throw Diagnostic(fmt::format("the Lua function '{}' is gone", lua_tostring(L, lua_upvalueindex(1))), {},
                         Fault::run);
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, 1);
    make_fish_value(L);
    return 1;
}

} // namespace

void define_fish_function(lua_State* L, const std::string& text, const Place& place) {
    Fish& fish = fish_of(L);
    auto& hooks = hooks_of(L).of_fish;
    fish::Function function = fish::read_function(text, place);
    if (names_of(L).built_ins.contains(function.name))
        throw Diagnostic(fmt::format("'{}' is built in and cannot be defined", function.name),
                         "give the function another name")
            .at(function.place);
    const bool is_callback = std::ranges::any_of(
        hooks, [&](const StoredHook& hook) { return hook.function == function.name && !hook.whilestepping; });
    if (is_callback && !function.arguments.empty())
        throw Diagnostic(fmt::format("'{}' is a callback and cannot have arguments", function.name),
                         fmt::format("write before: fish callback remove {}", function.name))
            .at(function.place);
    // Nothing is changed before the whole function has been checked.
    const auto dictionary = dictionary_of(L, &function);
    refuse_unknown_functions(L, fish::name_uses(function), dictionary);
    const std::string generated = fish::generate(function, dictionary);
    const std::string chunk_name = state_of(L).sources.add({function.name, function.place, true});
    push_generated(L, generated, chunk_name);

    const bool automatic = fish_of(L).automatic_create; // else its names are looked at when it runs for the first time
    if (automatic) create_variables(L, function.mentions, dictionary);
    const std::string name = function.name;
    push_anchor(L, fish_of(L).called);
    lua_insert(L, -2);
    lua_setfield(L, -2, name.c_str());
    lua_pop(L, 1);
    push_anchor(L, fish_of(L).globals);
    lua_pushnil(L);
    lua_setfield(L, -2, name.c_str());
    lua_pop(L, 1);

    std::erase_if(hooks, [&](const StoredHook& hook) { return hook.function == name && hook.whilestepping; });
    if (function.whilestepping) hooks.push_back({name, static_cast<std::uint8_t>(Moment::after_cycle), 1, true});
    std::erase_if(chunks_of(L).stored, [&](const StoredSource& stored) {
        return stored.kind == StoredSource::Kind::fish && stored.title == name;
    });
    chunks_of(L).stored.push_back(
        {StoredSource::Kind::fish, name, place.source ? place.source->name : "", std::max(place.line, 1), text});
    fish.lua_functions.erase(name);
    fish.functions[name] = {std::move(function), chunk_name};
    if (!automatic) set_translator(L, name);
    for (auto& [other, defined] : fish.functions) {
        const auto& mentions = defined.function.mentions;
        if (other != name && std::binary_search(mentions.begin(), mentions.end(), name)) set_translator(L, other);
    }
    forget_expressions(L);
}

void forget_translations(lua_State* L, const std::string& name) {
    for (auto& [other, defined] : fish_of(L).functions) {
        const auto& mentions = defined.function.mentions;
        if (std::binary_search(mentions.begin(), mentions.end(), name)) set_translator(L, other);
    }
    forget_expressions(L);
}

void adopt_lua_function(lua_State* L, const std::string& name) {
    const std::string known_as = lower_case(name);
    if (fish_of(L).functions.contains(known_as) || names_of(L).built_ins.contains(known_as)) return;
    push_anchor(L, fish_of(L).called);
    lua_pushstring(L, name.c_str());
    lua_pushcclosure(L, guarded<call_lua_function>, 1);
    lua_setfield(L, -2, known_as.c_str());
    lua_pop(L, 1);
    if (fish_of(L).lua_functions.insert(known_as).second) forget_translations(L, known_as);
}

bool push_lua_function(lua_State* L, const std::string& name) {
    const std::string known_as = lower_case(name);
    if (!fish_of(L).lua_functions.contains(known_as)) return false;
    const int top = lua_gettop(L);
    push_anchor(L, state_of(L).environment);
    push_anchor(L, fish_of(L).called);
    lua_getfield(L, -1, known_as.c_str());
    lua_getupvalue(L, -1, 1); // the name as Lua spells it
    lua_gettable(L, top + 1);
    lua_insert(L, top + 1);
    lua_settop(L, top + 1);
    if (lua_isfunction(L, -1)) return true;
    lua_pop(L, 1);
    return false;
}

Place place_of_function(lua_State* L, int index) {
    lua_Debug record;
    lua_pushvalue(L, index);
    lua_getinfo(L, ">S", &record);
    const Source* source = state_of(L).sources.find(record.source);
    return source != nullptr ? line_place(*source, record.linedefined) : Place{};
}

std::string bare_expression(const std::string& expression) {
    const auto first = expression.find_first_not_of(" \t");
    const auto last = expression.find_last_not_of(" \t\r\n");
    if (first == std::string::npos) return {};
    std::string bare = expression.substr(first, last - first + 1);
    if (bare.front() == '@') return bare.substr(1);
    if (bare.front() == '[' && bare.back() == ']') return bare.substr(1, bare.size() - 2);
    return bare;
}

void push_expression(lua_State* L, const std::string& text, const Place& place) {
    Fish& fish = fish_of(L);
    const fish::Dialect dialect = text.starts_with('[') ? fish::Dialect::modern : fish::dialect_at(place);
    const std::string key = fmt::format("{}\n{}\n{}", text, place.line, static_cast<int>(dialect));
    if (const auto kept = fish.expressions.find(key); kept != fish.expressions.end()) {
        lua_rawgeti(L, LUA_REGISTRYINDEX, kept->second);
        return;
    }
    const fish::Expression expression = fish::read_expression(bare_expression(text), place, dialect);
    const auto dictionary = dictionary_of(L);
    refuse_unknown_functions(L, fish::name_uses(expression), dictionary);
    // An unknown word of a command is a misspelling; only an assignment makes a variable here.
    for (const auto& name : expression.mentions) {
        if (name == expression.assigned || is_constant(name)) continue;
        if (dictionary(name).kind == fish::NameKind::variable && !variable_exists(L, name))
            fail_unknown_name(L, name, place);
    }
    const std::string generated = fish::generate(expression, dictionary);
    create_variables(L, expression.mentions, dictionary);
    push_generated(L, generated, state_of(L).sources.add({"", place, true}));
    lua_pushvalue(L, -1);
    fish.expressions[key] = luaL_ref(L, LUA_REGISTRYINDEX);
}

void push_fish_name(lua_State* L, const std::string& given) {
    const std::string name = lower_case(given);
    if (fish_of(L).functions.contains(name) || fish_of(L).lua_functions.contains(name)) {
        lua_pushstring(L, name.c_str());
        lua_pushcclosure(L, guarded<call_from_lua>, 1);
        return;
    }
    if (!variable_exists(L, name)) fail_unknown_name(L, name, {});
    push_anchor(L, fish_of(L).globals);
    lua_getfield(L, -1, name.c_str());
    lua_remove(L, -2);
}

void set_fish_name(lua_State* L, const std::string& given, int index) {
    const std::string name = lower_case(given);
    if (fish_of(L).functions.contains(name) || fish_of(L).lua_functions.contains(name))
        throw Diagnostic(fmt::format("'{}' is a FISH function: it cannot be assigned", name));
    if (names_of(L).built_ins.contains(name))
        throw Diagnostic(fmt::format("'{}' is built in: a variable of this name cannot be made", name),
                         "use another name for the variable");
    lua_pushvalue(L, index);
    make_fish_value(L);
    push_anchor(L, fish_of(L).globals);
    lua_insert(L, -2);
    lua_setfield(L, -2, name.c_str());
    lua_pop(L, 1);
}

std::vector<std::string> fish_symbols(lua_State* L) {
    std::vector<std::string> names;
    for (const auto& [name, function] : fish_of(L).functions) names.push_back(name);
    push_anchor(L, fish_of(L).globals);
    for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1)) {
        const std::string name = lua_tostring(L, -2);
        if (name.find(' ') == name.npos) names.push_back(name); // not the kinds of structures
    }
    lua_pop(L, 1);
    std::sort(names.begin(), names.end());
    return names;
}

bool knows_fish_name(lua_State* L, const std::string& given) {
    const std::string name = lower_case(given);
    const Fish& fish = fish_of(L);
    return fish.functions.contains(name) || fish.lua_functions.contains(name) || names_of(L).built_ins.contains(name) ||
           variable_exists(L, name) || shortened(names_of(L), name).size() == 1;
}

} // namespace kaya::script
