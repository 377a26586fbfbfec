// What is kept of a run that does not come to its end.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace kaya {

class Session;

/// Saves the model every so many minutes of cycles, and when a run is stopped or a command of it fails, into
/// DECK-autosave.kaya.h5 in the current folder: a machine that goes down takes no more than these minutes, an error behind a
/// long run nothing. The file goes when the run comes to its end. Saving changes nothing in the model.
class Rescue {
public:
    explicit Rescue(Session& session) : session_(session) {}

    /// Seconds between two files; nullopt: nothing is kept.
    void set_interval(std::optional<double> seconds) { interval_ = seconds; }

    /// Says so when an earlier run of the deck has left a file.
    void look_for_earlier();
    /// To be called behind cycles, several times a second.
    void advanced();
    /// The model is in a file, or nobody wants it any more.
    void saved() { since_.reset(); }
    /// What the model is for a while is not to be kept: joints are stronger than they are, say.
    void hold(bool on) { held_ += on ? 1 : -1; }
    /// A cycle has failed half way: the model is no state to go on from.
    void step_failed() { half_way_ = true; }
    /// The run ends here, and not by itself: keeps the model if it took long, and says where.
    void keep();
    /// The run has come to its end.
    void done();

private:
    using Clock = std::chrono::steady_clock;

    std::string file_name();
    bool write();

    Session& session_;
    std::optional<double> interval_ = 15 * 60;
    std::optional<Clock::time_point> since_; ///< of the first cycle that is in no file
    std::string written_;                    ///< the file of this run
    std::int64_t cycle_ = 0;                 ///< that it holds
    int held_ = 0;
    bool half_way_ = false, complained_ = false;
};

} // namespace kaya
