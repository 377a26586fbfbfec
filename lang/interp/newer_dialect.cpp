#include "lang/interp/newer_dialect.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace kaya::lang {

namespace {

struct NewerCommand {
    std::string_view words;   ///< as it begins
    std::string_view classic; ///< the classic words
    bool rest_stays = true;   ///< the rest of the line is the same in both
};

constexpr NewerCommand commands[] = {
    {"model new", "new"},
    {"model title", "title"},
    {"model configure", "config"},
    {"model gravity", "gravity"},
    {"model cycle", "cycle"},
    {"model step", "step"},
    {"model solve", "solve ratio 1e-5", false},
    {"model save", "save"},
    {"model restore", "restore"},
    {"model history", "hist unbal", false},
    {"model range create", "range name"},
    {"model range", "range name", false},
    {"model random", "set random"},
    {"model large-strain", "leave it out: strains are always large", false},
    {"model mechanical timestep", "fraction", false},
    {"model display", "list", false},
    {"program call", "call"},
    {"program log", "set log"},
    {"program quit", "quit"},
    {"program exit", "exit"},
    {"block create brick", "poly brick"},
    {"block create prism", "poly prism", false},
    {"block create polyhedron", "poly face", false},
    {"block create tetrahedron", "poly tet", false},
    {"block create tunnel", "poly tunnel", false},
    {"block create drum", "poly drum", false},
    {"block create", "poly", false},
    {"block cut joint-set", "jset", false},
    {"block densify", "densify", false},
    {"block delete", "delete"},
    {"block excavate", "excavate"},
    {"block fill", "fill"},
    {"block copy", "copy", false},
    {"block join on", "join on"},
    {"block join", "join on", false},
    {"block hide", "hide"},
    {"block show", "seek", false},
    {"block group", "group block"},
    {"block fix", "fix", false},
    {"block free", "free", false},
    {"block insitu", "insitu", false},
    {"block history", "hist xdis x y z", false},
    {"block list", "list", false},
    {"block import", "import", false},
    {"block export", "export", false},
    {"block property", "prop mat 1 dens 2600", false},
    {"block zone generate edgelength", "gen edge"},
    {"block zone generate", "gen edge", false},
    {"block zone cmodel assign", "zone model"},
    {"block zone cmodel", "zone model mohr-coulomb", false},
    {"block zone property", "prop mat 1 dens 2600 k 1e9 g 1e9", false},
    {"block zone group", "group zone"},
    {"block contact jmodel assign", "jmodel model"},
    {"block contact property", "prop jmat 1 jkn 1e9 jks 1e9 jfric 30", false},
    {"block contact material-table", "prop jmat 1 jkn 1e9 jks 1e9 jfric 30", false},
    {"block contact group", "group joint"},
    {"block contact list", "list contacts", false},
    {"block apply", "bound", false},
    {"block gridpoint apply", "bound", false},
    {"block gridpoint initialize", "initialize", false},
    {"block face apply", "bound stress", false},
    {"block initialize", "initialize", false},
    {"block mechanical damping", "damp"},
};

std::vector<std::string_view> split(std::string_view words) {
    std::vector<std::string_view> parts;
    while (!words.empty()) {
        const auto end = std::min(words.find(' '), words.size());
        parts.push_back(words.substr(0, end));
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return parts;
}

/// The number of words of the statement that the entry matches, 0 when it does not match. Words may be abbreviated.
std::size_t begins_like(const Statement& statement, const NewerCommand& command) {
    const auto parts = split(command.words);
    if (statement.words.size() < parts.size()) return 0;
    constexpr std::size_t shortest = 3;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string& typed = statement.words[i].folded;
        const bool fits = typed == parts[i] || (i > 0 && typed.size() >= shortest && parts[i].starts_with(typed));
        if (statement.words[i].kind != WordKind::word || !fits) return 0;
    }
    return parts.size();
}

} // namespace

std::optional<Diagnostic> newer_dialect(const Statement& statement) {
    const Word& first = statement.words.front();
    if (first.kind != WordKind::word ||
        (first.folded != "model" && first.folded != "block" && first.folded != "program"))
        return std::nullopt;
    const NewerCommand* found = nullptr;
    std::size_t length = 0;
    for (const auto& command : commands)
        if (const std::size_t fits = begins_like(statement, command); fits > length) {
            found = &command;
            length = fits;
        }
    Diagnostic d("this is the dialect of version 6 and later; kaya reads the classic one, of version 5.2 and before");
    d.code = "newer-dialect";
    if (found) {
        const bool rest = found->rest_stays && statement.words.size() > length;
        d.hint = fmt::format("classic: {}{}{}", found->classic, rest ? " " : "",
                             rest ? statement.raw(length) : std::string());
    }
    return d.at(first.place);
}

} // namespace kaya::lang
