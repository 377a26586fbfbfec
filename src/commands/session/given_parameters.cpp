#include "commands/session/given_parameters.hpp"

#include <fmt/format.h>

namespace kaya {

void warn_of_unused_parameters(Session& session, const std::vector<std::string>& names, const DeckWords* words) {
    constexpr const char* unused = "the value that was given for it was not used";
    for (const auto& name : session.deck.given_properties.unused())
        session.warn(Diagnostic(fmt::format("no command set '{}'", name), unused));
    if (words == nullptr) return;
    for (const auto& name : names) {
        const auto value = session.deck.parameters.find(lang::fold(name));
        if (value == session.deck.parameters.end() || words->declared().contains(lang::fold(name))) continue;
        if (session.engine.scripts->value(name) != value->second)
            session.warn(Diagnostic(fmt::format("the deck sets '{}' itself: {}", name, unused),
                                    fmt::format("write there param {} = VALUE", name)));
    }
}

} // namespace kaya
