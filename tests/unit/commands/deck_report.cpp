// kaya check, and that the decks of the tests use every command.
#include "commands/session/deck_report.hpp"

#include "commands/session/session.hpp"
#include "lang/commands/commands.hpp"
#include "lang/commands/language.hpp"
#include "lang/fish/inner_commands.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace kaya {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// A temporary folder with decks.
class DeckReportTest : public testing::Test {
protected:
    void write(const char* name, const std::string& text) { test::put(folder_ / name, text); }
    DeckReport report(const char* name) { return check_deck(name, {folder_.path()}); }
    fs::path folder() const { return folder_.path(); }

private:
    test::ScratchFolder folder_;
};

TEST_F(DeckReportTest, ADeckThatRunsHasNoLines) {
    write("a.3dd", "poly brick 0 1\ndef f\n  f = 1\nend\nprint @f\n");
    const DeckReport found = report("a.3dd");
    EXPECT_TRUE(found.lines.empty());
    EXPECT_TRUE(found.can_run());
    EXPECT_EQ(found.text("a.3dd"), "a.3dd: 3 statements: 3 run");
}

TEST_F(DeckReportTest, EachKindOfLineIsNamed) {
    write("a.3dd", "poly brick 0 1\nlabel hist 1 &\n  hold\nset pagination off dyn on\nstruct pile 1 2\n"
                   "bound ff range x 0\ngen egde 1\ncycle 1.5\nhide range sregion 1\ncycle 1\n");
    const DeckReport found = report("a.3dd");
    EXPECT_EQ(found.text("a.3dd"),
              "a.3dd:2:1: ignored: label hist 1 hold\n"
              "a.3dd:4:1: ignored: set pagination\n"
              "a.3dd:5:8: not supported yet: 'structure pile' is known, but kaya does not support it yet; it is about "
              "piles: of structures there are cables, beams and liners\n"
              "a.3dd:6:7: not supported yet: 'boundary ff' is known, but kaya does not support it yet; it is about "
              "free fields at the sides of a model\n"
              "a.3dd:7:5: unknown: 'egde' is not a kind of generate; did you mean 'edge'?\n"
              "a.3dd:8:7: wrong: cycle takes a whole number, not 1.5; write it without a point or an exponent\n"
              "a.3dd:9:12: not supported yet: 'sregion' is known, but kaya does not support it yet; it is about "
              "regions of surfaces\n"
              "a.3dd: 9 statements: 2 run, 2 ignored, 3 not supported yet, 1 unknown, 1 wrong");
    EXPECT_FALSE(found.can_run());
}

TEST_F(DeckReportTest, CalledFilesAndCommandsInsideFunctionsAreChecked) {
    write("a.3dd", "call b\ndef f\n  loop i (1, 2)\n    if i = 1\n      command\n        gen egde 1\n"
                   "        poly brick [i] @j\n        save [name].sav\n      endcommand\n    endif\n  endloop\nend\n");
    write("b.3dd", "bound xvle 1\n");
    const DeckReport found = report("a.3dd");
    EXPECT_EQ(found.text("a.3dd"), "a.3dd:6:13: unknown: 'egde' is not a kind of generate; did you mean 'edge'?\n"
                                   "b:1:7: unknown: 'xvle' is not a keyword of boundary; did you mean 'xvel'?\n"
                                   "a.3dd: 6 statements: 4 run, 2 unknown");
}

TEST_F(DeckReportTest, NamesThatAreNeverDefinedAreUnknown) {
    write("a.3dd",
          "def build_wall(n)\n  height = n\n  command\n    gen edge @n\n  endcommand\nend\nset @load = 1\n[depth = 3]\n"
          "@bulid_wall(2)\nprint @height @load @time @depth\ngravity 0 0 @g\nprint @heigth\n");
    const DeckReport found = report("a.3dd");
    EXPECT_EQ(
        found.text("a.3dd"),
        "a.3dd:9:1: unknown: there is no FISH variable or function 'bulid_wall'; did you mean '@build_wall'?\n"
        "a.3dd:11:13: unknown: there is no FISH variable or function 'g'; give it a value before, set @g = 1, or define it: "
        "def g ... end\n"
        "a.3dd:12:7: unknown: there is no FISH variable or function 'heigth'; did you mean '@height'?\n"
        "a.3dd: 8 statements: 5 run, 3 unknown");
}

TEST_F(DeckReportTest, NamesOnlyReadOrOnlySetAreDoubtful) {
    write(
        "a.3dd",
        "def f\n  local here = frction\n  friction = 30\n  frictoin = 25\n  f = friction + here + depht(2)\n  intialise\nend\n"
        "def initialise\n  status = out('x')\n  global later\nend\nset @loadin = 3\nset @loading = 2\n"
        "print @f @loading @later\n");
    const DeckReport found = report("a.3dd");
    EXPECT_EQ(found.text("a.3dd"),
              "a.3dd:2:16: warning: nothing in this deck sets 'frction': it is 0; did you mean 'friction'?\n"
              "a.3dd:4:3: warning: nothing in this deck reads 'frictoin', which is set here; did you mean 'friction'?\n"
              "a.3dd:5:25: warning: 'depht' is neither a function nor an array\n"
              "a.3dd:6:3: warning: 'intialise' is not a function: this line does nothing; did you mean 'initialise'?\n"
              "a.3dd:12:1: warning: nothing in this deck reads 'loadin', which is set here; did you mean 'loading'?\n"
              "a.3dd: 5 statements: 5 run, 5 warnings");
    EXPECT_TRUE(found.can_run());
}

TEST_F(DeckReportTest, CountersTargetsOfLoopsAndArraysAreSet) {
    write(
        "a.3dd",
        "def f\n  array store(3)\n  loop row (1, 3)\n    store(row) = count\n    count = count + 1\n  endloop\n"
        "  loop foreach block block.list\n    x1 = b_id(block)\n    x2 = 3\n  endloop\n  f = store(2) + x1\nend\n[f]\n");
    EXPECT_EQ(report("a.3dd").text("a.3dd"), "a.3dd: 2 statements: 2 run");
}

TEST_F(DeckReportTest, CallsAreCounted) {
    write("a.3dd", "def f(a, b)\n  f = a + b\nend\ndef g\n  g = f(1) + cos(1, 2)\nend\n@f(1)\n@f(1, 2)\n[f(@g, 2)]\n");
    EXPECT_EQ(report("a.3dd").text("a.3dd"),
              "a.3dd:5:7: wrong: 'f' takes 2 arguments, here it is given 1; its arguments stand in its first line\n"
              "a.3dd:5:14: wrong: 'cos' takes 1 argument, here it is given 2; 'kaya help cos' names them\n"
              "a.3dd:7:1: wrong: 'f' takes 2 arguments, here it is given 1; its arguments stand in its first line\n"
              "a.3dd: 5 statements: 2 run, 3 wrong");
}

TEST_F(DeckReportTest, NamesInsideCommandBlocksAreChecked) {
    write(
        "a.3dd",
        "def f\n  local mine = 1\n  command\n    cycle @mine\n    cycle @sum\n    cycle @smu\n  endcommand\n  sum = 2\nend\n@f\n");
    EXPECT_EQ(report("a.3dd").text("a.3dd"),
              "a.3dd:6:11: unknown: there is no FISH variable or function 'smu'; did you mean '@sum'?\n"
              "a.3dd: 5 statements: 4 run, 1 unknown");
}

TEST_F(DeckReportTest, LuaIsReadBeforeItRuns) {
    write("a.3dd", "lua\nlocal a = 1\nlocal b == 2\nendlua\nlua tools.lua\n");
    write("tools.lua", "function f()\n  return 1 +\nend\n");
    const DeckReport found = report("a.3dd");
    ASSERT_EQ(found.lines.size(), 1u) << found.text("a.3dd");
    EXPECT_EQ(found.lines[0].outlook, Outlook::wrong);
    EXPECT_EQ(found.lines[0].line, 3);
    EXPECT_THAT(found.lines[0].text, HasSubstr("Lua cannot read this: "));
    write("b.3dd", "lua tools.lua\n");
    EXPECT_THAT(report("b.3dd").text("b.3dd"), HasSubstr("tools.lua:3:1: wrong: Lua cannot read this: "));
}

TEST_F(DeckReportTest, FilesThatACommandReadsAreSearched) {
    write("a.3dd", "poly brick 0 1\nsave base\nrestore base.kaya.h5\nrestore bsae\nimport a.obj\ncut ground b.xyz\n"
                   "water ground c.xyz\njmodel test mohr d.csv jkn 1 jks 1 jfric 1\n");
    const std::string search = "; it is searched next to the deck and in the current folder\n";
    EXPECT_EQ(report("a.3dd").text("a.3dd"), "a.3dd:4:9: wrong: there is no save file 'bsae'" + search +
                                                 "a.3dd:5:8: wrong: there is no geometry file 'a.obj'" + search +
                                                 "a.3dd:6:12: wrong: there is no surface file 'b.xyz'" + search +
                                                 "a.3dd:7:14: wrong: there is no surface file 'c.xyz'" + search +
                                                 "a.3dd:8:18: wrong: there is no CSV file 'd.csv'" + search +
                                                 "a.3dd: 8 statements: 3 run, 5 wrong");
    write("b.3dd", "poly brick 0 1\nrestore a.3dd\nwater off\n@f\ndef f\nend\n");
    EXPECT_TRUE(report("b.3dd").lines.empty());
}

/// A line, and what is found in it; a deck with all of them finds the same. Empty: nothing.
struct PropertyLine {
    const char* line;
    const char* found;
};
constexpr PropertyLine property_lines[] = {
    {"prop mat 1 desn 2600", "'desn' is not a property of blocks, nor of joints; did you mean 'dens"},
    {"prop mat 1 dens 0", "'density' is 0, but must be above 0"},
    {"prop mat 1 dens 2600 k 1e9 g 1e9 bcoh 1e5", ""},
    {"prop mat 1 prat 0.5 young 1e9", "'prat' is 0.5, but must be above -1 and below 0.5"},
    {"prop jmat 1 jfrci 30", "'jfrci' is not a property of joints; did you mean 'jfric"},
    {"prop jmat 1 jfric 950", "'jfric' is 950, but for joint model"},
    {"prop jmat 1 kn 1e9 ks 1e9 fric 30 resfriction 20", ""},
    {"prop jmat 1 jrco 8 jcso 1e8", ""}, // of a model that the deck names later
    {"prop jmat 1 jrco 8 jsco 1e8", "'jsco' is not a property of joints; did you mean 'jcso'"},
    {"prop mat 1 ratoi 3", "'ratoi' is not a property of blocks, nor of joints; did you mean '"},
    {"jmodel jfrci 18", "has no property 'jfrci'"},
    {"jmodel jkn 1e9 jks 1e9 jrco 8", ""},
    {"jmodel model barton-bandis jrcoo 8", "joint model 'barton-bandis' has no property 'jrcoo'; did you mean 'jrco'"},
    {"jmodel model mohr jcso 8", "joint model 'mohr' has no property 'jcso'"},
    {"jmodel model mohr jfric -1", "'jfric' is -1, but for joint model mohr it must be from 0 to 90"},
    {"zone model mohr-coulomb frictoin 30",
     "zone model 'mohr-coulomb' has no property 'frictoin'; did you mean 'friction'"},
    {"zone model mohr-coulomb friction 95", "'friction' is 95, but for zone model mohr-coulomb it must be"},
    {"zone property cohesoin 1", "has no property 'cohesoin'"},
    {"zone property cohesion 1e5", ""},
    {"prop mat 1 dens [2*0]", ""}, // known at run time only
};

TEST_F(DeckReportTest, WordsAndValuesOfPropertiesAreLookedUp) {
    const std::string named = "jmodel load barton-bandis\n";
    std::string all;
    std::size_t wrong = 0;
    for (const auto& [line, found] : property_lines) {
        write("a.3dd", line + ("\n" + named));
        all += line + std::string("\n");
        const auto lines = check_deck("a.3dd", {folder()}, {KAYA_TEST_JOINTS}).lines;
        if (*found == '\0') {
            EXPECT_TRUE(lines.empty()) << line << ": " << lines.front().text;
            continue;
        }
        ++wrong;
        ASSERT_EQ(lines.size(), 1u) << line;
        EXPECT_THAT(lines[0].text + "; " + lines[0].hint, HasSubstr(found)) << line;
        EXPECT_EQ(lines[0].line, 1);
        EXPECT_GT(lines[0].column, 6) << line;
    }
    write("a.3dd", all + named);
    EXPECT_EQ(check_deck("a.3dd", {folder()}, {KAYA_TEST_JOINTS}).lines.size(), wrong);
}

// A line inside a function may not be reached.
TEST_F(DeckReportTest, PropertiesInsideFunctionsAreWarnings) {
    write("a.3dd", "def f\n  if 1 = 2\n    command\n      prop mat 1 dens -1\n    endcommand\n  endif\nend\n@f\n");
    const DeckReport found = check_deck("a.3dd", {folder()}, {KAYA_TEST_JOINTS});
    EXPECT_TRUE(found.can_run());
    EXPECT_THAT(found.text("a.3dd"), HasSubstr("a.3dd:4:18: warning: 'density' is -1, but must be above 0"));
}

// A model of another folder, a restored model, a model of a script, and a file that is not read may have any property.
TEST_F(DeckReportTest, PropertiesOfUnknownModelsAreNotDoubted) {
    write("saved.kaya.h5", "");
    write("tools.lua", "command 'jmodel load mine'");
    for (const char* first : {"jmodel load mine", "jmodel load ./mine.so", "zone load ./mine.so", "restore saved",
                              "lua\ncommand 'jmodel load mine'\nendlua", "lua tools.lua", "jmodel model [name]",
                              "def f\n  command\n    jmodel load mine\n  endcommand\nend\n@f"}) {
        write("a.3dd", first + std::string("\nprop jmat 1 roughness 30\njmodel roughness 30\n"));
        for (const auto& line : check_deck("a.3dd", {folder()}, {KAYA_TEST_JOINTS}).lines)
            EXPECT_THAT(line.text, testing::Not(HasSubstr("roughness"))) << first;
    }
}

TEST_F(DeckReportTest, FilesOfTablesAreSearched) {
    write("a.3dd", "table 1 read wave.tab\n");
    EXPECT_THAT(report("a.3dd").text("a.3dd"), HasSubstr("a.3dd:1:14: wrong: there is no table file 'wave.tab'"));
    write("wave.tab", "wave\n2 0.1\n0\n1\n");
    EXPECT_TRUE(report("a.3dd").can_run());
    write("b.3dd", "hist time\ncycle 1\nhist write 1 file mine.tab\ntable 2 read mine.tab\n");
    EXPECT_TRUE(report("b.3dd").can_run()) << report("b.3dd").text("b.3dd");
    write("c.3dd", "def f\n  a = open('mine.tab', 1, 1)\nend\n@f\ntable 2 read mine.tab\n");
    EXPECT_TRUE(report("c.3dd").can_run()) << report("c.3dd").text("c.3dd");
}

TEST_F(DeckReportTest, NamesMayComeFromLuaAndFromSavedModels) {
    write("a.3dd", "lua\nx = 1\nendlua\nprint @x\n");
    EXPECT_TRUE(report("a.3dd").can_run());
    write("settled.kaya.h5", "");
    write("b.3dd", "restore settled\nprint @x\n");
    EXPECT_TRUE(report("b.3dd").can_run());
    write("c.3dd", "set @name = 'other.dat'\ncall @name\nprint @x\n");
    EXPECT_TRUE(report("c.3dd").can_run());
}

TEST_F(DeckReportTest, FishNamesWithoutSupportAreCountedAsSuch) {
    write("a.3dd", "def f\n  a = cable_head\nend\n");
    EXPECT_EQ(report("a.3dd").count(Outlook::not_supported), 1u);
}

TEST_F(DeckReportTest, AFunctionThatDoesNotCompileIsWrong) {
    write("a.3dd", "def f\n  f = (1\nend\n");
    const DeckReport found = report("a.3dd");
    ASSERT_EQ(found.lines.size(), 1u);
    EXPECT_EQ(found.lines[0].outlook, Outlook::wrong);
    EXPECT_EQ(found.lines[0].line, 2);
}

TEST_F(DeckReportTest, AllMistakesOfALongDeckAreCounted) {
    std::string text;
    for (int i = 0; i < 100; ++i) text += "gen egde 1\n";
    write("a.3dd", text);
    EXPECT_EQ(report("a.3dd").count(Outlook::unknown), 100u);
}

TEST_F(DeckReportTest, AMissingDeckIsAMistake) { EXPECT_THROW(report("none.3dd"), Diagnostic); }

TEST(Decks, ThatRunAreCheckedAsSuch) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(KAYA_DECKS)) {
        if (entry.path().extension() != ".3dd") continue;
        ++count;
        const DeckReport found = check_deck(entry.path().string(), {KAYA_DECKS, fs::path(KAYA_DECKS) / "parts"});
        EXPECT_TRUE(found.can_run()) << found.text(entry.path().filename().string());
    }
    EXPECT_GT(count, 30);
}

/// Names of the commands that a file binds to, including those in functions and called files.
void gather(const lang::BoundFile& file, const lang::BareNames& bare, std::set<std::string>& names) {
    for (const auto& step : file.steps) {
        names.insert(step.command.spec->name());
        if (step.called) gather(*step.called, bare, names);
        const auto* definition = std::any_cast<lang::FishDefinition>(&step.command.command);
        if (definition == nullptr) continue;
        const auto function = fish::read_function(definition->text, definition->place);
        for (const auto& inner : fish::inner_commands(function)) {
            lang::Lexer lexer(definition->place.source, inner.line);
            lang::Statement words;
            if (!inner.joined && lexer.next(words))
                names.insert(lang::bind_with_names(lang::classic(), words, bare).spec->name());
        }
    }
}

TEST(Decks, UseEveryCommand) {
    std::set<std::string> used;
    for (const auto& entry : fs::directory_iterator(KAYA_DECKS)) {
        if (entry.path().extension() != ".3dd") continue;
        const lang::ReadDeck deck =
            lang::read_deck(lang::classic(), entry.path().string(), {KAYA_DECKS, fs::path(KAYA_DECKS) / "parts"});
        gather(*deck.file, deck.names, used);
    }
    for (const auto& family : lang::classic().families)
        for (const auto& command : family.commands)
            if (command.support != lang::Support::not_yet) {
                EXPECT_TRUE(used.contains(command.name())) << "no deck of tests/decks uses " << command.name();
            }
}

} // namespace
} // namespace kaya
