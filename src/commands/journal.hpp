// What a run has done, as a text that runs again: `kaya replay run.journal`.
#pragma once

#include "base/descriptor.hpp"
#include "commands/session.hpp"

#include <string>

namespace kaya {

/// Writes each command when it has done its work, or failed, or was stopped: its lines as they stand in the deck or
/// the called file, with the place they come from. Commands that a script gives are left out: the script gives them
/// again.
class Journal : public Listener {
public:
    /// Listens to the session. A journal that cannot be written is a note, not an error.
    Journal(Session& session, const std::string& file);
    ~Journal() override;
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Which deck comes next; files that it reads are looked for next to it.
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

/// Runs what a journal says, in a new session. Says whether the final state is the same; warns about joint
/// models and files that are not those of the journal. Gives the exit status. Throws Diagnostic.
int replay_journal(Session& session, const std::string& file);

} // namespace kaya
