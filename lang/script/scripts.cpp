#include "lang/script/scripts.hpp"

#include "base/lower_case.hpp"
#include "lang/fish/lexer.hpp"
#include "lang/script/built_ins.hpp"
#include "lang/script/chunks.hpp"
#include "lang/script/context.hpp"
#include "lang/script/fish_library.hpp"
#include "lang/script/guard.hpp"
#include "lang/script/libraries.hpp"
#include "lang/script/lua_messages.hpp"
#include "lang/script/machine.hpp"
#include "lang/script/state_store.hpp"
#include "lang/script/value_text.hpp"
#include "lang/script/values.hpp"

#include <atomic>
#include <fmt/format.h>
#include <stdexcept>

namespace kaya::script {

class Scripts::Impl {
public:
    Impl(World& world, Options options) { renew(world, std::move(options)); }

    void renew(World& world, Options options) {
        lua.store(nullptr);
        machine = std::make_unique<Machine>(world, std::move(options));
        open_libraries(*machine);
        lua.store(machine->lua);
    }

    std::unique_ptr<Machine> machine;
    std::atomic<lua_State*> lua = nullptr; ///< for the signal handler
};

namespace {

/// The hook stays until the outermost call has ended, so that a pcall of a script cannot stop it.
int end_script(lua_State* L) {
    machine_of(L).stopping = true;
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
    explicit Awaited(Machine& machine) : count_(machine.awaited) { ++count_; }
    ~Awaited() { --count_; }
    Awaited(const Awaited&) = delete;
    Awaited& operator=(const Awaited&) = delete;

private:
    int& count_;
};

/// Errors without a place in a script get that of the command.
template <class Action> auto placed(const Place& place, Action action) {
    try {
        return action();
    } catch (Diagnostic& diagnostic) { throw diagnostic.at(place); }
}

} // namespace

Scripts::Scripts(World& world, Options options) : impl_(std::make_unique<Impl>(world, std::move(options))) {}
Scripts::~Scripts() = default;

void Scripts::on_print(std::function<void(const std::string&)> sink) { impl_->machine->sink = std::move(sink); }

void Scripts::on_require(std::function<std::vector<std::filesystem::path>()> folders) {
    impl_->machine->deck_folders = std::move(folders);
}

void Scripts::define_fish(const std::string& text, const Place& place) {
    const StackLevel level(impl_->machine->lua);
    placed(place, [&] { define_fish_function(*impl_->machine, text, place); });
}

void Scripts::run_lua(const std::string& text, const Place& place) {
    const StackLevel level(impl_->machine->lua);
    placed(place, [&] { run_chunk(*impl_->machine, text, place); });
}

void Scripts::run_lua_file(const std::filesystem::path& file, const Place& place) {
    const StackLevel level(impl_->machine->lua);
    placed(place, [&] { run_chunk_file(*impl_->machine, file, place); });
}

Value Scripts::value(const std::string& expression, const Place& place) {
    lua_State* L = impl_->machine->lua;
    const StackLevel level(L);
    const Awaited awaited(*impl_->machine);
    return placed(place, [&] {
        push_expression(*impl_->machine, expression, place);
        call_protected(L, 0, 1);
        return value_at(L, -1, fmt::format("'{}'", bare_expression(expression)));
    });
}

double Scripts::number(const std::string& expression, const Place& place) {
    const Value result = value(expression, place);
    if (const auto* real = std::get_if<double>(&result)) return *real;
    if (const auto* whole = std::get_if<std::int64_t>(&result)) return static_cast<double>(*whole);
    if (const auto* truth = std::get_if<bool>(&result)) return *truth ? 1 : 0;
    throw Diagnostic(fmt::format("'{}' is the {} {}, where a number is needed", bare_expression(expression),
                                 type_name(result), to_text(result, &impl_->machine->world)),
                     {}, Fault::run)
        .at(place);
}

void Scripts::call(const std::string& expression, const Place& place) {
    lua_State* L = impl_->machine->lua;
    const StackLevel level(L);
    placed(place, [&] {
        push_expression(*impl_->machine, expression, place);
        call_protected(L, 0, 0);
    });
}

void Scripts::set(const std::string& name, const Value& value, const Place& place) {
    lua_State* L = impl_->machine->lua;
    const StackLevel level(L);
    placed(place, [&] {
        push_fish_value(L, value);
        set_fish_name(*impl_->machine, bare_expression(name), -1);
    });
}

void Scripts::create_automatically(bool on) { impl_->machine->fish.automatic_create = on; }

void Scripts::define_structure(const std::string& name, const std::vector<std::string>& members, const Place& place) {
    lua_State* L = impl_->machine->lua;
    const StackLevel level(L);
    placed(place, [&] {
        luaL_checkstack(L, static_cast<int>(members.size()) + 4, "for a structure");
        push_runtime(L, "define_structure");
        lua_pushstring(L, lower_case(name).c_str());
        for (const auto& member : members) lua_pushstring(L, member.c_str());
        call_protected(L, static_cast<int>(members.size()) + 1, 0);
    });
}

void Scripts::seed(std::uint64_t seed) { impl_->machine->random.seed(seed); }

bool Scripts::knows(const std::string& name) const { return knows_fish_name(*impl_->machine, bare_expression(name)); }

std::vector<std::string> Scripts::symbols() const { return fish_symbols(*impl_->machine); }

std::vector<std::pair<std::string, bool>> Scripts::built_in_names() const {
    std::vector<std::pair<std::string, bool>> names;
    for (const auto& [name, built_in] : impl_->machine->fish.built_ins) names.emplace_back(name, built_in.writable);
    return names;
}

std::vector<std::string> Scripts::lua_names() const { return global_names(impl_->machine->lua); }

std::vector<std::pair<std::string, std::string>> Scripts::newer_names() const {
    return modern_names(impl_->machine->world);
}

fish::Meaning Scripts::meaning_of(const std::string& name) const { return dictionary_of(*impl_->machine)(name); }

void Scripts::add_fish_hook(const std::string& function, Moment moment, std::int64_t interval, const Place& place) {
    FishLibrary& fish = impl_->machine->fish;
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
    fish.hooks.push_back({name, static_cast<std::uint8_t>(moment), interval, false});
}

void Scripts::remove_fish_hook(const std::string& function, std::optional<Moment> moment, const Place& place) {
    const std::string name = lower_case(function);
    const auto removed = std::erase_if(impl_->machine->fish.hooks, [&](const StoredHook& hook) {
        const bool meant = !moment || static_cast<Moment>(hook.moment) == *moment;
        return hook.function == name && meant && !hook.whilestepping;
    });
    if (removed == 0) throw Diagnostic(fmt::format("no callback runs '{}'", function), {}, Fault::run).at(place);
}

bool Scripts::has_hooks(Moment moment) const {
    const Machine& machine = *impl_->machine;
    for (const auto& hook : machine.fish.hooks)
        if (static_cast<Moment>(hook.moment) == moment) return true;
    for (const auto& hook : machine.hooks)
        if (hook.moment == moment) return true;
    return false;
}

void Scripts::run_hooks(Moment moment, std::int64_t cycle) {
    Machine& machine = *impl_->machine;
    lua_State* L = machine.lua;
    const StackLevel level(L);
    const Awaited awaited(machine);
    const auto of_fish = machine.fish.hooks; // a function may define or replace another one
    for (const auto& hook : of_fish) {
        if (static_cast<Moment>(hook.moment) != moment || cycle % hook.interval != 0) continue;
        push_anchor(L, machine.anchors.functions);
        lua_getfield(L, -1, hook.function.c_str());
        call_protected(L, 0, 0);
        lua_pop(L, 1);
    }
    const std::vector<Hook> hooks = machine.hooks;
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
    const Machine* machine = impl_->machine.get();
    // The hook is set when the stop was requested while the script ran.
    return machine && machine->depth > 0 && !machine->stopping && lua_gethook(machine->lua) != nullptr;
}

Tables& Scripts::tables() { return impl_->machine->tables; }

ScriptState Scripts::state() {
    const StackLevel level(impl_->machine->lua);
    return stored_state(*impl_->machine);
}

void Scripts::restore(const ScriptState& state) {
    clear();
    const StackLevel level(impl_->machine->lua);
    restore_state(*impl_->machine, state);
}

void Scripts::clear() {
    if (running()) throw std::logic_error("a running script cannot be removed");
    Machine& old = *impl_->machine;
    const auto sink = old.sink;
    const auto deck_folders = old.deck_folders;
    impl_->renew(old.world, old.options);
    impl_->machine->sink = sink;
    impl_->machine->deck_folders = deck_folders;
}

bool Scripts::running() const { return impl_->machine->depth > 0; }

void Scripts::refuse_while_awaited(const char* what) const {
    if (impl_->machine->awaited > 0)
        throw Diagnostic(
            fmt::format("'{}' cannot be given here: a command or a cycle waits for the value of the function", what),
            "call the function on a separate line, as @name, or from a Lua chunk", Fault::run);
}

void Scripts::change_model(const ScriptState* state) {
    const StackLevel level(impl_->machine->lua);
    script::change_model(*impl_->machine, state);
}

} // namespace kaya::script
