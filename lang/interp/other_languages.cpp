#include "lang/interp/other_languages.hpp"

#include "base/pattern.hpp"

namespace kaya::lang {

namespace {

struct Neighbour {
    const char* line; ///< what a line of it looks like, letters of either case
    const char* what;
    const char* hint;
};

constexpr const char* script_hint =
    "kaya runs command files; scripts in them are FISH (def ... end) or Lua (lua ... endlua)";
constexpr const char* rock_hint =
    "kaya has polyhedral blocks: poly brick makes them, jset cuts them, gen edge divides them into zones";

constexpr Neighbour neighbours[] = {
    {R"((import\s+\S+\s+as\s+\w+|import\s+(itasca|numpy|math|os|sys)|from\s+[\w.]+\s+import\s.*|(def|class)\s+\w+\s*(\(.*\))?:.*|print\s*\(.*\)|for\s+\w+\s+in\s+.*:|if\s+__name__.*))",
     "this is a line of Python", script_hint},
    {R"(((local\s+)?function\s+[\w.:]+\s*(\(.*)?))", "this is a line of Lua",
     "Lua stands between lua and endlua; a function of FISH is def ... end"},
    {R"((clear|close|clc|format)\s+(all|long|short)|clc|function\s+.*=.*\(.*\)|(figure|disp|fprintf|plot)\s*\(.*\);?)",
     "this is a line of MATLAB", script_hint},
    {R"((zone\s+(create2?d?|cmodel|face|gridpoint|initialize(-stresses)?|history|fill|apply|results|water|relax|geometry-\S+)|extrude)\s+.*)",
     "this is a command of FLAC3D", rock_hint},
    {R"((ball|wall|clump|rblock|cmat|domain|brick|fragment)\s+(create|generate|default|extent|distribute|attribute|property|make|assemble|activate|template)\b.*)",
     "this is a command of PFC", rock_hint},
    {R"((block\s+[-+.\d].*|crack\s+[-+.\d].*|round\s+[-+.\d].*|(jregion|jdelete|pgen)\b.*))",
     "this is a command of UDEC",
     "kaya is three-dimensional: a slice of one block's thickness does what UDEC does; poly prism makes it, jset cuts it"},
    {R"(\*(heading|node|element|nset|elset|material|step|part|assembly|instance|boundary|include)\b.*)",
     "this is a line of Abaqus", rock_hint},
    {R"(/(prep7|solu|post1|clear|filname|title|units|batch|com)\b.*|finish)", "this is a line of Ansys", rock_hint},
    {R"(<(!doctype|html|\?xml|svg)\b.*)", "this is a page or a drawing, not a deck",
     "name the command file: kaya DECK"},
    {R"(\{\s*(".*)?)", "this is a file of JSON, not a deck", "name the command file: kaya DECK"},
};

} // namespace

std::optional<Diagnostic> other_language(const Statement& statement) {
    const std::string text = statement.raw(0);
    constexpr std::size_t longest = 200; // matching takes a stack that grows with the text
    if (text.size() > longest) return std::nullopt;
    for (const auto& neighbour : neighbours) {
        if (!Pattern(neighbour.line, Pattern::Letters::of_either_case).matches(text)) continue;
        Diagnostic d(neighbour.what, neighbour.hint);
        d.code = "other-language";
        return d.at(statement.words.front().place);
    }
    return std::nullopt;
}

} // namespace kaya::lang
