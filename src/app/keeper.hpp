// Saves the model of a prompt when the program ends inside a command.
#pragma once

#include "commands/session/session.hpp"

#include <atomic>
#include <semaphore.h>
#include <thread>

namespace kaya {

/// While it exists, a crash of a joint model, its exit() and a second Ctrl-C save the model before the command, or after one of its cycles: no deck
/// can rebuild it. A separate thread writes the file, because the thread of the command cannot continue.
class Keeper {
public:
    explicit Keeper(Session& session);
    ~Keeper();
    Keeper(const Keeper&) = delete;
    Keeper& operator=(const Keeper&) = delete;

private:
    void write();
    static void act();

    Session& session_;
    sem_t wanted_{};
    std::atomic<bool> ends_ = false, written_ = false;
    std::thread thread_;
};

} // namespace kaya
