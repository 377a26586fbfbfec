#include "app/editor_answers.hpp"

#include "guide/completion.hpp"
#include "guide/help_text.hpp"
#include "lang/interp/binder.hpp"
#include "lang/interp/help.hpp"
#include "lang/interp/command_words.hpp"
#include "lang/commands/language.hpp"
#include "lang/modern/convert.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace kaya {

using Json = nlohmann::json;

namespace {

Json at_start() {
    const Json start{{"line", 0}, {"character", 0}};
    return {{"start", start}, {"end", start}};
}

/// The function of a name, in the deck or in those that share its names.
struct Defined {
    std::string uri;
    const OpenDeck* deck = nullptr;
    const OpenDeck::FishFunction* function = nullptr; ///< null when there is none
};
Defined defined_in(const std::vector<OpenDecks::Member>& family, const std::string& folded) {
    for (const auto& [uri, deck] : family)
        if (const auto* function = deck->function(folded)) return {uri, deck, function};
    return {};
}

/// Of one deck.
struct Uses {
    OpenDecks::Member member;
    std::vector<OpenDeck::Piece> pieces;
};
/// Decks without one are left out.
std::vector<Uses> uses_in(const std::vector<OpenDecks::Member>& family, const std::string& folded) {
    const bool is_function = defined_in(family, folded).function != nullptr;
    std::vector<Uses> uses;
    for (const auto& member : family)
        if (auto pieces = member.deck->uses_of(folded, is_function); !pieces.empty())
            uses.push_back({member, std::move(pieces)});
    return uses;
}

/// Whether a place is in the words that name a command, and the command; null when it is not.
const lang::CommandSpec* command_at(const OpenDeck::Stretch& stretch, const OpenDeck::Piece& piece) {
    try {
        const auto found = lang::find_command(lang::language(), stretch.statement);
        const std::size_t naming = std::max(found.spec->words.size(), found.form_at + 1);
        const auto column = static_cast<int>(piece.begin) + 1;
        const auto& words = stretch.statement.words;
        for (std::size_t k = 0; k < std::min(naming, words.size()); ++k) {
            const Place& place = words[k].place;
            if (place.line - 1 == piece.line && place.column <= column && column < place.column + place.length)
                return found.spec;
        }
    } catch (const Diagnostic&) {} // a line that is being typed
    return nullptr;
}

/// The page on a command, a word or a name of FISH, or the head of a function of the deck; empty when there is none.
std::string help_at(const EditorAnswers::Asked& asked, const OpenDeck::Piece& piece) {
    const OpenDeck& deck = asked.deck;
    const std::string word = deck.text_of(piece);
    const bool fish = deck.in_fish(asked.spot);
    if (const auto found = defined_in(asked.family, lang::fold(word)); found.function != nullptr && fish)
        return found.function->head;
    try {
        const auto* stretch = deck.stretch_at(asked.spot.line);
        const auto* command = stretch == nullptr || fish ? nullptr : command_at(*stretch, piece);
        if (command == nullptr) return help_text(word);
        std::string words;
        for (const auto& spelled : command->words) words += (words.empty() ? "" : " ") + std::string(spelled.word);
        return lang::help_on(lang::language(), words);
    } catch (const Diagnostic&) { return {}; }
}

bool is_name(const std::string& text) {
    const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) == 0 &&
           std::ranges::all_of(text, fits);
}

[[noreturn]] void refuse(std::string why) { throw Refusal{Refusal::Code::refused, std::move(why)}; }

} // namespace

Json EditorAnswers::range_of(const OpenDeck& deck, const OpenDeck::Piece& piece) {
    const std::string& line = deck.lines()[static_cast<std::size_t>(piece.line)];
    const auto position = [&](std::size_t byte) {
        return Json{{"line", piece.line}, {"character", utf16_of(line, byte)}};
    };
    return {{"start", position(piece.begin)}, {"end", position(piece.end)}};
}

void EditorAnswers::propose(std::string_view dialect) {
    const auto wanted = lang::dialects_of(dialect);
    language_ = wanted == lang::Dialects::modern    ? &lang::modern()
                : wanted == lang::Dialects::classic ? &lang::classic()
                                                    : &lang::language();
}

Json EditorAnswers::completions(const Asked& asked) const {
    const auto typed = asked.deck.typed_at(asked.spot);
    const Proposals found = proposals(*session_, typed.before, typed.line, *language_);
    std::set<std::string> words(found.words.begin(), found.words.end());
    const std::string begun =
        lang::fold(typed.line.substr(typed.line.size() - std::min(found.typed, typed.line.size())));
    const std::string mark = begun.starts_with("@") ? "@" : "", name = begun.substr(mark.size());
    if (!mark.empty() || asked.deck.in_fish(asked.spot))
        for (const auto& member : asked.family)
            for (const auto& own : member.deck->names())
                if (lang::fold(own).starts_with(name) && lang::fold(own) != name) words.insert(mark + own);
    Json items = Json::array();
    const Spot& spot = asked.spot;
    const OpenDeck::Piece piece{spot.line, spot.byte - std::min(found.typed, spot.byte), spot.byte};
    for (const auto& word : words) {
        Json item{{"label", word}};
        if (spot.line >= 0) item["textEdit"] = {{"range", range_of(asked.deck, piece)}, {"newText", word}};
        items.push_back(std::move(item));
    }
    return {{"isIncomplete", false}, {"items", std::move(items)}};
}

Json EditorAnswers::hover(const Asked& asked) const {
    const auto piece = asked.deck.word_at(asked.spot);
    if (!piece) return {};
    const std::string text = help_at(asked, *piece);
    if (text.empty()) return {};
    const std::string shown = "```text\n" + text + (text.ends_with("\n") ? "" : "\n") + "```";
    return {{"contents", {{"kind", "markdown"}, {"value", shown}}}, {"range", range_of(asked.deck, *piece)}};
}

Json EditorAnswers::definition(const Asked& asked) const {
    const auto* stretch = asked.deck.stretch_at(asked.spot.line);
    if (stretch != nullptr && asked.spot.line < stretch->body)
        if (const auto called = called_file(*stretch, path_of(asked.uri)))
            return {{"uri", uri_of(*called)}, {"range", at_start()}};
    const auto piece = asked.deck.word_at(asked.spot);
    if (!piece) return {};
    const auto found = defined_in(asked.family, lang::fold(asked.deck.text_of(*piece)));
    if (found.function == nullptr) return {};
    return {{"uri", found.uri}, {"range", range_of(*found.deck, found.function->piece)}};
}

Json EditorAnswers::uses(const Asked& asked) const {
    Json uses = Json::array();
    if (const auto piece = asked.deck.word_at(asked.spot))
        for (const auto& [member, pieces] : uses_in(asked.family, lang::fold(asked.deck.text_of(*piece))))
            for (const auto& use : pieces)
                uses.push_back({{"uri", member.uri}, {"range", range_of(*member.deck, use)}});
    return uses;
}

bool EditorAnswers::is_built_in(const std::string& folded) const {
    const auto names = session_->engine.scripts->built_in_names();
    return std::ranges::any_of(names, [&](const auto& name) { return name.first == folded; });
}

EditorAnswers::Named EditorAnswers::own_name(const Asked& asked) const {
    const auto piece = asked.deck.word_at(asked.spot);
    if (!piece) refuse("there is no name here");
    const std::string text = asked.deck.text_of(*piece), folded = lang::fold(text);
    if (is_built_in(folded)) refuse("'" + text + "' is a name of FISH itself");
    const bool is_function = defined_in(asked.family, folded).function != nullptr;
    if (asked.deck.uses_of(folded, is_function).empty())
        refuse("'" + text + "' is a word of a command, not a name of FISH");
    return {*piece, folded};
}

Json EditorAnswers::name_to_change(const Asked& asked) const {
    const Named name = own_name(asked);
    return {{"range", range_of(asked.deck, name.piece)}, {"placeholder", asked.deck.text_of(name.piece)}};
}

Json EditorAnswers::other_name(const Asked& asked, const std::string& given) const {
    const Named name = own_name(asked);
    const std::string folded = lang::fold(given);
    if (!is_name(given)) refuse("'" + given + "' is not a name: letters, digits and _");
    if (is_built_in(folded)) refuse("'" + given + "' is a name of FISH itself");
    if (folded != name.folded)
        if (const auto taken = uses_in(asked.family, folded); !taken.empty())
            refuse(
                fmt::format("'{}' is used already{}: two names would become one", given,
                            taken.front().member.uri == asked.uri ? "" : " in " + path_of(taken.front().member.uri)));
    Json changes = Json::object();
    for (const auto& [member, pieces] : uses_in(asked.family, name.folded))
        for (const auto& use : pieces)
            changes[member.uri].push_back({{"range", range_of(*member.deck, use)}, {"newText", given}});
    return {{"changes", std::move(changes)}};
}

Json EditorAnswers::functions(const OpenDeck& deck) {
    constexpr int function_kind = 12;
    Json symbols = Json::array();
    for (const auto& function : deck.functions()) {
        const auto* stretch = deck.stretch_at(function.piece.line);
        const int last = stretch == nullptr ? function.piece.line : stretch->last;
        const std::size_t length = deck.lines()[static_cast<std::size_t>(last)].size();
        const Json from = range_of(deck, {function.piece.line, 0, 0}), to = range_of(deck, {last, length, length});
        symbols.push_back({{"name", function.name},
                           {"kind", function_kind},
                           {"range", {{"start", from["start"]}, {"end", to["end"]}}},
                           {"selectionRange", range_of(deck, function.piece)}});
    }
    return symbols;
}

Json EditorAnswers::diagnostic(const OpenDeck& deck, const std::string& path, const ReportLine& line) {
    const bool here = line.file == path && line.line >= 1 && static_cast<std::size_t>(line.line) <= deck.lines().size();
    Json range = at_start();
    if (here) {
        const std::string& text = deck.lines()[static_cast<std::size_t>(line.line) - 1];
        const std::size_t begin = std::min(static_cast<std::size_t>(std::max(line.column - 1, 0)), text.size());
        range = range_of(deck, {line.line - 1, begin, std::min(text.find_first_of(" \t,", begin), text.size())});
    }
    std::string message = here ? line.text : fmt::format("{}:{}: {}", line.file, line.line, line.text);
    if (!line.hint.empty()) message += "\n" + line.hint;
    Json diagnostic{
        {"range", range}, {"severity", severity_of(line.outlook)}, {"source", "kaya"}, {"message", message}};
    if (!line.code.empty()) diagnostic["code"] = line.code;
    return diagnostic;
}

Json EditorAnswers::proposed_edits(const std::string& uri, const Json& diagnostics) {
    Json actions = Json::array();
    for (const auto& diagnostic : diagnostics) {
        const std::string word = proposal_of(diagnostic.at("message").get<std::string>());
        if (word.empty()) continue;
        const Json edit{{"range", diagnostic.at("range")}, {"newText", word}};
        actions.push_back({{"title", "write " + word},
                           {"kind", "quickfix"},
                           {"diagnostics", Json::array({diagnostic})},
                           {"edit", {{"changes", {{uri, Json::array({edit})}}}}}});
    }
    return actions;
}

Json EditorAnswers::converted(const OpenDeck& deck, const std::string& uri, int line) {
    const auto* stretch = deck.stretch_at(line);
    if (stretch == nullptr || stretch->body <= stretch->last) return Json::array(); // functions are of both dialects
    std::string text;
    for (int k = stretch->first; k <= stretch->last; ++k) text += deck.lines()[static_cast<std::size_t>(k)] + "\n";
    const bool modern = &lang::dialect_of(lang::language(), stretch->statement) == &lang::modern();
    try {
        const auto other =
            lang::convert_deck(lang::source_from_text("deck", text), modern ? lang::To::classic : lang::To::modern);
        if (other.changed == 0) return Json::array();
        const Json range{{"start", {{"line", stretch->first}, {"character", 0}}},
                         {"end", {{"line", stretch->last + 1}, {"character", 0}}}};
        const Json edit{{"range", range}, {"newText", other.text}};
        return Json::array({{{"title", fmt::format("write in {} words", modern ? "classic" : "modern")},
                             {"kind", "refactor.rewrite"},
                             {"edit", {{"changes", {{uri, Json::array({edit})}}}}}}});
    } catch (const Diagnostic&) { return Json::array(); } // a line with a mistake
}

} // namespace kaya
