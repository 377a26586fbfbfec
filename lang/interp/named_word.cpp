#include "lang/interp/named_word.hpp"

#include "lang/interp/binder.hpp"

#include <algorithm>
#include <cctype>

namespace kaya::lang {

namespace {

bool part_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

/// Names of files are recognised by their ending or by quotes in the deck; other words only where the message quotes them.
bool names(const std::string& message, const Word& word) {
    if (word.text.empty() || (word.kind != WordKind::word && word.kind != WordKind::text)) return false;
    const bool anywhere = word.kind == WordKind::text || word.text.find('.') != std::string::npos;
    for (auto at = message.find(word.text); at != std::string::npos; at = message.find(word.text, at + 1)) {
        const auto end = at + word.text.size();
        if (end < message.size() && part_of_word(message[end])) continue;
        if (at > 0 && message[at - 1] == '\'') return true;
        if (anywhere && (at == 0 || !part_of_word(message[at - 1]))) return true;
    }
    return false;
}

} // namespace

void place_problem(Diagnostic& problem, const Language& language, const Place& command) {
    const Place& known = problem.place;
    const bool first_word =
        known.source == command.source && known.line == command.line && known.column == command.column;
    if (known && !first_word) return;
    problem.place = command;
    if (!command) return;
    Lexer lexer(command.source, command.line);
    Statement statement;
    if (!next_statement(language, lexer, statement)) return;
    const auto named = std::find_if(statement.words.begin() + 1, statement.words.end(),
                                    [&](const Word& word) { return names(problem.message, word); });
    if (named != statement.words.end()) problem.place = named->place;
}

} // namespace kaya::lang
