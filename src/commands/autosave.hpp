// What is kept of a run that does not come to its end.
#pragma once

#include "commands/last_good.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace kaya {

class Session;

/// Saves the model every so many minutes of cycles, and when a run is stopped or a command of it fails, into
/// DECK-autosave.kaya.h5 in the current folder: a machine that goes down takes no more than these minutes, an error after a
/// long run nothing. The file goes when the run comes to its end. Saving changes nothing in the model.
class Autosave {
public:
    explicit Autosave(Session& session) : session_(session) {}

    /// Seconds between two files; nullopt: nothing is kept.
    void set_interval(std::optional<double> seconds) { interval_ = seconds; }

    /// Says so when an earlier run of the deck has left a file.
    void find_earlier();
    /// To be called before the first cycle of a command, when the model is ready for it.
    void begins();
    /// To be called after cycles, several times a second.
    void advanced();
    /// The model has been saved or discarded.
    void saved() {
        since_.reset();
        last_good_.drop();
    }
    /// What the model is for a while is not to be kept: joints are stronger than they are, say.
    void hold(bool on) { held_ += on ? 1 : -1; }
    /// A cycle has failed half way: the model is no state to go on from, and that before the cycle is kept instead.
    void step_failed(std::int64_t cycle, const std::string& why) {
        failed_cycle_ = cycle;
        why_ = why;
    }
    /// The run ends here, and not by itself: keeps the model if it took long, and says where.
    void keep();
    /// The run has come to its end.
    void done();

private:
    using Clock = std::chrono::steady_clock;

    std::string file_name();
    /// Seconds of cycles that are in no file.
    double unsaved() const;
    /// Whether more than a minute would be lost.
    bool is_long() const;
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
    bool complained_ = false;
};

} // namespace kaya
