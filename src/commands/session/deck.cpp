#include "commands/session/deck.hpp"

#include "commands/review/property_meaning.hpp"
#include "lang/commands/commands.hpp"
#include "lang/modern/language.hpp"
#include "lang/fish/compiler.hpp"
#include "lang/script/scripts/scripts.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace kaya {

namespace fs = std::filesystem;

Deck::Deck(lang::InterpreterHost& host) : interpreter(lang::language(), host) { interpreter.checks = deck_checks(); }

std::string Deck::here() const {
    const Place place = interpreter.current_place();
    return place ? fmt::format("{}:{}", place.source->name, place.line) : std::string{};
}

fs::path Deck::next_to_deck(const std::string& name) const {
    const fs::path adjacent = fs::path(file).parent_path() / name;
    std::error_code ignored;
    return fs::exists(adjacent, ignored) ? adjacent : fs::path(name);
}

void Deck::take_source(const Place& place) {
    const auto& source = place.source;
    // Text given by a script belongs to a deck that has been read already; there may be very many of them.
    if (source->is_file && (sources.empty() || sources.back() != source))
        if (std::ranges::find(sources, source) == sources.end()) sources.push_back(source);
}

lang::Checks deck_checks() {
    // A function that does not compile is reported before the first command runs, not hours later. Its names are resolved when it is
    // defined; unsupported names are refused in any case.
    lang::Checks checks;
    checks.command = [](const std::any& command) {
        if (const auto* function = std::any_cast<lang::FishDefinition>(&command))
            fish::generate(fish::read_function(function->text, function->place),
                           [](std::string_view) { return fish::Meaning{}; });
        else if (const auto* chunk = std::any_cast<lang::LuaChunk>(&command))
            script::check_lua_text(chunk->text, chunk->place);
        else if (const auto* set = std::any_cast<lang::Set>(&command); set != nullptr && set->units) Units(*set->units);
        else if (const auto* change = std::any_cast<lang::Change>(&command)) refuse_unknown_number(*change);
    };
    return checks;
}

} // namespace kaya
