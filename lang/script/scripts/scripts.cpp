#include "lang/script/scripts/scripts.hpp"

#include "base/lower_case.hpp"
#include "lang/fish/lexer.hpp"
#include "lang/fish/name_uses.hpp"
#include "lang/script/libraries/families.hpp"
#include "lang/script/libraries/libraries.hpp"
#include "lang/script/names/chunks.hpp"
#include "lang/script/names/fish.hpp"
#include "lang/script/names/fish_library.hpp"
#include "lang/script/names/hooks.hpp"
#include "lang/script/scripts/state_store.hpp"
#include "lang/script/state/guard.hpp"
#include "lang/script/state/lua_messages.hpp"
#include "lang/script/state/lua_state.hpp"
#include "lang/script/state/values.hpp"
#include "lang/script/values/value_text.hpp"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <stdexcept>

namespace kaya::script {

/// The five owners of one Lua state. The state ends first: finalizers of scripts may use the others.
struct Parts {
    Parts(World& world, Options options) : state(world, std::move(options), owners) {
        fish.random.seed(state.options.seed);
        open_libraries(state.lua);
    }

    Names names;
    Fish fish;
    Chunks chunks;
    Hooks hooks;
    const Owners owners{&state, &names, &fish, &chunks, &hooks};
    LuaState state;
};

class Scripts::Impl {
public:
    Impl(World& world, Options options) { renew(world, std::move(options)); }

    void renew(World& world, Options options) {
        lua.store(nullptr);
        parts = std::make_unique<Parts>(world, std::move(options));
        lua.store(parts->state.lua);
    }

    lua_State* L() const { return parts->state.lua; }

    std::unique_ptr<Parts> parts;
    std::atomic<lua_State*> lua = nullptr; ///< for the signal handler
};

namespace {

/// The hook stays until the outermost call has ended, so that a pcall of a script cannot stop it.
int end_script(lua_State* L) {
    state_of(L).stopping = true;
    throw Diagnostic("the script was stopped", {}, Fault::run);
}

/// Runs before the next instruction of Lua.
void stop_hook(lua_State* L, lua_Debug*) { guarded<end_script>(L); }

/// Restores the height of the stack on every exit.
class StackLevel {
public:
    explicit StackLevel(lua_State* L) : lua_(L), level_(lua_gettop(L)) { luaL_checkstack(L, 40, "for a call"); }
    ~StackLevel() { lua_settop(lua_, level_); }
    StackLevel(const StackLevel&) = delete;
    StackLevel& operator=(const StackLevel&) = delete;

private:
    lua_State* lua_;
    int level_;
};

/// While it lives, a command or a cycle waits for a value from a script.
class Awaited {
public:
    explicit Awaited(lua_State* L) : count_(state_of(L).awaited) { ++count_; }
    ~Awaited() { --count_; }
    Awaited(const Awaited&) = delete;
    Awaited& operator=(const Awaited&) = delete;

private:
    int& count_;
};

/// A Lua function has returned nil: the error stands where it begins.
Diagnostic no_number(lua_State* L, const std::string& expression) {
    const StackLevel level(L);
    const std::string name = bare_expression(expression);
    Diagnostic error(fmt::format("the function '{}' returned nothing, where a number is needed", name),
                     "return a number from it; a name that was never set, or is misspelt, is nil in Lua", Fault::run);
    return push_lua_function(L, name) ? error.at(place_of_function(L, -1)) : error;
}

/// Errors without a place in a script get that of the command.
template <class Action> auto placed(const Place& place, Action action) {
    try {
        return action();
    } catch (Diagnostic& diagnostic) { throw diagnostic.at(place); }
}

} // namespace

Scripts::Scripts(World& world, Options options) : impl_(std::make_unique<Impl>(world, std::move(options))) {}
Scripts::~Scripts() = default;

void Scripts::on_print(std::function<void(const std::string&)> sink) { impl_->parts->state.sink = std::move(sink); }

void Scripts::on_require(std::function<std::vector<std::filesystem::path>()> folders) {
    impl_->parts->chunks.deck_folders = std::move(folders);
}

void Scripts::define_fish(const std::string& text, const Place& place) {
    const StackLevel level(impl_->L());
    placed(place, [&] { define_fish_function(impl_->L(), text, place); });
}

void Scripts::run_lua(const std::string& text, const Place& place) {
    const StackLevel level(impl_->L());
    placed(place, [&] { run_chunk(impl_->L(), text, place); });
}

void Scripts::run_lua_file(const std::filesystem::path& file, const Place& place) {
    const StackLevel level(impl_->L());
    placed(place, [&] { run_chunk_file(impl_->L(), file, place); });
}

Value Scripts::value(const std::string& expression, const Place& place) {
    lua_State* L = impl_->L();
    const StackLevel level(L);
    const Awaited awaited(impl_->L());
    return placed(place, [&] {
        const std::string bare = bare_expression(expression);
        if (!push_lua_function(L, bare)) push_expression(L, expression, place);
        call_protected(L, 0, 1);
        if (!lua_isnil(L, -1)) make_fish_value(L); // what FISH reads as 0 is nothing here
        return value_at(L, -1, fmt::format("'{}'", bare));
    });
}

double Scripts::number(const std::string& expression, const Place& place) {
    const Value result = value(expression, place);
    if (std::holds_alternative<std::monostate>(result)) throw no_number(impl_->L(), expression).at(place);
    if (const auto* real = std::get_if<double>(&result)) return *real;
    if (const auto* whole = std::get_if<std::int64_t>(&result)) return static_cast<double>(*whole);
    if (const auto* truth = std::get_if<bool>(&result)) return *truth ? 1 : 0;
    throw Diagnostic(fmt::format("'{}' is the {} {}, where a number is needed", bare_expression(expression),
                                 type_name(result), to_text(result, &impl_->parts->state.world)),
                     {}, Fault::run)
        .at(place);
}

void Scripts::call(const std::string& expression, const Place& place) {
    lua_State* L = impl_->L();
    const StackLevel level(L);
    placed(place, [&] {
        push_expression(impl_->L(), expression, place);
        call_protected(L, 0, 0);
    });
}

void Scripts::set(const std::string& name, const Value& value, const Place& place) {
    lua_State* L = impl_->L();
    const StackLevel level(L);
    placed(place, [&] {
        push_fish_value(L, value);
        set_fish_name(impl_->L(), bare_expression(name), -1);
    });
}

void Scripts::create_automatically(bool on) { impl_->parts->fish.automatic_create = on; }

void Scripts::define_structure(const std::string& name, const std::vector<std::string>& members, const Place& place) {
    lua_State* L = impl_->L();
    const StackLevel level(L);
    placed(place, [&] {
        luaL_checkstack(L, static_cast<int>(members.size()) + 4, "for a structure");
        push_runtime(L, "define_structure");
        lua_pushstring(L, lower_case(name).c_str());
        for (const auto& member : members) lua_pushstring(L, member.c_str());
        call_protected(L, static_cast<int>(members.size()) + 1, 0);
    });
}

void Scripts::seed(std::uint64_t seed) { impl_->parts->fish.random.seed(seed); }

bool Scripts::gives_value(const std::string& name) const {
    const auto& functions = impl_->parts->fish.functions;
    const auto found = functions.find(lower_case(bare_expression(name)));
    return found == functions.end() || fish::gives_value(found->second.function);
}

bool Scripts::knows(const std::string& name) const { return knows_fish_name(impl_->L(), bare_expression(name)); }

std::vector<std::string> Scripts::symbols() const { return fish_symbols(impl_->L()); }

std::vector<std::pair<std::string, bool>> Scripts::built_in_names() const {
    std::vector<std::pair<std::string, bool>> names;
    for (const auto& [name, built_in] : impl_->parts->names.built_ins) names.emplace_back(name, built_in.writable);
    return names;
}

std::vector<std::string> Scripts::lua_names() const { return global_names(impl_->L()); }

std::vector<std::pair<std::string, std::string>> Scripts::newer_names() const {
    return modern_names(impl_->parts->state.world);
}

fish::Meaning Scripts::meaning_of(const std::string& name) const { return dictionary_of(impl_->L())(name); }

void Scripts::add_fish_hook(const std::string& function, Moment moment, double location, std::int64_t interval,
                            const Place& place) {
    const Fish& fish = impl_->parts->fish;
    const std::string name = lower_case(function);
    const auto found = fish.functions.find(name);
    if (found == fish.functions.end()) {
        std::vector<std::string_view> names;
        for (const auto& [known, defined] : fish.functions) names.push_back(known);
        const auto meant = did_you_mean(name, names);
        throw Diagnostic(fmt::format("there is no FISH function '{}'", function),
                         meant.empty() ? std::string("define it before") : fmt::format("did you mean '{}'?", meant),
                         Fault::run)
            .at(place);
    }
    if (!found->second.function.arguments.empty())
        throw Diagnostic(fmt::format("'{}' runs in cycles and cannot have arguments", function),
                         "take a function without arguments", Fault::run)
            .at(place);
    add_hook(impl_->parts->hooks.of_fish, {name, static_cast<std::uint8_t>(moment), interval, false, location});
}

void Scripts::remove_fish_hook(const std::string& function, std::optional<Moment> moment,
                               std::optional<double> location, const Place& place) {
    auto& hooks = impl_->parts->hooks.of_fish;
    const auto is_callback = [name = lower_case(function)](const StoredHook& hook) {
        return hook.function == name && !hook.whilestepping;
    };
    const auto removed = std::erase_if(hooks, [&](const StoredHook& hook) {
        const bool in_moment = !moment || static_cast<Moment>(hook.moment) == *moment;
        return is_callback(hook) && in_moment && (!location || hook.location == *location);
    });
    if (removed > 0) return;
    const bool elsewhere = std::ranges::any_of(hooks, is_callback);
    const std::string at = location ? fmt::format(" at {}", *location) : moment ? " at this event" : "";
    throw Diagnostic(fmt::format("no callback runs '{}'{}", function, elsewhere ? at : ""),
                     elsewhere ? fmt::format("without a location or event all its callbacks are removed: fish callback "
                                             "remove {}",
                                             function)
                               : "",
                     Fault::run)
        .at(place);
}

bool Scripts::has_hooks(Moment moment) const {
    lua_State* L = impl_->L();
    for (const auto& hook : hooks_of(L).of_fish)
        if (static_cast<Moment>(hook.moment) == moment) return true;
    for (const auto& hook : hooks_of(L).of_lua)
        if (hook.moment == moment) return true;
    return false;
}

void Scripts::run_hooks(Moment moment, std::int64_t cycle) {
    lua_State* L = impl_->L();
    const StackLevel level(L);
    const Awaited awaited(L);
    const auto of_fish = hooks_of(L).of_fish; // a function may define or replace another one
    for (const auto& hook : of_fish) {
        if (static_cast<Moment>(hook.moment) != moment || cycle % hook.interval != 0) continue;
        push_anchor(L, fish_of(L).called);
        lua_getfield(L, -1, hook.function.c_str());
        call_protected(L, 0, 0);
        lua_pop(L, 1);
    }
    const std::vector<LuaHook> hooks = hooks_of(L).of_lua;
    for (const auto& hook : hooks) {
        if (hook.moment != moment || cycle % hook.interval != 0) continue;
        lua_rawgeti(L, LUA_REGISTRYINDEX, hook.function);
        // An earlier hook may have removed this one.
        if (lua_isfunction(L, -1)) call_protected(L, 0, 0);
        else lua_pop(L, 1);
    }
}

void Scripts::interrupt() noexcept {
    lua_State* L = impl_->lua.load();
    if (L) lua_sethook(L, stop_hook, LUA_MASKCALL | LUA_MASKRET | LUA_MASKLINE | LUA_MASKCOUNT, 1);
}

bool Scripts::is_deaf() const noexcept {
    const Parts* parts = impl_->parts.get();
    // The hook is set when the stop was requested while the script ran.
    return parts && parts->state.depth > 0 && !parts->state.stopping && lua_gethook(parts->state.lua) != nullptr;
}

Tables& Scripts::tables() { return impl_->parts->fish.tables; }

ScriptState Scripts::state() {
    const StackLevel level(impl_->L());
    return stored_state(impl_->L());
}

void Scripts::restore(const ScriptState& state) {
    clear();
    const StackLevel level(impl_->L());
    restore_state(impl_->L(), state);
}

void Scripts::clear() {
    if (running()) throw std::logic_error("a running script cannot be removed");
    const Parts& old = *impl_->parts;
    const auto sink = old.state.sink;
    const auto deck_folders = old.chunks.deck_folders;
    impl_->renew(old.state.world, old.state.options);
    impl_->parts->state.sink = sink;
    impl_->parts->chunks.deck_folders = deck_folders;
}

bool Scripts::running() const { return impl_->parts->state.depth > 0; }

void Scripts::refuse_while_awaited(const char* what) const {
    if (impl_->parts->state.awaited > 0)
        throw Diagnostic(
            fmt::format("'{}' cannot be given here: a command or a cycle waits for the value of the function", what),
            "call the function on a separate line, as @name, or from a Lua chunk", Fault::run);
}

void Scripts::change_model(const ScriptState* state) {
    const StackLevel level(impl_->L());
    script::change_model(impl_->L(), state);
}

} // namespace kaya::script
