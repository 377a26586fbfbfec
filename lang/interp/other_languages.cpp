#include "lang/interp/other_languages.hpp"

#include "base/pattern.hpp"

#include <algorithm>
#include <iterator>

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
    {R"((using\s+namespace|#include|int\s+main|void\s+\w+\s*\(|double\s+\w+|template\s*<).*)", "this is a line of C++",
     "a joint model in C++ is compiled and loaded: jmodel load FILE; scripts of decks are FISH and Lua"},
    {R"(<(!doctype|html|\?xml|svg)\b.*)", "this is a page or a drawing, not a deck",
     "name the command file: kaya DECK"},
    {R"(\{\s*(".*)?)", "this is a file of JSON, not a deck", "name the command file: kaya DECK"},
};

struct OddLine {
    const char* line;
    const char* hint;
};

constexpr const char* comment_hint = "a comment begins with ;";

constexpr OddLine odd_lines[] = {
    {R"(<<<<<<<.*|>>>>>>>.*)", "it is a mark of git: two versions of the file are in it, keep one of them"},
    {R"((>+|(kaya|3dec|fish|flac3d)\s*>).*)", "leave the prompt out"},
    {R"(kaya\s.*)", "commands stand in a deck without the name of the program"},
    {R"(\d+:?\s+[a-z].*)", "lines of a command file have no numbers: leave it out"},
    {R"([*!]\s.*|(rem|c)\s+(a|the|this|an)\b.*)", comment_hint},
    {R"(```.*)", "it is a mark of Markdown: leave it out"},
    {R"(PK\b.*)", "this is a zip file: name the command file in it"},
    {R"((var|let|const|double|real)\s+[a-z_]\w*\s*(=|<-).*|[a-z_$%]\w*\s*(=|<-|:=)\s*[^=].*)",
     "variables are those of FISH: [name = value], or set @name = value"},
};

constexpr std::size_t longest = 200; // matching takes a stack that grows with the text

bool is_like(const char* line, const std::string& text) {
    return text.size() <= longest && Pattern(line, Pattern::Letters::of_either_case).matches(text);
}

} // namespace

std::optional<Diagnostic> other_language(const Statement& statement) {
    const std::string text = statement.raw(0);
    const auto* found =
        std::ranges::find_if(neighbours, [&](const Neighbour& known) { return is_like(known.line, text); });
    if (found == std::end(neighbours)) return std::nullopt;
    Diagnostic d(found->what, found->hint);
    d.code = "other-language";
    return d.at(statement.words.front().place);
}

std::string_view odd_line_hint(const Statement& statement) {
    const std::string text = statement.raw(0);
    const auto* found =
        std::ranges::find_if(odd_lines, [&](const OddLine& known) { return is_like(known.line, text); });
    return found == std::end(odd_lines) ? std::string_view{} : found->hint;
}

} // namespace kaya::lang
