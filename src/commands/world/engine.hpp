// The engine of a session: the model, its cycle, the laws of joints and zones, and the scripts that act on them.
#pragma once

#include "commands/program/host.hpp"
#include "commands/world/model_world.hpp"
#include "commands/world/occupied.hpp"
#include "laws/joint_model.hpp"
#include "mechanics/cycle/cycle.hpp"
#include "model/tables/model.hpp"
#include "system/gate.hpp"

#include "lang/script/scripts/scripts.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace kaya {

class Engine {
public:
    explicit Engine(WorldHost& host) : world(model, joints, host) {}
    ~Engine();

    /// Call before anything runs. The gate is queried before a library is loaded; `script_memory` in megabytes, 0: no separate limit.
    void begin(const std::shared_ptr<Gate>& gate, const std::vector<std::filesystem::path>& joint_folders, bool trust,
               std::size_t script_memory, const std::shared_ptr<Host>& host);

    /// Runs the hooks of scripts for that moment, then the callbacks.
    void run_hooks(script::Moment moment);

    /// Creates the cycle of the present model; call it again when the model was replaced.
    void make_cycle();

    /// A function of the program around the run, called inside cycles as hooks of scripts are.
    struct Callback {
        int number;
        script::Moment moment;
        std::int64_t interval; ///< of cycles
        std::function<void()> call;
    };
    std::vector<Callback> callbacks; ///< in the order of their calls

    Model model;
    JointRegistry joints;
    ModelWorld world;
    std::unique_ptr<script::Scripts> scripts;
    std::unique_ptr<Cycle> cycle;
    bool inside_cycle = false;                                     ///< a hook is running: structure must not change
    std::vector<std::pair<Place, std::function<void()>>> deferred; ///< changes that wait for the end of the cycle
    Occupied occupied; ///< positions of blocks, for the warning about two in one place
};

} // namespace kaya
