// Keeps the model of a run that is cut off.
#pragma once

#include "commands/session/last_good.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace kaya {

class Session;

/// Saves the model at intervals of cycling time, and when a run is stopped or a command fails, into DECK-autosave.kaya.h5 in the current
/// folder: a crash of the machine costs at most one interval, an error after a long run nothing. The file is removed when the run ends
/// normally. Saving does not change the model.
class Autosave {
public:
    explicit Autosave(Session& session) : session_(session) {}

    /// Seconds between two files; nullopt: never.
    void set_interval(std::optional<double> seconds) { interval_ = seconds; }

    /// Reports a file left by an earlier run of the deck.
    void find_earlier();
    /// Call before the first cycle of a command, when the model is prepared.
    void begins();
    /// To be called after cycles, several times a second.
    void advanced();
    /// The model has been saved or discarded.
    void saved();
    /// Suspends saving while the model is in a temporary state, for example with raised joint strength.
    void hold(bool on) { held_ += on ? 1 : -1; }
    /// A cycle has failed midway: the model is unusable, and the state before the cycle is kept instead.
    void step_failed(std::int64_t cycle, const std::string& why) {
        failed_cycle_ = cycle;
        why_ = why;
    }
    /// Commands are typed: no deck can rebuild the model, so it is kept however short the run.
    void set_typed() { typed_ = true; }
    /// Call before each typed command.
    void before_typed();
    /// The run is cut off here: saves the model if it took long or was typed, and prints where.
    void keep();
    /// The program ends inside a typed command: saves the last copy. Runs in another thread than the command, which is stopped.
    void keep_copy();
    /// The run has ended normally.
    void done();

private:
    using Clock = std::chrono::steady_clock;

    std::string file_name();
    /// Seconds of cycles that are in no file.
    double unsaved() const;
    /// Whether more than a minute would be lost, or typed commands.
    bool is_long() const;
    /// Whether typed commands have changed the model since it was saved.
    bool is_new() const;
    bool write();
    void write_before_failure();
    bool into_file(const std::function<void(const std::string&)>& save, std::int64_t cycle);
    void offer_copy();

    Session& session_;
    std::optional<double> interval_ = 15 * 60;
    std::optional<Clock::time_point> since_; ///< of the first cycle that is in no file
    std::string written_;                    ///< the file of this run
    std::int64_t cycle_ = 0;                 ///< that it holds
    LastGood last_good_;
    std::int64_t failed_cycle_ = 0; ///< 0: none has failed
    std::string why_;               ///< it failed
    int held_ = 0;
    bool complained_ = false, typed_ = false, kept_ = false;
    std::uint64_t saved_hash_ = 0; ///< of the model that was saved last, when commands are typed
};

} // namespace kaya
