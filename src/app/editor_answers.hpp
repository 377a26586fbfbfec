// What an editor asks about a place in a deck: words that fit, help, definitions, uses, another name. Answers are JSON of the language server
// protocol.
#pragma once

#include "app/open_decks.hpp"
#include "commands/session/deck_report.hpp"
#include "commands/session/session.hpp"
#include "lang/modern/language.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace kaya {

/// A request that is answered with an error: its code in the protocol, and the reason for the user.
struct Refusal {
    enum class Code { parse = -32700, request = -32600, method = -32601, parameters = -32602, refused = -32803 };
    Code code;
    std::string message;
};

class EditorAnswers {
public:
    using Json = nlohmann::json;

    /// A place in a deck; its line is -1 when the editor names one that the text does not have.
    struct Asked {
        const OpenDeck& deck;
        Spot spot;
        std::string uri;                       ///< of the deck
        std::vector<OpenDecks::Member> family; ///< the decks that share its names, itself first
    };

    /// The dialect of proposed words: modern, classic, or both for any other word.
    void propose(std::string_view dialect);

    /// All of them return null, or an empty list, where there is nothing.
    Json completions(const Asked& asked) const;
    Json hover(const Asked& asked) const;
    Json definition(const Asked& asked) const;
    Json uses(const Asked& asked) const;

    /// Throw Refusal for a name that is not the deck's, and for one that is taken or is not a name.
    Json name_to_change(const Asked& asked) const;
    Json other_name(const Asked& asked, const std::string& name) const;

    static Json functions(const OpenDeck& deck);
    static Json range_of(const OpenDeck& deck, const OpenDeck::Piece& piece);
    /// A finding of `check`; one of a called file is shown at the first line.
    static Json diagnostic(const OpenDeck& deck, const std::string& path, const ReportLine& line);
    /// "did you mean 'x'?" of the diagnostics as edits.
    static Json proposed_edits(const std::string& uri, const Json& diagnostics);
    /// The command on a line in the words of the other dialect, as an edit; an empty list where they say it no other way.
    static Json converted(const OpenDeck& deck, const std::string& uri, int line);

private:
    /// The name at a place, in lower case. Throws Refusal.
    struct Named {
        OpenDeck::Piece piece;
        std::string folded;
    };
    Named own_name(const Asked& asked) const;
    bool is_built_in(const std::string& folded) const;

    const lang::Language* language_ = &lang::language();                      ///< of proposed words
    std::unique_ptr<Session> session_ = std::make_unique<Session>(Options{}); ///< knows built-in names
};

} // namespace kaya
