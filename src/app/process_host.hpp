// The host of the command line: the process is that of one run.
#pragma once

#include "commands/program/host.hpp"

namespace kaya {

class ProcessHost : public Host {
public:
    std::unique_ptr<ThreadTeam> threads(int count) override;
    bool stops_by_session() const override { return false; }
    std::unique_ptr<Command> at_command(const std::string& text) override;
    void session_begins() override;
    void law_loads() override;
    void refuse_copies() override;
    std::vector<std::string> restored(std::string& who) override;
};

} // namespace kaya
