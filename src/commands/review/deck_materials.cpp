#include "commands/review/deck_materials.hpp"

#include "base/diagnostic.hpp"
#include "lang/commands/commands.hpp"

#include <algorithm>
#include <any>
#include <array>
#include <fmt/format.h>

namespace kaya {

void DeckMaterials::check(const lang::BoundCommand& command) {
    if (command.command.type() == typeid(lang::Restore)) open_ = true;
    if (const auto* property = std::any_cast<lang::Property>(&command.command)) {
        if (!command.late) given_.push_back({property->number, property->joint, command.place});
        return;
    }
    if (command.spec->raw || !command.spec->body_end.empty()) return;
    lang::Lexer lexer(command.place.source, command.place.line);
    lang::Statement statement;
    if (!lexer.next(statement)) return;
    if (statement.words.front().folded.starts_with("impo")) open_ = true; // the file may give any
    // Any word with this beginning followed by a number sets or selects a material: change mat 2, poly brick ... mat 2, set jmatdf 2.
    for (std::size_t i = 0; i + 1 < statement.words.size(); ++i) {
        const std::string& word = statement.words[i].folded;
        if (word.empty()) continue;
        const bool joint = word.starts_with("jmat") || (word.size() > 1 && std::string_view("jmat").starts_with(word));
        if (!joint && !word.starts_with("mat") && !std::string_view("mat").starts_with(word)) continue;
        for (std::size_t k = i + 1; k < statement.words.size(); ++k) {
            const lang::Word& number = statement.words[k];
            if (number.late()) open_ = true;
            if (number.kind != lang::WordKind::number) break;
            (joint ? joints_ : blocks_).insert(number.integer);
        }
    }
}

void DeckMaterials::check_script(std::string_view text) {
    constexpr std::array<std::string_view, 6> giving{"material", "_mat", ".mat", "command", "capture", "call"};
    const std::string folded = lang::fold(text);
    open_ = open_ || std::ranges::any_of(giving, [&](auto word) { return folded.find(word) != folded.npos; });
}

std::vector<Diagnostic> DeckMaterials::findings() const {
    std::vector<Diagnostic> found;
    if (open_) return found;
    std::set<std::pair<bool, std::int64_t>> said;
    for (const auto& [number, joint, place] : given_) {
        if (joints_.contains(number) || (!joint && blocks_.contains(number)) || !said.insert({joint, number}).second)
            continue;
        Diagnostic d(fmt::format("nothing in this deck has {} {}", joint ? "joint material" : "material", number),
                     fmt::format("its properties have no effect: `change {} {} range ...` gives it",
                                 joint ? "jmat" : "mat", number));
        d.severity = Severity::warning;
        d.code = "implausible";
        found.push_back(d.at(place));
    }
    return found;
}

} // namespace kaya
