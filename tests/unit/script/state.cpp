// Saving and restoring the complete state of scripts.
#include "fake_world.hpp"

#include <gmock/gmock.h>

namespace kaya::script::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A stage with values of every kind.
void fill(Stage& s) {
    s.fish("def setup\n array grid(2,3) row(2)\n grid(2,1) = 'wall'\n row(1) = grid\n n = 5\n x = 0.1\n name "
           "= 'a ''b'''\n"
           " v = vector(1,2,3)\n c = contact_head\n c_extra(c) = 77\n table(2, 1.5) = 4\n other = row\nend");
    s.fish("def watch\n whilestepping\n n = n + urand\nend");
    s.lua("function double(a) return 2 * a end\nsettings = { depth = 3, names = { 'a', 'b' }, deep = { flag "
          "= true } }\n"
          "settings.self = settings\nfunction settings.describe() return settings.depth end\n"
          "hook.after_forces(function() settings.depth = settings.depth + 1 end)");
    s.lua("command 'poly brick'\nfor b in blocks() do b.velocity = vector(9, 9, 9) "
          "end\nhistory.add(double)\nprint('made')");
    s.lua("only_a_calculation = 12");
    s.scripts.call("@setup");
    s.lua("settings.depth = 10\nsettings.names[3] = 'c'");
}

TEST(ScriptState, ACopyGoesOnAsTheOriginalWould) {
    Stage first;
    fill(first);
    for (int i = 1; i <= 3; ++i) first.scripts.run_hooks(Moment::after_cycle, i);

    Stage second;
    second.scripts.restore(from_bytes(to_bytes(first.scripts.state())));
    EXPECT_EQ(to_bytes(second.scripts.state()), to_bytes(first.scripts.state()));
    for (Stage* s : {&first, &second}) {
        for (int i = 4; i <= 6; ++i) {
            s->scripts.run_hooks(Moment::after_forces, i);
            s->scripts.run_hooks(Moment::after_cycle, i);
        }
        EXPECT_EQ(s->text("[grid(2,1)]"), "wall");
        EXPECT_EQ(s->value("v"), Value(Vec3(1, 2, 3)));
        EXPECT_EQ(s->value("[c_extra(c)]"), Value(std::int64_t{77}));
        EXPECT_EQ(s->number("table(2, 1.5)"), 4);
        EXPECT_EQ(s->text("name"), "a 'b'");
        EXPECT_EQ(s->number("@double(4)"), 8);
        s->lua("assert(settings.depth == 13 and settings.describe() == 13 and settings.self == settings)\n"
               "assert(settings.names[3] == 'c' and settings.deep.flag and only_a_calculation == 12)");
    }
    EXPECT_EQ(first.number("n"), second.number("n"));
    EXPECT_EQ(to_bytes(first.scripts.state()), to_bytes(second.scripts.state()));
}

TEST(ScriptState, RestoringChangesNeitherTheModelNorTheScreen) {
    Stage first;
    fill(first);
    EXPECT_EQ(first.world.commands.size(), 2);
    Stage second;
    second.scripts.restore(first.scripts.state());
    EXPECT_TRUE(second.world.commands.empty());
    EXPECT_TRUE(second.printed.empty());
    EXPECT_EQ(second.world.velocity, Vec3::Zero());
    second.lua("command 'go'\nprint('here')"); // afterwards all functions work again
    EXPECT_EQ(second.world.commands.size(), 1);
    EXPECT_THAT(second.printed, ElementsAre("here"));
}

TEST(ScriptState, TwoNamesOfOneArrayStayOneArray) {
    Stage first;
    first.fish("def f\n array a(2)\n b = a\nend");
    first.scripts.call("f");
    Stage second;
    second.scripts.restore(first.scripts.state());
    second.value("[a(1) = 6]");
    EXPECT_EQ(second.value("[b(1)]"), Value(std::int64_t{6}));
}

TEST(ScriptState, AChunkInALoopIsKeptOnce) {
    Stage s;
    for (int i = 0; i < 10; ++i) s.lua("function f() return 1 end");
    EXPECT_EQ(s.scripts.state().sources.size(), 1);
    for (int i = 0; i < 3; ++i) s.lua("hook.after_cycle(f)");
    EXPECT_EQ(s.scripts.state().sources.size(), 4);
}

TEST(ScriptState, TheSameWorkGivesTheSameBytes) {
    Stage a, b;
    fill(a);
    fill(b);
    EXPECT_EQ(to_bytes(a.scripts.state()), to_bytes(b.scripts.state()));
    a.scripts.set("n", Value(std::int64_t{6}));
    EXPECT_NE(to_bytes(a.scripts.state()), to_bytes(b.scripts.state()));
}

TEST(ScriptState, LinesOfRestoredFunctionsAreThoseOfTheDeck) {
    Stage first;
    const std::string text = "def f\n f = 1 / zero\nend\n";
    first.scripts.define_fish(text, deck("\n\n\n\n" + text, 5));
    Stage second;
    second.scripts.restore(first.scripts.state());
    EXPECT_EQ(message_of([&] { second.scripts.call("f"); }), message_of([&] { first.scripts.call("f"); }));
    EXPECT_THAT(message_of([&] { second.scripts.call("f"); }), HasSubstr("test.3ddat:6:2: error: division by zero"));
}

TEST(ScriptState, ClearForgetsEverything) {
    Stage s;
    fill(s);
    s.scripts.clear();
    EXPECT_FALSE(s.scripts.knows("n"));
    EXPECT_FALSE(s.scripts.knows("watch"));
    EXPECT_FALSE(s.scripts.has_hooks(Moment::after_cycle));
    EXPECT_TRUE(s.scripts.tables().empty());
    EXPECT_TRUE(s.scripts.symbols().empty());
    s.lua("assert(settings == nil)\nprint('still here')");
    EXPECT_EQ(s.printed.back(), "still here");
}

TEST(ScriptState, AFunctionOutlivesTheModelThatItThrowsAway) {
    Stage s;
    s.fish(
        "def f\n p = contact_head\n c_extra(p) = 5\n n = 1\n command\n new\n endcommand\n n = n + 1\n q = contact_head\n x = c_extra(q)\nend");
    s.scripts.tables()[3].set(1, 2);
    s.world.on_command = [&](const std::string&) {
        EXPECT_TRUE(s.scripts.running());
        s.scripts.refuse_while_awaited("new");
        s.scripts.change_model();
    };
    s.scripts.call("f");
    EXPECT_FALSE(s.scripts.running());
    EXPECT_EQ(s.scripts.value("n"), Value(std::int64_t{2}));
    EXPECT_EQ(s.scripts.value("x"), Value(std::int64_t{0})); // it belonged to an object of the deleted model
    EXPECT_EQ(s.scripts.tables().at(3).points().size(), 1u);
    // The old pointer has the row of an object in the new model, but is not valid for it.
    const auto old = std::get<Handle>(s.scripts.value("p")), present = std::get<Handle>(s.scripts.value("q"));
    EXPECT_EQ(old.slot, present.slot);
    EXPECT_NE(old.model, present.model);
    // A save file does not confuse them either: the old pointer is saved as null.
    Stage other;
    other.scripts.restore(from_bytes(to_bytes(s.scripts.state())));
    EXPECT_EQ(other.scripts.value("p"), Value(std::int64_t{0}));
    EXPECT_TRUE(std::holds_alternative<Handle>(other.scripts.value("q")));
}

TEST(ScriptState, WhatACommandWaitsForCannotChangeTheModel) {
    Stage s;
    s.fish("def f\n command\n new\n endcommand\n f = 1\nend");
    s.world.on_command = [&](const std::string&) { s.scripts.refuse_while_awaited("new"); };
    EXPECT_EQ(message_of([&] { s.scripts.call("f"); }), "no error");
    EXPECT_THAT(message_of([&] { s.scripts.value("f"); }), HasSubstr("'new' cannot be given here"));
    EXPECT_THAT(message_of([&] { s.scripts.number("f"); }), HasSubstr("'new' cannot be given here"));
    s.scripts.add_fish_hook("f", Moment::after_cycle, 0, 1, {});
    EXPECT_THAT(message_of([&] { s.scripts.run_hooks(Moment::after_cycle, 1); }),
                HasSubstr("'new' cannot be given here"));
}

TEST(ScriptState, OfASavedModelComesWhatBelongsToObjectsAndMissingTables) {
    Stage first;
    first.lua("n = 7");
    first.fish("def f\n c_extra(contact_head) = 5\n n = 7\nend");
    first.scripts.call("f");
    first.scripts.tables()[1].set(0, 1);
    first.scripts.tables()[2].set(0, 1);
    const ScriptState saved = first.scripts.state();
    Stage s;
    s.fish("def g\n g = c_extra(contact_head)\nend\n");
    s.fish("def h\n n = 1\nend");
    s.scripts.call("h");
    s.scripts.tables()[1].set(0, 9);
    s.scripts.change_model(&saved);
    EXPECT_EQ(s.scripts.value("g"), Value(std::int64_t{5}));
    EXPECT_EQ(s.scripts.value("n"), Value(std::int64_t{1}));
    EXPECT_FALSE(s.scripts.knows("f"));
    EXPECT_EQ(s.scripts.tables().at(1).at(0), 9);
    EXPECT_EQ(s.scripts.tables().at(2).at(0), 1);

    ScriptState damaged = saved;
    damaged.extras = {{"c_extra", ObjectReference{99}}};
    EXPECT_THAT(message_of([&] { s.scripts.change_model(&damaged); }), HasSubstr("damaged"));
    EXPECT_EQ(s.scripts.value("g"), Value(std::int64_t{5})); // unchanged
}

TEST(ScriptState, DamagedBytesAreRefusedWhereverTheyEnd) {
    Stage s;
    fill(s);
    const std::string bytes = to_bytes(s.scripts.state());
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_THROW(from_bytes(bytes.substr(0, size)), Diagnostic) << size;
    EXPECT_THAT(message_of([&] { from_bytes(bytes + "x"); }), HasSubstr("left over"));
    EXPECT_THAT(message_of([&] { from_bytes("something else"); }), HasSubstr("these are not saved scripts"));
    std::string newer = bytes;
    newer[10] = 9;
    EXPECT_THAT(message_of([&] { from_bytes(newer); }),
                HasSubstr("saved in version 9; this program reads versions 3 to 5"));
}

TEST(ScriptState, HooksOfVersion4GetTheLocationOfTheirMoment) {
    ScriptState state;
    state.hooks = {{.function = "f", .moment = 0, .location = 20}};
    std::string bytes = to_bytes(state);
    EXPECT_EQ(from_bytes(bytes).hooks.at(0).location, 20);
    // Behind the location come the number of tables, four words of random numbers, and a truth.
    bytes.erase(bytes.size() - 1 - 4 * 8 - 8 - 8, 8);
    bytes[10] = 4;
    EXPECT_EQ(from_bytes(bytes).hooks.at(0).location, 1);
}

TEST(ScriptState, ChangedBytesEndInAMessageOrAStateNeverInACrash) {
    Stage s;
    fill(s);
    const std::string bytes = to_bytes(s.scripts.state());
    int refused = 0;
    for (std::size_t i = 14; i < bytes.size(); i += 3) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
        Stage other;
        refused += message_of([&] { other.scripts.restore(from_bytes(changed)); }) != "no error";
    }
    EXPECT_GT(refused, 50);
}

TEST(ScriptState, ObjectsThatCannotBeAreRefused) {
    const auto refusal = [](const StoredObject& object) {
        ScriptState state;
        state.objects = {object};
        state.lua_globals = {{"t", ObjectReference{0}}};
        Stage s;
        return message_of([&] { s.scripts.restore(state); });
    };
    const StoredValue one = std::int64_t{1};
    EXPECT_EQ(refusal({{}, {one}, {one}}), "no error");
    EXPECT_THAT(refusal({{}, {StoredValue()}, {one}}), HasSubstr("damaged"));
    EXPECT_THAT(refusal({{}, {std::nan("")}, {one}}), HasSubstr("damaged"));
    EXPECT_THAT(refusal({{}, {one}, {ObjectReference{7}}}), HasSubstr("damaged"));
    EXPECT_THAT(refusal({{2, 2}, {}, {one}}), HasSubstr("damaged"));
    EXPECT_THAT(refusal({{-1}, {}, {one}}), HasSubstr("damaged"));
}

TEST(ScriptState, HandlesOfTablesThatNoModelHasAreRefused) {
    for (const Handle handle :
         {Handle{40, 1, 1}, Handle{-1, 1, 1}, Handle{3, 1, 1}, Handle{0, 1u << 28, 1}, Handle{0, 1, 1u << 30}}) {
        ScriptState state;
        state.lua_globals = {{"p", handle}};
        Stage s;
        EXPECT_THAT(message_of([&] { s.scripts.restore(state); }), HasSubstr("damaged"))
            << handle.table << " " << handle.slot;
        state.lua_globals = {{"t", ObjectReference{0}}};
        state.objects.push_back({{}, {handle}, {std::int64_t{1}}});
        EXPECT_THAT(message_of([&] { s.scripts.restore(state); }), HasSubstr("damaged")) << "as a key";
    }
    ScriptState state;
    state.lua_globals = {{"p", Handle{2, 1, 1}}};
    Stage s;
    EXPECT_EQ(message_of([&] { s.scripts.restore(state); }), "no error");
}

TEST(ScriptState, LinesThatWouldFillTheMemoryAreRefused) {
    ScriptState state;
    for (int i = 0; i < 3; ++i)
        state.sources.push_back({StoredSource::Kind::lua, "", "deck" + std::to_string(i), 4'000'000, "x = 1"});
    Stage s;
    EXPECT_THAT(message_of([&] { s.scripts.restore(state); }), HasSubstr("damaged"));
}

TEST(ScriptState, AChunkThatFailsWhenItRunsAgainSaysSo) {
    ScriptState state;
    state.sources.push_back({StoredSource::Kind::lua, "", "old.3ddat", 3, "error('gone')"});
    Stage s;
    EXPECT_EQ(message_of([&] { s.scripts.restore(state); }),
              "old.3ddat:3:1: error: gone\n     3 | error('gone')\n       | ^^^^^^^^^^^^^\n  in a Lua chunk, "
              "old.3ddat:3\n"
              "  while the scripts of the saved model were defined again");
    s.lua("command 'go'");
    EXPECT_EQ(s.world.commands.size(), 1);
}

} // namespace
} // namespace kaya::script::test
