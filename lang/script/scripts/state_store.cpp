#include "lang/script/scripts/state_store.hpp"

#include "lang/script/names/chunks.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/fish_library.hpp"
#include "lang/script/names/hooks.hpp"
#include "lang/script/names/names.hpp"
#include "lang/script/state/compounds.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/handles.hpp"

#include <algorithm>
#include <memory>
#include <sstream>
#include <unordered_map>

namespace kaya::script {

namespace {

constexpr int deepest_table = 100;
constexpr std::int64_t most_lines = 10'000'000; ///< of a deck; more means a damaged file

using Named = std::vector<std::pair<std::string, StoredValue>>;

/// Numbers, then texts, then pointers, each ascending.
bool before(const StoredValue& a, const StoredValue& b) {
    const auto rank = [](const StoredValue& v) {
        const bool number = std::holds_alternative<std::int64_t>(v) || std::holds_alternative<double>(v);
        return number ? 0 : std::holds_alternative<std::string>(v) ? 1 : std::holds_alternative<bool>(v) ? 2 : 3;
    };
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    const auto number = [](const StoredValue& v) {
        const auto* whole = std::get_if<std::int64_t>(&v);
        return whole ? static_cast<double>(*whole) : std::get<double>(v);
    };
    switch (rank(a)) {
    case 0: return number(a) < number(b);
    case 1: return std::get<std::string>(a) < std::get<std::string>(b);
    case 2: return !std::get<bool>(a) && std::get<bool>(b);
    default: break;
    }
    const auto* left = std::get_if<Handle>(&a);
    const auto* right = std::get_if<Handle>(&b);
    if (!left || !right) return left != nullptr && right == nullptr;
    return std::tie(left->table, left->slot, left->generation) < std::tie(right->table, right->slot, right->generation);
}

class StateWriter {
public:
    explicit StateWriter(lua_State* L) : lua_(L) {}

    ScriptState write() {
        state_.fish_globals = named(fish_of(lua_).globals);
        state_.lua_globals = named(state_of(lua_).environment);
        state_.extras = named(names_of(lua_).extras);
        state_.sources = chunks_of(lua_).stored;
        state_.hooks = hooks_of(lua_).of_fish;
        state_.tables = fish_of(lua_).tables;
        state_.random = fish_of(lua_).random.state;
        state_.automatic_create = fish_of(lua_).automatic_create;
        return std::move(state_);
    }

private:
    Named named(int anchor) {
        // Sorted before the values are taken, so that the numbers of objects do not depend on the order in which Lua stores names.
        std::vector<std::string> names;
        push_anchor(lua_, anchor);
        for (lua_pushnil(lua_); lua_next(lua_, -2) != 0; lua_pop(lua_, 1))
            if (lua_type(lua_, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(lua_, -2));
        std::sort(names.begin(), names.end());
        Named result;
        for (const auto& name : names) {
            lua_pushlstring(lua_, name.data(), name.size());
            lua_rawget(lua_, -2);
            StoredValue value;
            if (take(value, 0)) result.emplace_back(name, anchor == fish_of(lua_).globals ? for_fish(value) : value);
            lua_pop(lua_, 1);
        }
        lua_pop(lua_, 1);
        return result;
    }

    /// The value at the top of the stack; false for values that cannot be stored: functions, files.
    bool take(StoredValue& value, int depth) {
        if (lua_istable(lua_, -1)) return take_table(value, depth);
        if (lua_isfunction(lua_, -1) || (lua_type(lua_, -1) == LUA_TUSERDATA && !is_vector(lua_, -1))) return false;
        std::visit(
            [&](auto&& plain) {
                if constexpr (std::is_constructible_v<StoredValue, decltype(plain)>) value = plain;
            },
            value_at(lua_, -1, "a variable"));
        if (is_stale(value)) value = std::monostate{};
        return true;
    }

    /// FISH has 0 where Lua has nothing.
    static StoredValue for_fish(const StoredValue& value) {
        return std::holds_alternative<std::monostate>(value) ? StoredValue(std::int64_t{0}) : value;
    }

    /// A file does not record the model of a pointer: a pointer of a deleted model could point at any object.
    bool is_stale(const StoredValue& value) const {
        const auto* handle = std::get_if<Handle>(&value);
        return handle != nullptr && handle->generation != 0 && !is_of_this_model(world_of(lua_), *handle);
    }

    bool take_table(StoredValue& value, int depth) {
        if (depth > deepest_table)
            throw Diagnostic("the tables of a Lua variable are nested too deeply to be saved", {}, Fault::run);
        luaL_checkstack(lua_, 8, "too many tables in tables");
        const auto [found, is_new] = known_.try_emplace(lua_topointer(lua_, -1), state_.objects.size());
        value = ObjectReference{found->second};
        if (!is_new) return true;
        state_.objects.emplace_back();
        StoredObject object;
        const std::size_t index = found->second;
        const std::string kind = kind_of_value(lua_, -1);
        if (is_array(lua_, -1)) take_array(object, depth);
        else if (kind == "list" || kind == "tensor") take_elements(object, kind, depth);
        else if (kind == "matrix") take_matrix(object, depth);
        else if (kind == "structure") take_structure(object, depth);
        else take_pairs(object, depth);
        if (kind == "map") object.kind = StoredObject::Kind::map;
        state_.objects[index] = std::move(object);
        return true;
    }

    /// The numbered elements of the table at the top of the stack.
    void take_values(StoredObject& object, int depth) {
        for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(lua_, -1)); ++i) {
            lua_rawgeti(lua_, -1, i);
            StoredValue element;
            take(element, depth + 1);
            object.values.push_back(for_fish(element));
            lua_pop(lua_, 1);
        }
    }

    void take_elements(StoredObject& object, const std::string& kind, int depth) {
        object.kind = kind == "list" ? StoredObject::Kind::list : StoredObject::Kind::tensor;
        take_values(object, depth);
    }

    void take_matrix(StoredObject& object, int depth) {
        object.kind = StoredObject::Kind::matrix;
        lua_getfield(lua_, -1, "columns");
        object.keys.emplace_back(static_cast<std::int64_t>(lua_tointeger(lua_, -1)));
        lua_pop(lua_, 1);
        take_values(object, depth);
    }

    void take_structure(StoredObject& object, int depth) {
        object.kind = StoredObject::Kind::structure;
        lua_getfield(lua_, -1, "kind");
        object.name = lua_tostring(lua_, -1);
        lua_pop(lua_, 1);
        lua_getfield(lua_, -1, "values");
        take_values(object, depth);
        lua_pop(lua_, 1);
    }

    void take_array(StoredObject& object, int depth) {
        object.kind = StoredObject::Kind::array;
        lua_getfield(lua_, -1, "dimensions");
        for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(lua_, -1)); ++i) {
            lua_rawgeti(lua_, -1, i);
            object.dimensions.push_back(lua_tointeger(lua_, -1));
            lua_pop(lua_, 1);
        }
        lua_pop(lua_, 1);
        take_values(object, depth);
    }

    void take_pairs(StoredObject& object, int depth) {
        std::vector<StoredValue> keys;
        for (lua_pushnil(lua_); lua_next(lua_, -2) != 0; lua_pop(lua_, 1)) {
            if (lua_istable(lua_, -2) || lua_isfunction(lua_, -2) || lua_type(lua_, -2) == LUA_TUSERDATA) continue;
            StoredValue key;
            lua_pushvalue(lua_, -2);
            take(key, depth + 1);
            lua_pop(lua_, 1);
            if (!std::holds_alternative<std::monostate>(key)) keys.push_back(std::move(key));
        }
        std::sort(keys.begin(), keys.end(), before);
        for (auto& key : keys) {
            push_plain(key);
            lua_rawget(lua_, -2);
            StoredValue value;
            const bool data = take(value, depth + 1);
            lua_pop(lua_, 1);
            if (!data) continue;
            object.keys.push_back(std::move(key));
            object.values.push_back(std::move(value));
        }
    }

    void push_plain(const StoredValue& stored) {
        std::visit(
            [&](const auto& plain) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(plain)>, ObjectReference>)
                    push_lua_value(lua_, Value(plain));
                else lua_pushnil(lua_);
            },
            stored);
    }

    lua_State* lua_;
    ScriptState state_;
    std::unordered_map<const void*, std::size_t> known_; // looked up, never iterated
};

class StateReader {
public:
    StateReader(lua_State* L, const ScriptState& state)
        : lua_(L), state_(state), made_(state.objects.size(), LUA_NOREF) {}

    ~StateReader() {
        for (const int reference : made_) luaL_unref(lua_, LUA_REGISTRYINDEX, reference);
    }
    StateReader(const StateReader&) = delete;
    StateReader& operator=(const StateReader&) = delete;

    void read() {
        check();
        fish_of(lua_).tables = state_.tables;
        rebuild_decks();
        fish_of(lua_).automatic_create = state_.automatic_create;
        state_of(lua_).restoring = true;
        for (const auto& source : state_.sources) define(source);
        state_of(lua_).restoring = false;
        hooks_of(lua_).of_fish = state_.hooks;
        named(fish_of(lua_).globals, state_.fish_globals);
        named(names_of(lua_).extras, state_.extras);
        named(state_of(lua_).environment, state_.lua_globals);
        fish_of(lua_).tables = state_.tables;
        fish_of(lua_).random.state = state_.random;
    }

    /// Only values of objects of the model, and tables that do not exist.
    void read_adjacent_scripts() {
        check();
        named(names_of(lua_).extras, state_.extras);
        fish_of(lua_).tables.insert(state_.tables.begin(), state_.tables.end());
    }

private:
    /// Checks the numbers of objects and of lines before they are used.
    void check() const {
        const auto check_value = [&](const StoredValue& value) {
            if (const auto* reference = std::get_if<ObjectReference>(&value);
                reference && reference->index >= made_.size())
                fail_damaged();
            const auto* handle = std::get_if<Handle>(&value);
            if (handle && handle->generation != 0 && !is_handle(world_of(lua_), *handle)) fail_damaged();
        };
        for (const auto* values : {&state_.fish_globals, &state_.lua_globals, &state_.extras})
            for (const auto& [name, value] : *values) check_value(value);
        for (const auto& object : state_.objects)
            for (const auto* values : {&object.keys, &object.values})
                for (const auto& value : *values) check_value(value);
        std::map<std::string, std::int64_t> last_lines;
        for (const auto& source : state_.sources) {
            if (source.line < 1 || source.line > most_lines || source.kind > StoredSource::Kind::lua) fail_damaged();
            auto& last = last_lines[source.name];
            last = std::max(last, source.line);
        }
        std::int64_t lines = 0;
        for (const auto& [name, last] : last_lines)
            if ((lines += last) > most_lines) fail_damaged();
    }

    /// One text for each deck, with the known lines; the others are empty, so that line numbers are right.
    void rebuild_decks() {
        for (const auto& stored : state_.sources) {
            auto& deck = decks_[stored.name];
            if (!deck) {
                deck = std::make_shared<SourceText>();
                deck->name = stored.name;
            }
            std::istringstream stream(stored.text);
            auto at = static_cast<std::size_t>(stored.line - 1);
            for (std::string line; std::getline(stream, line); ++at) {
                if (deck->lines.size() <= at) deck->lines.resize(at + 1);
                deck->lines[at] = line;
            }
        }
    }

    void define(const StoredSource& stored) {
        const Place place{decks_[stored.name], static_cast<int>(stored.line), 1, 1};
        try {
            if (stored.kind == StoredSource::Kind::fish) define_fish_function(lua_, stored.text, place);
            else run_chunk(lua_, stored.text, place);
        } catch (Diagnostic& diagnostic) {
            state_of(lua_).restoring = false;
            throw diagnostic.add("while the scripts of the saved model were defined again");
        }
    }

    void named(int anchor, const std::vector<std::pair<std::string, StoredValue>>& values) {
        push_anchor(lua_, anchor);
        for (const auto& [name, value] : values) {
            lua_pushlstring(lua_, name.data(), name.size());
            lua_pushvalue(lua_, -1);
            lua_rawget(lua_, -3);
            push(value);
            lua_remove(lua_, -2);
            lua_rawset(lua_, -3);
        }
        lua_pop(lua_, 1);
    }

    /// Pushes the value. Below it is the present value of the variable: a table is filled and not replaced, because functions of the chunks
    /// that ran again may hold it.
    void push(const StoredValue& stored) {
        if (const auto* reference = std::get_if<ObjectReference>(&stored)) return push_object(reference->index);
        if (const auto* stored_handle = std::get_if<Handle>(&stored)) {
            Handle handle = *stored_handle;
            handle.model = world_of(lua_).model_number;
            return push_lua_value(lua_, Value(handle));
        }
        std::visit(
            [&](const auto& plain) {
                if constexpr (!std::is_same_v<std::decay_t<decltype(plain)>, ObjectReference>)
                    push_lua_value(lua_, Value(plain));
            },
            stored);
    }

    void push_object(std::size_t index) {
        if (index >= made_.size()) fail_damaged();
        if (made_[index] != LUA_NOREF) {
            lua_rawgeti(lua_, LUA_REGISTRYINDEX, made_[index]);
            return;
        }
        luaL_checkstack(lua_, 8, "too many tables in tables");
        const StoredObject& object = state_.objects[index];
        using Kind = StoredObject::Kind;
        if (object.kind == Kind::table && object.dimensions.empty() && lua_istable(lua_, -1)) lua_pushvalue(lua_, -1);
        else lua_newtable(lua_);
        lua_pushvalue(lua_, -1);
        made_[index] = luaL_ref(lua_, LUA_REGISTRYINDEX);
        if (++depth_ > deepest_table + 1) fail_damaged();
        const bool array = !object.dimensions.empty();
        switch (array ? Kind::array : object.kind) {
        case Kind::table: fill_pairs(object); break;
        case Kind::array: fill_array(object); break;
        case Kind::structure: fill_structure(object); break;
        case Kind::matrix: fill_matrix(object); break;
        default: fill_value(object); break;
        }
        --depth_;
    }

    [[noreturn]] static void fail_damaged() {
        throw Diagnostic("the saved scripts are damaged", "the file cannot be used", Fault::run);
    }

    /// Lua itself would stop the program at a key that is nothing or not a number.
    static bool is_key(const StoredValue& value) {
        if (const auto* number = std::get_if<double>(&value)) return *number == *number;
        if (const auto* handle = std::get_if<Handle>(&value)) return handle->generation != 0;
        return !std::holds_alternative<std::monostate>(value);
    }

    void fill_elements(const StoredObject& object) {
        for (std::size_t i = 0; i < object.values.size(); ++i) {
            lua_pushnil(lua_);
            push(object.values[i]);
            lua_remove(lua_, -2);
            lua_rawseti(lua_, -2, static_cast<lua_Integer>(i) + 1);
        }
    }

    /// The table at the top of the stack becomes a value of FISH.
    void set_type(const char* kind) {
        push_runtime(lua_, "types");
        lua_getfield(lua_, -1, kind);
        lua_setmetatable(lua_, -3);
        lua_pop(lua_, 1);
    }

    /// A list, map or tensor.
    void fill_value(const StoredObject& object) {
        using Kind = StoredObject::Kind;
        constexpr std::size_t components = 6;
        if (object.kind == Kind::tensor && object.values.size() != components) fail_damaged();
        if (object.kind == Kind::map) fill_pairs(object);
        else fill_elements(object);
        set_type(object.kind == Kind::map ? "map" : object.kind == Kind::list ? "list" : "tensor");
    }

    void fill_matrix(const StoredObject& object) {
        const auto* columns = object.keys.size() == 1 ? std::get_if<std::int64_t>(&object.keys.front()) : nullptr;
        const auto size = static_cast<std::int64_t>(object.values.size());
        if (columns == nullptr || *columns < 1 || size == 0 || size % *columns != 0) fail_damaged();
        for (const StoredValue& value : object.values)
            if (!std::holds_alternative<double>(value) && !std::holds_alternative<std::int64_t>(value)) fail_damaged();
        fill_elements(object);
        lua_pushinteger(lua_, *columns);
        lua_setfield(lua_, -2, "columns");
        set_type("matrix");
    }

    void fill_structure(const StoredObject& object) {
        lua_pushstring(lua_, object.name.c_str());
        lua_setfield(lua_, -2, "kind");
        lua_newtable(lua_);
        fill_elements(object);
        lua_setfield(lua_, -2, "values");
        set_type("structure");
    }

    void fill_array(const StoredObject& object) {
        if (object.dimensions.empty()) fail_damaged();
        std::size_t size = 1;
        for (const std::int64_t extent : object.dimensions)
            if (extent < 1 || __builtin_mul_overflow(size, static_cast<std::size_t>(extent), &size)) fail_damaged();
        if (size != object.values.size()) fail_damaged();
        fill_elements(object);
        lua_newtable(lua_);
        for (std::size_t i = 0; i < object.dimensions.size(); ++i) {
            lua_pushinteger(lua_, object.dimensions[i]);
            lua_rawseti(lua_, -2, static_cast<lua_Integer>(i) + 1);
        }
        lua_setfield(lua_, -2, "dimensions");
        push_anchor(lua_, state_of(lua_).runtime);
        lua_getfield(lua_, -1, object.dimensions.size() == 1 ? "list_kind" : "grid_kind");
        lua_setmetatable(lua_, -3);
        lua_pop(lua_, 1);
    }

    void fill_pairs(const StoredObject& object) {
        for (std::size_t i = 0; i < object.keys.size() && i < object.values.size(); ++i) {
            if (!is_key(object.keys[i])) fail_damaged();
            lua_pushnil(lua_);
            push(object.keys[i]);
            lua_remove(lua_, -2);
            lua_pushvalue(lua_, -1);
            lua_rawget(lua_, -3);
            push(object.values[i]);
            lua_remove(lua_, -2);
            lua_rawset(lua_, -3);
        }
    }

    lua_State* lua_;
    const ScriptState& state_;
    std::vector<int> made_; ///< registry numbers of the tables made so far
    int depth_ = 0;
    std::map<std::string, std::shared_ptr<SourceText>> decks_;
};

} // namespace

ScriptState stored_state(lua_State* L) { return StateWriter(L).write(); }

void restore_state(lua_State* L, const ScriptState& state) { StateReader(L, state).read(); }

void change_model(lua_State* L, const ScriptState* state) {
    World& world = world_of(L);
    const std::uint8_t number_before = world.model_number;
    const Tables tables_before = fish_of(L).tables;
    push_anchor(L, names_of(L).extras);
    lua_newtable(L);
    lua_rawseti(L, LUA_REGISTRYINDEX, names_of(L).extras);
    world.model_number = static_cast<std::uint8_t>((number_before + 1) % World::model_numbers);
    try {
        if (state != nullptr) StateReader(L, *state).read_adjacent_scripts();
    } catch (...) {
        lua_pushvalue(L, -1);
        lua_rawseti(L, LUA_REGISTRYINDEX, names_of(L).extras);
        world.model_number = number_before;
        fish_of(L).tables = tables_before;
        throw;
    }
    lua_pop(L, 1);
}

} // namespace kaya::script
