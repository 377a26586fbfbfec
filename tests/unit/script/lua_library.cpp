// Features of a Lua chunk in a deck.
#include "fake_world.hpp"
#include "tests/unit/scratch_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <unistd.h>

namespace kaya::script::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A separate working folder of the test.
class Folder {
public:
    Folder() : before_(std::filesystem::current_path()) { std::filesystem::current_path(folder_.path()); }
    ~Folder() { std::filesystem::current_path(before_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    static void write(const std::string& name, const std::string& text) { kaya::test::put(name, text); }
    static std::string read(const std::string& name) { return kaya::test::content_of(name); }

private:
    kaya::test::ScratchFolder folder_;
    std::filesystem::path before_;
};

TEST(LuaLibrary, ListsWalkOverTheModel) {
    Stage s(3, 2);
    s.lua("local n = 0\nfor c in contacts() do for p in c:sub_contacts() do n = n + 1 end end\n"
          "local m = 0\nfor p in sub_contacts() do m = m + 1 end\n"
          "print(n, m, count('contact'), count('block'))");
    EXPECT_THAT(s.printed, ElementsAre("6\t6\t3\t1"));
}

TEST(LuaLibrary, HistoriesAreReadByTheirLabels) {
    Stage s;
    s.lua("local h = history['tau']\nprint(#h.values, h.minimum, h.maximum, h.last, h.times[3])\n"
          "print((select(2, pcall(function() return history.sigma end))))\n"
          "print((select(2, pcall(function() history.tau = 3 end))))");
    EXPECT_THAT(s.printed,
                ElementsAre("3\t1.0\t5.0\t3.0\t0.3", "there is no history 'sigma'", "histories can be read, not set"));
}

TEST(LuaLibrary, FieldsAreReadAndWrittenByName) {
    Stage s;
    s.lua("for p in sub_contacts() do p.normal_force = 3 end\nmodel.damping = 0.25\n"
          "for b in blocks() do b.velocity = vector(1, 2, 3) end\n"
          "local c = nearest('contact', 7, 8, 9)\nprint(c.id, c.normal, c.block, c.alive, model.time, "
          "model.cycle)\n"
          "print(nearest('contact', vector(0,0,0)) == c, c)");
    EXPECT_EQ(s.world.normal_force, std::vector<double>(8, 3.0));
    EXPECT_EQ(s.world.damping, 0.25);
    EXPECT_EQ(s.world.velocity, Vec3(1, 2, 3));
    EXPECT_THAT(s.printed, ElementsAre("1\t(0,0,1)\tblock 1\ttrue\t0.25\t100", "true\tcontact 1"));
}

TEST(LuaLibrary, NullIsNil) {
    Stage s;
    s.lua("local i = 0\nfor c in contacts() do i = i + 1; print(i, c.block) end");
    EXPECT_THAT(s.printed, ElementsAre("1\tblock 1", "2\tnil"));
}

TEST(LuaLibrary, Reductions) {
    Stage s;
    s.lua("local total = 0\nfor p in sub_contacts() do total = total + p.normal_force end\n"
          "assert(sum('sub_contact', 'normal_force') == total)\n"
          "assert(mean('sub_contact', 'normal_force') == total / 8)");
}

TEST(LuaLibrary, Vectors) {
    Stage s;
    s.lua("local a, b = vector(1, 2, 3), vector(0, 0, 2)\n"
          "print(a + b, a - b, -a, a * 2, 2 * a, a / 2, a * b)\n"
          "print(a:dot(b), b:length(), b:unit(), a:cross(b), a.x + a.y + a.z, a == vector(1, 2, 3))");
    EXPECT_THAT(s.printed, ElementsAre("(1,2,5)\t(1,2,1)\t(-1,-2,-3)\t(2,4,6)\t(2,4,6)\t(0.5,1,1.5)\t(0,0,6)",
                                       "6.0\t2.0\t(0,0,1)\t(4,-2,0)\t6.0\ttrue"));
}

TEST(LuaLibrary, TextsBehaveAsInLua) {
    Stage s;
    s.lua("print('10' + 5, '3' * '4', 'a' .. 1, ('x'):rep(3))");
    EXPECT_THAT(s.printed, ElementsAre("15\t12\ta1\txxx"));
}

TEST(LuaLibrary, HooksRunAtTheirMomentAndInterval) {
    Stage s;
    s.lua("log = ''\n"
          "hook.before_cycle(function() log = log .. 'b' end)\n"
          "hook.after_forces(function() log = log .. 'f' end)\n"
          "every = hook.after_cycle(function() log = log .. 'a' end, 2)");
    for (std::int64_t cycle = 1; cycle <= 4; ++cycle)
        for (const Moment m : {Moment::before_cycle, Moment::after_forces, Moment::after_cycle})
            s.scripts.run_hooks(m, cycle);
    s.lua("print(log)\nhook.remove(every)");
    EXPECT_THAT(s.printed, ElementsAre("bfbfabfbfa"));
    EXPECT_FALSE(s.scripts.has_hooks(Moment::after_cycle));
    EXPECT_TRUE(s.scripts.has_hooks(Moment::after_forces));
}

TEST(LuaLibrary, FishAndLuaSeeEachOther) {
    Stage s;
    s.fish("def twice(n)\n twice = n * 2\n total = total + 1\nend");
    s.fish("def ask\n ask = Answer(1) + tell\n if yes\n ask = ask + 100\n endif\n if nothing_at_all = 0\n "
           "ask = ask + 1000\n endif\nend");
    s.lua("function answer(x) return fish.twice(x) + 40 end\nfunction tell() return 0.5 end\n"
          "function yes() return true end\nfunction nothing_at_all() end\nfish.Start = 7\n"
          "fish.list = {5, 6}\nprint(fish.START, fish.total)");
    EXPECT_EQ(s.value("ask"), Value(1142.5));
    EXPECT_EQ(s.value("start"), Value(std::int64_t{7}));
    EXPECT_EQ(s.value("[list(2)]"), Value(std::int64_t{6}));
    EXPECT_EQ(s.value("@answer(2)"), Value(std::int64_t{44}));
    EXPECT_THAT(s.printed, ElementsAre("7\t0"));
    EXPECT_THAT(message_of([&] { s.lua("fish.twice()"); }),
                HasSubstr("'twice' takes 1 argument, here it is given none"));
}

TEST(LuaLibrary, ANameThatWasAVariableBecomesALuaFunction) {
    Stage s;
    s.fish("def f\n f = late\nend");
    EXPECT_EQ(s.value("f"), Value(std::int64_t{0}));
    s.lua("function late() return 9 end");
    EXPECT_EQ(s.value("f"), Value(std::int64_t{9}));
}

TEST(LuaLibrary, CommandsGoToTheWorldWithTheirLine) {
    Stage s;
    s.lua("\ncommand [[poly brick 0,1\ngen edge 1]]");
    ASSERT_EQ(s.world.commands.size(), 1);
    EXPECT_EQ(s.world.commands[0].text, "poly brick 0,1\ngen edge 1");
    EXPECT_EQ(s.world.commands[0].chunk, "test.3ddat");
    EXPECT_EQ(s.world.commands[0].line, 2);
}

TEST(LuaLibrary, HistoriesOfFunctionsAndNames) {
    Stage s;
    s.fish("def watch\n watch = 3\nend");
    s.lua("history.add('watch')\nhistory.add(function() return model.time * 2 end)");
    ASSERT_EQ(s.world.commands.size(), 2);
    EXPECT_EQ(s.world.commands[0].text, "history @watch");
    EXPECT_EQ(s.world.commands[1].text, "history @lua_history_1");
    EXPECT_EQ(s.number("@lua_history_1"), 0.5);
    EXPECT_EQ(s.number("@watch"), 3);
}

TEST(LuaLibrary, PairsHasAFixedOrder) {
    Stage s;
    s.lua("local t = {zeta = 1, alpha = 2, [3] = 'c', [1] = 'a', mid = 3}\nlocal words = {}\n"
          "for k, v in pairs(t) do words[#words + 1] = k .. '=' .. v; t[k] = nil "
          "end\nprint(table.concat(words, ' '), next(t))\n"
          "for c in contacts() do t[c] = c.id end\nfor c, id in pairs(t) do print(id) end");
    EXPECT_THAT(s.printed, ElementsAre("1=a 3=c alpha=2 mid=3 zeta=1\tnil", "1", "2"));
}

TEST(LuaLibrary, RandomNumbersComeFromTheSeed) {
    Stage a, b;
    const std::string text =
        "local t = {}\nfor i = 1, 5 do t[i] = math.random(1, 1000) end\nprint(table.concat(t, ' '))\n"
        "local x = math.random()\nassert(x >= 0 and x < 1 and math.random(3) <= 3)";
    a.lua(text);
    b.lua(text);
    EXPECT_EQ(a.printed, b.printed);
    a.lua("math.randomseed(5)");
    b.lua("math.randomseed(5)");
    a.fish("def f\n f = urand\nend");
    b.fish("def f\n f = urand\nend");
    EXPECT_EQ(a.value("f"), b.value("f"));
}

TEST(LuaLibrary, RequireFindsModulesNextToTheDeck) {
    const Folder folder;
    std::filesystem::create_directories("parts");
    Folder::write("parts/wall.lua", "loads = (loads or 0) + 1\nreturn { height = 3 }");
    Folder::write("broken.lua", "local x = 1\nreturn x +");
    Folder::write("main.lua",
                  "local wall = require 'parts.wall'\nprint(wall.height, require('parts.wall') == wall, loads)");
    Stage s;
    s.scripts.run_lua_file("main.lua", {});
    EXPECT_THAT(s.printed, ElementsAre("3\ttrue\t1"));
    EXPECT_THAT(message_of([&] { s.lua("require 'broken'"); }),
                HasSubstr("broken.lua:2:1: error: unexpected symbol near <eof>"));
}

TEST(LuaLibrary, FilesOfLuaAndFishStayInTheFolder) {
    const Folder folder;
    Stage s;
    s.lua("local f = io.open('a.txt', 'w')\nf:write('one\\ntwo\\n')\nf:close()\nfor line in "
          "io.lines('a.txt') do print(line) end");
    EXPECT_THAT(s.printed, ElementsAre("one", "two"));
    s.fish("def f\n array line(3) words(4)\n status = open('a.txt', 0, 1)\n n = read(line, 3)\n status = close\n"
           " words(1) = line(2) + '!'\n words(2) = 2.5\n words(4) = vector(1,2,3)\n"
           " status = status + open('b.txt', 1, 1)\n status = status + write(words, 4)\n close\n"
           " f = n * 10 + open('missing', 0, 1) + status\nend");
    EXPECT_EQ(s.value("f"), Value(std::int64_t{21}));
    EXPECT_EQ(Folder::read("b.txt"), "two!\n 2.5\n 0\n (1,2,3)\n");
}

} // namespace
} // namespace kaya::script::test
