#include "app/process_host.hpp"

#include "base/parallel.hpp"
#include "system/process_state.hpp"
#include "system/run_copies.hpp"
#include "system/run_record.hpp"

namespace kaya {

std::unique_ptr<ThreadTeam> ProcessHost::threads(int count) {
    set_threads(count);
    return nullptr;
}

std::unique_ptr<Host::Command> ProcessHost::at_command(const std::string& text) {
    struct Recorded : Command {
        explicit Recorded(const std::string& words) : at(words) {}
        AtCommand at;
    };
    return std::make_unique<Recorded>(text);
}

void ProcessHost::session_begins() { forget_process_state(); }

void ProcessHost::law_loads() { take_process_state(); }

void ProcessHost::refuse_copies() { kaya::refuse_copies(); }

std::vector<std::string> ProcessHost::restored(std::string& who) { return put_process_state_back(who); }

} // namespace kaya
