// Errors while scripts run: the complete message for the user.
#include "fake_world.hpp"

#include <gmock/gmock.h>

namespace kaya::script::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Message of a function `f` with these lines, without position and call stack.
std::string fish_message(const std::string& body) {
    Stage s;
    s.fish("def f\n" + body + "\nend\n");
    try {
        s.scripts.call("f");
    } catch (const Diagnostic& d) {
        EXPECT_TRUE(d.place) << body;
        EXPECT_EQ(d.fault, Fault::run) << body;
        return d.hint.empty() ? d.message : d.message + " | " + d.hint;
    }
    return "no error";
}

std::string lua_message(const std::string& text) {
    Stage s;
    try {
        s.lua(text);
    } catch (const Diagnostic& d) {
        EXPECT_TRUE(d.place) << text;
        return d.hint.empty() ? d.message : d.message + " | " + d.hint;
    }
    return "no error";
}

TEST(ScriptErrors, LineAndStackOfFunctions) {
    Stage s;
    s.fish("def g(n)\n g = 1 / n ; by nothing\nend\n");
    const std::string text = "\n\n\ndef f\n a = 1\n f = g(a - 1)\nend\n";
    s.scripts.define_fish("def f\n a = 1\n f = g(a - 1)\nend\n", deck(text, 4));
    EXPECT_EQ(message_of([&] { s.scripts.call("@f"); }), "test.3ddat:2:2: error: division by zero\n"
                                                         "     2 |  g = 1 / n ; by nothing\n"
                                                         "       |  ^^^^^^^^^\n"
                                                         "  in FISH function 'g', test.3ddat:2\n"
                                                         "  in FISH function 'f', test.3ddat:6");
}

TEST(ScriptErrors, StackThroughLuaAndCommands) {
    Stage s;
    s.fish("def deep\n deep = 1 / 0\nend\n");
    s.fish("def outer\n command\n  go\n endcommand\nend\n");
    s.lua("function middle()\n    return fish.deep()\nend\n");
    s.world.on_command = [&](const std::string&) { s.scripts.call("@middle"); };
    EXPECT_EQ(message_of([&] { s.scripts.call("@outer"); }), "test.3ddat:2:2: error: division by zero\n"
                                                             "     2 |  deep = 1 / 0\n"
                                                             "       |  ^^^^^^^^^^^^\n"
                                                             "  in FISH function 'deep', test.3ddat:2\n"
                                                             "  in a Lua function, test.3ddat:2\n"
                                                             "  in FISH function 'outer', test.3ddat:3");
}

TEST(ScriptErrors, FishArithmetic) {
    EXPECT_EQ(fish_message("a = 0\nb = 1 / a"), "division by zero");
    EXPECT_EQ(fish_message("b = 1.0 / 0.0"), "division by zero");
    EXPECT_EQ(fish_message("b = 0 ^ -1"), "division by zero");
    EXPECT_EQ(fish_message("b = vector(1,2,3) / 0"), "division by zero");
    EXPECT_EQ(fish_message("b = 'a' * 2"), "the text 'a' and the integer 2 cannot be multiplied");
    EXPECT_EQ(fish_message("b = 'a' - 'b'"), "the text 'a' and the text 'b' cannot be subtracted");
    EXPECT_EQ(fish_message("b = -'a'"), "the text 'a' has no negative");
    EXPECT_EQ(fish_message("b = contact_head + 1"), "a pointer to contact 1 and the integer 1 cannot be added");
    EXPECT_EQ(fish_message("b = vector(1,2,3) * 'a'"), "the vector (1,2,3) and the text 'a' cannot be multiplied");
    EXPECT_EQ(fish_message("array a(3)\nb = a + 1"), "an array and the integer 1 cannot be added");
    EXPECT_EQ(fish_message("if 'a' > 1\nendif"), "the integer 1 and the text 'a' cannot be compared by size");
    EXPECT_EQ(fish_message("if contact_head > 1\nendif"),
              "the integer 1 and a pointer to contact 1 cannot be compared by size");
    EXPECT_EQ(fish_message("b = (-8) ^ 0.5"), "the negative number -8 has no power 0.5");
    EXPECT_EQ(fish_message("b = sqrt(-1)"), "'sqrt' is given -1; it takes no negative number");
    EXPECT_EQ(fish_message("b = ln(0)"), "'ln' is given 0; it takes numbers above 0");
    EXPECT_EQ(fish_message("b = acos(1.5)"), "'acos' is given 1.5; it takes numbers from -1 to 1");
    EXPECT_EQ(fish_message("b = sin('a')"), "the argument of 'sin' must be a number, here it is the text 'a'");
    EXPECT_EQ(fish_message("b = int('two')"), "'int' is given the text 'two', which is not a number");
    EXPECT_EQ(fish_message("b = unit(vector(0,0,0))"), "'unit' is given a vector of length zero");
    EXPECT_EQ(fish_message("b = dot(vector(0,0,0), 3)"),
              "argument 2 of 'dot' must be a vector, here it is the integer 3");
}

TEST(ScriptErrors, FishPointers) {
    EXPECT_EQ(fish_message("c = 0\nb = c_id(c)"),
              "'c_id' is given a null pointer | test the pointer against 0 before its contact is used");
    EXPECT_EQ(fish_message("b = c_next(0)"),
              "'c_next' is given a null pointer | test the pointer against 0 before it is used");
    EXPECT_EQ(fish_message("b = c_id(block_head)"),
              "'c_id' needs a pointer to a contact, here it is given a pointer to block 1");
    EXPECT_EQ(fish_message("b = c_cx(3.5)"), "'c_cx' needs a pointer to a contact, here it is given the number 3.5");
    EXPECT_EQ(fish_message("b = cx_nforc(contact_head)"),
              "'cx_nforc' is neither a function nor an array | did you mean 'cx_nforce'?");
    EXPECT_EQ(fish_message("b = b_near(1, 2)"), "'b_near' needs a place: three coordinates or one vector");
    EXPECT_EQ(fish_message("command\ntitle [contact_head]\nendcommand"),
              "a pointer cannot stand in a command | use its number, as in [b_id(p)]");
}

TEST(ScriptErrors, DeletedObjectsAreRecognised) {
    Stage s;
    s.fish("def f\n f = c_id(c)\nend");
    s.fish("def keep\n c = contact_head\nend");
    s.scripts.call("keep");
    s.world.generation = 2;
    EXPECT_THAT(message_of([&] { s.scripts.call("f"); }),
                StartsWith("test.3ddat:2:2: error: this object no longer exists"));
    s.lua("kept = fish.c\nprint(kept.alive)");
    EXPECT_EQ(s.printed.back(), "false");
    EXPECT_THAT(message_of([&] { s.lua("print(kept.id)"); }), HasSubstr("this object no longer exists"));
}

TEST(ScriptErrors, FishArrays) {
    EXPECT_EQ(fish_message("array a(3)\na(4) = 1"),
              "a(4) is outside of the array a(3) | indices are whole numbers and count from 1");
    EXPECT_EQ(fish_message("array a(3)\nb = a(0)"),
              "a(0) is outside of the array a(3) | indices are whole numbers and count from 1");
    EXPECT_EQ(fish_message("array a(3)\nb = a(1.5)"),
              "a(1.5) is outside of the array a(3) | indices are whole numbers and count from 1");
    EXPECT_EQ(fish_message("array a(3,2)\nb = a(1)"),
              "the array a(3,2) has 2 indices, here it is given 1 | give one for each dimension");
    EXPECT_EQ(fish_message("array a(3,2)\na(1,3) = 0"),
              "a(1,3) is outside of the array a(3,2) | indices are whole numbers and count from 1");
    EXPECT_EQ(fish_message("array a(3)\nb = a(1,1)"),
              "the array a(3) has 1 index, here it is given 2 | give one for each dimension");
    EXPECT_EQ(fish_message("a = 3\nb = a(1)"), "'a' is not an array but the integer 3");
    EXPECT_EQ(fish_message("a(1,2) = 5"),
              "'a' is neither a function nor an array | define it, or make the array with: array a(n)");
    EXPECT_EQ(fish_message("array a(0)"),
              "the size of the array 'a' is the integer 0 | a size is a whole number above 0");
    EXPECT_EQ(fish_message("array a(100000,100000)"),
              "the array 'a' has too many elements | at most 134217728 are possible");
    EXPECT_EQ(fish_message("loop foreach x 3\nendloop"), "'loop foreach' needs a list, here it is given the integer 3");
    EXPECT_EQ(fish_message("b = nothing()"), "'nothing' is not a function but the integer 0");
}

TEST(ScriptErrors, FishOther) {
    EXPECT_EQ(fish_message("loop i (1,2,0)\nendloop"),
              "the step of a loop is the integer 0 | it must be a number other than 0");
    EXPECT_EQ(fish_message("error = 'the wall fell'"), "the wall fell");
    EXPECT_EQ(fish_message("f = f()"),
              "functions call each other too deeply | a function that calls itself needs a way to end");
    EXPECT_EQ(fish_message("b = table(4, 1)"), "table 4 holds no point | fill it before it is read");
    EXPECT_EQ(fish_message("ytable(4, 2) = 1"), "table 4 holds no point | fill it before it is read");
    EXPECT_EQ(fish_message("table(4, 1) = 1\nb = xtable(4, 2)"), "table 4 has points 1 to 1, not 2");
    EXPECT_EQ(fish_message("b = open('../x', 0, 1)"),
              "'../x' is outside of the folders that this run may use | allow it once for all with: kaya allow ..");
    EXPECT_EQ(fish_message("b = open('x', 0, 0)"),
              "FISH's own binary files cannot be read or written | use 1 as third argument: plain text");
}

TEST(ScriptErrors, UnknownNamesInACommand) {
    Stage s;
    s.fish("def watch\n sstav = 1\nend");
    EXPECT_EQ(message_of([&] { s.scripts.number("@sstat", deck("hist @sstat\n")); }),
              "test.3ddat:1:1: error: there is no FISH variable or function 'sstat'\n"
              "     1 | hist @sstat\n"
              "       | ^ did you mean 'sstav'?");
    EXPECT_THAT(message_of([&] { s.scripts.call("@wach"); }), HasSubstr("did you mean 'watch'?"));
    EXPECT_THAT(message_of([&] { s.scripts.set("@watch", Value(1.0)); }), HasSubstr("'watch' is a FISH function"));
    EXPECT_THAT(message_of([&] { s.scripts.set("@sin", Value(1.0)); }), HasSubstr("'sin' is built in"));
    EXPECT_THAT(message_of([&] { s.scripts.define_fish("def sin\nend", deck("def sin\nend")); }),
                StartsWith("test.3ddat:1:1: error: 'sin' is built in and cannot be defined"));
}

TEST(ScriptErrors, HistoriesNeedNumbers) {
    Stage s;
    s.scripts.set("a", Value(std::string("much")));
    s.scripts.set("b", Value(true));
    EXPECT_EQ(message_of([&] { s.number("@a"); }), "error: 'a' is the text much, where a number is needed");
    EXPECT_EQ(s.number("@b"), 1);
    s.fish("def arr\n array v(3)\nend");
    s.scripts.call("arr");
    EXPECT_EQ(message_of([&] { s.value("@v"); }), "error: 'v' is an array, where one value is needed\n  a "
                                                  "value is a number, a text, a vector or a pointer");
}

TEST(ScriptErrors, AFailedDefinitionLeavesTheOldOne) {
    Stage s;
    s.fish("def f\n f = 1\nend");
    EXPECT_NE(message_of([&] { s.fish("def f\n f = (2\nend"); }), "no error");
    EXPECT_NE(message_of([&] { s.fish("def f\n sin = 2\nend"); }), "no error");
    EXPECT_EQ(s.value("f"), Value(std::int64_t{1}));
}

TEST(ScriptErrors, CommandsAndFunctionsThatCallEachOtherWithoutEnd) {
    Stage s;
    s.fish("def f\n command\n go\n endcommand\nend");
    s.world.on_command = [&](const std::string&) { s.scripts.call("@f"); };
    EXPECT_THAT(message_of([&] { s.scripts.call("@f"); }),
                HasSubstr("commands and functions call each other more than 50 levels deep"));
    s.world.on_command = nullptr;
    EXPECT_EQ(message_of([&] { s.scripts.call("@f"); }), "no error");
}

TEST(ScriptErrors, AnEndlessLoopCanBeStopped) {
    Stage s;
    s.fish("def f\n loop while 1\n n = n + 1\n if n = 1000\n  command\n  go\n  endcommand\n endif\n "
           "endloop\nend");
    s.world.on_command = [&](const std::string&) { s.scripts.interrupt(); };
    EXPECT_THAT(message_of([&] { s.scripts.call("@f"); }), HasSubstr("the script was stopped"));
    EXPECT_EQ(s.value("n"), Value(std::int64_t{1000}));
    s.lua("function safe() while true do pcall(function() command('go') while true do end end) end end");
    EXPECT_THAT(message_of([&] { s.lua("safe()"); }), HasSubstr("the script was stopped"));
}

TEST(ScriptErrors, LuaFields) {
    EXPECT_EQ(lua_message("for s in sub_contacts() do\n print(s.normal_farce)\nend"),
              "a sub_contact has no field 'normal_farce' | did you mean 'normal_force'?");
    EXPECT_EQ(lua_message("for s in sub_contacts() do print(s.cx_nforce) end"),
              "a sub_contact has no field 'cx_nforce' | in Lua it is called 'normal_force'");
    EXPECT_EQ(lua_message("for c in contacts() do c.id = 3 end"), "'id' of a contact can be read, not set");
    EXPECT_EQ(lua_message("for c in contacts() do c.idd = 3 end"), "a contact has no field 'idd' | did you mean 'id'?");
    EXPECT_EQ(lua_message("print(model.tyme)"), "the model has no field 'tyme' | did you mean 'time'?");
    EXPECT_EQ(lua_message("model.time = 3"), "'time' of the model can be read, not set");
    EXPECT_EQ(lua_message("for b in blocks() do b.velocity = print end"),
              "the new 'velocity' is a function, where one value is needed | a value is a number, a text, a "
              "vector or a pointer");
    EXPECT_EQ(lua_message("for b in blocks() do for s in b:sub_contacts() do end end"),
              "a block has no list of sub_contacts");
    EXPECT_EQ(lua_message("sum('sub_contact','norm')"),
              "sub_contact has no field 'norm' | did you mean 'normal_force'?");
    EXPECT_EQ(lua_message("sum('subcontact','norm')"),
              "there is no kind of object 'subcontact' | did you mean 'sub_contact'?");
}

TEST(ScriptErrors, LuaLanguage) {
    EXPECT_EQ(lua_message("x = = 3"), "unexpected symbol near '='");
    EXPECT_EQ(lua_message("while true do"), "'end' expected near <eof>");
    EXPECT_EQ(lua_message("local a\nprint(a.b)"),
              "'a' is nil here: it has no fields | the call or look-up that gave it found nothing");
    EXPECT_EQ(lua_message("prnt('x')"), "there is no function 'prnt' here | did you mean 'print'?");
    EXPECT_EQ(lua_message("stone = {}\nston.x = 3"), "'ston' is nil here: it has no fields | did you mean 'stone'?");
    EXPECT_EQ(lua_message("local y = 1 + lenght"),
              "'lenght' is nil here: nothing has set it | set it before, or test it: if value ~= nil then ... end");
    EXPECT_EQ(lua_message("local t = {}\nt[3].x = 1"), "this value is nil here: it has no fields | the call or "
                                                       "look-up that gave it found nothing");
    EXPECT_EQ(lua_message("x = string.formt('%d', 3)"), "there is no function 'formt' here | did you mean 'format'?");
    EXPECT_EQ(lua_message("for c in contacts do print(c) end"),
              "'contacts' takes no values | write: for x in contacts() do ... end");
    EXPECT_EQ(lua_message("print(contacts()[1])"), "a function has no fields or elements | objects are walked in "
                                                   "order: for b in blocks() do ... end");
    EXPECT_EQ(lua_message("print(#contacts())"),
              "a function has no length | objects are walked in order: for b in blocks() do ... end; "
              "count(\"block\") is their number");
    EXPECT_EQ(lua_message("local v = {size = 3}\nprint(v.size())"),
              "'size' is a number and not a function | write it without parentheses: .size");
    EXPECT_EQ(lua_message("print(vector(1,2,3)[1])"),
              "a vector has no element for the integer 1 | it has x, y, z, and the functions length(), unit(), dot(v), "
              "cross(v)");
    EXPECT_EQ(lua_message("coroutine.create(print)"), "'coroutine' of Lua is not available in decks");
    EXPECT_EQ(lua_message("error('my own')"), "my own");
    EXPECT_EQ(lua_message("error({})"), "the script stopped with a table as error value");
    EXPECT_EQ(lua_message("local v = vector(1,2,3)\nv.x = 3"),
              "the components of a vector cannot be set one by one | make a new one: v = vector(1, v.y, v.z)");
    EXPECT_EQ(
        lua_message("v = vector(1,2)"),
        "'vector' takes x, y and z, here it is given 2 values | write all three: vector(x, y, z); vector() is zero");
    EXPECT_EQ(lua_message("print(vector(1,2,3).w)"),
              "a vector has no 'w' | it has x, y, z, and the functions length(), unit(), dot(v), cross(v)");
    EXPECT_EQ(lua_message("hook.after_cycle(3)"), "hook.after_cycle needs a function, here it is given the integer 3");
    EXPECT_EQ(lua_message("hook.after_cycle(print, 0)"), "the interval of a hook is 0 | it counts cycles from 1 up");
    EXPECT_EQ(lua_message("fish.nothing = 3\nprint(fish.nothin)"),
              "there is no FISH variable or function 'nothin' | did you mean 'nothing'?");
    EXPECT_EQ(lua_message("fish.f = function() end"),
              "fish.f cannot hold a function | FISH can call every global function of Lua by its name");
}

TEST(ScriptErrors, TheSandboxIsClosed) {
    const std::string trust = " | run with --trust to allow it";
    EXPECT_EQ(lua_message("os.execute('ls')"), "os.execute cannot be used in a deck" + trust);
    EXPECT_EQ(lua_message("os.remove('x')"), "os.remove cannot be used in a deck" + trust);
    EXPECT_EQ(lua_message("io.popen('ls')"), "io.popen cannot be used in a deck" + trust);
    EXPECT_EQ(lua_message("package.loadlib('x', 'y')"), "package.loadlib cannot be used in a deck" + trust);
    EXPECT_EQ(lua_message("debug.getregistry()"), "debug.getregistry cannot be used in a deck" + trust);
    EXPECT_THAT(lua_message("io.open('/etc/passwd')"), HasSubstr("is outside of the folders"));
    EXPECT_THAT(lua_message("for l in io.lines('../x') do end"), HasSubstr("is outside of the folders"));
    EXPECT_EQ(lua_message("dofile('x')"), "'dofile' of Lua is not available in decks");
    EXPECT_EQ(lua_message("assert(load('\\27Lua') == nil)"), "no error"); // no bytecode
    EXPECT_EQ(lua_message("assert(_G.os == os and _G._G == _G)"), "no error");
    EXPECT_EQ(lua_message("assert(load('return os')() == os)"), "no error");
    EXPECT_EQ(lua_message("assert(getmetatable('') == false and string.dump == nil)"), "no error");
    EXPECT_EQ(lua_message("local c = nearest('contact', 0, 0, 0)\nassert(getmetatable(c) == false)"), "no error");
    EXPECT_EQ(lua_message("setmetatable({}, {__gc = print})"),
              "a metatable with __gc cannot be used in a deck | leave __gc out");
    EXPECT_EQ(lua_message("local _, e = pcall(function() return model.x end)\nassert(getmetatable(e) == false)"),
              "no error");
    EXPECT_EQ(lua_message("require '../x'"), "'../x' is not the name of a module | a name has letters, "
                                             "digits, '_' and '-'; a point stands for a folder");
    EXPECT_EQ(lua_message("require 'nowhere'"),
              "there is no module 'nowhere' | it would be the file nowhere.lua next to the deck");
    EXPECT_EQ(lua_message("require 'library'"),
              "there is no module 'library' | it would be the file library.lua next to the deck");
}

TEST(ScriptErrors, ATrustedDeckMayDoAll) {
    Options options;
    options.trusted = true;
    Stage s(2, 4, options);
    s.lua("assert(os.getenv and io.popen and debug.getinfo)\nlocal f = "
          "io.open('/dev/null')\nassert(f)\nf:close()");
}

TEST(ScriptErrors, AMissingLuaFile) {
    Stage s;
    EXPECT_EQ(message_of([&] { s.scripts.run_lua_file("nowhere.lua", deck("lua nowhere.lua\n")); }),
              "test.3ddat:1:1: error: the Lua file 'nowhere.lua' cannot be read: No such file or directory\n"
              "     1 | lua nowhere.lua\n"
              "       | ^ the path counts from the working folder");
}

} // namespace
} // namespace kaya::script::test
