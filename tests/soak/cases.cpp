#include "cases.hpp"

#include "bench_files.hpp"
#include "change.hpp"
#include "scenes.hpp"
#include "study_files.hpp"
#include "valid_change.hpp"

#include "lang/commands/language.hpp"

#include <array>
#include <fmt/format.h>

namespace kaya::soak {

namespace {

constexpr std::array all_kinds{
    Kind{"decks", "commands of the tables, with calls, functions and loops around them", &Cases::decks, 0.1},
    Kind{"scripts", "FISH and Lua: every name, on living and dead objects", &Cases::scripts, 0.1},
    Kind{"files", "surfaces, grids, grounds and tables that were changed, half of them validly", &Cases::files, 0.2},
    Kind{"studies", "studies: parameters, designs, results, searches", &Cases::studies, 0.1},
    Kind{"benches", "paths of jtest, jfit and ztest", &Cases::benches, 0.1},
    Kind{"journals", "journals that somebody has changed", &Cases::journals, 0.02},
    Kind{"joint-models", "joint models in Lua that somebody has changed", &Cases::joint_models, 0.02},
};

constexpr const char* short_deck = R"(poly brick 0 1 0 1 0 1
poly brick 0 1 0 1 1 2
prop mat 1 dens 2000
jmodel jkn 1e8 jks 1e8
fix range z 0 1
gravity 0 0 -10
def f
  a = 2
end
@f
set @b = 3
hist unbal
cycle 5
)";

// Errors of scripts are caught, so that the next line runs; a fault of the program must be seen all the same.
constexpr const char* trying = R"(lua
local pcall, print, tostring, type, find = pcall, print, tostring, type, string.find
function try(body)
    local right, why = pcall(body)
    if not right and type(why) == 'userdata' and find(tostring(why), 'kaya itself failed', 1, true) then print(why) end
end
endlua
)";

std::vector<File> sample_files() {
    std::vector<File> files;
    for (const Sample& sample : samples()) files.push_back({sample.name, sample.bytes});
    return files;
}

bool ends_with_any(const std::string& name, std::initializer_list<const char*> endings) {
    for (const char* ending : endings)
        if (name.ends_with(ending)) return true;
    return false;
}

/// Lines that read a file of samples().
std::string reading(const std::string& name, Chance& c) {
    const std::string bricks = "poly brick 0 10 0 10 -10 10\n",
                      ending = "prop mat 1 dens 2000\njmodel jkn 1e8 jks 1e8\ncycle 2\n";
    if (name.ends_with(".tab"))
        return fmt::format(
                   "table 1 read '{}'\nlist tables\npoly brick 0 1 0 1 0 1\nbound xload 1 hist table 1 range x 1\n",
                   name) +
               ending;
    const bool ground = ends_with_any(name, {".pit", ".xyz", ".asc"});
    if (ground || (c.heads(0.3) && !ends_with_any(name, {".msh", ".3dgrid", ".f3grid", ".tess", ".ts", ".dxf", ".json",
                                                         ".vtk", ".vtu", ".vtp"}))) {
        static constexpr std::array uses{"cut ground '{}'", "water ground '{}' density 1000",
                                         "delete range ground '{}' above", "cut ground '{}' shift 0 0 -0.2 region 3"};
        const char* mesh = c.heads(0.2) ? "gen edge 4\n" : "";
        return bricks + fmt::format(fmt::runtime(c.of(uses)), name) + "\n" + mesh + ending;
    }
    const char* mesh = c.heads(0.3) ? "gen edge 0.5\n" : "";
    static constexpr std::array ways{
        "", "", "", " stop", " mend 0.01", " mend 0.3 holes 2", " scale 1e-3 up y", " holes 1 skip"};
    return fmt::format("import '{}'{}\nlist blocks quality\n", name, c.of(ways)) + mesh + ending;
}

} // namespace

std::span<const Kind> kinds() { return all_kinds; }

Cases::Cases() : lines_(lang::classic()), fish_(vocabulary_, lines_), lua_(vocabulary_, lines_) {}

std::string Cases::lines(Chance& c, double odd, int most, bool in_script) const {
    std::string text;
    for (int k = 1 + c.below(most); k > 0; --k) {
        text += (in_script ? lines_.short_line(c, odd) : lines_.line(c, odd)) + "\n";
        if (c.heads(0.2)) text += cycles(c);
    }
    return text;
}

Case Cases::decks(Chance& c) const {
    // Most decks bind, so that they run; the others have errors of each kind.
    const double odd = c.heads(0.8) ? 0.15 : 0.6;
    Case one{sample_files(), {}};
    std::string deck = scene(c) + lines(c, odd, 12);
    if (c.heads(0.2))
        deck += fmt::format("def again\n  loop n (1, {})\n  command\n{}  endcommand\n  endloop\nend\n@again\n",
                            1 + c.below(3), lines(c, odd, 3, true));
    if (c.heads(0.2)) {
        one.files.push_back({"part.3dd", lines(c, odd, 5) + (c.heads(0.1) ? "call part\n" : "")});
        deck += "call part\n";
    }
    deck += cycles(c) + (c.heads(0.2) ? "save out\nrestore out\ncycle 2\n" : "");
    if (c.heads(0.05)) deck.resize(static_cast<std::size_t>(c.below(static_cast<int>(deck.size()))));
    one.files.push_back({"deck.3dd", deck});
    static const std::array<std::vector<std::string>, 8> ways{{{"deck.3dd"},
                                                               {"deck.3dd"},
                                                               {"deck.3dd", "--threads", "1", "-q"},
                                                               {"--no-journal", "--threads", "1", "deck.3dd"},
                                                               {"--strict", "deck.3dd"},
                                                               {"--echo", "--threads", "2", "deck.3dd"},
                                                               {"check", "deck.3dd", "--json"},
                                                               {"fmt", "deck.3dd"}}};
    one.words = c.of(ways);
    return one;
}

Case Cases::scripts(Chance& c) const {
    std::string deck = trying + scene(c) + cycles(c);
    const int functions = 2 + c.below(8);
    for (int k = 0; k < functions; ++k) deck += fish_.function(fmt::format("soup{}", k), c);
    if (c.heads(0.7)) deck += lua_.chunk(c);
    deck += "lua\n";
    for (int k = 0; k < functions; ++k) deck += fmt::format("try(function() fish.soup{}() end)\n", k);
    deck += "endlua\n";
    if (c.heads(0.5)) deck += lua_.chunk(c);
    deck += cycles(c);
    if (c.heads(0.3)) deck += "save out\nrestore out\ncycle 2\n";
    if (c.heads(0.3)) deck += "@soup0\n";
    Case one{sample_files(), {"--no-journal", "--threads", "1", "--script-memory", "500", "deck.3dd"}};
    one.files.push_back({"deck.3dd", deck});
    return one;
}

Case Cases::files(Chance& c) const {
    const Sample& sample = c.of(samples());
    if (sample.name.ends_with(".lua")) return files(c);
    const std::string bytes = c.heads(0.5)    ? changed_validly(sample.bytes, c)
                              : c.heads(0.95) ? changed(sample.bytes, c)
                                              : sample.bytes;
    return {{{sample.name, bytes}, {"deck.3dd", reading(sample.name, c)}},
            {"--no-journal", "--threads", "1", "deck.3dd"}};
}

Case Cases::studies(Chance& c) const {
    Case one = study(c);
    if (c.heads(0.3)) one.files.front().bytes = changed(one.files.front().bytes, c);
    return one;
}

Case Cases::benches(Chance& c) const {
    Case one = bench(c);
    if (c.heads(0.3)) one.files.front().bytes = changed(one.files.front().bytes, c);
    return one;
}

Case Cases::journal_run() { return {{{"good.3dd", short_deck}}, {"good.3dd"}}; }

Case Cases::journals(Chance& c) const {
    return {{{"good.journal", c.heads(0.05) ? journal_ : changed(journal_, c)}, {"good.3dd", short_deck}},
            {"replay", "good.journal"}};
}

Case Cases::joint_models(Chance& c) const {
    Case one{{{"slip.lua", changed(samples().back().bytes, c)}}, {}};
    if (c.heads(0.3)) {
        one.files.push_back({"path.csv", "normal_stress,shear_displacement\n2,0\n2,0.002\n2,-0.002\n"});
        one.words = {"jtest",       "./slip.lua", "path.csv", "kn=1e5",      "ks=1e5",
                     "friction=30", "--steps",    "50",       "--no-picture"};
        return one;
    }
    one.files.push_back(
        {"deck.3dd", "poly brick 0 1 0 1 0 1\npoly brick 0 1 0 1 1 2\nprop mat 1 dens 2000\njmodel model ./slip.lua\n"
                     "jmodel kn 1e8 ks 1e8 friction 20\nfix range z 0 1\ngravity 1 0 -10\ncycle 20\nlist contacts\n"
                     "save out\nrestore out\ncycle 2\n"});
    one.words = {"--no-journal", "--threads", "2", "deck.3dd"};
    return one;
}

} // namespace kaya::soak
