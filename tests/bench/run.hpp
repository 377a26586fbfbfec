// A deck's model, ready for timing.
#pragma once

#include "base/parallel.hpp"
#include "commands/session/session.hpp"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>
#include <memory>
#include <string>

namespace bench {

inline double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of this process, all its threads, to reduce the effect of other load on the machine.
inline double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// A silent session with the model of a deck of this folder.
class Run {
public:
    explicit Run(const std::string& deck, int threads = 1) : silence_(std::fopen("/dev/null", "w"), &std::fclose) {
        kaya::Options options;
        options.threads = threads;
        kaya::set_threads(threads); // of the cycles that run without a command
        options.quiet = true;
        options.joint_folders = options.own_joints = {KAYA_JOINT_FOLDER, KAYA_ZONE_PLUGINS};
        session_ = std::make_unique<kaya::Session>(options, silence_.get(), stderr);
        session_->run_deck(deck.front() == '/' ? deck : KAYA_BENCH_FOLDER "/" + deck);
    }
    /// As by `cycle`.
    void cycles(std::int64_t count) {
        const kaya::Cycle::Unwatched unwatched(*session_->engine.cycle);
        for (std::int64_t i = 0; i < count; ++i) session_->engine.cycle->advance();
    }
    /// Cycles with a contact search and new geometry of every contact in each cycle.
    void rebuilding_cycles(std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) {
            for (auto& way : session_->engine.model.blocks.travelled) way = std::numeric_limits<double>::infinity();
            session_->engine.cycle->advance();
        }
    }
    kaya::Model& model() { return session_->engine.model; }
    const kaya::Model& model() const { return session_->engine.model; }
    const std::vector<kaya::PhaseTime>& timing() const { return session_->engine.cycle->timing(); }

private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> silence_;
    std::unique_ptr<kaya::Session> session_;
};

} // namespace bench
