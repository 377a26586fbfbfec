// The script side of a model: one Lua state in which FISH and Lua functions live together.
#pragma once

#include "base/diagnostic.hpp"
#include "lang/fish/compiler.hpp"
#include "lang/script/base/options.hpp"
#include "lang/script/values/state.hpp"
#include "lang/script/values/tables.hpp"
#include "lang/script/values/world.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace kaya::script {

/// Throws Diagnostic at the first mistake in the text of a Lua chunk, without running it; `place` is where it begins.
void check_lua_text(const std::string& text, const Place& place);

/// All functions throw Diagnostic: with a place in the deck, and the stack of functions in `context`.
/// The caller adds the cycle.
class Scripts {
public:
    explicit Scripts(World& world, Options options = {});
    ~Scripts();
    Scripts(const Scripts&) = delete;
    Scripts& operator=(const Scripts&) = delete;

    /// Receives the output of `out(...)` and Lua's print; one call per line, without line end. Default: stdout.
    void on_print(std::function<void(const std::string& line)> sink);

    /// Gives the folders of the running deck file and of its callers, for `require`.
    void on_require(std::function<std::vector<std::filesystem::path>()> folders);

    /// Defines `def name ... end`; `place` is where the text begins. A function of that name is replaced.
    void define_fish(const std::string& text, const Place& place);
    /// Runs a Lua chunk (`lua ... endlua`); `place` is where the text begins.
    void run_lua(const std::string& text, const Place& place);
    /// Runs a file; `place` is where the deck names it.
    void run_lua_file(const std::filesystem::path& file, const Place& place);

    /// Value of `name`, `name(a,b)`, or any FISH expression (also an assignment), with or without the
    /// leading `@` or brackets around it. A FISH or Lua function that is named is run.
    Value value(const std::string& expression, const Place& place = {});
    /// The same as a number, for histories and commands; nothing, texts, vectors and pointers are refused. The translated expression is kept, for
    /// calls in every cycle.
    double number(const std::string& expression, const Place& place = {});
    /// A line that starts with `@`: runs the function. An unknown name is an error.
    void call(const std::string& expression, const Place& place = {});
    /// `set @name = value`
    void set(const std::string& name, const Value& value, const Place& place = {});
    /// False: variables of FISH must be declared before they are used.
    void create_automatically(bool on);
    /// `struct NAME(a, b)`: names the members of a kind of structure.
    void define_structure(const std::string& name, const std::vector<std::string>& members, const Place& place);
    /// Restarts the random numbers of FISH and Lua.
    void seed(std::uint64_t seed);
    /// True for a function, a variable that was mentioned, or a built-in name.
    bool knows(const std::string& name) const;
    /// False for a FISH function that never sets its name and returns nothing: its value is always 0.
    bool gives_value(const std::string& name) const;
    /// Names of all FISH variables and functions, sorted (for `list fish`, and for "did you mean").
    std::vector<std::string> symbols() const;

    /// Names that FISH knows without a definition, sorted; true for those that can also be set.
    std::vector<std::pair<std::string, bool>> built_in_names() const;

    /// Names that Lua knows in this state, sorted.
    std::vector<std::string> lua_names() const;

    /// Names of newer versions and the classic ones with the same meaning.
    std::vector<std::pair<std::string, std::string>> newer_names() const;
    /// Present meaning of a name of FISH in lower case.
    fish::Meaning meaning_of(const std::string& name) const;

    /// Runs a FISH function without arguments in each cycle whose number is a multiple of `interval`, or at each such event.
    /// Locations order the hooks of one moment.
    void add_fish_hook(const std::string& function, Moment moment, double location, std::int64_t interval,
                       const Place& place);
    /// Removes the hooks of a function, or those of one moment, or of one location; throws Diagnostic when there is none.
    void remove_fish_hook(const std::string& function, std::optional<Moment> moment, std::optional<double> location,
                          const Place& place);

    /// FISH hooks in the order of their locations, then in that of their definition; then those of Lua. `cycle` decides for hooks with an
    /// interval.
    bool has_hooks(Moment moment) const;
    void run_hooks(Moment moment, std::int64_t cycle);

    /// Stops the running script at its next instruction with a Diagnostic. May be called by a signal handler.
    void interrupt() noexcept;

    /// A requested stop is pending, because one call into Lua's own library does not end. For signal handlers.
    bool is_deaf() const noexcept;

    /// Tables by number, shared with the commands.
    Tables& tables();

    ScriptState state();
    /// Replaces everything. The Lua chunks of the state are run again to define their functions and hooks,
    /// with commands, prints and changes of the model switched off; then the saved values are set.
    void restore(const ScriptState& state);
    /// `new`: forgets all variables, functions, hooks and tables.
    void clear();

    /// A script is running that outlives the model which it replaces: restore and clear do not apply to it, change_model does.
    bool running() const;
    /// Throws Diagnostic when the running script cannot replace the model: a command or a cycle waits for its value.
    void refuse_while_awaited(const char* what) const;
    /// The model is replaced and the scripts stay: values that belonged to its objects are dropped, and handles of them become stale. With
    /// a state, the values that belong to its objects are added, and tables of numbers that do not exist. Throws Diagnostic, with nothing
    /// changed, when the state is damaged.
    void change_model(const ScriptState* state = nullptr);

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace kaya::script
