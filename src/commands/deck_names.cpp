#include "commands/deck_names.hpp"

#include "commands/session.hpp"
#include "lang/commands/commands.hpp"
#include "lang/fish/compiler.hpp"

#include <any>

namespace kaya {

void DeckNames::look_at(const lang::BoundCommand& command, bool inside) {
    if (const auto* definition = std::any_cast<lang::FishDefinition>(&command.command)) {
        // Every name that a function mentions is a variable from then on.
        const auto function = fish::read_function(definition->text, definition->place);
        made_.insert(function.name);
        made_.insert(function.mentions.begin(), function.mentions.end());
        return;
    }
    if (const auto* set = std::any_cast<lang::Set>(&command.command))
        for (const auto& [name, value] : set->fish) made_.insert(lang::fold(name));
    for (const auto* type : {&typeid(lang::LuaChunk), &typeid(lang::LuaFile), &typeid(lang::Restore)})
        if (command.command.type() == *type) open_ = true;
    const bool call = std::any_cast<lang::FishCall>(&command.command) != nullptr;
    if (!inside && (call || !command.spec->raw)) use_words(command);
}

void DeckNames::use_words(const lang::BoundCommand& command) {
    lang::Lexer lexer(command.place.source, command.place.line);
    lang::Statement statement;
    if (!lexer.next(statement)) return;
    for (const auto& word : statement.words) {
        if (!word.late() || word.text.empty()) continue;
        try {
            const auto expression = fish::read_expression(word.text, word.place);
            if (!expression.assigned.empty()) made_.insert(expression.assigned);
            for (const auto& name : expression.mentions) used_.emplace_back(name, word.place);
        } catch (const Diagnostic&) {
            // The run says what is wrong with it; which names it means cannot be told.
        }
    }
}

std::vector<DeckNames::Missing> DeckNames::missing() const {
    std::vector<Missing> missing;
    if (open_ || used_.empty()) return missing;
    std::set<std::string> known = made_;
    const Session session{Options{}};
    for (const auto& [name, writable] : session.scripts->built_in_names()) known.insert(name);
    const std::vector<std::string_view> candidates(known.begin(), known.end());
    for (const auto& [name, place] : used_) {
        if (known.contains(name)) continue;
        const bool said = !missing.empty() && missing.back().place.source == place.source &&
                          missing.back().place.line == place.line;
        if (!said) missing.push_back({name, place, std::string(did_you_mean(name, candidates))});
    }
    return missing;
}

} // namespace kaya
