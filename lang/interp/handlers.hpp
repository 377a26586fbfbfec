// Which function runs which command. Filled once, in src/commands; an explicit list.
#pragma once

#include <any>
#include <functional>
#include <stdexcept>
#include <typeindex>
#include <unordered_map>

namespace kaya::lang {

class Handlers {
public:
    template <class Command> void on(std::function<void(const Command&)> run) {
        run_[typeid(Command)] = [run = std::move(run)](const std::any& command) {
            run(std::any_cast<const Command&>(command));
        };
    }

    bool has(std::type_index type) const { return run_.contains(type); }

    void run(const std::any& command) const {
        const auto found = run_.find(command.type());
        if (found == run_.end()) throw std::logic_error("a command has no handler");
        found->second(command);
    }

private:
    std::unordered_map<std::type_index, std::function<void(const std::any&)>> run_;
};

} // namespace kaya::lang
