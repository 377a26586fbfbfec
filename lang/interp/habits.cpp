#include "lang/interp/habits.hpp"

#include <algorithm>

namespace kaya::lang {

namespace {

struct Habit {
    std::string_view place;
    std::string_view word, hint;
};

constexpr std::string_view keyboard = "it is a word of the keyboard: decks do not have it",
                           no_programs = "a deck starts no programs; with --trust Lua has os.execute",
                           in_fish = "it is a word of FISH, which stands between def NAME and end",
                           in_lua = "it is a word of Lua, which stands between lua and endlua",
                           one_range = "elements of a range follow each other, and all must hold: range x 0 1 y 0 1",
                           limits = "write the two limits: range z -1 0";

// clang-format off
constexpr Habit habits[] = {
    {"a command", "run", "write cycle NUMBER, cycle time SECONDS, or solve"},
    {"a command", "continue", "a run continues with the next cycle or solve"},
    {"a command", "resume", "a run continues with the next cycle or solve"},
    {"a command", "help", keyboard},
    {"a command", "man", keyboard},
    {"a command", "undo", "nothing is undone: save FILE keeps a model, restore FILE brings it back"},
    {"a command", "clear", "write new: it removes the model"},
    {"a command", "include", "write call FILE"},
    {"a command", "load", "write restore FILE for a saved model, call FILE for a deck"},
    {"a command", "open", "write restore FILE for a saved model, call FILE for a deck"},
    {"a command", "system", no_programs},
    {"a command", "shell", no_programs},
    {"a command", "ls", no_programs},
    {"a command", "dir", no_programs},
    {"a command", "cd", "files of a deck are found next to it: write their path in the name"},
    {"a command", "echo", "print @NAME shows a value; kaya --echo shows the commands"},
    {"a command", "brick", "write poly brick"},
    {"a command", "prism", "write poly prism"},
    {"a command", "joint", "write jset for planes, jmodel for their model, prop jmat for their properties"},
    {"a command", "contact", "write jmodel for classic decks, block contact for modern ones"},
    {"a command", "material", "write prop mat 1 dens 2600"},
    {"a command", "density", "write prop mat 1 dens 2600"},
    {"a command", "monitor", "write hist"},
    {"a command", "mesh", "write gen edge LENGTH"},
    {"a command", "element", "write gen edge LENGTH for zones, structure beam for bars"},
    {"a command", "support", "write fix range ..."},
    {"a command", "whilestepping", "write it inside the function: def NAME, whilestepping, ..., end"},
    {"a command", "loop", in_fish},
    {"a command", "if", in_fish},
    {"a command", "endif", in_fish},
    {"a command", "endloop", in_fish},
    {"a command", "case_of", in_fish},
    {"a command", "end", "no def is open here: it ended before this line"},
    {"a command", "for", in_lua},
    {"a command", "while", in_lua},
    {"a command", "function", "write def NAME ... end for FISH, lua ... endlua for Lua"},
    {"a command", "endlua", "no lua is open here: it ended before this line"},
    {"a command", "python", "decks have FISH and Lua; Python runs kaya with: import kaya"},
    {"a range element", "and", one_range},
    {"a range element", "&&", one_range},
    {"a range element", "or", "write union: one element is then enough"},
    {"a range element", "<", limits},
    {"a range element", ">", limits},
    {"a range element", "from", limits},
    {"a range element", "to", limits},
    {"a range element", "all", "omit the range: the command then acts on everything visible"},
    {"a range element", "x", "write position-x"},
    {"a range element", "y", "write position-y"},
    {"a range element", "z", "write position-z"},
    {"a keyword of block cut joint-set", "dd", "write dip-direction"},
    {"a keyword of block cut joint-set", "ddir", "write dip-direction"},
    {"a keyword of block cut joint-set", "strike", "write dip-direction: it is the strike plus 90"},
    {"a kind of block cut", "jset", "write joint-set"},
    {"a kind of block zone generate", "size", "write edgelength"},
    {"a kind of block", "joint-set", "write block cut joint-set"},
    {"a kind of block", "tunnel", "write block create tunnel, or block cut tunnel"},
    {"a kind of block", "split", "write block cut joint-set"},
    {"a kind of block", "merge", "write block join"},
    {"a kind of block", "structure", "write structure cable, beam or liner"},
    {"a kind of block", "initialise", "write block initialize"},
    {"a kind of block cut", "plane", "write joint-set: one plane unless number says otherwise"},
    {"a keyword of block initialize", "stress-zz", "write block zone initialize stress-zz"},
    {"a keyword of block gridpoint apply", "pressure", "write block face apply stress: a pressure p is stress -p -p -p 0 0 0"},
    {"a kind of zone", "initialize-stresses", "write block insitu stress"},
    {"a keyword of model solve", "factor-of-safety", "write model factor-of-safety"},
    {"a kind of block mechanical", "timestep", "write model mechanical timestep"},
    {"a range element", "dip", "write orientation dip d dip-direction dd tolerance t"},
    {"a keyword of block create brick", "grp", "write group"},
    {"a keyword of block history", "list", "write: history list"},
    {"a keyword of block history", "delete", "write: history delete"},
    {"a keyword of structure delete", "all", "omit it: without a number or a range all are deleted"},
    {"a keyword of list", "mat", "write list prop mat"},
    {"a keyword of list", "joint", "write list contacts, or list subcontacts"},
    {"a keyword of tunnel", "radius", "write poly tunnel for a round one; tunnel takes the corners of two polygons"},
    {"a keyword of jset", "strike", "write dd: the direction of the dip is the strike plus 90"},
    {"a keyword of jset", "azimuth", "write dd: the direction of the dip"},
    {"a keyword of jset", "angle", "write dip and dd"},
    {"a keyword of jset", "gap", "write spacing: the distance of the planes"},
    {"a keyword of apply", "xforce", "write xload: force along x"},
    {"a keyword of apply", "yforce", "write yload: force along y"},
    {"a keyword of apply", "zforce", "write zload: force along z"},
    {"a keyword of apply", "pressure", "write bound stress: a pressure p is stress -p -p -p 0 0 0"},
    {"a keyword of boundary", "xforce", "write xload: force along x"},
    {"a keyword of boundary", "yforce", "write yload: force along y"},
    {"a keyword of boundary", "zforce", "write zload: force along z"},
    {"a keyword of boundary", "fixed", "write xvel 0 yvel 0 zvel 0"},
    {"a keyword of boundary", "pressure", "write stress: a pressure p is stress -p -p -p 0 0 0"},
    {"a keyword of solve", "steps", "write cycles NUMBER"},
    {"a keyword of solve", "step", "write cycles NUMBER"},
    {"a keyword of solve", "tolerance", "write ratio 1e-5"},
    {"a keyword of solve", "convergence", "write ratio 1e-5"},
    {"a keyword of cycle", "cycles", "the number alone is enough: cycle 1000"},
    {"a keyword of cycle", "steps", "the number alone is enough: cycle 1000"},
};
// clang-format on

} // namespace

std::string_view habit_hint(std::string_view place, std::string_view word) {
    const auto* found =
        std::ranges::find_if(habits, [&](const Habit& habit) { return habit.word == word && habit.place == place; });
    return found == std::end(habits) ? std::string_view{} : found->hint;
}

} // namespace kaya::lang
