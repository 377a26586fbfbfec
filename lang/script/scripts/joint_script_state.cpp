#include "lang/script/scripts/joint_script_state.hpp"

#include "kaya/law/roles.hpp"
#include "lang/script/base/lua_headers.hpp"
#include "lang/script/scripts/joint_script_names.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <new>
#include <sstream>
#include <stdexcept>

namespace kaya::script {

/// table_value(n, x) and table_slope(n, x) of a script: the deck's tables; nil when there is none.
struct JointScriptTables {
    template <double (*kaya_jtables::*function)(const void*, double)> static int read(lua_State* L) {
        const auto* state = static_cast<const JointScriptState*>(lua_touserdata(L, lua_upvalueindex(1)));
        const char* name = luaL_checkstring(L, 1);
        const double x = luaL_checknumber(L, 2);
        const kaya_jtables* tables = state->batch_ ? state->batch_->tables : nullptr;
        const void* table = tables ? tables->find(tables, name) : nullptr;
        if (table) lua_pushnumber(L, (tables->*function)(table, x));
        else lua_pushnil(L);
        return 1;
    }
};

namespace {

std::string underscored(std::string name) {
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

/// Raw, so that changes of the table by a script do not matter.
void set_number(lua_State* L, const char* field, double value) {
    lua_pushstring(L, field);
    lua_pushnumber(L, value);
    lua_rawset(L, -3);
}

/// Fields of a row in run(); the header describes them.
constexpr const char* row_fields[] = {"area",
                                      "normal_disp",
                                      "normal_disp_inc",
                                      "pore_pressure",
                                      "normal_force",
                                      "normal_stiffness",
                                      "shear_stiffness",
                                      "frictional_work",
                                      "time_step",
                                      "shear_disp_x",
                                      "shear_disp_y",
                                      "shear_disp_z",
                                      "shear_disp_inc_x",
                                      "shear_disp_inc_y",
                                      "shear_disp_inc_z",
                                      "shear_force_x",
                                      "shear_force_y",
                                      "shear_force_z",
                                      "state"};

std::string text_field(lua_State* L, const char* field, const char* otherwise) {
    lua_getfield(L, -1, field);
    if (!lua_isnil(L, -1) && lua_type(L, -1) != LUA_TSTRING) fail(fmt::format("'{}' must be a text", field));
    const std::string text = lua_isnil(L, -1) ? otherwise : lua_tostring(L, -1);
    lua_pop(L, 1);
    return text;
}

double number_field(lua_State* L, const char* field, double otherwise) {
    lua_getfield(L, -1, field);
    if (!lua_isnil(L, -1) && lua_type(L, -1) != LUA_TNUMBER) fail(fmt::format("'{}' must be a number", field));
    const double number = lua_isnil(L, -1) ? otherwise : lua_tonumber(L, -1);
    lua_pop(L, 1);
    return number;
}

/// The text at [1] of the table on the stack, or the text itself.
std::string first_text(lua_State* L, const char* of) {
    if (lua_type(L, -1) == LUA_TSTRING) return lua_tostring(L, -1);
    if (lua_type(L, -1) != LUA_TTABLE) fail(fmt::format("an entry of '{}' must be a name or a table", of));
    lua_rawgeti(L, -1, 1);
    if (lua_type(L, -1) != LUA_TSTRING) fail(fmt::format("an entry of '{}' must begin with its name", of));
    const std::string text = lua_tostring(L, -1);
    lua_pop(L, 1);
    return text;
}

/// Calls visit() with each entry of a list on the stack.
template <class Visit> void each_entry(lua_State* L, const char* list, Visit visit) {
    lua_getfield(L, -1, list);
    if (!lua_isnil(L, -1)) {
        if (lua_type(L, -1) != LUA_TTABLE) fail(fmt::format("'{}' must be a list", list));
        const auto count = static_cast<lua_Integer>(lua_rawlen(L, -1));
        for (lua_Integer k = 1; k <= count; ++k) {
            lua_rawgeti(L, -1, k);
            visit();
            lua_pop(L, 1);
        }
    }
    lua_pop(L, 1);
}

/// "friction", ...: a role of kaya/jmodel.h; by the name of the property where none is stated.
kaya_jrole role_named(const std::string& word, const std::string& property) {
    if (word.empty()) return KAYA_JROLE_BY_NAME;
    std::vector<std::string_view> words;
    for (const auto& known : law::role_words) {
        if (known.word == word) return known.role;
        words.push_back(known.word);
    }
    fail(fmt::format("the role of property '{}' is '{}'; roles are {}", property, word, fmt::join(words, ", ")));
}

JointScriptTable::Property property_on_stack(lua_State* L) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    JointScriptTable::Property p{first_text(L, "properties"), "", "-", "", std::nan(""), -infinity, infinity, false,
                                 KAYA_JROLE_BY_NAME};
    if (lua_type(L, -1) != LUA_TTABLE) return p;
    refuse_other_names(L, fmt::format("the entry of property '{}'", p.name),
                       {"unit", "help", "initial", "minimum", "maximum", "optional", "role"});
    lua_rawgeti(L, -1, 2);
    if (lua_type(L, -1) == LUA_TSTRING) p.aliases = lua_tostring(L, -1);
    lua_pop(L, 1);
    p.unit = text_field(L, "unit", "-");
    p.help = text_field(L, "help", "");
    p.initial = number_field(L, "initial", p.initial);
    p.minimum = number_field(L, "minimum", p.minimum);
    p.maximum = number_field(L, "maximum", p.maximum);
    lua_getfield(L, -1, "optional");
    p.optional = lua_toboolean(L, -1) != 0;
    lua_pop(L, 1);
    p.role = role_named(text_field(L, "role", ""), p.name);
    return p;
}

} // namespace

JointScriptState::JointScriptState(const std::string& text, const std::string& file) : lua_(luaL_newstate()) {
    if (!lua_) throw std::bad_alloc();
    try {
        const luaL_Reg libraries[] = {{LUA_GNAME, luaopen_base},
                                      {LUA_MATHLIBNAME, luaopen_math},
                                      {LUA_STRLIBNAME, luaopen_string},
                                      {LUA_TABLIBNAME, luaopen_table}};
        for (const auto& library : libraries) {
            luaL_requiref(lua_, library.name, library.func, 1);
            lua_pop(lua_, 1);
        }
        for (const char* name : {"dofile", "loadfile", "load", "collectgarbage"}) {
            lua_pushnil(lua_);
            lua_setglobal(lua_, name);
        }
        lua_getglobal(lua_, LUA_MATHLIBNAME);
        for (const char* name : {"random", "randomseed"}) {
            lua_pushnil(lua_);
            lua_setfield(lua_, -2, name);
        }
        lua_pop(lua_, 1);
        lua_pushlightuserdata(lua_, this);
        lua_pushcclosure(lua_, JointScriptTables::read<&kaya_jtables::value>, 1);
        lua_setglobal(lua_, "table_value");
        lua_pushlightuserdata(lua_, this);
        lua_pushcclosure(lua_, JointScriptTables::read<&kaya_jtables::slope>, 1);
        lua_setglobal(lua_, "table_slope");
        if (luaL_loadbufferx(lua_, text.data(), text.size(), ("@" + file).c_str(), "t") != LUA_OK)
            fail(lua_tostring(lua_, -1));
        lua_pushvalue(lua_, -1);
        chunk_ = luaL_ref(lua_, LUA_REGISTRYINDEX);
        call(0, 1);
        read_table();
        freeze();
    } catch (...) {
        lua_close(lua_);
        throw;
    }
}

JointScriptState::~JointScriptState() { lua_close(lua_); }

void JointScriptState::freeze() {
    push_freezer(lua_);
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, chunk_);
    lua_pushglobaltable(lua_);
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, model_);
    luaL_requiref(lua_, LUA_DBLIBNAME, luaopen_debug, 0);
    call(4, 1);
    changed_ = luaL_ref(lua_, LUA_REGISTRYINDEX);
}

/// Throws when a local variable outside of the functions has another value than when the file was read.
void JointScriptState::refuse_change() {
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, changed_);
    call(0, 1);
    const std::string name = lua_isstring(lua_, -1) ? lua_tostring(lua_, -1) : "";
    lua_pop(lua_, 1);
    if (!name.empty())
        fail(fmt::format(
            "'{}' is changed by the functions of the model and would be kept from call to call: a joint model keeps nothing "
            "but its history",
            name));
}

void JointScriptState::read_table() {
    if (lua_type(lua_, -1) != LUA_TTABLE) fail("the file must return a table");
    refuse_other_names(
        lua_, "the table of the model",
        {"name", "title", "version", "properties", "history", "states", "initialise", "run", "check", "stiffness"});
    table_.name = text_field(lua_, "name", "");
    if (table_.name.empty()) fail("'name' is missing");
    table_.title = text_field(lua_, "title", "");
    table_.version = text_field(lua_, "version", "");
    each_entry(lua_, "properties", [this] { table_.properties.push_back(property_on_stack(lua_)); });
    each_entry(lua_, "history", [this] {
        JointScriptTable::Kept kept{first_text(lua_, "history"), "-", ""};
        if (lua_type(lua_, -1) == LUA_TTABLE) {
            refuse_other_names(lua_, fmt::format("the entry of history '{}'", kept.name), {"unit", "help"});
            kept.unit = text_field(lua_, "unit", "-");
            kept.help = text_field(lua_, "help", "");
        }
        spellings_.push_back(underscored(kept.name));
        table_.history.push_back(std::move(kept));
    });
    each_entry(lua_, "states", [this] {
        if (!table_.states.empty()) table_.states.push_back(' ');
        table_.states.append(first_text(lua_, "states"));
    });
    for (const char* name : {"run", "stiffness"}) {
        if (lua_getfield(lua_, -1, name) != LUA_TFUNCTION) fail(fmt::format("'{}' must be a function", name));
        lua_pop(lua_, 1);
    }
    for (const char* name : {"initialise", "check"}) {
        const int type = lua_getfield(lua_, -1, name);
        if (type != LUA_TFUNCTION && type != LUA_TNIL) fail(fmt::format("'{}' must be a function", name));
        lua_pop(lua_, 1);
    }
    model_ = luaL_ref(lua_, LUA_REGISTRYINDEX);
    lua_newtable(lua_);
    for (const char* field : row_fields) set_number(lua_, field, 0);
    close_names(lua_, "the row");
    row_ = luaL_ref(lua_, LUA_REGISTRYINDEX);
    lua_newtable(lua_);
    for (const auto& name : spellings_) set_number(lua_, name.c_str(), 0);
    close_names(lua_, "the history");
    kept_ = luaL_ref(lua_, LUA_REGISTRYINDEX);
    lua_newtable(lua_);
    values_ = luaL_ref(lua_, LUA_REGISTRYINDEX);
    set_property_names();
}

/// By each of their words, also with _ for -.
void JointScriptState::set_property_names() {
    names_of_properties_.clear();
    for (const auto& p : table_.properties) {
        std::vector<std::string> words{p.name, underscored(p.name)};
        std::istringstream aliases(p.aliases);
        for (std::string word; aliases >> word;) words.insert(words.end(), {word, underscored(word)});
        std::sort(words.begin(), words.end());
        words.erase(std::unique(words.begin(), words.end()), words.end());
        names_of_properties_.push_back(std::move(words));
    }
    const std::vector<double> zeros(table_.properties.size(), 0);
    set_values(zeros.data());
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, values_);
    close_names(lua_, "the list of properties");
    push_view(lua_, "the list of properties");
    view_ = luaL_ref(lua_, LUA_REGISTRYINDEX);
    lua_pop(lua_, 1);
}

void JointScriptState::call(int arguments, int results) {
    if (lua_pcall(lua_, arguments, results, 0) == LUA_OK) return;
    const char* text = lua_tostring(lua_, -1);
    const std::string message = text ? text : "it raised what is not a text";
    lua_settop(lua_, 0);
    fail(message);
}

void JointScriptState::set_values(const double* values) {
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, values_);
    for (std::size_t k = 0; k < table_.properties.size(); ++k)
        for (const auto& word : names_of_properties_[k]) set_number(lua_, word.c_str(), values[k]);
    lua_pop(lua_, 1);
}

void JointScriptState::push_row(const kaya_jbatch& b, std::size_t i) {
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, row_);
    set_number(lua_, "area", b.area[i]);
    set_number(lua_, "normal_disp", b.normal_disp[i]);
    set_number(lua_, "normal_disp_inc", b.normal_disp_inc[i]);
    set_number(lua_, "pore_pressure", b.pore_pressure[i]);
    set_number(lua_, "normal_force", b.normal_force[i]);
    set_number(lua_, "normal_stiffness", b.normal_stiffness[i]);
    set_number(lua_, "shear_stiffness", b.shear_stiffness[i]);
    set_number(lua_, "frictional_work", b.frictional_work[i]);
    set_number(lua_, "time_step", b.time_step);
    static constexpr const char* disp[] = {"shear_disp_x", "shear_disp_y", "shear_disp_z"};
    static constexpr const char* inc[] = {"shear_disp_inc_x", "shear_disp_inc_y", "shear_disp_inc_z"};
    static constexpr const char* force[] = {"shear_force_x", "shear_force_y", "shear_force_z"};
    for (int k = 0; k < 3; ++k) {
        set_number(lua_, disp[k], b.shear_disp[k][i]);
        set_number(lua_, inc[k], b.shear_disp_inc[k][i]);
        set_number(lua_, force[k], b.shear_force[k][i]);
    }
    lua_pushstring(lua_, "state");
    lua_pushinteger(lua_, b.state[i]);
    lua_rawset(lua_, -3);
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, view_);
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, kept_);
    for (std::size_t k = 0; k < spellings_.size(); ++k) set_number(lua_, spellings_[k].c_str(), b.history[k][i]);
}

void JointScriptState::take_row(kaya_jbatch& b, std::size_t i) {
    const auto number = [this](const char* field) {
        lua_pushstring(lua_, field);
        lua_rawget(lua_, -2);
        int is_number = 0;
        const double value = lua_tonumberx(lua_, -1, &is_number);
        lua_pop(lua_, 1);
        if (!is_number) fail(fmt::format("it left '{}' as something that is not a number", field));
        return value;
    };
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, row_);
    b.normal_force[i] = number("normal_force");
    static constexpr const char* force[] = {"shear_force_x", "shear_force_y", "shear_force_z"};
    for (int k = 0; k < 3; ++k) b.shear_force[k][i] = number(force[k]);
    const double normal = number("normal_stiffness"), shear = number("shear_stiffness");
    if (normal != b.normal_stiffness[i] || shear != b.shear_stiffness[i]) b.stiffness_changed = 1;
    b.normal_stiffness[i] = normal;
    b.shear_stiffness[i] = shear;
    b.frictional_work[i] = number("frictional_work");
    const double state = number("state");
    if (!(state >= 0 && state <= std::numeric_limits<std::uint32_t>::max())) fail("it left 'state' out of range");
    b.state[i] = static_cast<std::uint32_t>(state);
    lua_pop(lua_, 1);
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, kept_);
    for (std::size_t k = 0; k < spellings_.size(); ++k) b.history[k][i] = number(spellings_[k].c_str());
    lua_pop(lua_, 1);
}

ptrdiff_t JointScriptState::rows(kaya_jbatch& batch, const char* function) {
    batch_ = &batch;
    const bool starts = std::strcmp(function, "initialise") == 0;
    try {
        batch.row = 0;
        set_values(batch.properties);
        double normal = 0, shear = 0;
        if (starts) stiffness(batch.properties, normal, shear);
        for (; batch.row < batch.n; ++batch.row) {
            const std::size_t i = batch.row;
            if (starts) {
                batch.normal_stiffness[i] = normal;
                batch.shear_stiffness[i] = shear;
            }
            lua_rawgeti(lua_, LUA_REGISTRYINDEX, model_);
            const int type = lua_getfield(lua_, -1, function);
            lua_remove(lua_, -2);
            if (type == LUA_TNIL) { // no `initialise`: the stiffness is all that there is to set
                lua_pop(lua_, 1);
                continue;
            }
            push_row(batch, i);
            call(3, 0);
            take_row(batch, i);
        }
        refuse_change();
        batch_ = nullptr;
        return -1;
    } catch (const std::exception& mistake) {
        lua_settop(lua_, 0);
        batch_ = nullptr;
        std::snprintf(batch.message, sizeof batch.message, "%s", mistake.what());
        return static_cast<ptrdiff_t>(std::min(batch.row, batch.n - 1));
    }
}

std::string JointScriptState::check(const double* values) {
    set_values(values);
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, model_);
    const int type = lua_getfield(lua_, -1, "check");
    lua_remove(lua_, -2);
    std::string sentence;
    if (type == LUA_TFUNCTION) {
        lua_rawgeti(lua_, LUA_REGISTRYINDEX, view_);
        call(1, 1);
        if (const char* text = lua_tostring(lua_, -1)) sentence = text;
    }
    lua_settop(lua_, 0);
    return sentence;
}

void JointScriptState::stiffness(const double* values, double& normal, double& shear) {
    set_values(values);
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, model_);
    lua_getfield(lua_, -1, "stiffness");
    lua_remove(lua_, -2);
    lua_rawgeti(lua_, LUA_REGISTRYINDEX, view_);
    call(1, 2);
    if (!lua_isnumber(lua_, -2) || !lua_isnumber(lua_, -1)) {
        lua_settop(lua_, 0);
        fail("stiffness() must return two numbers");
    }
    normal = lua_tonumber(lua_, -2);
    shear = lua_tonumber(lua_, -1);
    lua_settop(lua_, 0);
}

} // namespace kaya::script
