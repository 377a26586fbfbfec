// The program whose process a session works in. A session changes nothing of the process by itself: it tells its host.
#pragma once

#include "base/thread_team.hpp"

#include <memory>
#include <string>
#include <vector>

namespace kaya {

/// This one is a guest in a process that belongs to another program, as in libkaya and in Python: it keeps the process as it is, and several
/// sessions work in it at once. The command line has a host that owns its process (app/process_host.hpp).
class Host {
public:
    virtual ~Host() = default;

    /// Threads for the loops of a session that begins. Null: it uses those of the process, and there are that many now.
    virtual std::unique_ptr<ThreadTeam> threads(int count) { return std::make_unique<ThreadTeam>(count); }

    /// Whether long work stops through the listener of the session. No: the host has its own.
    virtual bool stops_by_session() const { return true; }

    /// While the object lives, a session carries out the command: for a report when the process ends in it.
    struct Command {
        virtual ~Command() = default;
    };
    virtual std::unique_ptr<Command> at_command(const std::string&) { return nullptr; }

    /// A session begins, maybe in another folder than the one before.
    virtual void session_begins() {}
    /// A law is about to be loaded.
    virtual void law_loads() {}
    /// Laws were called. Throws Diagnostic when one has made a second process of the run.
    virtual void refuse_copies() {}
    /// Laws were called: parts of the process that they changed and that were restored, in words; `who` receives the laws.
    virtual std::vector<std::string> restored(std::string& who) {
        who.clear();
        return {};
    }
};

} // namespace kaya
