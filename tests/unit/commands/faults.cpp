// What `kaya check` finds in decks with one fault that their text tells, and that it finds nothing in right ones.
#include "commands/session/deck_report.hpp"

#include "tests/unit/scratch_folder.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace kaya {
namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string>;

/// Rigid blocks with the parts that decks have.
const Lines rigid{"title 'two blocks'",
                  "poly brick 0 2 0 2 -1 0",
                  "poly brick 0 1 0 1 0 1 group top",
                  "range name base z -1 0",
                  "prop mat 1 dens 2600",
                  "jmodel model mohr",
                  "jmodel jkn 1e9 jks 1e9 jfric 30",
                  "fix range nrange base",
                  "gravity 0 0 -9.81",
                  "damp local 0.8",
                  "table 1 0 0 1 1",
                  "hist unbal",
                  "hist zdis 0.5 0.5 1",
                  "apply xload 100 hist table 1 range group top",
                  "def height",
                  "  b = b_near(0.5, 0.5, 0.5)",
                  "  height = b_z(b)",
                  "end",
                  "lua",
                  "for b in blocks() do",
                  "  print(b.volume)",
                  "end",
                  "endlua",
                  "cycle 100",
                  "print @height",
                  "plot block displacement file a.png",
                  "hist write 1 2 file a.csv",
                  "save end"};

/// Blocks with zones, in the words of newer versions.
const Lines zoned{"model new",
                  "block create brick 0 2 0 2 0 2",
                  "block cut joint-set dip 30 dip-direction 90 origin 1 1 1",
                  "block group 'rock'",
                  "block zone generate edgelength 1",
                  "block property density 2600",
                  "block zone cmodel assign mohr-coulomb",
                  "block zone property bulk 1e9 shear 6e8 cohesion 1e6 friction 30",
                  "block contact jmodel assign mohr",
                  "block contact property stiffness-normal 1e10 stiffness-shear 1e10 friction 30",
                  "block gridpoint apply velocity 0 0 0 range position-z 0",
                  "model gravity 0 0 -9.81",
                  "block history displacement-z position 1 1 2",
                  "fish define top",
                  "  top = block.gp.disp.z(block.gp.near(1, 1, 2))",
                  "end",
                  "block mechanical damping local 0.8",
                  "model cycle 100",
                  "[io.out(top)]",
                  "history export '1' file 'a.csv'",
                  "model save 'end'"};

/// A stope with bolts, where structures, scripts and an excavation follow each other.
const Lines stope{"; a stope with bolts",
                  "config dynamic",
                  "; geometry",
                  "set @span = 6",
                  "set @depth = 400",
                  "poly brick -10 10 0 2 -10 10",
                  "jset dip 60 dd 90 spacing 2 number 4 origin 0 1 0 id 1",
                  "jset dip 10 dd 270 spacing 2.5 number 3 origin 0 1 0 id 2",
                  "group block hanging range x 0 10",
                  "group block foot range x -10 0",
                  "gen edge 1.5",
                  "prop mat 1 dens 2700 bulk 5e9 shear 3e9",
                  "zone model mohr-coulomb",
                  "zone property cohesion 2e6 friction 35 tension 2e5",
                  "jmodel model barton-bandis",
                  "jmodel jkn 2e10 jks 1e10 resfric 28 jrco 8 jcso 8e7 sigmac 1e8 lo 0.1 ln 1",
                  "insitu stress -8e6 -6e6 -1.1e7 0 0 0 zgrad 0 0 27000 0 0 0",
                  "bound xvel 0 range x -10",
                  "bound xvel 0 range x 10",
                  "bound yvel 0 range y 0",
                  "bound yvel 0 range y 2",
                  "bound zvel 0 range z -10",
                  "bound stress 0 0 -1.1e7 0 0 0 range z 10",
                  "gravity 0 0 -9.81",
                  "table 5 0 0 1 1 2 0",
                  "hist ncyc 20 unbal",
                  "hist zdis 0 1 3",
                  "solve ratio 1e-5 cycles 500",
                  "reset disp",
                  "excavate range x -3 3 z -3 3",
                  "structure cable 0 1 3 0 1 9 segments 6 prop 4",
                  "structure property 4 area 5e-4 young 2e11 yield 2.5e5 kbond 1e7 sbond 2e5",
                  "fish define closure",
                  "  local top = block.gp.near(0, 1, 3)",
                  "  closure = block.gp.disp.z(top)",
                  "end",
                  "fish history closure",
                  "cycle 200",
                  "[io.out('closure ' + string(closure))]",
                  "solve ratio 1e-4 cycles 500",
                  "lua",
                  "local worst = minimum(\"gridpoint\", \"z\")",
                  "print((\"worst %g\"):format(worst))",
                  "endlua",
                  "title",
                  "A stope with bolts",
                  "plot block szz cut dip 90 dd 0 origin 0 1 0 file stope.png",
                  "plot hist 2 3 vs 1 file curve.svg",
                  "hist write 2 3 file stope.csv",
                  "list zones range x -3 3 z 3 5",
                  "vtk write stope",
                  "save stope"};

/// One line of a deck in place of another; a fault is found on the line `found`, or on the changed one.
struct Edit {
    int line;
    const char* text; ///< "": the line is omitted
    int found = 0;
};

// clang-format off
const Edit rigid_faults[] = {
    {2, "poly brik 0 2 0 2 -1 0"}, {2, "poly brick 0 2 0 2 -1"}, {2, "poly brick 0 2 0 2 0 -1"}, {2, "polly brick 0 2 0 2 -1 0"},
    {2, "poly brick 0;2;0 2 -1 0"}, {3, "poly brick 0 1 0 1 0 1 grup top"}, {3, "poly brick 0 1 0 1 0 1 group pot", 14},
    {3, "poly brick 0 1 0 1 0 1m group top"}, {4, "range name bass z -1 0", 8}, {4, "range name base z 0 -1"},
    {5, "prop mat 1 desn 2600"}, {5, "prop mat 1 dens -2600"}, {5, "prop mat 2 dens 2600"}, {5, "prop mat 1 dens"},
    {5, "", 24}, {6, "jmodel model morh"}, {6, "jmodel modle mohr"}, {7, "jmodel jkn 1e9 jks 1e9 jfirc 30"},
    {7, "jmodel jkn 1e9 jks 1e9 jfric 95"}, {7, "jmodel jkn 1e9 jks 1e9 sigmac 10"}, {7, "jmodel jkn 1GPa jks 1e9 jfric 30"},
    {7, "", 24}, {8, "fix range nrange bsae"}, {8, "fix range z -1 O"}, {8, "fix rnage z -1 0"}, {9, "gravity 0 -9.81"},
    {9, "gravity 0 0 -9,81"}, {10, "damp locl 0.8"}, {10, "damp local 80"}, {11, "table 2 0 0 1 1", 14},
    {11, "table 1 read nosuch.tab"}, {12, "hist unbalanced-force"}, {13, "hist zdis 0.5 0.5"}, {13, "", 27},
    {14, "apply xload 100 hist table 3 range group top"}, {14, "apply xload 100 hist tabel 1 range group top"},
    {14, "apply xforce 100 range group top"}, {14, "apply xload 100 range group tpo"}, {16, "  b = b_near(0.5, 0.5, 0.5"},
    {16, "  b = b_naer(0.5, 0.5, 0.5)"}, {17, "  height = b_z(c)"}, {18, "ned", 20}, {20, "for b in blocks() od"},
    {20, "for b in blcoks() do"}, {21, "  prnt(b.volume)"}, {22, "endd", 23}, {24, "cycle 1e2"}, {24, "cylce 100"},
    {25, "print @hieght"}, {25, "call nosuch.3dd"}, {25, "restore nosuch"}, {26, "plot block displcement file a.png"},
    {26, "plot block displacement file nosuch/a.png"}, {26, "plot hist 5 file a.png"}, {27, "hist write 1 3 file a.csv"},
    {28, "save nosuch/end"}, {28, "save"}, {1, "hist write 1 file b.csv"}, {1, "fix range z 0 1"}, {1, "jmodel model morh jkn 1"},
    {1, "import nosuch.stl"}, {1, "lua nosuch.lua"}, {28, "hist xvel 0.5 0.5 1"},
};

const Edit zoned_faults[] = {
    {2, "block create brik 0 2 0 2 0 2"}, {3, "block cut joint-set dip 30 dip-directoin 90 origin 1 1 1"}, {4, "block group"},
    {5, "block zone generate edgelength -1"}, {5, "block zone generate egdelength 1"}, {6, "block property desnity 2600"},
    {6, "", 18}, {7, "block zone cmodel assign mohr"}, {7, "block zone cmodel assign elastic", 8}, {8, "block zone property bulk 1e9 shear 6e8 cohesion 1e6 frction 30"},
    {8, "block zone property bulk 1e9 shear 6e8 cohesion 1e6 friction 95"}, {9, "block contact jmodel assign moor"},
    {10, "block contact property stiffness-normal 1e10 stifness-shear 1e10 friction 30"}, {10, "", 18},
    {11, "block gridpoint apply velocity 0 0 range position-z 0"}, {11, "block gridpoint apply velocity 0 0 0 range group 'rokc'"},
    {12, "model gravty 0 0 -9.81"}, {13, "block history displacment-z position 1 1 2"}, {13, "", 20},
    {15, "  top = block.gp.dsip.z(block.gp.near(1, 1, 2))"}, {15, "  top = block.gp.disp.z(block.gp.near(1, 1, 2)"},
    {17, "block mechanical damping lcoal 0.8"}, {18, "model cycle many"}, {19, "[io.out(tpo)]"}, {20, "history export '4' file 'a.csv'"},
    {21, "model save 'nosuch/end'"}, {21, "model restore 'nosuch'"}, {21, "program call 'nosuch.dat'"}, {1, "model nwe"},
};

const Edit stope_faults[] = {
    {3, "call nosuch.3dd"}, {4, "set span = 6"}, {5, "set @depth = 400 m"}, {6, "poly brick -10 10 0 2 -10 10x"}, {6, "poly brick 10 -10 0 2 -10 10"},
    {7, "jset dip 60 dd 90 spacing 2 number 4 origin 0 1 id 1"}, {7, "jset dip 60 dd 90 spacing -2 number 4 origin 0 1 0 id 1"},
    {8, "jset dip 10 dd 270 spacng 2.5 number 3 origin 0 1 0 id 2"}, {9, "group block hanging range xx 0 10"}, {9, "group blok hanging range x 0 10"},
    {11, "gen edge"}, {11, "gen edge 0"}, {12, "prop mat 1 dens 2700 bulk 5e9 sheer 3e9"}, {12, "prop mat 1 dens 2700 bulk 5e9"},
    {12, "prop mat 2 dens 2700 bulk 5e9 shear 3e9", 6}, {13, "zone model mohr-columb"}, {14, "zone property cohesion 2e6 friction 35 tensoin 2e5"},
    {14, "zone property cohesion 2e6 friction 135 tension 2e5"}, {13, "zone model elastic", 14}, {15, "jmodel model barton-bandi"},
    {16, "jmodel jkn 2e10 jks 1e10 resfric 28 jrco 8 jcso 8e7 sigmac 1e8 lo 0.1 ln"},
    {16, "jmodel jkn -2e10 jks 1e10 resfric 28 jrco 8 jcso 8e7 sigmac 1e8 lo 0.1 ln 1"}, {17, "insitu stress -8e6 -6e6 -1.1e7 0 0"},
    {17, "insitu stress 8e6 6e6 1.1e7 0 0 0 zgrad 0 0 27000 0 0 0"}, {18, "bound xvel range x -10"}, {19, "bound xvel 0 range group sidewall"},
    {23, "bound stress 0 0 -1.1e7 range z 10"}, {24, "gravity 0 0"}, {25, "table 5 0 0 1"}, {26, "hist ncyc 0 unbal"}, {27, "hist zdisp 0 1 three"},
    {28, "solve ratio 1e-5 cycles 5e2"}, {28, "solve ratio 1e-5 and"}, {29, "reset displ stress hits"}, {30, "excavate range x 3 -3 z -3 3"},
    {30, "excavate rang group hangin"}, {31, "structure cable 0 1 3 0 1 3 segments 6 prop 4"}, {31, "structure cable 0 1 3 0 1 9 segments 6 prop 3"},
    {32, "structure property 4 area 5e-4 yung 2e11 yield 2.5e5 kbond 1e7 sbond 2e5"},
    {32, "structure property 4 area -5e-4 young 2e11 yield 2.5e5 kbond 1e7 sbond 2e5"}, {34, "  local top = block.gp.naer(0, 1, 3)"},
    {35, "  closure = block.gp.disp.z(tpo)"}, {36, "edn", 33}, {37, "fish history closrue"}, {38, "cycle -200"},
    {39, "[io.out('closure ' + string(closr))]"}, {39, "[io.out('closure ' + string(closure)]"}, {42, "local worst = minimun(\"gridpoint\", \"z\")"},
    {43, "print((\"worst %g\"):format(worst)", 44}, {44, "end lua", 41}, {47, "plot block szz cut dip 90 dd 0 origin 0 1 file stope.png"},
    {47, "plot block szzz cut dip 90 dd 0 origin 0 1 0 file stope.png"}, {48, "plot hist 2 4 vs 1 file curve.svg"},
    {50, "list zones range x -3 3 z 5 3"}, {50, "list zone stres range x -3 3 z 3 5"}, {51, "vtk wrte stope"}, {52, "save out/stope"},
};

/// Lines that are as right as those in their place.
const Edit rigid_changes[] = {
    {1, "; a comment"}, {1, "title"}, {2, "poly brick 0,2 0,2 -1,0"}, {2, "POLY BRICK (0,2) (0,2) (-1,0)"}, {2, "poly br 0 2 0 2 -1 0 ; base"},
    {2, "poly brick 0 2 0 2 -1 0;base"}, {3, "poly brick 0 1 0 1 0 1 group TOP"}, {3, "poly brick 0 1 0 1 0 1\ngroup block top range z 0 1"},
    {4, "range name BASE z -1 0"}, {5, "prop mat=1 density=2600"}, {5, "property mat 1 dens 2600 k 1e9 g 6e8"}, {6, ""},
    {6, "jmodel model barton-bandis\njmodel model mohr"}, {7, "jmodel stiffness-normal 1e9 stiffness-shear 1e9 friction 30"},
    {7, "prop jmat 1 jkn 1e9 jks 1e9 jfric 30"}, {8, "fix range z -1 0"}, {8, "fix z -1 0"}, {8, "bound xvel 0 yvel 0 zvel 0 range z -1 0"},
    {9, "set gravity 0 0 -9.81"}, {10, "damp auto"}, {10, ""}, {11, "table 1 0,0 1,1 2,0"}, {12, "hist unbal ncyc 10"},
    {14, "apply xload 100 hist sine 5 range group top"}, {14, "apply xload 100 range z 0 1"}, {15, "define height"},
    {24, "step 100"}, {24, "solve ratio 1e-4 cycles 100"}, {24, "cycle 50\ncycle 50"}, {25, "list max"}, {26, "plot block disp cut dip 90 dd 0 origin 0 0 0 file a.png"},
    {26, "plot hist 1 2 file a.png"}, {26, "plot add block"}, {27, "hist write 2 vs 1"}, {28, "save 'the end'"}, {28, "quit"},
};

const Edit zoned_changes[] = {
    {1, "; a comment"}, {1, "model new\nmodel large-strain on"}, {2, "block create brick (0,2) (0,2) (0,2) group 'x'"}, {3, "block cut joint-set dip 30 dip-direction 90 spacing 0.7 number 2 origin 1 1 1"},
    {4, "block group 'rock' range position-z 0 2"}, {5, "block zone gen edge 1"}, {7, "block zone cmodel assign elastic\nblock zone cmodel assign mohr-coulomb"},
    {8, "block zone property young 1e9 poisson 0.2 cohesion 1e6 friction 30"}, {11, "block gridpoint apply velocity 0 0 0 range group 'rock' position-z 0"},
    {13, "block history displacement-z position 1 1 2\nmodel history mechanical ratio"}, {17, "block mechanical damping global"}, {18, "model solve ratio 1e-3 cycles 100"},
    {19, "[top]"}, {20, "history export 1 file 'a.csv'"}, {21, "program return"}, {21, "model save \"end\""},
};
// clang-format on

std::string text_of(const Lines& deck, const Edit* edit) {
    std::string text;
    for (std::size_t i = 0; i < deck.size(); ++i) {
        const bool changed = edit != nullptr && static_cast<std::size_t>(edit->line) == i + 1;
        text += (changed ? edit->text : deck[i]) + std::string("\n");
    }
    return text;
}

DeckReport report_on(const std::string& text) {
    const test::ScratchFolder folder;
    test::put(folder.path() / "a.3dd", text);
    return check_deck("a.3dd", {folder.path()}, {KAYA_TEST_JOINTS});
}

/// Of a report: lines that say more than that a word is ignored.
std::vector<ReportLine> findings_of(const DeckReport& report) {
    auto lines = report.lines;
    std::erase_if(lines, [](const ReportLine& line) { return line.outlook == Outlook::ignored; });
    return lines;
}

template <std::size_t n> void expect_found(const Lines& deck, const Edit (&faults)[n]) {
    for (const Edit& fault : faults) {
        const auto found = findings_of(report_on(text_of(deck, &fault)));
        const int line = fault.found == 0 ? fault.line : fault.found;
        EXPECT_TRUE(std::ranges::any_of(found, [&](const ReportLine& at) { return at.line == line; }))
            << "line " << fault.line << ": " << fault.text << "\n"
            << (found.empty() ? "nothing is found"
                              : found.front().text + " at line " + std::to_string(found.front().line));
    }
}

template <std::size_t n> void expect_right(const Lines& deck, const Edit (&changes)[n]) {
    for (const Edit& change : changes) {
        const auto found = findings_of(report_on(text_of(deck, &change)));
        EXPECT_TRUE(found.empty()) << change.text << "\n" << found.front().text << " at line " << found.front().line;
    }
}

TEST(FaultsOfDecks, AreFound) {
    static_assert(std::size(rigid_faults) + std::size(zoned_faults) + std::size(stope_faults) >= 140);
    expect_found(rigid, rigid_faults);
    expect_found(zoned, zoned_faults);
    expect_found(stope, stope_faults);
}

TEST(FaultsOfDecks, AreNotSeenInRightOnes) {
    EXPECT_TRUE(findings_of(report_on(text_of(rigid, nullptr))).empty());
    EXPECT_TRUE(findings_of(report_on(text_of(zoned, nullptr))).empty());
    EXPECT_TRUE(findings_of(report_on(text_of(stope, nullptr))).empty());
    expect_right(rigid, rigid_changes);
    expect_right(zoned, zoned_changes);
}

/// Whether the comments of a deck say that it gets a message or more files than its own.
bool is_more_than_right(const fs::path& deck) {
    std::ifstream in(deck);
    std::ostringstream text;
    text << in.rdbuf();
    const std::string words = text.str();
    return std::ranges::any_of(std::array{";!", ";needs", ";first"},
                               [&](const char* mark) { return words.find(mark) != std::string::npos; });
}

TEST(FaultsOfDecks, AreNotSeenInExamplesAndTests) {
    std::size_t decks = 0;
    for (const fs::path folder : {KAYA_DECKS, KAYA_EXAMPLES})
        for (const auto& entry : fs::recursive_directory_iterator(folder)) {
            const fs::path& deck = entry.path();
            if (deck.extension() != ".3dd" || is_more_than_right(deck)) continue;
            const auto report = check_deck(deck.string(), {deck.parent_path()}, {KAYA_TEST_JOINTS, KAYA_TEST_PLUGINS});
            const auto found = findings_of(report);
            EXPECT_TRUE(found.empty()) << deck << ":" << found.front().line << ": " << found.front().text;
            ++decks;
        }
    EXPECT_GE(decks + std::size(rigid_changes) + std::size(zoned_changes), 100u);
}

} // namespace
} // namespace kaya
