// def ... end, @function, lua.
#include "commands/session/handlers.hpp"

#include "lang/script/values/value_text.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace kaya {

void run(Session& session, const lang::FishDefinition& command) {
    session.engine.scripts->define_fish(command.text, command.place);
}

void run(Session& session, const lang::Parameter& command) {
    if (command.name.find(' ') != std::string::npos) {
        const auto* whole = std::get_if<std::int64_t>(&command.value);
        const auto* number = std::get_if<double>(&command.value);
        if (whole == nullptr && number == nullptr)
            throw Diagnostic(fmt::format("'{}' takes a number", command.name)).at(command.place);
        session.deck.given_properties.give(command.name, whole != nullptr ? static_cast<double>(*whole) : *number,
                                           command.place);
        return;
    }
    const auto value = std::visit([](const auto& v) { return script::Value(v); }, command.value);
    const auto [known, is_new] = session.deck.parameters.try_emplace(lang::fold(command.name), value);
    if (!is_new && known->second != value)
        session.program.output.say(fmt::format("{} = {}, as given before; {} is not used", command.name,
                                               script::to_text(known->second, &session.engine.world),
                                               script::to_text(value, &session.engine.world)));
    session.engine.scripts->set(command.name, known->second, command.place);
}

void run(Session& session, const lang::FishCall& command) {
    session.engine.scripts->call(command.expression, command.place);
    for (const auto& [expression, place] : command.further) session.engine.scripts->call(expression, place);
}

void run(Session& session, const lang::FishCallback& command) {
    using When = lang::FishCallback::When;
    using script::Moment;
    static constexpr std::array moments{
        std::pair{When::before_cycle, Moment::before_cycle}, std::pair{When::after_forces, Moment::after_forces},
        std::pair{When::after_cycle, Moment::after_cycle}, std::pair{When::solve_start, Moment::solve_start},
        std::pair{When::solve_complete, Moment::solve_complete}};
    const auto moment_of = [](When when) {
        return std::ranges::find(moments, when, &std::pair<When, Moment>::first)->second;
    };
    const auto moment = command.when ? std::optional(moment_of(*command.when)) : std::nullopt;
    auto& scripts = *session.engine.scripts;
    if (command.remove) scripts.remove_fish_hook(command.function, moment, command.location, command.place);
    else
        scripts.add_fish_hook(command.function, moment.value(), command.location.value_or(0), command.interval,
                              command.place);
}

void run(Session& session, const lang::FishSetting& command) {
    if (command.automatic_create) session.engine.scripts->create_automatically(*command.automatic_create);
    if (!command.structure.empty())
        session.engine.scripts->define_structure(command.structure, command.members, command.place);
}

void run(Session& session, const lang::HistoryAdd& command); // histories.cpp

void run(Session& session, const lang::LuaChunk& command) {
    session.engine.scripts->run_lua(command.text, command.place);
}

void run(Session& session, const lang::LuaFile& command) {
    session.engine.scripts->run_lua_file(session.input_file(command.file), command.place);
}

void add_handlers(HandlerTable& table, lang::ScriptCommands list) { fill(table, list); }

} // namespace kaya
