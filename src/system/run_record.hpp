// What the run is doing, in memory shared with the process that waits for the run.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kaya {

/// A law whose functions are called. It lives as long as the program, so that a report can name it at any time.
struct Called {
    const char* name;
    const char* file;
    const char* noun;                               ///< "joint model"
    bool foreign;                                   ///< it does not ship with the program
    mutable std::atomic<bool> is_suspected = false; ///< called since take_suspects(); foreign ones only
    mutable std::atomic<bool> starts_threads = false;
};

/// Written by the run, read by signal handlers and by the process that waits. All that it points to lies in the same memory or in the program.
struct RunRecord {
    static constexpr std::size_t most_threads = 256, longest_text = 512;
    static constexpr int no_status = -1;

    /// The present call of a thread, visible to other threads.
    struct alignas(64) Desk {
        std::atomic<bool> taken = false;
        std::atomic<const Called*> who = nullptr;
        std::atomic<const char*> what = nullptr;
    };
    Desk desks[most_threads];

    /// The call of a foreign law that began last, in any thread.
    std::atomic<const Called*> called_last = nullptr;
    std::atomic<const char*> last_work = nullptr;

    /// The law that has started a second process of the run.
    std::atomic<const Called*> copied_by = nullptr;
    std::atomic<const char*> copied_in = nullptr;

    int process = 0;                     ///< of the run
    std::atomic<int> status = no_status; ///< with which the program ends, set when it ends by itself
    std::atomic<bool> is_told = false;   ///< a message about the end is printed
    char command[longest_text] = "";     ///< "cycle 2000 (wall.3dd:12)"; empty: none
    char reason[longest_text] = "";      ///< why the run ends, where it has no stream left to print it
};

/// That of this process, or of the run that a process waits for.
RunRecord& run_record();

/// Begins a new one, for a forked process with separate work.
void begin_run_record();

/// Adds folders of joint models that ship with the program, besides those next to it: for a library in a separate folder. Zone models lie
/// in `zones` beside `joints`.
void add_own_folders(const std::vector<std::filesystem::path>& joints);

/// The same one for the same three texts. Not for signal handlers.
const Called* called(std::string_view name, std::string_view file, const char* noun);

/// Around fork(): another thread may be in called(), whose lock a second process would find taken for ever.
void hold_names();
void release_names();

/// The foreign laws that were called since this was last asked: "joint model 'wear' (/lib/wear.so)"; empty: none.
std::string take_suspects();

/// Notes that this process is about to end by itself. Processes other than that of the run are ignored.
void note_end(int status);

/// Why the run ends, for the process that waits: this one cannot print it.
void note_reason(std::string_view reason);

/// While it lives, the program carries out a command. A command inside of another one is reported in its place. For the main thread only.
class AtCommand {
public:
    /// The text is copied as far as there is room, without control characters.
    explicit AtCommand(std::string_view text);
    ~AtCommand();
    AtCommand(const AtCommand&) = delete;
    AtCommand& operator=(const AtCommand&) = delete;

private:
    char before_[RunRecord::longest_text];
};

} // namespace kaya
