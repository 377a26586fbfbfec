#include "commands/world/engine.hpp"

#include "commands/world/joint_values.hpp"
#include "commands/world/lua_joint_models.hpp"
#include "system/memory.hpp"

#include <charconv>
#include <fmt/format.h>

namespace kaya {

namespace {

/// The points of a table for joint models; its name is a number.
std::optional<JointTables::Points> table_points(script::Scripts& scripts, const std::string& name) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
    const auto& tables = scripts.tables();
    const auto found = tables.find(number);
    if (found == tables.end()) return std::nullopt;
    found->second.require_sorted(fmt::format("table {}", number));
    JointTables::Points points;
    for (const auto& point : found->second.points()) {
        points.x.push_back(point.x);
        points.y.push_back(point.y);
    }
    return points;
}

/// Memory limit of scripts in bytes: a text that is doubled too often ends with a message instead of exhausting the machine.
std::size_t memory_for_scripts(std::size_t megabytes) {
    if (megabytes > 0) return megabytes << 20;
    return memory_of_machine() / 2;
}

} // namespace

Engine::~Engine() { scripts.reset(); }

void Engine::begin(const std::shared_ptr<Gate>& gate, const std::vector<std::filesystem::path>& joint_folders,
                   bool trust, std::size_t script_memory, const std::shared_ptr<Host>& host) {
    host->session_begins();
    joints.set_path(joint_folders);
    add_lua_loader(joints);
    joints.before_loading = joints.zones.before_loading = [gate, host](const std::filesystem::path& file) {
        host->law_loads();
        return gate->may_load(file);
    };
    joints.tables().set_source([this](const std::string& name) { return table_points(*scripts, name); });

    script::Options script_options;
    script_options.trusted = trust;
    script_options.gate = gate;
    script_options.memory = memory_for_scripts(script_memory);
    scripts = std::make_unique<script::Scripts>(world, script_options);
    make_cycle();
}

void Engine::run_hooks(script::Moment moment) {
    if (scripts->has_hooks(moment)) {
        world.forget_ranges(); // shapes and places are others than in the cycle before
        scripts->run_hooks(moment, model.clock.cycle);
    }
    for (std::size_t k = 0; k < callbacks.size(); ++k) // one may add others
        if (callbacks[k].moment == moment && model.clock.cycle % callbacks[k].interval == 0) {
            const auto call = callbacks[k].call; // or remove itself
            call();
        }
}

void Engine::make_cycle() {
    cycle = std::make_unique<Cycle>(model, joints);
    const auto hook = [this](script::Moment moment) { return [this, moment] { run_hooks(moment); }; };
    cycle->hooks.before_cycle.push_back(hook(script::Moment::before_cycle));
    cycle->hooks.after_forces.push_back(hook(script::Moment::after_forces));
    cycle->hooks.after_cycle.push_back(hook(script::Moment::after_cycle));
    cycle->hooks.table_value = [this](std::int64_t number, double x) {
        const auto& tables = scripts->tables();
        const auto found = tables.find(number);
        if (found == tables.end()) throw Diagnostic(fmt::format("there is no table {}", number), {}, Fault::run);
        found->second.require_sorted(fmt::format("table {}", number));
        return found->second.at(x);
    };
    cycle->hooks.script_value = [this](const std::string& expression) {
        const auto own = recorded_own_value(*this, expression);
        return own ? *own : scripts->number(expression);
    };
}

} // namespace kaya
