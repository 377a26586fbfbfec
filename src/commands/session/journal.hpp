// Record of a run as a text that can be run again: `kaya replay run.journal`.
#pragma once

#include "commands/session/session.hpp"
#include "system/descriptor.hpp"

#include <string>

namespace kaya {

/// Writes each command when it is done, failed or was stopped: its lines as in the deck or the called file, with their place. Commands
/// given by a script are omitted: the script gives them again.
class Journal : public Listener {
public:
    /// Listens to the session. A journal that cannot be written is a note, not an error.
    Journal(Session& session, const std::string& file);
    ~Journal() override;
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Sets the next deck; files that it reads are searched in its folder.
    void deck(const std::string& name);
    /// The end: joint models and files that were used with digests of their contents, and the final state.
    void finish();

private:
    void executed(const lang::BoundCommand& command, const Completion& completion) override;
    void write(const std::string& text);

    Session& session_;
    std::string file_;
    Descriptor opened_;
    bool failed_ = false;
};

/// Runs a journal in a new session. Reports whether the final state is the same; warns about joint models and files that differ from those
/// of the journal. Returns the exit status. Throws Diagnostic.
int replay_journal(Session& session, const std::string& file);

} // namespace kaya
