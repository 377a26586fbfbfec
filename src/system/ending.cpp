#include "system/ending.hpp"

#include "base/diagnostic.hpp"
#include "system/crash_report.hpp"
#include "system/sentence.hpp"

#include <csignal>
#include <cstring>
#include <sys/wait.h>

namespace kaya {

namespace {

/// Signals by which a user ends a program; they need no message.
bool is_request(int signal) {
    return signal == SIGINT || signal == SIGTERM || signal == SIGHUP || signal == SIGQUIT || signal == SIGPIPE;
}

void add_how(Sentence& sentence, const Ending& end, const RunRecord& record) {
    if (record.reason[0] != '\0') sentence << record.reason;
    else if (end.signal != 0)
        sentence << "the run was ended by signal " << long{end.signal} << " (" << ::strsignal(end.signal) << ")";
    else if (record.status == RunRecord::no_status)
        sentence << "the program was ended with status " << long{end.status} << " before the run came to its end";
    else if (end.status != record.status)
        sentence << "the program was ended with status " << long{end.status} << " after the run, while it cleared up";
    else if (const Called* who = record.copied_by)
        sentence << who->noun << " '" << who->name << "' made a second process of the run in "
                 << record.copied_in.load();
}

void add_where(Sentence& sentence, const RunRecord& record) {
    if (record.command[0] != '\0') sentence << "\n  the last command: " << record.command;
    Sentence models;
    if (add_models_at_work(models)) sentence << "\n  at work: " << models.text();
    else if (const Called* last = record.called_last)
        sentence << "\n  called last: " << last->noun << " '" << last->name << "' (" << record.last_work.load()
                 << " of " << last->file << ")";
}

} // namespace

void tell_stop(int signal) {
    Sentence models;
    if (signal != SIGSTOP || !add_models_at_work(models)) return;
    Sentence sentence;
    sentence << "\nthe run is stopped by signal " << long{signal} << " (" << ::strsignal(signal)
             << "); SIGCONT continues it\n  at work: " << models.text() << "\n";
    sentence.write();
}

Ending tell_ending(int wait_status) {
    const RunRecord& record = run_record();
    Ending end;
    if (WIFSIGNALED(wait_status)) end.signal = WTERMSIG(wait_status);
    else end.status = WEXITSTATUS(wait_status);
    const bool is_own_end = end.signal == 0 && end.status == record.status;
    const bool was_copied = record.copied_by != nullptr || record.reason[0] != '\0';
    if (is_own_end && (end.status != 0 || !was_copied)) return end;
    const Ending seen = end;
    if (end.signal == 0 && (end.status == 0 || !record.is_told)) end.status = static_cast<int>(Fault::run);
    Sentence models;
    if (record.is_told || (is_request(end.signal) && !add_models_at_work(models))) return end;
    Sentence sentence;
    sentence << "\nerror: ";
    add_how(sentence, seen, record);
    add_where(sentence, record);
    if (end.signal == SIGKILL) sentence << "\n  the system ends programs by it where memory runs out; so does kill -9";
    sentence << "\n  files that were saved before are whole\n";
    sentence.write();
    return end;
}

} // namespace kaya
